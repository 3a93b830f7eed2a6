"""Tables 3 and 6: networks trained without and with a share of simulated samples."""

from __future__ import annotations

import contextlib
import itertools
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Literal

from texvent.errors import InputError, MissingDependencyError
from texvent.options.values import plain
from texvent.runtime.progress import NO_PROGRESS
from texvent_lab.bench.jobs import Progress
from texvent_lab.bench.paper.config import PaperConfig
from texvent_lab.bench.paper.published_tables import TABLES, Measured
from texvent_lab.reconstruct.image_measures import load_measures
from texvent_lab.train.classification.config import (
    ClassData,
    ClassificationConfig,
    ClassNetwork,
    LabelledSource,
)
from texvent_lab.train.reconstruction.config import (
    ExtraClips,
    ReconstructionConfig,
    ReconstructionLoss,
    ReconstructionNetwork,
)
from texvent_lab.train.reconstruction.sequences import SequenceData
from texvent_lab.train.schedule import Hardware, Schedule, TrainingConfig

CLASSIFIERS: Mapping[str, str] = {
    "ResNet34": "torchvision:resnet34",
    "ResNet152": "torchvision:resnet152",
    "ViTB": "torchvision:vit_b_16",
    "SqueezeNet": "torchvision:squeezenet1_1",
}
"""Column of Table 6 → network."""
SHARE = 0.2
"""Simulated samples, of the recorded ones."""
RECORDED, TESTED = "train", "test"
"""Sub-folders of recorded streams."""
ORIGINAL = "Original"
SENSOR = "640x480"
"""Sensor of files that do not state it: N-ImageNet's."""


def measure_recognition(config: PaperConfig, progress: Progress) -> Measured:
    """Accuracy of classifiers after the last epoch, with each folder of simulated streams.

    Raises:
        InputError: a sub-folder, class or file is missing; named before any training.
        ConfigError: a network takes no images of the size.
    """
    if config.folder is None:
        return Measured(
            needs=[
                "anything; --folder DIR with sub-folders train and test of recorded streams, and "
                "one per simulator (texvent ...), each with a folder of event files per class"
            ]
        )
    names = {ORIGINAL: None, **_simulated(config.folder)}
    found: dict[str, dict[str, str]] = {row: {} for row in names}
    trainings = {
        (row, column): _training(config, network, simulated)
        for row, simulated in names.items()
        for column, network in CLASSIFIERS.items()
    }
    with _work_folder(config) as work:
        for (row, column), training in trainings.items():
            progress(f"training {column}, {row}")
            try:
                accuracy = _last_scores(training, work / f"{column}-{names[row] or RECORDED}")[
                    "accuracy"
                ]
            except MissingDependencyError as error:
                return Measured(needs=[f"anything; {error}"])
            found[row][column] = f"{accuracy:.4f}"
    classes = sum(1 for one in (config.folder / TESTED).iterdir() if one.is_dir())
    notes = [
        f"epochs: {config.epochs}, on {config.folder}, binary event images of {config.image_size} "
        f"px, from random weights; {SHARE:.0%} as many simulated as recorded streams; accuracy "
        f"after the last epoch, of {classes} classes: guessing gives {1 / classes:.4f}"
    ]
    return Measured(found, notes)


def _simulated(folder: Path) -> dict[str, str]:
    """Row of the table → sub-folder of its streams."""
    if not folder.is_dir():
        raise InputError(f"there is no folder {folder}")
    present = sorted(one.name for one in folder.iterdir() if one.is_dir())
    absent = [one for one in (RECORDED, TESTED) if one not in present]
    others = [one for one in present if one not in (RECORDED, TESTED)]
    if absent or not others:
        raise InputError(
            f"{folder} has no sub-folder {absent[0] if absent else 'of simulated streams'}; "
            f"Table 6 needs {RECORDED}, {TESTED} and one per simulator, such as texvent"
        )
    published = {row.removeprefix("with ").lower(): row for row in TABLES[6].rows}
    return {published.get(one.lower(), f"with {one}"): one for one in others}


def _training(config: PaperConfig, network: str, simulated: str | None) -> ClassificationConfig:
    folder = config.folder or Path()
    data = ClassData(
        recordings=folder,
        split=RECORDED,
        validation_split=TESTED,
        sensor=SENSOR,
        slice_events=30_000,
        image_size=config.image_size,
    )
    extra = LabelledSource()
    if simulated is not None:
        classes = [one for one in (folder / RECORDED).iterdir() if one.is_dir()]
        recorded = sum(1 for one in classes for _ in one.iterdir())
        each = max(round(SHARE * recorded / max(len(classes), 1)), 1)
        extra = LabelledSource(recordings=folder, split=simulated, sensor=SENSOR, per_class=each)
    return ClassificationConfig(
        data=data,
        extra=extra,
        network=ClassNetwork(name=network, representation="binary-event-image"),
        schedule=Schedule(epochs=config.epochs, batch_size=32, learning_rate=1e-4),
    )


@contextlib.contextmanager
def _work_folder(config: PaperConfig) -> Iterator[Path]:
    """The folder that keeps trainings, or one for this run alone."""
    if config.work is not None:
        yield config.work
        return
    with tempfile.TemporaryDirectory() as folder:
        yield Path(folder)


def _last_scores(training: TrainingConfig, folder: Path) -> Mapping[str, float]:
    """Scores after the last epoch of a training, which goes on where it was stopped."""
    from texvent_lab.train.loop import train  # brings torch

    state = train(
        training.make_task(),
        training.schedule,
        folder,
        tables=plain(training),
        hardware=Hardware(),
        progress=NO_PROGRESS,
    )
    return state.rows[-1]


RECONSTRUCTORS: Mapping[str, Literal["e2vid", "hypere2vid", "et-net"]] = {
    "E2VID": "e2vid",
    "HyperE2VID": "hypere2vid",
    "ET-Net": "et-net",
}
"""Row of Table 3 → network."""
MEASURES = {"PSNR ↑": "psnr", "SSIM ↑": "ssim", "LPIPS ↓": "lpips", "MSE ↓": "mse"}
CLIPS, SEQUENCE, CROP_PX, MULTIPLE_PX = 0.05, 20, 112, 8
"""Simulated clips, of the recorded ones; windows of a training sequence; its longest side, and
what divides it."""


def measure_augmented_reconstruction(config: PaperConfig, progress: Progress) -> Measured:
    """Table 3: images after the last epoch, of the last fifth of each recording.

    Raises:
        InputError, ConfigError: a recording or the specification does not fit.
    """
    needs = []
    if config.specification is None:
        needs.append("anything; --specification FILE of a data set to simulate clips of")
    if not config.sources:
        needs.append("anything; texvent data pull slider_depth, or --recordings with the ECD")
    if needs:
        return Measured(needs=needs)
    rows: dict[str, dict[str, str]] = {}
    sides = [min(one.frames.size) for one in config.whole_recordings()]
    crop = min(CROP_PX, *sides) // MULTIPLE_PX * MULTIPLE_PX
    absent = load_measures().absent
    loss = ReconstructionLoss(consistency=0.0)
    if absent:
        loss = ReconstructionLoss(consistency=0.0, lpips=0.0, l1=1.0, ssim=1.0)
    with _work_folder(config) as work:
        simulated = (None, config.specification)
        for (row, network), extra in itertools.product(RECONSTRUCTORS.items(), simulated):
            name = row if extra is None else f"{row} + 5 %"
            progress(f"training {name}")
            training = ReconstructionConfig(
                data=SequenceData(recordings=config.sources, length=SEQUENCE, crop=crop),
                extra=ExtraClips(specification=extra, share=CLIPS),
                network=ReconstructionNetwork(name=network),
                loss=loss,
                schedule=Schedule(epochs=config.epochs, batch_size=2, learning_rate=1e-4),
            )
            try:
                scores = _last_scores(training, work / name.replace(" ", ""))
            except MissingDependencyError as error:
                return Measured(needs=[f"anything; {error}"])
            rows[name] = {
                column: f"{scores[one]:.4f}" for column, one in MEASURES.items() if one in scores
            }
    notes = [
        f"epochs: {config.epochs}, from random weights on the first four fifths of "
        f"{', '.join(config.sources)}; scores of the last fifth after the last epoch; loss: "
        + ("L1 + 1 - SSIM" if absent else "LPIPS"),
        f"{max(1, round(CLIPS * len(config.sources)))} simulated beside {len(config.sources)} "
        "recorded: 5 % of the recordings, and at least one clip",
    ]
    return Measured(rows, notes, [f"{name}: {why}" for name, why in absent.items()])
