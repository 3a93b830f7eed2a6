"""Threshold crossings of brightness that changes in a straight line between two frames, compiled.

ESIM and v2e share them, and the linear times of Texvent. A pixel fires at every threshold that its
brightness crosses, and its reference moves by one threshold per event. Crossings are counted first,
then listed, each as one 64-bit key of `kernels.radix_sort`.
"""

from __future__ import annotations

from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.runtime.kernel_arrays import take_scratch
from texvent.simulation.kernels.radix_sort import KEY_USES, key_bits
from texvent.simulation.packets import check_event_number
from texvent.simulation.random.mismatch import Thresholds

Float64Array: TypeAlias = NDArray[np.float64]


class RefractoryPeriod(NamedTuple):
    """Refractory period, in which a pixel cannot fire."""

    period_us: int
    """µs; 0 is none."""
    is_level_lost: bool
    """Whether a crossing within the period is lost (ESIM: the reference moves past it) or may still
    fire in a later interval (v2e: the reference stays)."""


_0, _1, _2 = np.uint64(0), np.uint64(1), np.uint64(2)
FEW = 2
"""Events that most pixels that fire have at most in an interval."""
_FEW = np.uint64(FEW)
BLOCK = 256
"""Pixels whose first events are timed together."""
NO_LEVEL = np.empty(0)
"""Stands for references that changes have been taken against."""


class RampChanges(NamedTuple):
    """Change of each pixel, and how many thresholds it crosses; [n] each."""

    start: Float64Array
    """Change at the start of the interval, log units."""
    stop: Float64Array
    """Change at its end."""
    threshold: Float64Array
    """Threshold of the polarity that it may fire."""
    steps: NDArray[np.int64]
    """Thresholds that it has passed at the end; OFF below 0."""


class KeyLayout(NamedTuple):
    """Place of the time of an event in its key."""

    start_us: int
    duration_us: int
    low: int
    """Bits of a key below its time."""


def key_layout(span_us: tuple[int, int], shape: tuple[int, int]) -> KeyLayout:
    """The layout for an interval and a sensor.

    Raises:
        InputError: the interval is too long for a sensor of this size.
    """
    start_us, stop_us = span_us
    return KeyLayout(start_us, stop_us - start_us, key_bits(stop_us - start_us, shape))


def list_crossing_keys(
    pixel: NDArray[np.int64],
    changes: RampChanges,
    thresholds: Thresholds,
    fired_us: NDArray[np.int64],
    layout: KeyLayout,
    refractory: RefractoryPeriod,
) -> NDArray[np.uint64]:
    """Keys of all events, by pixel and then in time; fills in thresholds and steps."""
    number = _count_crossings(changes, thresholds)
    check_event_number(number)
    keys = take_scratch(KEY_USES[0], number + FEW, np.uint64)
    list_crossings(pixel, changes, NO_LEVEL, layout, keys)
    if refractory.period_us > 0:
        number = _drop_refractory(pixel, changes.steps, fired_us, layout, refractory, keys)
    return keys[:number]


@jit(error_model="numpy")
def _count_crossings(changes: RampChanges, thresholds: Thresholds) -> int:
    """Fill in thresholds and steps; the number of all crossings."""
    _, stop, threshold, steps = changes
    (on, off), number = thresholds, 0
    # Loops over few arrays each, which become vector instructions.
    if on.size == 1:
        single_on, single_off = on[0], off[0]
        for n in range(stop.size):
            threshold[n] = single_on if stop[n] > 0 else single_off
    else:
        for n in range(stop.size):
            threshold[n] = on[n] if stop[n] > 0 else off[n]
    for n in range(stop.size):
        change, size = abs(stop[n]), threshold[n]
        # The quotient may be rounded across a whole number; what counts is the product.
        count = np.floor(change / size)
        count += 1.0 if change >= (count + 1.0) * size else 0.0
        count -= 1.0 if change < count * size else 0.0
        steps[n] = np.int64(count if stop[n] > 0 else -count)
        number += int(count)
    return number


@jit(error_model="numpy")
def list_crossings(
    pixel: NDArray[np.int64],
    changes: RampChanges,
    reference: Float64Array,
    layout: KeyLayout,
    keys: NDArray[np.uint64],
) -> None:
    """Fill in the keys of all events, by pixel and then in time.

    Args:
        pixel: flat index, [n].
        changes: brightness against the reference; or itself, if there are references.
        reference: [n] log units, or `NO_LEVEL`.
        layout: of the keys.
        keys: room for all events and `FEW` more.
    """
    start, stop, thresholds, steps = changes
    found, early = _0, np.empty((FEW, BLOCK), np.uint64)
    for number in range(0, pixel.size, BLOCK):
        first, last = np.uint64(number), np.uint64(min(number + BLOCK, pixel.size))
        for k in range(FEW):
            own = early[k]
            for i in range(first, last):
                line = _line(i, start, stop, reference, thresholds, steps)
                own[i - first] = _key(line, k, pixel[i], layout)
        for i in range(first, last):
            # The first few always, also beyond the count: the end of a loop whose length differs
            # from pixel to pixel is mispredicted. The next pixel overwrites what is too many.
            for k in range(_FEW):
                keys[found + k] = early[k, i - first]
            count = np.uint64(abs(steps[i]))
            if count > _FEW:
                line = _line(i, start, stop, reference, thresholds, steps)
                for k in range(_FEW, count):
                    keys[found + k] = _key(line, k, pixel[i], layout)
            found += count


@jit(inline="always")
def _line(
    i: Any,
    start: Float64Array,
    stop: Float64Array,
    reference: Float64Array,
    thresholds: Float64Array,
    steps: NDArray[np.int64],
) -> Any:
    """Start and stop of a pixel, its reference, and the signed threshold."""
    step = thresholds[i] if steps[i] > 0 else -thresholds[i]
    return start[i], stop[i], reference[i] if reference.size else 0.0, step


@jit(inline="always")
def _key(line: tuple[float, float, float, float], k: Any, pixel: int, layout: KeyLayout) -> Any:
    """Key of a pixel's event number k: where a straight line reaches the (k + 1)-th threshold.

    (R ± (k + 1)θ − start) / (stop − start) of the interval: exact for linear ramps, with any
    residual carried over. A crossing before the interval (left over from it) is put at its start.

    Source: ESIM (Rebecq, Gehrig and Scaramuzza, CoRL 2018).
    """
    start, stop, reference, step = line
    level = reference + (k + 1.0) * step
    is_before = start >= level if step > 0 else start <= level
    fraction = min(max((level - start) / (stop - start), 0.0), 1.0)
    fraction = 0.0 if is_before else 1.0 if stop == start else fraction
    return key_at(fraction, pixel, np.uint64(step > 0) << _1, layout)


@jit(inline="always")
def key_at(fraction: float, pixel: int, kind: np.uint64, layout: KeyLayout) -> Any:
    """Key of an event at a fraction 0..1 of the interval; `kind` has its p and label."""
    duration = np.float64(layout.duration_us)
    offset = np.int64(min(np.floor(fraction * duration), duration - 1.0))
    return np.uint64(offset) << np.uint64(layout.low) | np.uint64(pixel) << _2 | kind


@jit
def _drop_refractory(
    pixel: NDArray[np.int64],
    steps: NDArray[np.int64],
    fired_us: NDArray[np.int64],
    layout: KeyLayout,
    refractory: RefractoryPeriod,
    keys: NDArray[np.uint64],
) -> int:
    """Drop events within refractory periods, and note the last ones; how many are left."""
    found, listed = 0, 0
    for i in range(pixel.size):
        count = abs(steps[i])
        if count == 0:
            continue
        first, last_us = found, fired_us[pixel[i]] - layout.start_us
        for k in range(listed, listed + count):
            offset_us = np.int64(keys[k] >> np.uint64(layout.low))
            if offset_us - last_us >= refractory.period_us:
                keys[found], last_us = keys[k], offset_us
                found += 1
        listed += count
        fired_us[pixel[i]] = layout.start_us + last_us
        if not refractory.is_level_lost:
            steps[i] = found - first if steps[i] > 0 else first - found
    return found
