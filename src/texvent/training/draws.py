"""Draws of a training clip: its pixels, its place in a video, its flip, pauses and speed."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields
from types import MappingProxyType
from typing import ClassVar, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_range
from texvent.errors import ConfigError, shown
from texvent.simulation.model_options import RATIO_LIMIT, THRESHOLDS
from texvent.simulation.physical.config import (
    DAVIS346_NOISE,
    PhysicalConfig,
    parse_noise_curve,
)
from texvent.simulation.random.draws import draw_uniforms, frame_key

Limits: TypeAlias = tuple[float, float]
"""The lowest and the highest value, both possible; draws are uniform between them."""

_ALLOWED: Mapping[str, Limits] = MappingProxyType(
    {
        "threshold": (0.01, 10.0),
        "ratio": (1.0, 10.0),
        "mismatch": (0.0, 1.0),
        "noise": (0.0, 10.0),
        "hot_fraction": (0.0, 1.0),
        "hot_noise": (0.0, 10.0),
        "noise_scale": (0.0, 1e3),
        "leak_rate_hz": (0.0, 1e3),
        "cutoff_hz": (0.0, 1e6),
        "refractory_us": (0, 10**6),
        "speed": (1, 1000),
        "pause": (0.0, 1.0),
        "flip": (0.0, 1.0),
        "gamma": (0.1, 10.0),
        "log_eps": (1e-9, 1.0),
    }
)
_SINGLE = ("flip", "gamma", "log_eps")
"""Those that are one number, and are not drawn."""


@dataclass(frozen=True, kw_only=True)
class MotionRanges:
    """Ranges that the motion of every clip is drawn from, with what all pixel models share.

    Raises:
        ConfigError: a limit is out of range, or the lower one is above the higher.
    """

    drawn: ClassVar[Mapping[str, int]]
    """Number that a model draws beside its thresholds → the place of its chance."""

    speed: tuple[int, int] = (1, 1)
    """Playback speed: so many frames of the video are one step, at the video's frame rate."""
    pause: Limits = (0.01, 0.98)
    """Probability that the video pauses at a frame, and that a pause goes on."""
    flip: float = 0.5
    """Probability of a mirrored clip."""
    gamma: float = 2.2
    """γ of the video: light is (I / 255)^γ."""
    has_phase: bool = True
    """References begin anywhere between the two thresholds, not at the first frame."""
    refractory_us: Limits = (0, 0)
    """Refractory period, µs."""

    def __post_init__(self) -> None:
        for one in fields(self):
            value = getattr(self, one.name)
            if one.name not in _ALLOWED:
                continue
            is_pair, is_single = isinstance(value, tuple | list), one.name in _SINGLE
            if is_pair == is_single or (is_pair and len(value) != 2):
                wanted = "one number" if is_single else "two numbers, the lowest and the highest"
                raise ConfigError(f"{one.name} is {shown(value)}; it must be {wanted}")
            for limit in value if is_pair else (value,):
                check_range(one.name, limit, *_ALLOWED[one.name])
            if is_pair and one.name != "pause" and value[0] > value[1]:
                raise ConfigError(f"{one.name} is {shown(value)}; give the lowest value first")
        if not isinstance(self.has_phase, bool):
            raise ConfigError(f"has_phase is {shown(self.has_phase)}; it must be True or False")


@dataclass(frozen=True, kw_only=True)
class ClipRanges(MotionRanges):
    """Ranges that the pixels and the motion of every clip are drawn from; V2V's by default.

    Source: V2V, "Scaling event-based vision through efficient video-to-voxel simulation", NeurIPS
        2025, and the defaults of its program. It has no mismatch, refractory period or speed.

    Example:
        >>> from texvent.training import ClipRanges
        >>> ClipRanges(threshold=(0.1, 0.5), flip=0.0).noise
        (0.0, 0.2)
    """

    drawn: ClassVar[Mapping[str, int]] = MappingProxyType(
        {"mismatch": 3, "noise": 4, "hot_fraction": 5, "hot_noise": 6, "refractory_us": 7}
    )

    threshold: Limits = THRESHOLDS["v2v"][:2]
    """Smaller contrast threshold, log units."""
    ratio: Limits = (1.0, RATIO_LIMIT)
    """The larger threshold by the smaller; which polarity has it is drawn too."""
    mismatch: Limits = (0.0, 0.0)
    """Standard deviation of thresholds between pixels, a share of the threshold."""
    noise: Limits = (0.0, 0.2)
    """Standard deviation of what brightness moves by at every frame, log units."""
    hot_fraction: Limits = (0.0, 0.001)
    """Share of hot pixels."""
    hot_noise: Limits = (0.0, 0.2)
    """Standard deviation of what a hot pixel moves by, the same at every frame, log units."""
    log_eps: float = 1e-3
    """ε of brightness, ln((I / 255)^γ + ε)."""


@dataclass(frozen=True, kw_only=True)
class PhysicalRanges(MotionRanges):
    """Ranges for the `physical` pixel model, around the presets of its cameras.

    Example:
        >>> from texvent.training import PhysicalRanges
        >>> PhysicalRanges(leak_rate_hz=(0.0, 0.0)).cutoff_hz
        (100.0, 500.0)
    """

    drawn: ClassVar[Mapping[str, int]] = MappingProxyType(
        {
            "mismatch": 3,
            "noise_scale": 4,
            "hot_fraction": 5,
            "leak_rate_hz": 6,
            "refractory_us": 7,
            "cutoff_hz": 13,
        }
    )

    threshold: Limits = (0.15, 0.5)
    """Smaller contrast threshold, log units."""
    ratio: Limits = (1.0, 1.5)
    """The larger threshold by the smaller; which polarity has it is drawn too."""
    mismatch: Limits = (0.0, 0.05)
    """Standard deviation of thresholds between pixels, log units."""
    noise_curve: str = DAVIS346_NOISE
    """Noise rate by intensity, LEVEL:RATE as of the pixel model; default: that of a DAVIS346."""
    noise_scale: Limits = (0.1, 1.0)
    """Factor of these rates."""
    hot_fraction: Limits = (0.0, 0.001)
    """Share of hot pixels."""
    leak_rate_hz: Limits = (0.0, 0.1)
    """ON events per pixel and second from leakage."""
    refractory_us: Limits = (0, 1000)
    """Refractory period, µs."""
    cutoff_hz: Limits = (100.0, 500.0)
    """Bandwidth of the photoreceptor at white; (0, 0) is unlimited."""

    def __post_init__(self) -> None:
        super().__post_init__()
        parse_noise_curve(self.noise_curve)
        if self.cutoff_hz[0] == 0 < self.cutoff_hz[1]:
            raise ConfigError(
                f"cutoff_hz is {shown(self.cutoff_hz)}, and 0 is unlimited, the opposite of slow; "
                "give a lowest value above 0, or (0, 0)"
            )
        highest, most = self.threshold[1] * math.sqrt(self.ratio[1]), _ALLOWED["threshold"][1]
        if highest > most:
            raise ConfigError(
                f"threshold is {shown(self.threshold)}, ratio {shown(self.ratio)}; the geometric "
                f"mean of ON and OFF would reach {highest:.3g}, and {most:g} is the most: lower one"
            )

    def config(self, numbers: NDArray[np.float64]) -> PhysicalConfig:
        """Options of the pixels of a clip, by what `draw_clip` drew."""
        on, off, mismatch, noise_scale, hot_fraction, leak_hz, refractory_us, cutoff_hz = (
            float(one) for one in numbers[:8]
        )
        return PhysicalConfig(
            gamma=self.gamma,
            contrast_threshold=math.sqrt(on * off),
            on_off_ratio=on / off,
            threshold_sigma=mismatch,
            initial_phase="random" if self.has_phase else "zero",
            cutoff_hz=cutoff_hz,
            refractory_period_us=int(refractory_us),
            leak_rate_hz=leak_hz,
            noise_curve=self.noise_curve,
            noise_scale=noise_scale,
            hot_pixel_fraction=hot_fraction,
        )


NO_DRAWS = ClipRanges(
    threshold=(0.2, 0.2), ratio=(1.0, 1.0), noise=(0.0, 0.0), hot_fraction=(0.0, 0.0),
    hot_noise=(0.0, 0.0), pause=(0.0, 0.0), flip=0.0, has_phase=False,
)  # fmt: skip
RECOMMENDED = PhysicalRanges(noise_curve="0:1 255:1", noise_scale=(0.05, 0.5))
"""Ranges that teach most by docs/teaching.md: noise on every pixel, here .05 to .5 events a second,
and thresholds within the range of cameras; the same as configs/training/recommended.toml."""
Ranges: TypeAlias = ClipRanges | PhysicalRanges
RANGES: Mapping[str, Ranges] = MappingProxyType(
    {
        "recommended": RECOMMENDED,
        "physical": PhysicalRanges(),
        "v2v": ClipRanges(),
        "none": NO_DRAWS,
    }
)
"""By name; of "none", only the place in the video is drawn."""


class ClipDraw(NamedTuple):
    """Draws of one clip, whatever video it is cut from."""

    key: np.uint64
    """Key of its pixels."""
    numbers: NDArray[np.float64]
    """Thresholds, the numbers that its ranges name in `drawn`, and 1 where references have a phase:
    of `ClipRanges` a row of `clips.pixels.ClipPixels.numbers`."""
    is_flipped: bool
    speed: float
    """A chance, 0..1."""
    place: NDArray[np.float64]
    """[3] chances of its first frame, row and column."""
    is_paused: NDArray[np.bool_]
    """[T] whether an interval shows the same frame again."""


def draw_clip(ranges: Ranges, seed: int, number: int, intervals: int) -> ClipDraw:
    """The draws of clip `number` of a stream: of seed and number alone.

    Args:
        ranges: where from.
        seed: of the stream.
        number: of the clip, from 0.
        intervals: T.
    """
    key = frame_key(seed, number)
    chance = draw_uniforms(key, 0, 0, np.arange(14))

    def value(name: str, at: int) -> float:
        low, high = getattr(ranges, name)
        return float(low + chance[at] * (high - low))

    thresholds = [value("threshold", 0)] * 2
    thresholds[int(chance[2] < 0.5)] *= value("ratio", 1)
    drawn = [value(name, at) for name, at in ranges.drawn.items()]
    is_paused = np.zeros(intervals, np.bool_)
    paused = False
    for at, one in enumerate(draw_uniforms(key, 0, 1, np.arange(intervals))):
        is_paused[at] = paused = bool(one < ranges.pause[int(paused)])
    return ClipDraw(
        key,
        np.array([*thresholds, *drawn, float(ranges.has_phase)]),
        bool(chance[8] < ranges.flip),
        float(chance[9]),
        chance[10:13],
        is_paused,
    )


def order_of_pass(seed: int, number: int, count: int) -> NDArray[np.int64]:
    """Order in which a pass shows `count` sources: another one in every pass."""
    at = np.arange(count)
    words = draw_uniforms(frame_key(seed, -3 - number), at >> 16, at & 0xFFFF, 0)
    return np.argsort(words, kind="stable")
