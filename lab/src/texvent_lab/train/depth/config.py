"""What a training file may say for depth."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from texvent.config import check_range
from texvent_lab.train.schedule import Schedule
from texvent_lab.train.sequences.config import SequenceData

if TYPE_CHECKING:
    from texvent_lab.train.task import Task


@dataclass(frozen=True, kw_only=True)
class DepthNetwork:
    """The network: E2Depth."""

    width: int = 32
    """Channels of the first layer; the published network has 32."""

    def __post_init__(self) -> None:
        check_range("width", self.width, 1, 1024)


@dataclass(frozen=True, kw_only=True)
class DepthLoss:
    """What is made small; the defaults are the published ones."""

    shift_weight: float = 1.0
    """Share of a constant factor of depth that is forgiven: 1 learns depth up to a factor, 0
    learns metres like any other error."""
    gradient_weight: float = 0.25
    """Of the differences between edges."""
    sky: bool = True
    """Whether the sky and what is beyond 80 m are learned as 80 m; else nothing is learned there,
    just as nothing is scored there."""

    def __post_init__(self) -> None:
        check_range("shift_weight", self.shift_weight, 0.0, 1.0)
        check_range("gradient_weight", self.gradient_weight, 0.0, 1e6)


@dataclass(frozen=True, kw_only=True)
class DepthConfig:
    """A network that gives depth from events."""

    seed: int = 0
    """Of the initial weights, the order of samples and their augmentation."""
    flip_x: bool = True
    """Mirror half of the training samples."""
    data: SequenceData = field(default_factory=SequenceData)
    network: DepthNetwork = field(default_factory=DepthNetwork)
    loss: DepthLoss = field(default_factory=DepthLoss)
    schedule: Schedule = field(default_factory=Schedule)

    def __post_init__(self) -> None:
        check_range("seed", self.seed, 0, 2**63 - 1)

    def make_task(self) -> Task:
        """The task; this imports torch."""
        from texvent_lab.train.depth.task import DepthTask

        return DepthTask(self)
