"""What a training file may say for a head on latents."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from texvent.config import check_range
from texvent_lab.latents.change import BALANCE
from texvent_lab.train.schedule import Schedule

if TYPE_CHECKING:
    from texvent_lab.train.task import Task


@dataclass(frozen=True, kw_only=True)
class LatentData:
    """Scenes, and the autoencoder whose latents stand for them."""

    specification: Path = Path()
    """Of the data set: TOML or YAML, with prompts of the embedded generator; docs/datasets.md."""
    variant: str | None = None
    """None: the only one."""
    split: str = "train"
    """Trained on."""
    validation_split: str = "validation"
    """Scored after every epoch."""
    autoencoder: Path = Path()
    """Folder of an AutoencoderKLWan or AutoencoderKLLTXVideo: `vae` of a downloaded model."""
    flip_x: bool = True
    """Mirror half of the training scenes left to right, before they are encoded."""
    cache: Path | None = None
    """Folder of latents and changes; None: `latents` in texvent's cache folder."""


@dataclass(frozen=True, kw_only=True)
class HeadNetwork:
    """Sizes of the head that the autoencoder does not decide."""

    bins: int = 8
    """Of a latent frame."""
    width: int = 96
    """Channels inside."""
    blocks: int = 3
    """Residual blocks."""
    balance: float = BALANCE
    """α of the brightness, on the 0..255 scale."""

    def __post_init__(self) -> None:
        check_range("bins", self.bins, 1, 1024)
        check_range("width", self.width, 1, 4096)
        check_range("blocks", self.blocks, 0, 64)
        check_range("balance", self.balance, 1e-6, 1e6)


@dataclass(frozen=True, kw_only=True)
class LatentsConfig:
    """A head that gives changes of brightness from latents."""

    seed: int = 0
    """Of the initial weights, the order of samples and their augmentation."""
    data: LatentData = field(default_factory=LatentData)
    network: HeadNetwork = field(default_factory=HeadNetwork)
    schedule: Schedule = field(default_factory=Schedule)

    def __post_init__(self) -> None:
        check_range("seed", self.seed, 0, 2**63 - 1)

    def make_task(self) -> Task:
        """The task; this imports torch."""
        from texvent_lab.train.latents.task import LatentsTask

        return LatentsTask(self)
