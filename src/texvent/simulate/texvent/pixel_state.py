"""The memory of the fast Texvent model, made from frames; see `kernels.scan`."""

from __future__ import annotations

import functools
import math

import numpy as np

from texvent.brightness import Float64Array, balanced_log
from texvent.runtime.read_only import read_only
from texvent.simulate.crossing.trigger_levels import MARGIN, trigger_factors
from texvent.simulate.texvent.config import TexventConfig
from texvent.simulate.texvent.kernels.scan import (
    SCAN_FLOOR,
    Intensity,
    Memory,
    ScanLevels,
)
from texvent.video import UINT16_PER_LEVEL

_CHUNK = 1 << 16
"""Pixels whose logarithms are taken at a time where all levels move."""
_NOTHING = np.empty(0)


def remember(first: Intensity, config: TexventConfig) -> Memory:
    """The memory of pixels that have seen one frame.

    Args:
        first: its intensity, [n]: uint8, uint16 (0..65535 scale) or float32.
        config: options; they decide what has to be remembered.
    """
    has_levels = needs_levels(config)
    if has_levels:
        first = as_luma(first)
    # The kernels write to these, so none may be the caller's array.
    memory = Memory(
        reference=first.copy(),
        renewed=np.empty(0 if has_levels or not may_renew(config) else first.size, first.dtype),
        previous=np.empty(0, first.dtype) if config.timestamp_rule != "linear" else first.copy(),
        level=np.empty(first.size if has_levels else 0),
        table=_NOTHING if has_levels else brightness_table(first.dtype.str, config.balance),
    )
    if has_levels:
        move_levels(memory, first, config.balance, 1.0)
    return memory


def keep_levels(memory: Memory, config: TexventConfig) -> None:
    """Go over to `Memory.level`, for whatever moves references between intensities.

    Args:
        memory: of pixels whose references are intensities so far; none of them has renewed all.
        config: options.
    """
    turn_to_float(memory)
    memory.renewed = np.empty(0, np.float32)
    memory.level = np.asarray(balanced_log(memory.reference, config.balance))
    memory.reference = np.exp(memory.level).astype(np.float32)


def needs_levels(config: TexventConfig) -> bool:
    """Whether references lie between intensities, so that their brightness has to be kept."""
    if config.cache == "none":
        return False
    return config.reset == "step" or (config.cache == "global" and config.residual_decay_hz > 0)


def may_renew(config: TexventConfig) -> bool:
    """Whether all references are ever renewed at once."""
    return config.cache in ("none", "local")


def as_luma(intensity: Intensity) -> Intensity:
    """The float32 luma on the 0..255 scale, as `Frame.luma` computes it, [n]."""
    if intensity.dtype == np.uint16:
        return np.asarray(intensity / np.float32(UINT16_PER_LEVEL), np.float32)
    return np.asarray(intensity, np.float32)


def turn_to_float(memory: Memory) -> None:
    """Go over to float32 intensities, which hold those of both integer types exactly."""
    memory.reference = as_luma(memory.reference)
    memory.previous = as_luma(memory.previous)
    memory.renewed = np.empty(memory.renewed.size, np.float32)
    memory.table = _NOTHING
    memory.work = None


def move_levels(memory: Memory, luma: Intensity, balance: float, share: float) -> None:
    """Move every pixel's reference towards the brightness of a frame.

    Args:
        memory: of pixels whose references lie between intensities.
        luma: of the frame, [n] float32.
        balance: α, 0..255 scale.
        share: of the distance, above 0 up to 1.
    """
    for first in range(0, luma.size, _CHUNK):
        part = slice(first, first + _CHUNK)
        brightness = balanced_log(luma[part], balance)
        level = memory.level[part]
        if share == 1:
            level[:] = brightness
        else:
            level += share * (brightness - level)
        memory.reference[part] = np.exp(level)


@functools.lru_cache(maxsize=16)
def brightness_table(dtype: str, balance: float) -> Float64Array:
    """Brightness of every intensity of an integer type; empty for float32.

    Returns:
        [256] or [65536], −∞ for black without a balance; read-only.
    """
    if np.dtype(dtype).kind == "f":
        return _NOTHING
    luma = as_luma(np.arange(np.iinfo(dtype).max + 1).astype(dtype))
    lit = luma[1:] if balance == 0 else luma
    dark = [-math.inf] if balance == 0 else []
    return read_only(np.concatenate([dark, balanced_log(lit, balance)]))


def scan_levels(config: TexventConfig, memory: Memory) -> ScanLevels:
    """How the scan compares this memory with frames."""
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
    """Smallest difference of two uint8 intensities above 0 that fires; 255 if none does."""
    table = brightness_table("uint8", balance)[0 if balance > 0 else 1 :]
    for difference in range(1, len(table)):
        if np.max(table[difference:] - table[:-difference]) >= threshold:
            return np.uint8(difference)
    return np.uint8(255)
