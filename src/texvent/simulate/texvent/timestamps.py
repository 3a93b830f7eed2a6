"""Time stamp reconstruction (Eq. 7), compiled: the time of an event within its sub-interval.

Every rule gives a fraction 0..1 of the sub-interval per event. Signal and noise both come by pixel,
so they are merged into one list of keys in that order, and sorting by time is all that is left.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.events import NOISE
from texvent.runtime.jit import jit
from texvent.simulate.kernels.radix_sort import key_bits, sort_keys, unpack_keys
from texvent.simulate.packets import FrameInterval, SortedEvents
from texvent.simulate.random.draws import Purpose
from texvent.simulate.random.draws_cpu import draw_uniform
from texvent.simulate.texvent.config import TexventConfig
from texvent.simulate.texvent.noise import NoisePlaces
from texvent.simulate.texvent.pixel_memory import FiredPixels

Float64Array = NDArray[np.float64]


Uint64Array = NDArray[np.uint64]

_STAMPS = ("eq7", "random", "linear", "end")
_EQ7, _RANDOM, _LINEAR, _END = range(len(_STAMPS))
_DRAW = int(Purpose.TIMESTAMP.draw())
_NOISE = np.uint64(NOISE)
_1, _2 = np.uint64(1), np.uint64(2)
_SIZE_BITS = (1 << 63) - 1
"""Bits of a float64 but its sign."""
_INFINITY_BITS = int(np.array(np.inf).view(np.int64))


class _Rule(NamedTuple):
    """The options that decide times (Eq. 7) and numbers of events, and the sensor."""

    timestamp_rule: int
    threshold: float
    """δ, log units."""
    multi_event: bool
    """Whether a pixel fires floor(Δ / δ) times."""
    noise_at_rest: bool
    """Whether noise is dropped where the pixel fired (Eq. 6)."""
    width: int
    low: int
    """Bits of a key below its time."""

    @classmethod
    @functools.lru_cache(maxsize=16)
    def of(cls, config: TexventConfig, width: int, low: int) -> _Rule:
        """The same numbers for every packet of a simulator."""
        return cls(
            _STAMPS.index(config.timestamp_rule),
            config.contrast_threshold,
            config.multi_event,
            config.noise == "adaptive",
            width,
            low,
        )


def timestamp_events(
    bands: Sequence[FiredPixels],
    noise: NoisePlaces,
    config: TexventConfig,
    span: FrameInterval,
    shape: tuple[int, int],
) -> SortedEvents:
    """Times of all events (Eq. 7), and signal and noise in the order of a packet.

    Args:
        bands: the pixels that fired, of bands that follow each other, at least one.
        noise: noise events.
        config: options.
        span: the sub-interval.
        shape: (height, width).

    Raises:
        InputError: the sub-interval is too long for a sensor of this size.
    """
    low = key_bits(span.duration_us, shape)
    rule, bits = _Rule.of(config, shape[1], low), low + span.duration_us.bit_length()
    if len(bands) == 1:
        return SortedEvents(*_stamp_events(bands[0], noise, rule, span, bits))
    return SortedEvents(*_stamp_bands(bands, noise, rule, span, bits))


def _stamp_bands(
    bands: Sequence[FiredPixels], noise: NoisePlaces, rule: _Rule, span: FrameInterval, bits: int
) -> Any:
    """The same for several bands, whose columns need not be joined for it."""
    numbers, smallest, largest = zip(*(_measure(band.change, rule) for band in bands), strict=True)
    reach = min(smallest), max(largest)
    signal, first = np.empty(sum(numbers), np.uint64), 0
    for band, number in zip(bands, numbers, strict=True):
        _list_signal(band, reach, rule, span, signal[first : first + number])
        first += number
    return _order(signal, noise, rule, span, bits)


@jit
def _stamp_events(
    fired: FiredPixels, noise: NoisePlaces, rule: _Rule, span: FrameInterval, bits: int
) -> Any:
    number, smallest, largest = _measure(fired.change, rule)
    signal = np.empty(number, np.uint64)
    _list_signal(fired, (smallest, largest), rule, span, signal)
    return _order(signal, noise, rule, span, bits)


@jit
def _measure(changes: Float64Array, rule: _Rule) -> tuple[int, float, float]:
    """Number of events, and the smallest and largest |ΔL|."""
    number = changes.size
    if rule.multi_event:
        number = 0
        for change in changes:
            number += _number_of(change, rule)
    # As bits, whose order is that of sizes: minima of floats do not become vector instructions.
    bits, reach = changes.view(np.int64), np.array([_INFINITY_BITS, 0])
    smallest, largest = reach
    for i in range(bits.size):
        size = bits[i] & _SIZE_BITS
        smallest, largest = min(smallest, size), max(largest, size)
    reach[0], reach[1] = smallest, largest
    ends = reach.view(np.float64)
    return number, ends[0], ends[1]


@jit
def _order(
    signal: Uint64Array, noise: NoisePlaces, rule: _Rule, span: FrameInterval, bits: int
) -> Any:
    """Columns of the packet."""
    keys = signal
    if noise.pixel.size:
        keys = _merge(signal, _list_noise(noise, rule, span), rule)
    keys = sort_keys(keys, np.empty_like(keys), rule.low, bits)
    return unpack_keys(keys, span.start_us, rule.width, rule.low)


@jit(inline="always")
def _number_of(change: float, rule: _Rule) -> Any:
    return np.int64(math.floor(abs(change) / rule.threshold)) if rule.multi_event else 1


@jit
def _list_signal(
    fired: FiredPixels,
    reach: tuple[float, float],
    rule: _Rule,
    span: FrameInterval,
    keys: Uint64Array,
) -> None:
    """Keys of the events that fired, by pixel; |ΔL| reaches from the one number to the other."""
    # Arrays are taken out of their tuple once: counting references to them in the loop is slow.
    pixel, change, start, stop, reference = fired
    smallest, largest = reach
    found = 0
    for i in range(pixel.size):
        sign = 1.0 if change[i] > 0 else -1.0
        place = np.uint64(pixel[i]) << _2 | np.uint64(change[i] > 0) << _1
        number = _number_of(change[i], rule)
        for order in range(1, number + 1):
            if rule.timestamp_rule == _EQ7:
                fraction = _larger_change_earlier(abs(change[i]), smallest, largest)
            elif rule.timestamp_rule == _LINEAR:
                level = reference[i] + sign * (order * rule.threshold)
                fraction = _linear_crossing(start[i], stop[i], level, sign)
            elif rule.timestamp_rule == _RANDOM:
                y = pixel[i] // rule.width
                fraction = draw_uniform(span.key, y, pixel[i] - y * rule.width, _DRAW + order)
            else:
                fraction = 1.0
            keys[found] = _key(place, fraction, rule, span)
            found += 1


@jit
def _list_noise(noise: NoisePlaces, rule: _Rule, span: FrameInterval) -> Uint64Array:
    """Keys of noise events, by pixel and polarity."""
    pixel, fraction, p = noise
    keys = np.empty(pixel.size, np.uint64)
    for i in range(pixel.size):
        place = np.uint64(pixel[i]) << _2 | np.uint64(p[i]) << _1 | _NOISE
        keys[i] = _key(place, fraction[i], rule, span)
    return keys


@jit
def _merge(signal: Uint64Array, noise: Uint64Array, rule: _Rule) -> Uint64Array:
    """Both by pixel, p and label; noise of pixels that fired is left out if it must be at rest."""
    mask = (_1 << np.uint64(rule.low)) - _1
    # What noise is compared by: its pixel alone, so that it meets all events of the pixel.
    of_pixel = ~np.uint64(3) if rule.noise_at_rest else ~np.uint64(0)
    keys, found, waiting = np.empty(signal.size + noise.size, np.uint64), 0, 0
    for i in range(signal.size):
        own = signal[i] & mask & of_pixel
        while waiting < noise.size and (noise[waiting] & mask & of_pixel) <= own:
            if not rule.noise_at_rest or (noise[waiting] & mask & of_pixel) < own:
                keys[found] = noise[waiting]
                found += 1
            waiting += 1
        keys[found] = signal[i]
        found += 1
    for i in range(waiting, noise.size):
        keys[found] = noise[i]
        found += 1
    return keys[:found]


@jit(inline="always")
def _key(place: np.uint64, fraction: float, rule: _Rule, span: FrameInterval) -> Any:
    """Time, as `interval.place_in` rounds it, above the place."""
    duration_us = span.stop_us - span.start_us
    offset = np.int64(math.floor(fraction * duration_us))
    return np.uint64(min(offset, np.int64(duration_us - 1))) << np.uint64(rule.low) | place


@jit(inline="always")
def _larger_change_earlier(size: float, smallest: float, largest: float) -> float:
    """The paper's rule: the largest change at the start, the smallest at the end.

    Args:
        size: Δ = |brightness minus reference| of an event pixel, log units.
        smallest: Δ of the event pixels of this sub-interval, the smallest.
        largest: the largest.

    Equation: (7), section 3.2.2: u = 1 − (Δ − min Δ) / (max Δ − min Δ).
    Deviation: the range of Δ is that of the event pixels of this sub-interval (the paper does not
        say); where all Δ are equal, and the paper divides by zero, u = 1/2.
    """
    if largest == smallest:
        return 0.5
    return 1.0 - (size - smallest) / (largest - smallest)


@jit(inline="always")
def _linear_crossing(start: float, stop: float, level: float, sign: float) -> float:
    """Crossing of a level by a straight line from the previous brightness to this one.

    (R ± kδ − L^{j−1}) / (L^j − L^{j−1}): exact for linear ramps, with any residual carried over.
    A crossing before the sub-interval (left over from it) is put at its start.

    Source: ESIM (Rebecq, Gehrig and Scaramuzza, CoRL 2018).
    """
    if sign * (start - level) >= 0:
        return 0.0
    if stop == start:
        return 1.0
    return min(max((level - start) / (stop - start), 0.0), 1.0)
