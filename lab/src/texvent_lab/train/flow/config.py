"""What a training file may say for optical flow."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

from texvent.config import check_choices, check_range
from texvent.represent.voxel_grid import MAX_BINS
from texvent_lab.train.schedule import Schedule
from texvent_lab.train.sequences.config import SequenceData

if TYPE_CHECKING:
    from texvent_lab.train.task import Task


@dataclass(frozen=True, kw_only=True)
class FlowNetwork:
    """The network and what it is shown."""

    name: Literal["ev-flownet", "e-raft"] = "ev-flownet"
    """e-raft is evaluated with its published weights, not trained."""
    bins: int = 5
    """Of the voxel grids; E-RAFT's published weights have 15."""
    width: int = 32
    """Half the channels of EV-FlowNet's first layer; the published network has 32."""

    def __post_init__(self) -> None:
        check_choices(self)
        check_range("bins", self.bins, 1, MAX_BINS)
        check_range("width", self.width, 1, 1024)


@dataclass(frozen=True, kw_only=True)
class FlowConfig:
    """A network that gives optical flow from events."""

    seed: int = 0
    """Of the initial weights, the order of samples and their augmentation."""
    flip_x: bool = True
    """Mirror half of the training samples left to right."""
    flip_y: bool = True
    """Turn half of the training samples upside down."""
    data: SequenceData = field(default_factory=SequenceData)
    network: FlowNetwork = field(default_factory=FlowNetwork)
    schedule: Schedule = field(default_factory=Schedule)

    def __post_init__(self) -> None:
        check_range("seed", self.seed, 0, 2**63 - 1)

    def make_task(self) -> Task:
        """The task; this imports torch."""
        from texvent_lab.train.flow.task import FlowTask

        return FlowTask(self)
