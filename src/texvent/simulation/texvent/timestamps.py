"""Time stamp reconstruction (Eq. 7), compiled: the time of an event within its sub-interval.

Every rule gives a fraction 0..1 of the sub-interval per event. Signal and noise both come by pixel,
so they are merged into one list of keys in that order, and sorting by time is all that is left.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.events import NOISE
from texvent.runtime.jit import jit
from texvent.runtime.kernel_arrays import take_scratch
from texvent.simulation.crossing.ramp import (
    FEW,
    KeyLayout,
    RampChanges,
    key_at,
    key_layout,
    list_crossings,
)
from texvent.simulation.kernels.radix_sort import KEY_USES, sort_keys, unpack_keys
from texvent.simulation.packets import FrameInterval, SortedEvents
from texvent.simulation.random.compiled_draws import draw_uniform
from texvent.simulation.random.draws import Purpose
from texvent.simulation.texvent.config import TexventConfig
from texvent.simulation.texvent.noise import NoisePlaces
from texvent.simulation.texvent.pixel_memory import FiredPixels

Float64Array = NDArray[np.float64]
Int64Array = NDArray[np.int64]
Uint64Array = NDArray[np.uint64]

_DRAW = int(Purpose.TIMESTAMP.draw())
_NOISE = np.uint64(NOISE)
_1 = np.uint64(1)
_SIZE_BITS = (1 << 63) - 1
"""Bits of a float64 but its sign."""
_INFINITY_BITS = int(np.array(np.inf).view(np.int64))


def timestamp_events(
    fired: FiredPixels,
    noise: NoisePlaces,
    config: TexventConfig,
    span: FrameInterval,
    shape: tuple[int, int],
) -> SortedEvents:
    """Times of all events (Eq. 7), and signal and noise in the order of a packet.

    Args:
        fired: the pixels that fired.
        noise: noise events.
        config: options.
        span: the sub-interval.
        shape: (height, width).

    Raises:
        InputError: the sub-interval is too long for a sensor of this size.
    """
    pixel, change, start, stop, reference = fired
    layout = key_layout((span.start_us, span.stop_us), shape)
    rule, number, steps = config.timestamp_rule, pixel.size, take_scratch("steps", 0, np.int64)
    if rule != "eq7":
        steps = take_scratch("steps", number, np.int64)
        number = _count_steps(change, config.contrast_threshold, config.multi_event, steps)
    keys, spare = (
        take_scratch(use, number + FEW + noise.pixel.size, np.uint64) for use in KEY_USES
    )
    if rule == "eq7":
        _list_by_size(pixel, change, layout, keys)
    elif rule == "linear":
        threshold = take_scratch("threshold", pixel.size, np.float64)
        threshold[:] = config.contrast_threshold
        list_crossings(pixel, RampChanges(start, stop, threshold, steps), reference, layout, keys)
    else:
        _list_others(pixel, steps, rule == "random", (span.key, shape[1]), layout, keys)
    is_at_rest = config.noise == "adaptive"
    bits = layout.low + layout.duration_us.bit_length()
    return SortedEvents(*_order((keys, spare), number, noise, is_at_rest, layout, bits, shape[1]))


@jit(error_model="numpy")
def _count_steps(
    changes: Float64Array, threshold: float, is_multi_event: bool, steps: Int64Array
) -> int:
    """Fill in the events of every pixel, OFF below 0; how many there are."""
    number = 0
    for i in range(changes.size):
        count = np.floor(abs(changes[i]) / threshold) if is_multi_event else 1.0
        steps[i] = np.int64(count if changes[i] > 0 else -count)
        number += int(count)
    return number


@jit(error_model="numpy")
def _list_by_size(
    pixel: Int64Array, changes: Float64Array, layout: KeyLayout, keys: Uint64Array
) -> None:
    """Keys by the paper's rule: the largest change at the start, the smallest at the end.

    Args:
        pixel: pixels that fire once, [n].
        changes: brightness minus reference, log units, [n].
        layout: of the keys.
        keys: [n] or more, filled in.

    Equation: (7), section 3.2.2: u = 1 − (Δ − min Δ) / (max Δ − min Δ), with Δ = |change|.
    Deviation: the range of Δ is that of the event pixels of this sub-interval (the paper does not
        say); where all Δ are equal, and the paper divides by zero, u = 1/2.
    """
    # As bits, whose order is that of sizes: minima of floats do not become vector instructions.
    bits, reach = changes.view(np.int64), np.array([_INFINITY_BITS, 0])
    least, most = reach
    for i in range(bits.size):
        size = bits[i] & _SIZE_BITS
        least, most = min(least, size), max(most, size)
    reach[0], reach[1] = least, most
    smallest, largest = reach.view(np.float64)
    for i in range(pixel.size):
        share = (abs(changes[i]) - smallest) / (largest - smallest)
        fraction = 0.5 if largest == smallest else 1.0 - share
        keys[i] = key_at(fraction, pixel[i], np.uint64(changes[i] > 0) << _1, layout)


@jit
def _list_others(
    pixel: Int64Array,
    steps: Int64Array,
    is_random: bool,
    draws: tuple[np.uint64, int],
    layout: KeyLayout,
    keys: Uint64Array,
) -> None:
    """Keys by pixel, at random times or at the end; `draws` are their key and a row's width."""
    (key, width), found = draws, 0
    for i in range(pixel.size):
        y = pixel[i] // width
        for order in range(1, abs(steps[i]) + 1):
            fraction = 1.0
            if is_random:
                fraction = draw_uniform(key, y, pixel[i] - y * width, _DRAW + order)
            keys[found] = key_at(fraction, pixel[i], np.uint64(steps[i] > 0) << _1, layout)
            found += 1


@jit
def _order(
    room: tuple[Uint64Array, Uint64Array],
    number: int,
    noise: NoisePlaces,
    is_at_rest: bool,
    layout: KeyLayout,
    bits: int,
    width: int,
) -> Any:
    """Columns of the packet, of `number` keys of signal of so many `bits`, and of noise."""
    keys, spare = room
    if noise.pixel.size:
        number = _merge(keys[:number], _list_noise(noise, layout), is_at_rest, layout, spare)
        keys, spare = spare, keys
    keys = sort_keys(keys[:number], spare[:number], layout.low, bits)
    return unpack_keys(keys, layout.start_us, width, layout.low)


@jit
def _list_noise(noise: NoisePlaces, layout: KeyLayout) -> Uint64Array:
    """Keys of noise events, by pixel and polarity."""
    pixel, fraction, p = noise
    keys = np.empty(pixel.size, np.uint64)
    for i in range(pixel.size):
        keys[i] = key_at(fraction[i], pixel[i], np.uint64(p[i]) << _1 | _NOISE, layout)
    return keys


@jit
def _merge(
    signal: Uint64Array,
    noise: Uint64Array,
    is_at_rest: bool,
    layout: KeyLayout,
    keys: Uint64Array,
) -> int:
    """Both by pixel, p and label into `keys`; how many there are.

    Noise of pixels that fired is left out if it must be at rest (Eq. 6).
    """
    mask = (_1 << np.uint64(layout.low)) - _1
    # What noise is compared by: its pixel alone, so that it meets all events of the pixel.
    of_pixel = ~np.uint64(3) if is_at_rest else ~np.uint64(0)
    found, waiting = 0, 0
    for i in range(signal.size):
        own = signal[i] & mask & of_pixel
        while waiting < noise.size and (noise[waiting] & mask & of_pixel) <= own:
            if not is_at_rest or (noise[waiting] & mask & of_pixel) < own:
                keys[found] = noise[waiting]
                found += 1
            waiting += 1
        keys[found] = signal[i]
        found += 1
    for i in range(waiting, noise.size):
        keys[found] = noise[i]
        found += 1
    return found
