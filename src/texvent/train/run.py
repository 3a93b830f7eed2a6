"""A training from its file."""

from __future__ import annotations

from pathlib import Path

from texvent.errors import OutputError, one_line
from texvent.options.values import plain
from texvent.runtime.progress import NO_PROGRESS, Progress
from texvent.train.checkpoint import TrainingState
from texvent.train.loop import train
from texvent.train.reading import read_training
from texvent.train.schedule import Hardware
from texvent.train.task import TaskConfig


def train_from_file(
    kind: type[TaskConfig],
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
    task = config.make_task()
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"cannot make {folder}: {one_line(error)}") from error
    return train(
        task,
        config.schedule,
        folder,
        seed=config.seed,
        tables=plain(config),
        hardware=hardware,
        progress=progress,
    )
