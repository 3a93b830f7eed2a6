"""What a training file may say about clips of consecutive windows."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from texvent.config import check_range


@dataclass(frozen=True, kw_only=True)
class SequenceData:
    """Clips of a data set specification, simulated when they are first needed."""

    specification: Path = Path()
    """Of the data set: TOML or YAML; see docs/datasets.md. Nothing needs to be made before."""
    variant: str | None = None
    """None: the only one."""
    split: str = "train"
    """Trained on."""
    validation_split: str = "validation"
    """Scored after every epoch."""
    slice_us: int = 40_000
    """Length of a window, µs. The network sees the events of one window at a time."""
    length: int = 20
    """Windows of a training sequence: a random run of each clip, drawn anew in every epoch."""
    crop: int | None = None
    """Side of the random square that is trained on, px; None: the whole sensor."""
    cache: Path | None = None
    """Folder of the simulated clips, which may serve many trainings; None: `sequences` in
    texvent's cache folder."""

    def __post_init__(self) -> None:
        check_range("slice_us", self.slice_us, 1, 10**12)
        check_range("length", self.length, 1, 1_000_000)
        check_range("crop", self.crop, 8, 65_536)
