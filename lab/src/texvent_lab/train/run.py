"""Trainings and evaluations from a training file."""

from __future__ import annotations

import dataclasses
import json
import typing
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from texvent.errors import ConfigError, InputError, shown
from texvent.extending import full_version, require
from texvent.io.atomic import atomic_file
from texvent.networks import describe_file, read_mapping
from texvent.options.values import plain, with_options
from texvent.runtime.progress import NO_PROGRESS, Progress
from texvent.settings.config_files import read_document
from texvent_lab.frame_recordings import resolve_source
from texvent_lab.reconstruct.checkpoint import LEFT_BY_TRAINING
from texvent_lab.train.loop import TrainingState, train
from texvent_lab.train.schedule import EXTRA, Hardware, TrainingConfig

Config = TypeVar("Config")


def read_training(path: Path, config: Config) -> Config:
    """The training in a file; paths in it count from its folder.

    Args:
        path: a `.toml`, `.yaml` or `.yml` file.
        config: the defaults of the task, a dataclass; its tables are dataclasses too.

    Raises:
        InputError: the file cannot be read.
        ConfigError: an unknown name, or a value that does not fit.
    """
    return with_tables(config, read_document(path), folder=path.parent, where=str(path))


def with_tables(config: Config, tables: Mapping[str, Any], *, folder: Path, where: str) -> Config:
    """A copy of a config with values replaced, in its tables too.

    Args:
        config: the defaults.
        tables: name → value; of a table, name → value again.
        folder: that relative paths count from.
        where: what to call them in messages.

    Raises:
        ConfigError: as `read_training`.
    """
    hints = typing.get_type_hints(type(config))
    values: dict[str, Any] = {}
    for name, value in tables.items():
        name = name.replace("-", "_")
        inner = getattr(config, name, None)
        if dataclasses.is_dataclass(inner):
            if not isinstance(value, Mapping):
                raise ConfigError(f"{where}: {name} is {shown(value)}; it must be a table")
            inner = with_tables(inner, value, folder=folder, where=f"{where}: {name}")
            config = dataclasses.replace(config, **{name: inner})  # type: ignore[type-var]
        elif Path in (hints.get(name), *typing.get_args(hints.get(name))):
            values[name] = str(folder / str(value))
        elif name in getattr(config, "names_or_paths", ()):
            several = value if isinstance(value, list) else [value]
            values[name] = [resolve_source(str(one), folder) for one in several]
        else:
            values[name] = value
    return with_options(config, values, where=where)


WHERE_FROM = "texvent train writes it as weights.pt"
"""Origin of a weights file, for messages."""


def train_from_file(
    kind: type[TrainingConfig],
    specification: Path,
    folder: Path,
    hardware: Hardware,
    progress: Progress = NO_PROGRESS,
) -> TrainingState:
    """Train as a file says, or go on where that was stopped.

    Args:
        kind: of the task; `TASKS` has them.
        specification: TOML or YAML; see docs/training.md.
        folder: of the training; made if it is missing.
        hardware: what trains.
        progress: told of batches and epochs.

    Raises:
        InputError, ConfigError, FileFormatError: before any work, what the file asks for cannot be
            done; the message says why.
        OutputError: the folder cannot be made.
        TexventError: the loss is no longer a number.
    """
    config = read_training(specification, kind())
    return train(
        config.make_task(),
        config.schedule,
        folder,
        tables=plain(config),
        hardware=hardware,
        progress=progress,
    )


@dataclass(frozen=True)
class Evaluation:
    """Scores of trained weights on the split that a training file names for validation."""

    scores: Mapping[str, float]
    facts: Mapping[str, Any]
    """Weights, version, what they were scored on, predictions if there are any: plain values."""

    def write(self, path: Path, *, overwrite: bool) -> None:
        """Write both as JSON.

        Raises:
            OutputError: the file exists, or cannot be written.
        """
        text = json.dumps({"scores": self.scores, **self.facts}, indent=1)
        with atomic_file(path, overwrite=overwrite) as part:
            part.write_text(text + "\n", encoding="utf-8")


def evaluate_from_file(
    kind: type[TrainingConfig], specification: Path, weights: Path, hardware: Hardware
) -> Evaluation:
    """Score trained weights; the training samples are not opened.

    Args:
        kind: of the task; `TASKS` has them.
        specification: as for training; its schedule is not used, but for the size of a batch.
        weights: what training wrote, or published weights of the same layout.
        hardware: what computes.

    Raises:
        InputError, ConfigError, FileFormatError: the file, the samples or the weights do not fit.
    """
    return evaluate(read_training(specification, kind()), weights, hardware)


def evaluate(config: TrainingConfig, weights: Path, hardware: Hardware) -> Evaluation:
    """Score trained weights on the `validation_split` of a training; see `evaluate_from_file`.

    Names of scores do not say "validation": the split may be a test's.
    """
    if not weights.is_file():
        raise InputError(f"there is no weights file {weights}; texvent train writes weights.pt")
    task, device = config.make_task(), hardware.find_device()
    network = task.make_network()
    content = read_mapping(weights, WHERE_FROM, extra=EXTRA, stand_ins=LEFT_BY_TRAINING)
    task.read(network, content, weights)
    network.to(device).eval()
    with require("torch", extra=EXTRA).inference_mode(), hardware.autocast(device):
        scores, predictions = task.validate(network, device, workers=hardware.workers)
    facts = {
        "texvent_version": full_version(),
        "weights": describe_file(weights),
        "scored_on": plain(config),
        **({"predictions": predictions} if predictions else {}),
    }
    named = {name.replace("validation ", ""): value for name, value in scores.items()}
    return Evaluation(named, facts)
