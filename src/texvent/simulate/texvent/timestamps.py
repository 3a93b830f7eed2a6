"""Time stamp reconstruction (Eq. 7): the time of an event within its sub-interval.

Every rule gives a fraction 0..1 of the sub-interval per event; `place_in` makes it µs. The rules
come first, on arrays; `timestamp_events` is the compiled form that a run uses, with the same
arithmetic, operation by operation. Signal and noise both come by pixel, so it merges them into one
list of keys in that order, and sorting by time is all that is left.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.events import NOISE
from texvent.runtime.jit import jit
from texvent.simulate.kernels.radix_sort import key_bits, sort_keys, unpack_keys
from texvent.simulate.packets import FrameInterval, SortedEvents, place_in
from texvent.simulate.random.draws import Purpose, draw_uniforms
from texvent.simulate.random.draws_cpu import allow_wrap_around, draw_uniform
from texvent.simulate.texvent.config import TimestampRule
from texvent.simulate.texvent.event_frame import ThresholdCrossings
from texvent.simulate.texvent.noise import NoisePlaces
from texvent.simulate.texvent.pixel_memory import FiredPixels

Float64Array = NDArray[np.float64]


class SubInterval(NamedTuple):
    """Time between two neighbouring frames, and the brightness of the pixels that fired in it."""

    span: FrameInterval
    """Time of both frames, and the key of the random draws between them."""
    width: int
    """Of the frame, pixels."""
    pixel: NDArray[np.int64]
    """[n] flat index y · W + x of the pixels that fired, ascending."""
    brightness: tuple[Float64Array, Float64Array, Float64Array]
    """Previous brightness, brightness and reference of each, [n] log units."""


def reconstruct_timestamps(
    crossings: ThresholdCrossings,
    interval: SubInterval,
    *,
    timestamp_rule: TimestampRule,
    threshold: float,
    scale: float = 1.0,
) -> NDArray[np.int64]:
    """Times of the events of one sub-interval.

    Args:
        crossings: the events.
        interval: the sub-interval they belong to.
        timestamp_rule: how.
        threshold: δ, log units.
        scale: γ of Eq. 7, 0..1; other rules do not use it.

    Returns:
        [n] µs, in `[start_us, stop_us)`.
    """
    if timestamp_rule == "eq7":
        return place_in(interval.span, scale * larger_change_earlier(crossings.change))
    return place_in(interval.span, _RULES[timestamp_rule](crossings, interval, threshold))


def larger_change_earlier(change: Float64Array) -> Float64Array:
    """The paper's rule: the largest change at the start, the smallest at the end.

    Args:
        change: brightness minus reference of every event pixel of the sub-interval, log units.

    Returns:
        u = 1 − (Δ − min Δ) / (max Δ − min Δ) with Δ = |change|.

    Equation: (7), section 3.2.2.
    Deviation: the range of Δ is that of the event pixels of this sub-interval (the paper does not
        say); where all Δ are equal, and the paper divides by zero, u = 1/2.

    Example:
        >>> larger_change_earlier(np.array([0.25, -0.30, 0.45])).round(3).tolist()
        [1.0, 0.75, 0.0]
    """
    if change.size == 0:
        return np.empty(0)
    size = np.abs(change)
    smallest, largest = size.min(), size.max()
    if largest == smallest:
        return np.full(change.shape, 0.5)
    return np.asarray(1.0 - (size - smallest) / (largest - smallest))


def random_time(
    crossings: ThresholdCrossings, interval: SubInterval, threshold: float
) -> Float64Array:
    """Uniform in the sub-interval: the paper's ablation E12."""
    y, x = np.divmod(crossings.pixel, interval.width)
    return draw_uniforms(interval.span.key, y, x, Purpose.TIMESTAMP.draw(crossings.order))


def linear_crossing(
    crossings: ThresholdCrossings, interval: SubInterval, threshold: float
) -> Float64Array:
    """Crossing of the k-th threshold by a straight line from the previous brightness to this one.

    (R ± kδ − L^{j−1}) / (L^j − L^{j−1}): exact for linear ramps, with any residual carried over.
    A crossing before the sub-interval (left over from it) is put at its start.

    Source: ESIM (Rebecq, Gehrig and Scaramuzza, CoRL 2018).
    """
    row = np.searchsorted(interval.pixel, crossings.pixel)
    start, stop, reference = (column[row] for column in interval.brightness)
    sign = np.sign(crossings.change)
    level = reference + sign * (crossings.order * threshold)
    is_over = sign * (start - level) >= 0
    fraction = np.ones(level.shape)
    np.divide(level - start, stop - start, out=fraction, where=~is_over & (stop != start))
    fraction[is_over] = 0.0
    return np.clip(fraction, 0.0, 1.0)


def hyperbolic_crossing(
    crossings: ThresholdCrossings, interval: SubInterval, threshold: float
) -> Float64Array:
    """Crossing of the k-th threshold by a ramp from the reference: kδ / Δ."""
    return np.minimum(crossings.order * threshold / np.abs(crossings.change), 1.0)


def even_spacing(
    crossings: ThresholdCrossings, interval: SubInterval, threshold: float
) -> Float64Array:
    """The k-th of n events of a pixel at k / n."""
    return np.asarray(crossings.order / crossings.number)


def interval_end(
    crossings: ThresholdCrossings, interval: SubInterval, threshold: float
) -> Float64Array:
    """All events at the end, as an event frame has them."""
    return np.ones(crossings.pixel.shape)


_RULES: Mapping[str, Callable[[ThresholdCrossings, SubInterval, float], Float64Array]] = {
    "random": random_time,
    "linear": linear_crossing,
    "hyperbolic": hyperbolic_crossing,
    "even": even_spacing,
    "end": interval_end,
}


class Timing(NamedTuple):
    """Rules for the times (Eq. 7) and the number of events."""

    timestamp_rule: TimestampRule
    scale: float
    """γ of Eq. 7."""
    threshold: float
    """δ, log units."""
    multi_event: bool
    """Whether a pixel fires floor(Δ / δ) times."""
    noise_at_rest: bool
    """Whether noise is dropped where the pixel fired (Eq. 6)."""


Uint64Array = NDArray[np.uint64]

_STAMPS = ("eq7", "random", "linear", "hyperbolic", "even", "end")
_EQ7, _RANDOM, _LINEAR, _HYPERBOLIC, _EVEN, _END = range(len(_STAMPS))
_DRAW = int(Purpose.TIMESTAMP.draw())
_NOISE = np.uint64(NOISE)
_1, _2 = np.uint64(1), np.uint64(2)
_SIZE_BITS = (1 << 63) - 1
"""Bits of a float64 but its sign."""
_INFINITY_BITS = int(np.array(np.inf).view(np.int64))


class _Rule(NamedTuple):
    """`Timing` and the sensor, in numbers."""

    timestamp_rule: int
    scale: float
    threshold: float
    multi_event: bool
    noise_at_rest: bool
    width: int
    low: int
    """Bits of a key below its time."""

    @classmethod
    @functools.lru_cache(maxsize=16)
    def of(cls, timing: Timing, width: int, low: int) -> _Rule:
        """The same numbers for every packet of a simulator."""
        return cls(_STAMPS.index(timing.timestamp_rule), *timing[1:], width, low)


def timestamp_events(
    bands: Sequence[FiredPixels],
    noise: NoisePlaces,
    timing: Timing,
    span: FrameInterval,
    shape: tuple[int, int],
) -> SortedEvents:
    """Times of all events (Eq. 7), and signal and noise in the order of a packet.

    Args:
        bands: the pixels that fired, of bands that follow each other, at least one.
        noise: noise events.
        timing: the rules.
        span: the sub-interval.
        shape: (height, width).

    Raises:
        InputError: the sub-interval is too long for a sensor of this size.
    """
    low = key_bits(span.duration_us, shape)
    rule, bits = _Rule.of(timing, shape[1], low), low + span.duration_us.bit_length()
    with allow_wrap_around():
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
                size = abs(change[i])
                fraction = rule.scale * _larger_change_earlier(size, smallest, largest)
            elif rule.timestamp_rule == _LINEAR:
                level = reference[i] + sign * (order * rule.threshold)
                fraction = _linear_crossing(start[i], stop[i], level, sign)
            else:
                fraction = _fraction(pixel[i], abs(change[i]), order, number, rule, span)
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
    if largest == smallest:
        return 0.5
    return 1.0 - (size - smallest) / (largest - smallest)


@jit(inline="always")
def _linear_crossing(start: float, stop: float, level: float, sign: float) -> float:
    if sign * (start - level) >= 0:
        return 0.0
    if stop == start:
        return 1.0
    return min(max((level - start) / (stop - start), 0.0), 1.0)


@jit(inline="always")
def _fraction(
    pixel: int, size: float, order: int, number: int, rule: _Rule, span: FrameInterval
) -> float:
    """Time of an event as a fraction of the sub-interval; see `timestamps`."""
    if rule.timestamp_rule == _HYPERBOLIC:
        return min(order * rule.threshold / size, 1.0)
    if rule.timestamp_rule == _EVEN:
        return order / number
    if rule.timestamp_rule == _RANDOM:
        y = pixel // rule.width
        return draw_uniform(span.key, y, pixel - y * rule.width, _DRAW + order)
    return 1.0
