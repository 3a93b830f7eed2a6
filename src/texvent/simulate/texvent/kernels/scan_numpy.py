"""Trigger levels in NumPy: what runs where nothing is compiled, or not yet."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.brightness import balanced_log
from texvent.simulate.texvent.kernels.scan import (
    Fired,
    FireRule,
    Float64Array,
    Intensity,
    Memory,
    ScanLevels,
)
from texvent.video import is_intensity

CHUNK = 1 << 17
"""Pixels scanned at a time, so that what lies between two passes stays in the cache."""
_NOTHING = np.empty(0)


def find_fired(
    frame: Intensity, memory: Memory, levels: ScanLevels, rule: FireRule
) -> Fired | None:
    """Which pixels fire in a sub-interval; changes what the pixels remember.

    Args:
        frame: intensity at its end, [n].
        memory: what the pixels remember of the frames before.
        levels: for the scan.
        rule: what firing is, and what it does.

    Returns:
        None where an intensity is NaN, infinite or negative; then nothing was changed.

    Equation: (5), section 3.2.2, as `texvent.kernels.scan` tells it.
    """
    candidates = []
    for first in range(0, frame.size, CHUNK):
        now = frame[first : first + CHUNK]
        if not is_intensity(now):
            return None
        may_fire = _may_fire(now, memory.reference[first : first + CHUNK], levels)
        candidates.append(np.flatnonzero(may_fire) + first)
    if rule.is_renewed:
        memory.renewed[:] = frame
    return settle(frame, np.concatenate(candidates), memory, rule)


def settle(
    frame: Intensity, candidates: NDArray[np.int64], memory: Memory, rule: FireRule
) -> Fired:
    """Which candidates fire, exactly; moves what they remember and renews references.

    Args:
        frame: intensity at the end of the sub-interval, [n].
        candidates: flat index of the pixels that may fire, ascending.
        memory: where `renewed` holds the frame if the rule renews references.
        rule: what firing is, and what it does.
    """
    now = brightness_of(frame[candidates], memory, rule)
    if memory.level.size:
        then = memory.level[candidates]
    else:
        then = brightness_of(memory.reference[candidates], memory, rule)
    change = now - then
    is_fired = np.abs(change) >= rule.threshold
    pixel = candidates
    if not is_fired.all():
        pixel, change = candidates[is_fired], change[is_fired]
        now, then = now[is_fired], then[is_fired]
    fired = Fired(pixel, change, _NOTHING, _NOTHING, _NOTHING)
    if rule.has_line:
        start = brightness_of(memory.previous[pixel], memory, rule)
        fired = Fired(pixel, change, start, now, then)
        memory.previous[:] = frame
    _renew(frame, fired, now, memory, rule)
    return fired


def brightness_of(intensity: Intensity, memory: Memory, rule: FireRule) -> Float64Array:
    """Exact brightness, L(α + I), [n]."""
    if memory.table.size:
        return np.asarray(memory.table[intensity])
    return balanced_log(intensity, rule.balance)


def _renew(
    frame: Intensity, fired: Fired, now: Float64Array, memory: Memory, rule: FireRule
) -> None:
    """Move the references of the pixels that fired, or all of them."""
    if rule.is_renewed and not memory.level.size:
        memory.reference, memory.renewed = memory.renewed, memory.reference
    elif not memory.level.size:
        memory.reference[fired.pixel] = frame[fired.pixel]
    else:
        level = now
        if rule.is_step:
            size = np.abs(fired.change)
            number = np.floor(size / rule.threshold) if rule.multi_event else 1.0
            level = memory.level[fired.pixel] + np.sign(fired.change) * (number * rule.threshold)
        memory.level[fired.pixel] = level
        memory.reference[fired.pixel] = np.exp(level)


def _may_fire(now: Intensity, reference: Intensity, levels: ScanLevels) -> NDArray[np.bool_]:
    """Pixels at or beyond their trigger levels."""
    if now.dtype == np.uint8:
        return np.asarray(np.maximum(now, reference) - np.minimum(now, reference) >= levels.least)
    is_on = now >= reference * levels.up + levels.up_offset
    return np.asarray(is_on | (now <= reference * levels.down + levels.down_offset))
