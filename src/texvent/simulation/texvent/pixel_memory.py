"""Memory of the pixels of the Texvent model between frames, and their trigger levels.

By definition every pixel of every frame is compared in float64. This form returns the same events,
bit for bit, without a logarithm per pixel, because an event needs only this state and these levels.

**State.** One array per pixel, `reference`: the intensity R that the pixel compares with, in the
type of the frames (uint8, uint16 or float32 luma; once frames of two types have come, float32,
which holds all three exactly). That is the whole state, because Eq. 5's cached reference is always
the intensity of an earlier frame: where a pixel fires, R becomes the frame's intensity there; where
the cache forgets (`local` after a source frame, `none` after every frame), R becomes the frame.
Only `reset="step"` and the residual decay move references between intensities. They keep two arrays
instead: `level`, the reference brightness itself, float64, exact; and `reference`, float32, the
balanced intensity exp(level), for the scan alone, rounded any way, within a relative 10⁻⁷.

**Trigger levels.** With brightness L = ln(α + I) an event is

    |L(I) − L(R)| ≥ δ   ⇔   α + I ≥ (α + R)·e^δ   or   α + I ≤ (α + R)·e^−δ ,

so a scan needs two multiplications and two comparisons per pixel, in float32. The levels are moved
towards R by the margin of `crossing.trigger_levels`: a pixel outside them *may* fire (a candidate),
a pixel inside cannot. A candidate fires if and only if `L(I) − L(R)`, both in float64 as
`brightness.balanced_log` computes them, differs from 0 by δ or more. For 8-bit frames a look-up
table of 256 logarithms does that, for 16-bit ones one of 65,536; float frames take NumPy's
logarithm of the candidates. For 8-bit frames there is an even cheaper scan, on bytes: no pixel
fires whose intensity differs from R by less than the smallest difference of any two levels that
fires.
"""

from __future__ import annotations

import functools
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.brightness import Float64Array, balanced_log
from texvent.frames import UINT16_PER_LEVEL
from texvent.runtime.kernel_arrays import read_only
from texvent.simulation.crossing.trigger_levels import MARGIN, trigger_factors
from texvent.simulation.texvent.config import TexventConfig

Intensity: TypeAlias = NDArray[Any]
"""[n] flat: uint8 or float32 luma on the 0..255 scale, or uint16 on the 0..65535 scale."""

SCAN_FLOOR = 1e-37
"""Added to `trigger_levels.MARGIN`, for intensities so small that float32 has no relative
precision."""


class ScanLevels(NamedTuple):
    """Trigger levels of a scan: `I ≥ R·up + up_offset` or `I ≤ R·down + down_offset`, float32.

    The trigger levels of above, `(α + R)·e^±δ − α`, moved towards each other by the margin.
    """

    up: np.float32
    up_offset: np.float32
    down: np.float32
    down_offset: np.float32
    least: np.uint8
    """Smallest difference of two uint8 intensities that may fire."""


class FireRule(NamedTuple):
    """Rule by which pixels fire and their references move (Eq. 5)."""

    threshold: float
    """δ, log units."""
    balance: float
    """α, 0..255 scale."""
    multi_event: bool
    """Whether a pixel fires floor(Δ / δ) times."""
    is_step: bool
    """Whether an event moves the level by δ; else to the frame's brightness."""
    is_renewed: bool
    """Whether the cache forgets all references after this frame: the frame becomes them."""
    has_line: bool
    """Whether the times of events need to know where brightness came from."""


class FiredPixels(NamedTuple):
    """The pixels that fired in one sub-interval, in row-major order: of a sensor, or of a band."""

    pixel: NDArray[np.int64]
    """[n] flat index y · W + x, ascending."""
    change: Float64Array
    """[n] brightness minus reference brightness, log units."""
    start: Float64Array
    """[n] brightness at the start of the sub-interval; [0] unless `FireRule.has_line`."""
    stop: Float64Array
    """[n] brightness at its end; [0] likewise."""
    reference: Float64Array
    """[n] reference brightness; [0] likewise."""

    def first(self, number: int) -> FiredPixels:
        """Views of the first so many rows."""
        rows, lines = slice(number), slice(number if self.start.size else None)
        pixel, change, start, stop, reference = self
        return FiredPixels(pixel[rows], change[rows], start[lines], stop[lines], reference[lines])


@dataclass(eq=False)
class Memory:
    """Memory of a sensor's pixels between frames; flat arrays, changed by the kernels."""

    reference: Intensity
    """[n] intensity that each pixel compares with, of the frames' type; beside `level` float32,
    exp(level)."""
    previous: Intensity
    """[n] intensity of the frame before, or [0] where times do not depend on it; of the frames'
    type."""
    level: Float64Array
    """[n] reference brightness, or [0] where `reference` says it all."""
    table: Float64Array
    """Brightness of every intensity that an integer type has, or [0] for float32."""


_CHUNK = 1 << 14
"""Pixels whose logarithms are taken at a time where all levels move."""
_NOTHING = np.empty(0)


def init_memory(first: Intensity, config: TexventConfig) -> Memory:
    """The memory of pixels that have seen one frame.

    Args:
        first: its intensity, [n]: uint8, uint16 (0..65535 scale) or float32.
        config: options; they decide what has to be remembered.
    """
    has_levels = needs_levels(config)
    if has_levels and first.dtype != np.uint8:
        first = as_luma(first)
    # The kernels write to these, so none may be the caller's array.
    memory = Memory(
        reference=np.empty(first.size, np.float32) if has_levels else first.copy(),
        previous=np.empty(0, first.dtype) if config.timestamp_rule != "linear" else first.copy(),
        level=np.empty(first.size if has_levels else 0),
        table=brightness_table(first.dtype.str, config.balance),
    )
    if has_levels:
        update_reference(memory, first, config.balance, 1.0)
    return memory


def store_reference(memory: Memory, config: TexventConfig) -> None:
    """Go over to `Memory.level`, for whatever moves references between intensities.

    Args:
        memory: of pixels whose references are intensities so far.
        config: options.
    """
    turn_to_float(memory)
    memory.level = np.asarray(balanced_log(memory.reference, config.balance))
    memory.reference = np.exp(memory.level).astype(np.float32)


def needs_levels(config: TexventConfig) -> bool:
    """Whether references lie between intensities, so that their brightness has to be kept."""
    if config.cache == "none":
        return False
    return config.reset == "step" or (config.cache == "global" and config.residual_decay_hz > 0)


def as_luma(intensity: Intensity) -> Intensity:
    """The float32 luma on the 0..255 scale, as `Frame.luma` computes it, [n]."""
    if intensity.dtype == np.uint16:
        return np.asarray(intensity / np.float32(UINT16_PER_LEVEL), np.float32)
    return np.asarray(intensity, np.float32)


def turn_to_float(memory: Memory) -> None:
    """Go over to float32 intensities, which hold those of both integer types exactly."""
    memory.reference = as_luma(memory.reference)
    memory.previous = as_luma(memory.previous)
    memory.table = _NOTHING


def update_reference(memory: Memory, intensity: Intensity, balance: float, share: float) -> None:
    """Move every pixel's reference towards the brightness of a frame.

    Args:
        memory: of pixels whose references are between intensities.
        intensity: of the frame, [n], of the type of `memory.previous`.
        balance: α, 0..255 scale.
        share: of the distance, above 0 up to 1.
    """
    for first in range(0, intensity.size, _CHUNK):
        part = slice(first, first + _CHUNK)
        seen, level, table = intensity[part], memory.level[part], memory.table
        brightness = table.take(seen) if table.size else balanced_log(seen, balance)
        if share == 1:
            level[:] = brightness
        else:
            level += share * (brightness - level)
        np.exp(level, out=memory.reference[part])


@functools.lru_cache(maxsize=16)
def brightness_table(dtype: str, balance: float) -> Float64Array:
    """Brightness of every intensity of an integer type; empty for float32.

    Returns:
        [256] or [65536], read-only.
    """
    if np.dtype(dtype).kind == "f":
        return _NOTHING
    luma = as_luma(np.arange(np.iinfo(dtype).max + 1).astype(dtype))
    return read_only(balanced_log(luma, balance))


def scan_levels(config: TexventConfig, memory: Memory) -> ScanLevels:
    """Trigger levels for the scan of frames against this memory."""
    is_full_scale = memory.reference.dtype == np.uint16
    balance = config.balance * (UINT16_PER_LEVEL if is_full_scale else 1.0)
    in_reference = 0.0 if memory.level.size else balance
    factors = trigger_factors(config.contrast_threshold, config.contrast_threshold)
    up = factors.up * (1 - MARGIN)
    down = factors.down * (1 + MARGIN)
    room = balance * MARGIN + SCAN_FLOOR
    return ScanLevels(
        up=np.float32(up),
        up_offset=np.float32(in_reference * up - balance - room),
        down=np.float32(down),
        down_offset=np.float32(in_reference * down - balance + room),
        least=least_difference(config.contrast_threshold, config.balance),
    )


@functools.lru_cache(maxsize=16)
def least_difference(threshold: float, balance: float) -> np.uint8:
    """Smallest difference of two uint8 intensities that fires; 255 if none does."""
    table = brightness_table("uint8", balance)
    for difference in range(1, len(table)):
        if np.max(table[difference:] - table[:-difference]) >= threshold:
            return np.uint8(difference)
    return np.uint8(255)
