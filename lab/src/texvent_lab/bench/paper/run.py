"""The paper's tables, measured with the inputs at hand."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from texvent.errors import InputError, MissingDependencyError, TexventError
from texvent.frames import Video
from texvent.metrics.compare import load_metric
from texvent.metrics.controls import CONTROLS, run_controls
from texvent.metrics.latent_similarity import EventQualityScore, load_eqs
from texvent.metrics.protocol import Metric
from texvent.run.prepare import prepare_video
from texvent.sensor import SENSORS
from texvent_lab.bench.fidelity.entries import (
    Entry,
    missing_rife,
)
from texvent_lab.bench.fidelity.event_files import FileEntry
from texvent_lab.bench.fidelity.results import FidelityReport
from texvent_lab.bench.jobs import Progress
from texvent_lab.bench.paper.augmentation import (
    measure_augmented_reconstruction,
    measure_recognition,
)
from texvent_lab.bench.paper.config import PaperConfig
from texvent_lab.bench.paper.published_tables import IMAGE_ROWS, TABLES, Measured, join_measured
from texvent_lab.bench.real.recording import RealScene, open_scene
from texvent_lab.bench.real.run import run_real
from texvent_lab.bench.reconstruction.run import (
    ReconstructionPlan,
    ReconstructionScorer,
    noise_curve,
    run_reconstruction,
)
from texvent_lab.bench.reconstruction.scores import pool_scores
from texvent_lab.frame_recordings import recording_name
from texvent_lab.reconstruct.image_measures import load_measures
from texvent_lab.reconstruct.reconstructor import Reconstructor, load_reconstructor
from texvent_lab.train.classification.config import (
    ClassData,
    ClassificationConfig,
    ClassNetwork,
)
from texvent_lab.train.schedule import Hardware
from texvent_scenes.procedural import ProceduralConfig, ProceduralGenerator

NETWORKS = {1: "e2vid", 7: "e2vid", 8: "pie-net"}
"""Table → network: the paper's, but for Table 8, whose ET-Net PIE-Net replaces."""
STAND_IN = "pie-net"
"""Network where no one is named and the table's own has no weights here."""
ENTRIES: Mapping[str, Entry] = {
    "VID2E": Entry(simulator="esim", interpolate="flow"),
    "V2E": Entry(simulator="v2e", interpolate="flow"),
    "V2CE": Entry(simulator="v2ce", interpolate="none"),
    "DVS-Voltmeter": Entry(simulator="voltmeter", interpolate="none"),
    "SENPI": Entry(simulator="senpi", interpolate="none"),
    "Texvent": Entry(simulator="texvent", preset="paper", interpolate="rife", rife_flow="each"),
}
"""Column of the paper → its counterpart here. Those that come with a network for interpolation
get motion compensation; the others get the frames alone. `find_columns` has those that can run."""
CLASSIFIER = ClassNetwork(name="resnet34", representation="binary-event-image")
"""N-ImageNet's published classifier."""
OWN_MODELS = (
    "the other simulators are texvent's models of them; docs/simulators.md of its repository says "
    "how close"
)
EVENT_FRAMES = {"MSE ↓": "ef_mse", "SSIM ↑": "ef_ssim", "LPIPS ↓": "ef_lpips"}
PROMPT = "a red car drives left past two trees at dusk"
TIMED_PAIRS, REPEATS = 12, 3


def measure_table(config: PaperConfig, progress: Progress) -> Measured:
    """Values of one table, and what is missing for the rest.

    Args:
        config: of any table but 4 and 5; `measure_ablations` has 4 and 5.
        progress: told of every step.

    Raises:
        InputError, FileFormatError: an input that was named is missing or damaged.
        ConfigError: the network does not exist.
    """
    if config.table == 3:
        return measure_augmented_reconstruction(config, progress)
    if config.table == 6:
        return measure_recognition(config, progress)
    if config.table == 9:
        return measure_accuracy(config, progress)
    find_columns(config)  # what is missing is named before any work
    if config.table == 2:
        return join_measured(
            [measure_times(config, progress), measure_eqs(config, progress), interpolation(config)]
        )
    if not config.sources:
        return Measured(
            needs=["anything; texvent data pull slider_depth, or --recordings with a recording"]
        )
    found = [] if config.table == 7 else [interpolation(config)]
    if config.table == 1:
        scenes = [open_scene(source) for source in config.sources]
        found.append(measure_event_frames(scenes, config, progress))
    return join_measured([*found, *measure_by_network(config, progress)])


def measure_by_network(config: PaperConfig, progress: Progress) -> list[Measured]:
    """Tables 1, 7 and 8 by the network that is named, else by the paper's or its stand-in."""
    measure = measure_noise if config.table == 7 else measure_images
    names = [config.network] if config.network else [NETWORKS[config.table or 1], STAND_IN]
    absent: list[Measured] = []
    for name in dict.fromkeys(names):
        try:
            network = load_reconstructor(name, config.weights)
        except (InputError, MissingDependencyError) as error:
            if config.weights is not None:
                raise
            absent.append(Measured(needs=[f"images by {name}; {error}"]))
        else:
            return [*absent, measure(config, network, progress)]
    return absent


def find_columns(config: PaperConfig) -> dict[str, Entry]:
    """Column → its simulator, Texvent's by flow where RIFE cannot run, or files of the program.

    Raises:
        InputError: a folder of such files lacks a recording.
    """
    names, given = [recording_name(one) for one in config.sources], config.event_folders.items()
    return {
        **{column: entry.or_flow(rife=config.rife) for column, entry in ENTRIES.items()},
        **{one: FileEntry.find(one, folder, names) for one, folder in given},
    }


def interpolation(config: PaperConfig) -> Measured:
    """A note: the interpolator of the rows of Texvent."""
    reason = missing_rife() if config.rife else "--no-rife was given"
    if reason is None:
        return Measured(notes=["Texvent interpolates by RIFE at every instant, as in the paper"])
    return Measured(notes=[f"Texvent interpolates by flow, not by the paper's RIFE: {reason}"])


def measure_event_frames(
    scenes: Sequence[RealScene], config: PaperConfig, progress: Progress
) -> Measured:
    """Table 1, event frames: MSE, SSIM and, where its weights are, LPIPS."""
    missing = {name: load_metric(name).missing() for name in EVENT_FRAMES.values()}
    metrics = ["stpp", *(name for name, reason in missing.items() if reason is None)]
    report = _run(scenes, metrics, config, progress)
    rows = {
        f"event frames: {title}": _means(report, name, config)
        for title, name in EVENT_FRAMES.items()
        if name in metrics
    }
    notes = [f"recordings: {', '.join(scene.scene for scene in scenes)}", *_origins(config)]
    needs = [f"{name}: {reason}" for name, reason in missing.items() if reason is not None]
    return Measured(rows, notes, [*needs, *_reasons(report.skipped)])


def measure_eqs(config: PaperConfig, progress: Progress) -> Measured:
    """Table 2, first row: EQS against the recording of the same scene, with its controls."""
    if config.rvt_weights is None or not config.sources:
        return Measured(
            needs=[
                "EQS; --rvt-weights FILE (docs/metrics.md of texvent's repository says where it "
                "comes from, and how one is trained here) and a recording, such as texvent data "
                "pull slider_depth"
            ]
        )
    eqs = load_eqs(config.rvt_weights)
    scenes = [open_scene(source) for source in config.sources]
    report = _run(scenes, [eqs], config, progress)
    notes = [
        f"EQS against recordings of the same scene ({', '.join(one.scene for one in scenes)}); the "
        "paper compares with other recordings of the same class",
        *(f"{eqs.name} of {scene.scene}'s own events: {_controls(eqs, scene)}" for scene in scenes),
        *_origins(config),
    ]
    title = "EQS ↑" if type(eqs) is EventQualityScore else f"{eqs.name} ↑"
    return Measured({title: _means(report, eqs.name, config)}, notes, _reasons(report.skipped))


def _controls(eqs: Metric, scene: RealScene) -> str:
    """Controls over all scored spans: a value is worth nothing outside of them."""
    found = [run_controls(eqs, events) for events in scene.references]
    return ", ".join(f"{name} {np.mean([one[name] for one in found]):.3f}" for name in CONTROLS)


def measure_times(config: PaperConfig, progress: Progress) -> Measured:
    """Table 2, second row: seconds per pair of 346x260 frames, interpolation included."""
    generator = ProceduralGenerator(
        ProceduralConfig(duration=TIMED_PAIRS / 24), size=SENSORS["davis346"].size
    )
    frames = list(generator.generate(PROMPT))
    levels = np.stack([np.rint(frame.luma).astype(np.uint8) for frame in frames])
    video = Video(levels, [frame.t_us for frame in frames])
    found: dict[str, str] = {}
    needs: list[str] = []
    columns = find_columns(config).items()
    simulated = {column: one for column, one in columns if column not in config.event_folders}
    for column, entry in simulated.items():
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
    return Measured({"time, s": found}, notes, needs)


def _seconds_per_pair(video: Video, entry: Entry) -> float:
    settings = entry.settings(0)
    prepare_video(video, settings).packets.collect()  # kernels are compiled and loaded
    seconds = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        prepare_video(video, settings).packets.collect()
        seconds.append(time.perf_counter() - start)
    return min(seconds) / (len(video) - 1)


def measure_images(config: PaperConfig, network: Reconstructor, progress: Progress) -> Measured:
    """Tables 1 and 8: images that a network makes of the events, against the true frames."""
    recordings, columns = config.whole_recordings(), find_columns(config)
    plan = ReconstructionPlan(entries=tuple(columns.values()), is_rate_matched=config.match_rate)
    scorer = ReconstructionScorer(reconstructor=network, measures=load_measures(), plan=plan)
    report = run_reconstruction(recordings, scorer, progress=progress)
    prefix = "images: " if config.table == 1 else ""
    rows = {
        f"{prefix}{title}": {
            column: f"{pool_scores(row.scores for row in rows).mean(measure):.3f}"
            for column, entry in columns.items()
            if (rows := report.rows_of(entry.name))
        }
        for title, measure in IMAGE_ROWS.items()
        if measure not in report.absent
    }
    notes = [
        f"images by {report.network} from {', '.join(one.name for one in recordings)}",
        *_origins(config),
    ]
    return Measured(rows, notes, _reasons({**report.absent, **report.skipped}))


def measure_noise(config: PaperConfig, network: Reconstructor, progress: Progress) -> Measured:
    """Table 7: images from perturbed events against those from the unperturbed ones."""
    recordings = config.whole_recordings()
    measures = load_measures()
    scorer = ReconstructionScorer(
        reconstructor=network, measures=measures, plan=ReconstructionPlan(entries=())
    )
    curves = []
    for recording in recordings:
        progress(f"{recording.name}: noise curve")
        curves.append(noise_curve(recording, scorer))
    pooled = dict(zip(TABLES[7].columns, map(pool_scores, zip(*curves, strict=True)), strict=True))
    rows = {
        title: {column: f"{one.mean(measure):.4f}" for column, one in pooled.items()}
        for title, measure in IMAGE_ROWS.items()
        if measure not in measures.absent
    }
    notes = [
        f"{network.name} on {', '.join(one.name for one in recordings)}; a perturbed event "
        "is moved to a random place, which the paper leaves open, and images are compared with "
        "those from the unperturbed events"
    ]
    return Measured(rows, notes, _reasons(measures.absent))


def measure_accuracy(config: PaperConfig, progress: Progress) -> Measured:
    """Table 9: top-1 and top-5 of folders of streams by N-ImageNet's protocol.

    A random run of 30,000 events of each file, scaled to 224x224, as a binary event image per
    polarity, through the published ResNet-34.

    Raises:
        InputError: no sub-folder has a column's name, or one has other classes than the network or
            another lacks.
    """
    if config.weights is None or not (config.folder or config.events):
        return Measured(
            needs=[
                "anything; --folder DIR with recorded and simulated streams per class, and "
                "--weights FILE of N-ImageNet's classifier, ResNet34 on binary event images "
                "(reshape_then_flat_pol), which the project 82magnolia/n_imagenet on GitHub links"
            ]
        )
    inside = [one for one in config.folder.iterdir() if one.is_dir()] if config.folder else []
    named = {one.name.lower(): one for one in inside}
    folders = {one: named[one.lower()] for one in TABLES[9].columns if one.lower() in named}
    folders |= config.event_folders
    absent = [column.lower() for column in TABLES[9].columns if column not in folders]
    if not folders:
        raise InputError(
            f"{config.folder} has no sub-folder of Table 9's columns; name them {', '.join(absent)}"
        )
    classes = {
        folder: {one.name for one in folder.iterdir() if one.is_dir()}
        for folder in folders.values()
    }
    for folder, own in classes.items():
        if lacking := sorted(set().union(*classes.values()) - own):
            raise InputError(f"{folder} lacks {', '.join(lacking)}, which another column has")
    rows: dict[str, dict[str, str]] = {title: {} for title in TABLES[9].rows}
    for column, folder in folders.items():
        progress(f"classifying {folder}")
        for title, share in zip(rows, _accuracies(folder, config.weights), strict=True):
            rows[title][column] = f"{share:.4f}"
    return Measured(rows, needs=[f"folders {', '.join(absent)}"] if absent else [])


def _accuracies(folder: Path, weights: Path) -> tuple[float, float]:
    """Top-1 and top-5 accuracy of the streams of a folder per class."""
    from texvent_lab.train.run import evaluate  # brings torch

    data = ClassData(
        recordings=folder.parent,
        validation_split=folder.name,
        sensor="640x480",
        slice_events=30_000,
        image_size="224x224",
    )
    # On the CPU: an accuracy must not depend on the machine.
    training = ClassificationConfig(data=data, network=CLASSIFIER)
    scores = evaluate(training, weights, Hardware(device="cpu")).scores
    return scores["accuracy"], scores.get("top-5 accuracy", 1.0)


def _run(
    scenes: Sequence[RealScene],
    metrics: Sequence[str | Metric],
    config: PaperConfig,
    progress: Progress,
) -> FidelityReport:
    entries = [
        replace(entry, is_rate_matched=config.match_rate) for entry in find_columns(config).values()
    ]
    return run_real(scenes, entries, metrics, jobs=config.jobs, progress=progress)


def _origins(config: PaperConfig) -> list[str]:
    """Notes on where the events of the columns come from."""
    return [
        *(f"{name}: events of that program, from files" for name in config.event_folders),
        OWN_MODELS,
    ]


def _means(report: FidelityReport, metric: str, config: PaperConfig) -> dict[str, str]:
    """Mean over recordings and their spans, per column."""
    found: dict[str, str] = {}
    for column, entry in find_columns(config).items():
        scores = [one for one in report.scores if one.entry == entry.name]
        if scores:
            found[column] = f"{np.mean([one.summary(metric).mean for one in scores]):.3f}"
    return found


def _reasons(skipped: Mapping[str, str]) -> list[str]:
    return [f"{name}: {why}" for name, why in skipped.items()]
