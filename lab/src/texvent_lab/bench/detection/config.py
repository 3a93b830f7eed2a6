"""What a training file may say for detection."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from texvent.config import check_range
from texvent.errors import ConfigError
from texvent_lab.train.schedule import Schedule, TrainingConfig

if TYPE_CHECKING:
    from texvent_lab.train.task import Task

EXTRA = "texvent-lab[detection]"
"""What brings evlib, pycocotools and torch."""


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
    windows: int = 4
    """Windows of a clip whose boxes are learned in a step, drawn anew each time; all of them are
    seen."""

    def __post_init__(self) -> None:
        check_range("passes", self.passes, 1, 10_000)
        check_range("windows", self.windows, 1, 1000)


SCHEDULE = Schedule(
    epochs=30,
    batch_size=8,
    optimizer="adamw",
    learning_rate=5e-4,
    weight_decay=1e-2,
    clip_gradient=1.0,
    decay="cosine",
)


@dataclass(frozen=True, kw_only=True)
class DetectionConfig(TrainingConfig):
    """A detector: RVT-T, the smallest of RVT's networks."""

    schedule: Schedule = SCHEDULE
    data: DetectionData = field(default_factory=DetectionData)
    flip_x: bool = True
    """Mirror half of the training clips left to right."""

    def make_task(self) -> Task:
        """See `TrainingConfig`."""
        if self.data.folder is None:
            raise ConfigError(
                "data.folder is missing; name what texvent dataset export --layout rvt wrote"
            )
        from texvent_lab.bench.detection.task import DetectionTask  # brings torch

        return DetectionTask(self)
