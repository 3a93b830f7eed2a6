"""The paper's tables with measurements of this machine beside them."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from texvent.errors import InputError, TexventError
from texvent.generate.procedural import ProceduralConfig, ProceduralGenerator
from texvent.metrics.compare import load_metric
from texvent.metrics.image_measures import load_measures
from texvent.metrics.protocol import Metric
from texvent.sensor import SENSORS
from texvent.video import Video
from texvent_lab.bench.classification import (
    classify,
    list_samples,
    read_resnet,
)
from texvent_lab.bench.fidelity.comparison import difference_text
from texvent_lab.bench.fidelity.entries import Entry, simulate_video
from texvent_lab.bench.fidelity.results import FidelityReport
from texvent_lab.bench.jobs import Progress
from texvent_lab.bench.paper.config_entry import ConfigEntry
from texvent_lab.bench.paper.published_tables import IMAGE_ROWS, TABLES, OurFigures
from texvent_lab.bench.real.recording import FrameRecording, RealScene
from texvent_lab.bench.real.run import RealPlan, run_real
from texvent_lab.bench.reconstruction.noise_robustness import PAPER_LEVELS, noise_curve
from texvent_lab.bench.reconstruction.run import (
    ReconstructionPlan,
    ReconstructionScorer,
    run_reconstruction,
)
from texvent_lab.bench.reconstruction.scores import ImageScores, pool_scores
from texvent_lab.reconstruct.reconstructor import Reconstructor

BASELINE = "Texvent"
TABLES_HERE = (4, 5)
EQS_NEED = (
    "EQS itself: it needs RVT's weights, and streams of N-ImageNet and streams simulated from "
    "their captions, which no one publishes"
)


def leave_out_other_tables(number: int, entries: Sequence[ConfigEntry]) -> list[ConfigEntry]:
    """The rows of Table 4 or 5, and the user's own; not those of the other of the two."""
    others = {column for table in TABLES_HERE for column in TABLES[table].columns}
    return [one for one in entries if one.name not in others - set(TABLES[number].columns)]


def ablation_figures(number: int, report: FidelityReport) -> OurFigures:
    """STPP of the rows of Table 4 or 5, and its paired difference to the paper's own setting.

    Args:
        number: 4 or 5.
        report: a run of the files in configs/paper, on scenes, on recordings, or both.
    """
    figures: dict[str, dict[str, str]] = {}
    for reference in report.references:
        scores = {one.entry: one for one in report.ranked(reference.scene, reference.target)}
        baseline = scores.get(BASELINE)
        stpp: dict[str, str] = {}
        difference: dict[str, str] = {}
        compared = report.comparison(reference)
        against = compared.differences(BASELINE) if baseline and compared.is_enough else None
        for column in TABLES[number].columns:
            if column not in scores:
                continue
            score = scores[column]
            lost = " (count not reached)" if score.threshold and not score.is_matched else ""
            stpp[column] = f"{score.summary('stpp').mean:.3f}{lost}"
            if baseline is None or column == BASELINE:
                continue
            if against is not None:
                difference[column] = difference_text(against[column], sign="+")
            else:
                found = score.difference("stpp", baseline)
                difference[column] = f"{found.mean:+.3f} ± {found.standard_error:.3f}"
        figures[f"STPP ↑, {reference.title}"] = stpp
        figures[f"− {BASELINE}, {reference.title}"] = difference
    return OurFigures(figures, needs=[EQS_NEED])


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
    classifier = read_resnet(weights)
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


ENTRIES: Mapping[str, Entry] = {
    "VID2E": Entry(simulator="esim", interpolate="flow"),
    "V2E": Entry(simulator="v2e", interpolate="flow"),
    "V2CE": Entry(simulator="v2ce", interpolate="none"),
    "DVS-Voltmeter": Entry(simulator="voltmeter", interpolate="none"),
    "SENPI": Entry(simulator="senpi", interpolate="none"),
    "Texvent": Entry(simulator="texvent", preset="paper", interpolate="flow"),
}
"""Column of the paper → its counterpart here. Those that come with a network for interpolation
get motion compensation, as Texvent does; the others get the frames alone."""
OWN_MODELS = "the other simulators are texvent's models of them; docs/simulators.md says how close"
EVENT_FRAMES = {"MSE ↓": "ef_mse", "SSIM ↑": "ef_ssim", "LPIPS ↓": "ef_lpips"}
PROMPT = "a red car drives left past two trees at dusk"
TIMED_PAIRS, REPEATS = 12, 3


def event_frame_figures(
    scenes: Sequence[RealScene], *, is_rate_matched: bool, jobs: int, progress: Progress
) -> OurFigures:
    """Table 1, event frames: MSE, SSIM and, where its weights are, LPIPS.

    Args:
        scenes: recordings with frames.
        is_rate_matched: fit each δ to the recorded number of events; else presets keep theirs.
        jobs: processes to use.
        progress: told of every step.
    """
    missing = {name: load_metric(name).missing() for name in EVENT_FRAMES.values()}
    metrics = ["stpp", *(name for name, reason in missing.items() if reason is None)]
    report = _run(scenes, metrics, is_rate_matched=is_rate_matched, jobs=jobs, progress=progress)
    figures = {
        f"event frames: {title}": _means(report, name)
        for title, name in EVENT_FRAMES.items()
        if name in metrics
    }
    notes = [f"recordings: {', '.join(scene.name for scene in scenes)}", OWN_MODELS]
    needs = [f"{name}: {reason}" for name, reason in missing.items() if reason is not None]
    return OurFigures(figures, notes, [*needs, *_skipped(report)])


def eqs_figures(
    scenes: Sequence[RealScene],
    eqs: Metric,
    *,
    is_rate_matched: bool,
    jobs: int,
    progress: Progress,
) -> OurFigures:
    """Table 2, first row: EQS against the recording of the same scene.

    Args:
        scenes: recordings with frames.
        eqs: the metric, with RVT's published weights.
        is_rate_matched: fit each δ to the recorded number of events; else presets keep theirs.
        jobs: processes to use.
        progress: told of every step.
    """
    report = _run(scenes, [eqs], is_rate_matched=is_rate_matched, jobs=jobs, progress=progress)
    notes = [
        f"EQS against recordings of the same scene ({', '.join(one.name for one in scenes)}); the "
        "paper compares with other recordings of the same class",
        OWN_MODELS,
    ]
    return OurFigures({"EQS ↑": _means(report, "eqs")}, notes, _skipped(report))


def time_figures(progress: Progress) -> OurFigures:
    """Table 2, second row: seconds per pair of 346x260 frames, interpolation included."""
    video = _timed_clip()
    found: dict[str, str] = {}
    needs: list[str] = []
    for column, entry in ENTRIES.items():
        progress(f"time: {entry.name}")
        try:
            found[column] = f"{_seconds_per_pair(video, entry):.4f}"
        except TexventError as error:
            needs.append(f"{column}: {error}")
    notes = [
        f"time: best of {REPEATS} runs over {TIMED_PAIRS} pairs of 346x260 frames of a scene of "
        "the embedded generator on this machine's processor, interpolation included; the paper "
        "used an H100. The programs themselves, installed by package name, are timed by "
        "lab/src/texvent_lab/measure/speed",
    ]
    return OurFigures({"time, s": found}, notes, needs)


def image_figures(
    recordings: Sequence[FrameRecording],
    reconstructor: Reconstructor,
    *,
    prefix: str,
    is_rate_matched: bool,
    progress: Progress,
) -> OurFigures:
    """Tables 1 and 8: images that a network makes of the events, against the true frames.

    Args:
        recordings: frames and events.
        reconstructor: the network.
        prefix: before the names of the rows, as "images: " in Table 1.
        is_rate_matched: fit each δ to the recorded number of events; else presets keep theirs.
        progress: told of every step.
    """
    plan = ReconstructionPlan(entries=tuple(ENTRIES.values()), is_rate_matched=is_rate_matched)
    scorer = ReconstructionScorer(reconstructor=reconstructor, measures=load_measures(), plan=plan)
    report = run_reconstruction(recordings, scorer, progress=progress)
    figures: dict[str, dict[str, str]] = {}
    for title, measure in IMAGE_ROWS.items():
        if measure in report.absent:
            continue
        figures[f"{prefix}{title}"] = {
            column: f"{pool_scores(row.scores for row in rows).mean(measure):.3f}"
            for column, entry in ENTRIES.items()
            if (rows := report.rows_of(entry.name))
        }
    notes = [
        f"images by {report.network} from {', '.join(one.name for one in recordings)}",
        OWN_MODELS,
    ]
    needs = [*(f"{name}: {why}" for name, why in report.absent.items())]
    needs += [f"{name}: {why}" for name, why in report.skipped.items()]
    return OurFigures(figures, notes, needs)


def _run(
    scenes: Sequence[RealScene],
    metrics: Sequence[str | Metric],
    *,
    is_rate_matched: bool,
    jobs: int,
    progress: Progress,
) -> FidelityReport:
    entries = [replace(entry, is_rate_matched=is_rate_matched) for entry in ENTRIES.values()]
    plan = RealPlan(metrics=metrics, entries=entries)
    return run_real(scenes, plan, jobs=jobs, progress=progress)


def _means(report: FidelityReport, metric: str) -> dict[str, str]:
    """Mean over recordings and their spans, per column."""
    found: dict[str, str] = {}
    for column, entry in ENTRIES.items():
        scores = [one for one in report.scores if one.entry == entry.name]
        if scores:
            found[column] = f"{np.mean([one.summary(metric).mean for one in scores]):.3f}"
    return found


def _skipped(report: FidelityReport) -> list[str]:
    return [f"{name}: {why}" for name, why in report.skipped.items()]


def _timed_clip() -> Video:
    """A video in memory, so that rendering is not timed."""
    generator = ProceduralGenerator(
        ProceduralConfig(duration=TIMED_PAIRS / 24), size=SENSORS["davis346"].size
    )
    frames = list(generator.generate(PROMPT))
    levels = np.stack([np.rint(frame.luma).astype(np.uint8) for frame in frames])
    return Video(levels, [frame.t_us for frame in frames])


def _seconds_per_pair(video: Video, entry: Entry) -> float:
    settings = entry.settings(0)
    simulate_video(video, settings, None)  # kernels are compiled and loaded
    seconds = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        simulate_video(video, settings, None)
        seconds.append(time.perf_counter() - start)
    return min(seconds) / (len(video) - 1)
