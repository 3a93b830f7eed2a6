"""The paper's Tables 7 and 9, which need the weights of a published network."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from texvent.errors import InputError
from texvent.metrics.image_measures import load_measures
from texvent_lab.bench.classification.classify import classify, list_samples
from texvent_lab.bench.classification.resnet34 import ResNetClassifier
from texvent_lab.bench.classification.resnet34_weights import read_resnet_weights
from texvent_lab.bench.paper.published_tables import IMAGE_ROWS, TABLES, OurFigures
from texvent_lab.bench.progress import Progress
from texvent_lab.bench.real.frame_recording import FrameRecording
from texvent_lab.bench.reconstruction.image_scores import ImageScores, pool_scores
from texvent_lab.bench.reconstruction.noise_robustness import PAPER_LEVELS, noise_curve
from texvent_lab.bench.reconstruction.run import ReconstructionPlan, ReconstructionScorer
from texvent_lab.reconstruct.reconstructor import Reconstructor


def noise_figures(
    recordings: Sequence[FrameRecording], reconstructor: Reconstructor, *, progress: Progress
) -> OurFigures:
    """Table 7: images from perturbed events against those from the unperturbed ones.

    Args:
        recordings: frames and events.
        reconstructor: the network.
        progress: told of every step.
    """
    measures = load_measures()
    scorer = ReconstructionScorer(
        reconstructor=reconstructor, measures=measures, plan=ReconstructionPlan(entries=())
    )
    parts: dict[str, list[ImageScores]] = {column: [] for column in TABLES[7].columns}
    for recording in recordings:
        progress(f"{recording.name}: noise curve")
        scores = noise_curve(recording, scorer, PAPER_LEVELS)
        for column, score in zip(TABLES[7].columns, scores, strict=True):
            parts[column].append(score.against_clean)
    pooled = {column: pool_scores(found) for column, found in parts.items()}
    figures = {
        title: {column: f"{one.mean(measure):.4f}" for column, one in pooled.items()}
        for title, measure in IMAGE_ROWS.items()
        if measure not in measures.absent
    }
    notes = [
        f"{reconstructor.name} on {', '.join(one.name for one in recordings)}; a perturbed event "
        "is moved to a random place, which the paper leaves open, and images are compared with "
        "those from the unperturbed events"
    ]
    return OurFigures(figures, notes, [f"{name}: {why}" for name, why in measures.absent.items()])


def accuracy_figures(
    folder: Path, weights: Path, *, classes: Path | None, progress: Progress
) -> OurFigures:
    """Table 9: top-1 and top-5 of folders of streams, one per column of the table.

    Args:
        folder: holds a sub-folder per column (`original`, `vid2e` ... `texvent`), each with a
            sub-folder per class.
        weights: N-ImageNet's classifier.
        classes: names of the classes in the network's order; see `classify.list_samples`.
        progress: told of every step.

    Raises:
        InputError: no sub-folder has a column's name.
    """
    classifier = ResNetClassifier(read_resnet_weights(weights))
    named = {one.name.lower(): one for one in folder.iterdir() if one.is_dir()}
    found: dict[str, dict[str, str]] = {title: {} for title in TABLES[9].rows}
    absent = []
    for column in TABLES[9].columns:
        place = named.get(column.lower())
        if place is None:
            absent.append(column.lower())
            continue
        progress(f"classifying {place}")
        accuracy = classify(
            list_samples(place, classifier.class_count, classes=classes), classifier
        )
        for title, share in zip(found, (accuracy.top1, accuracy.top5), strict=True):
            found[title][column] = f"{share:.4f}"
    if len(absent) == len(TABLES[9].columns):
        raise InputError(
            f"{folder} has no sub-folder of Table 9's columns; name them {', '.join(absent)}"
        )
    needs = [f"folders {', '.join(absent)} in {folder}"] if absent else []
    return OurFigures(found, needs=needs)
