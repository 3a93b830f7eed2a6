"""The state of a training after an epoch, in one file that is replaced as a whole."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any

from texvent.batch.manifest import describe_differences
from texvent.errors import ConfigError, FileFormatError
from texvent.extending import full_version, require
from texvent.io.atomic import atomic_file
from texvent.networks.weight_files import DAMAGE, Tensor
from texvent_lab.train.schedule import EXTRA

CHECKPOINT_FILE, WEIGHTS_FILE = "checkpoint.pt", "weights.pt"


@dataclass(kw_only=True)
class TrainingState:
    """All that the next epoch depends on, and what is kept of those before."""

    tables: Mapping[str, Any]
    """What is trained and how, as plain values."""
    version: str = field(default_factory=full_version)
    """Of texvent."""
    epochs: int = 0
    """Complete ones."""
    network: Mapping[str, Tensor] = field(default_factory=dict)
    optimizer: Mapping[str, Any] = field(default_factory=dict)
    best_epoch: int = 0
    """From 1."""
    best: Mapping[str, Tensor] = field(default_factory=dict)
    """The network after that epoch."""
    reduced_at: int = 0
    """Epoch after which the learning rate was reduced last."""
    rows: list[dict[str, float]] = field(default_factory=list)
    """Scores of all epochs."""


def write_state(folder: Path, state: TrainingState) -> None:
    """Write the state of a training, flushed to disk, in place of the last one."""
    values = {one.name: getattr(state, one.name) for one in fields(state)}
    save(folder / CHECKPOINT_FILE, values)


def save(path: Path, values: Mapping[str, Any]) -> None:
    """Write tensors and plain values as torch does."""
    torch = require("torch", extra=EXTRA)
    with atomic_file(path, overwrite=True) as part:
        torch.save(dict(values), part)


def read_state(folder: Path, tables: Mapping[str, Any]) -> TrainingState | None:
    """The state of a training that was begun, or None.

    Args:
        folder: of the training.
        tables: what is to be trained now.

    Raises:
        FileFormatError: the file is damaged.
        ConfigError: another training was begun there, or by another version of texvent.
    """
    torch = require("torch", extra=EXTRA)
    path = folder / CHECKPOINT_FILE
    if not path.exists():
        return None
    try:
        values = torch.load(path, map_location="cpu", weights_only=True)
        state = TrainingState(**values)
    except DAMAGE as error:
        raise FileFormatError(f"{path} is damaged; delete it to begin again") from error
    if state.version != full_version():
        raise ConfigError(
            f"{folder} was begun by texvent {state.version}, and this is {full_version()}; install "
            "that version, or name another folder with -o"
        )
    changed = describe_differences(state.tables, tables)
    if changed:
        raise ConfigError(
            f"{folder} holds another training: {changed}; name another folder with -o, or delete it"
        )
    return state
