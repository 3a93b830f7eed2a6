"""Table 6: classifiers trained without and with a share of simulated samples."""

from __future__ import annotations

import contextlib
import tempfile
from collections.abc import Mapping
from pathlib import Path

from texvent.errors import InputError, MissingDependencyError
from texvent.options.values import plain
from texvent.runtime.progress import NO_PROGRESS
from texvent_lab.bench.jobs import Progress
from texvent_lab.bench.paper.config import PaperConfig
from texvent_lab.bench.paper.published_tables import TABLES, Measured
from texvent_lab.train.classification.config import (
    ClassData,
    ClassificationConfig,
    ClassNetwork,
    Source,
)
from texvent_lab.train.schedule import Hardware, Schedule

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
"""Of files that do not say it: N-ImageNet's."""


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
    keep = contextlib.nullcontext(config.work) if config.work else tempfile.TemporaryDirectory()
    with keep as work:
        for (row, column), training in trainings.items():
            progress(f"training {column}, {row}")
            try:
                accuracy = _accuracy(training, Path(work) / f"{column}-{names[row] or RECORDED}")
            except MissingDependencyError as error:
                return Measured(needs=[f"anything; {error}"])
            found[row][column] = f"{accuracy:.4f}"
    notes = [
        f"{config.epochs} epochs on {config.folder}, binary event images of {config.image_size} "
        f"px, from random weights; {SHARE:.0%} as many simulated as recorded streams; accuracy "
        "after the last epoch"
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
    extra = Source()
    if simulated is not None:
        classes = [one for one in (folder / RECORDED).iterdir() if one.is_dir()]
        recorded = sum(1 for one in classes for _ in one.iterdir())
        each = max(round(SHARE * recorded / max(len(classes), 1)), 1)
        extra = Source(recordings=folder, split=simulated, sensor=SENSOR, per_class=each)
    return ClassificationConfig(
        data=data,
        extra=extra,
        network=ClassNetwork(name=network, representation="binary-event-image"),
        schedule=Schedule(epochs=config.epochs, batch_size=32, learning_rate=1e-4),
    )


def _accuracy(training: ClassificationConfig, folder: Path) -> float:
    from texvent_lab.train.loop import train  # brings torch

    state = train(
        training.make_task(),
        training.schedule,
        folder,
        tables=plain(training),
        hardware=Hardware(),
        progress=NO_PROGRESS,
    )
    return state.rows[-1]["accuracy"]
