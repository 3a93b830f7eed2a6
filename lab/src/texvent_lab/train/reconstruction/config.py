"""Options of a training file for reconstruction."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import ClassVar, Literal

from texvent.config import check_choices, check_range
from texvent.errors import ConfigError
from texvent_lab.train.reconstruction.sequences import SequenceData
from texvent_lab.train.schedule import Schedule, TrainingConfig


@dataclass(frozen=True, kw_only=True)
class ReconstructionNetwork:
    """The network; docs/reconstruction.md describes each."""

    name: Literal["firenet", "firenet+", "e2vid", "e2vid+", "hypere2vid", "et-net"] = "e2vid+"
    """firenet and e2vid see normalised voxel grids, the others the grids as they are."""

    def __post_init__(self) -> None:
        check_choices(self)


@dataclass(frozen=True, kw_only=True)
class ReconstructionLoss:
    """Distance of images from the true ones, and from themselves a window before: a sum."""

    lpips: float = 1.0
    """Weight of LPIPS (AlexNet; the published networks were trained with VGG); 0: none, and its
    weights file is not needed."""
    l1: float = 0.0
    """Weight of the mean absolute difference."""
    ssim: float = 0.0
    """Weight of 1 − SSIM."""
    consistency: float = 2.0
    """Weight of the temporal consistency, which clips of videos do not have."""
    consistency_from: int = 2
    """First window, counted from 0, that is compared with the one before."""
    consistency_alpha: float = 50.0
    """Rate at which a pixel counts less where the true images differ, per squared intensity."""

    def __post_init__(self) -> None:
        for name in ("lpips", "l1", "ssim", "consistency"):
            check_range(name, getattr(self, name), 0.0, 1e6)
        if not (self.lpips or self.l1 or self.ssim):
            raise ConfigError("lpips, l1 and ssim are all 0; give one of them a weight, such as 1")
        check_range("consistency_from", self.consistency_from, 1, 1_000_000)
        check_range("consistency_alpha", self.consistency_alpha, 0.0, 1e9)


@dataclass(frozen=True, kw_only=True)
class ReconstructionAugmentation:
    """Changes of training sequences, drawn anew in every epoch.

    Source of the defaults: T. Stoffregen et al., "Reducing the sim-to-real gap for event cameras",
        ECCV 2020, and its program.
    """

    flip: bool = True
    """Mirror half of the sequences along each axis."""
    noise: float = 0.1
    """Deviation of the noise in every voxel."""
    hot_pixels: float = 0.1
    """Deviation of what hot pixels add to all voxels of a sequence."""
    hot_pixel_fraction: float = 0.001
    """Largest share of hot pixels; each sequence draws its own."""
    pause_begin: float = 0.05
    """Probability that a window is a pause: no events, and the image stays."""
    pause_stay: float = 0.9
    """Probability that a pause goes on."""

    def __post_init__(self) -> None:
        check_range("noise", self.noise, 0.0, 1e6)
        check_range("hot_pixels", self.hot_pixels, 0.0, 1e6)
        check_range("hot_pixel_fraction", self.hot_pixel_fraction, 0.0, 1.0)
        check_range("pause_begin", self.pause_begin, 0.0, 1.0)
        check_range("pause_stay", self.pause_stay, 0.0, 1.0)


@dataclass(frozen=True, kw_only=True)
class ExtraClips:
    """Simulated clips beside the training clips, cut as they are."""

    specification: Path | None = None
    """Specification of the data set that they are of; None: no more clips."""
    variant: str | None = None
    """None: the only one."""
    split: str = "train"
    share: float = 0.05
    """Their number, of that of the training clips; at least one."""

    def __post_init__(self) -> None:
        check_range("share", self.share, 1e-6, 100.0)


@dataclass(frozen=True, kw_only=True)
class ReconstructionConfig(TrainingConfig):
    """A network that turns events into images."""

    task: ClassVar[str] = "texvent_lab.train.reconstruction.task:ReconstructionTask"

    data: SequenceData = field(default_factory=lambda: SequenceData(length=40, crop=112))
    extra: ExtraClips = field(default_factory=ExtraClips)
    network: ReconstructionNetwork = field(default_factory=ReconstructionNetwork)
    loss: ReconstructionLoss = field(default_factory=ReconstructionLoss)
    augmentation: ReconstructionAugmentation = field(default_factory=ReconstructionAugmentation)
    score_every: int = 1
    """After every epoch, all windows of the validation clips are reconstructed, and one of so many
    is scored: scores are computed on the CPU."""
    schedule: Schedule = field(
        default_factory=lambda: Schedule(epochs=200, batch_size=2, learning_rate=1e-4, amsgrad=True)
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        check_range("score_every", self.score_every, 1, 1_000_000)
