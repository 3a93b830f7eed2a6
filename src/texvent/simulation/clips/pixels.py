"""Pixels of training clips: ESIM's, with noise and constants that every clip has of its own.

Brightness is b = ln((I / 255)^γ + ε), a straight line between frames, and a pixel fires wherever
its distance from the reference crosses a multiple of its threshold; the reference moves along.
Noise is V2V's: at every frame the distance moves by a normal number, at hot pixels by a constant
too.

Every number comes from a key per clip, and normal numbers are sums of random bytes: with whole
numbers, products and quotients alone, compiled kernels of the CPU and of a GPU give equal bits.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_range, check_whole
from texvent.errors import InputError
from texvent.sensor import SensorSize
from texvent.simulation.random.draws import Purpose

Float64Array = NDArray[np.float64]

LOWEST = 0.01
"""Floor of thresholds with mismatch, log units, as in `random.mismatch`."""
LONG_AGO_US = -(2**40)
"""Stands for the last event of a pixel that has not fired."""
BYTES_MEAN, BYTES_UNIT = 1020, 1.0 / math.sqrt(8 * (2**16 - 1) / 12)
"""Mean of the sum of eight random bytes, and the inverse of its standard deviation."""
EVEN_BYTES, BYTE_SUM = 0x00FF00FF00FF00FF, 0x0001000100010001
"""Every other byte of a word; the product with it has the sum of four 16-bit numbers on top."""
NOISE_WORDS = 0x9E3779B9, 0x7FEB352D, 0x846CA68B
"""Factors of the noise, whose draws are 32 bits wide so that processors make eight at once. They
come from the pixel's index and the two halves of a word of the frame; the last two factors are
those of C. Wellons' lowbias32 (public domain)."""
NOISE_MEAN, NOISE_UNIT = 510, 1.0 / math.sqrt(4 * (2**16 - 1) / 12)
"""Mean and unit of the sum of its four bytes, as above."""
ON_DRAW, OFF_DRAW, PHASE_DRAW, CHOICE_DRAW, HOT_DRAW, NOISE_DRAW = (
    int(one)
    for one in (
        Purpose.THRESHOLD_ON.draw(),
        Purpose.THRESHOLD_OFF.draw(),
        Purpose.PHASE.draw(),
        Purpose.HOT_PIXEL.draw(),
        Purpose.HOT_PIXEL.draw(1),
        Purpose.VOLTAGE.draw(),
    )
)
THRESHOLD_ON, THRESHOLD_OFF, MISMATCH, NOISE, HOT_FRACTION, HOT_NOISE, REFRACTORY_US, HAS_PHASE = (
    range(8)
)
"""Columns of `ClipPixels.numbers`."""


class ClipPixels(NamedTuple):
    """Constants of the pixels of a batch; B clips."""

    numbers: Float64Array
    """[B, 8] by the columns above: thresholds, log units; standard deviation between the pixels, a
    share of the threshold; noise, log units per frame; share of hot pixels; standard deviation of
    what they move by, log units per frame; refractory period, µs; 1 where references begin anywhere
    between the thresholds, 0 where they begin at the first frame."""
    keys: NDArray[np.uint64]
    """[B] of `draws.frame_key`."""
    brightness: Float64Array
    """[256] of a byte, log units; increasing."""


def byte_brightness(gamma: float, log_eps: float) -> Float64Array:
    """[256] b of every byte; a gamma of 1 is ESIM's."""
    return np.asarray(np.log((np.arange(256) / 255.0) ** gamma + log_eps))


@dataclass(frozen=True, kw_only=True)
class ClipOutputs:
    """Arrays that are made of a batch.

    Raises:
        ConfigError: a number is out of range.
    """

    bins: int = 5
    """Time bins of a grid."""
    intervals_per_window: int = 1
    """Intervals between frames that a grid spans."""
    grids: bool = True
    """Voxel grids, as `represent.voxel_grid.voxel_e2vid` of the events of a window."""
    counts: bool = False
    """Events by polarity."""
    latest: bool = False
    """Times of the last events by polarity."""
    events: bool = False
    """The events themselves."""

    def __post_init__(self) -> None:
        check_whole("bins", self.bins, 1, 64)
        check_whole("intervals_per_window", self.intervals_per_window, 1, 1024)

    def count_bytes(self, clips: int, intervals: int, size: SensorSize) -> int:
        """Bytes of the frames of a batch and of its arrays; making them takes more."""
        windows = intervals // self.intervals_per_window
        of_window = 4 * self.bins * self.grids + 8 * self.counts + 8 * self.latest
        return clips * size.width * size.height * (intervals + 1 + windows * of_window)


class ClipArrays(NamedTuple):
    """Arrays of a batch: NumPy arrays or torch tensors; W windows. None: not asked for."""

    grids: Any
    """[B, W, bins, H, W] float32, events (signed)."""
    counts: Any
    """[B, W, 2, H, W] int32; index 0 is OFF."""
    latest: Any
    """[B, W, 2, H, W] int32, µs since the start of the window; −1 for none; index 0 is OFF."""
    words: Any
    """[n] int64, ((t · area + pixel) << 1) | p, in order within a clip; t in µs since its start."""
    ends: NDArray[np.int64] | None
    """[B] end of the words of each clip."""


def check_clips(frames: Any, times_us: NDArray[np.int64], outputs: ClipOutputs) -> None:
    """Refuse clips that the kernels cannot take.

    Args:
        frames: [B, T + 1, H, W] uint8.
        times_us: [B, T + 1] since the first frame of each clip, µs.
        outputs: whose windows must fit.

    Raises:
        InputError: another shape, times that do not rise from 0, or too long a clip.
    """
    shape, intervals = tuple(frames.shape), frames.shape[1] - 1
    if len(shape) != 4 or intervals < 1 or intervals % outputs.intervals_per_window:
        raise InputError(
            f"clips have the shape {list(shape)}; it must be [clips, frames, rows, columns] with "
            f"whole windows of {outputs.intervals_per_window} intervals"
        )
    if times_us.shape != shape[:2] or times_us[:, 0].any() or (np.diff(times_us) <= 0).any():
        raise InputError("times of clips must rise from 0, one per frame")
    check_range("length of a clip in µs", int(times_us.max()), 1, 2**31 - 1)
