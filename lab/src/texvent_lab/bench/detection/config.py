"""Options of a training file for detection."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from texvent.config import check_range
from texvent.errors import ConfigError
from texvent_lab.train.schedule import Schedule, TrainingConfig

if TYPE_CHECKING:
    from texvent_lab.train.task import TrainingTask

EXTRA = "texvent-lab[detection]"
"""Extra that brings evlib, pycocotools and torch."""


@dataclass(frozen=True, kw_only=True)
class DetectionData:
    """Clips with boxes."""

    folder: Path | None = None
    """Written by `texvent dataset export --layout rvt`."""
    split: str = "train"
    """Trained on."""
    validation_split: str = "val"
    """Scored after every epoch."""
    passes: int = 1
    """Passes over the clips in an epoch: scores and checkpoint follow each epoch."""
    length: int = 5
    """Successive windows of a clip that a step sees, drawn anew each time."""
    windows: int = 3
    """Windows among these whose boxes it learns."""
    binning: int = 2
    """Pixels along each side of a cell that the network sees: 2 takes a quarter of the time of 1,
    and misses the smallest objects."""

    def __post_init__(self) -> None:
        check_range("passes", self.passes, 1, 10_000)
        check_range("length", self.length, 1, 1000)
        check_range("windows", self.windows, 1, 1000)
        check_range("binning", self.binning, 1, 4)


SCHEDULE = Schedule(
    epochs=30,
    batch_size=4,
    optimizer="adamw",
    learning_rate=2e-3,
    weight_decay=1e-2,
    clip_gradient=1.0,
    decay="cosine",
)


@dataclass(frozen=True, kw_only=True)
class DetectionConfig(TrainingConfig):
    """A detector: RVT-T, the smallest of RVT's networks."""

    packages: ClassVar[str] = EXTRA
    task: ClassVar[str] = "texvent_lab.bench.detection.task:open_task"
    schedule: Schedule = SCHEDULE
    data: DetectionData = field(default_factory=DetectionData)
    flip_x: bool = True
    """Mirror half of the training clips left to right."""

    def make_task(self) -> TrainingTask:
        """See `TrainingConfig`."""
        if self.data.folder is None:
            raise ConfigError(
                "data.folder is missing; name what texvent dataset export --layout rvt wrote"
            )
        return super().make_task()
