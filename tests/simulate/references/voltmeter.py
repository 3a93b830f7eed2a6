"""The definition of first-passage sampling, in NumPy float64: all pixels, one event a round."""

from __future__ import annotations

import math
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.events import NOISE, SIGNAL
from texvent.simulate.kernels.elementary import cosine_of_turns, natural_log
from texvent.simulate.packets import FrameInterval, UnsortedEvents
from texvent.simulate.random.draws import HALF_UNIT, draw_uniforms, draw_words
from texvent.simulate.voltmeter.first_passage import (
    CERTAIN,
    DRAWS_PER_PASSAGE,
    FIRST_DRAW,
    MOST_DISPLACEMENT,
)
from texvent.simulate.voltmeter.voltage import (
    LONGEST_US,
    FirstPassageInput,
    Float64Array,
    Voltage,
    drift_and_diffusion,
)

_Events: TypeAlias = tuple[NDArray[np.int64], Float64Array, NDArray[np.uint8], NDArray[np.uint8]]
"""Pixel, µs after the first frame, p and label, [n] each."""


class _BrownianMotion(NamedTuple):
    """Motion of the voltages in the interval, [n] each."""

    signal_drift: Float64Array
    """Drift that the change of luma causes, 1/µs."""
    drift: Float64Array
    """Whole drift μ, leakage included, 1/µs."""
    sigma: Float64Array
    """Diffusion σ, 1/√µs."""
    displacement: Float64Array
    """Since the last event, thresholds."""
    since_us: Float64Array
    """Time of that event, or the start, µs after the first frame."""
    signal_displacement: Float64Array
    """Part of the displacement that the signal caused until then."""


class _Draw(NamedTuple):
    """Which random draws a round of first passages uses."""

    key: np.uint64
    width: int
    """Of the frame, pixels."""
    order: int
    """Number of the first draw."""


def find_first_passages(
    light: FirstPassageInput, voltage: Voltage, interval: FrameInterval, first_us: int
) -> UnsortedEvents:
    """As `voltmeter.first_passage.find_first_passages`."""
    start, stop = float(interval.start_us - first_us), float(interval.stop_us - first_us)
    before, now = (luma.reshape(-1).astype(np.float64) for luma in (light.before, light.now))
    light.before[:] = light.now
    must_draw = voltage.has_changed | (before != now)
    voltage.has_changed[:] = before != now
    motion = _BrownianMotion(
        *drift_and_diffusion(before, now, float(interval.duration_us), light.constants),
        displacement=_displacement_at(voltage, start),
        since_us=np.full(now.shape, start),
        signal_displacement=voltage.signal_displacement.astype(np.float64),
    )
    crosses = ~must_draw & (voltage.next_crossing_us < stop)
    pixel, order = np.flatnonzero(must_draw | crosses), FIRST_DRAW
    found = [_fire(voltage, motion, np.flatnonzero(crosses))]
    while pixel.size:
        _draw_passages(voltage, motion, pixel, _Draw(interval.key, light.now.shape[1], order))
        found.append(_fire(voltage, motion, pixel[voltage.next_crossing_us[pixel] < stop]))
        pixel, order = found[-1][0], order + DRAWS_PER_PASSAGE
    elapsed = stop - motion.since_us
    voltage.signal_displacement[:] = motion.signal_displacement + motion.signal_drift * elapsed
    pixel, after, p, label = (
        np.concatenate([events[column] for events in found]) for column in range(4)
    )
    # Stable, so a pixel's events keep their order.
    by_pixel = np.argsort(pixel, kind="stable")
    t = interval.start_us + np.floor(after - start).astype(np.int64)
    return UnsortedEvents(pixel[by_pixel], t[by_pixel], p[by_pixel], label[by_pixel])


def _displacement_at(voltage: Voltage, time: float) -> Float64Array:
    """Displacements at a time, between the thresholds, whatever is rounded."""
    left = voltage.rate * (voltage.next_crossing_us - time)
    displacement = np.copysign(1.0, voltage.rate) - left
    return np.clip(displacement, -MOST_DISPLACEMENT, MOST_DISPLACEMENT)


def _fire(voltage: Voltage, motion: _BrownianMotion, pixel: NDArray[np.int64]) -> _Events:
    """The events of pixels that cross a threshold; resets their displacement."""
    after, sign = voltage.next_crossing_us[pixel], np.sign(voltage.rate[pixel])
    elapsed = after - motion.since_us[pixel]
    by_signal = motion.signal_displacement[pixel] + motion.signal_drift[pixel] * elapsed
    label = np.where(sign * by_signal < 0.5, NOISE, SIGNAL).astype(np.uint8)
    motion.displacement[pixel] = motion.signal_displacement[pixel] = 0.0
    motion.since_us[pixel] = after
    return pixel, after, (sign > 0).astype(np.uint8), label


def _draw_passages(
    voltage: Voltage, motion: _BrownianMotion, pixel: NDArray[np.int64], draw: _Draw
) -> None:
    """Draw the next first passages of some pixels."""
    (key, width, order) = draw
    y, x = np.divmod(pixel, width)
    drift, sigma = motion.drift[pixel], motion.sigma[pixel]
    speed, direction = np.abs(drift), np.where(drift >= 0, 1.0, -1.0)
    displacement = direction * motion.displacement[pixel]
    along, against = 1.0 - displacement, 1.0 + displacement
    probability = probability_along_drift(speed, sigma, along, against)
    is_along = draw_uniforms(key, y, x, order) < probability
    distance = np.where(is_along, along, against)
    words = draw_words(key, y, x, order + 2)
    turns = (words >> np.uint64(32)).astype(np.float64) * HALF_UNIT
    chance = (words & np.uint64(0xFFFF_FFFF)).astype(np.float64) * HALF_UNIT
    cosine = cosine_of_turns(turns)
    square = -2.0 * natural_log(1.0 - draw_uniforms(key, y, x, order + 1)) * (cosine * cosine)
    wait = np.minimum(first_passage_time(distance, speed, sigma, square, chance), LONGEST_US)
    voltage.next_crossing_us[pixel] = motion.since_us[pixel] + wait
    voltage.rate[pixel] = np.where(is_along, direction, -direction) * (distance / wait)


def probability_along_drift(
    speed: Float64Array, sigma: Float64Array, along: Float64Array, against: Float64Array
) -> Float64Array:
    """Probability that the threshold in the direction of the drift is reached first.

    `(1 − e^{−s b}) / (1 − e^{−s (a + b)})` with s = 2 μ / σ²; b / (a + b) without drift.

    Args:
        speed: |μ|, [n].
        sigma: σ, [n].
        along: distance a to the threshold ahead, [n], above 0.
        against: distance b to the threshold behind, [n], above 0.
    """
    # Extremes overflow to infinity or vanish, and the formula still has its limit.
    with np.errstate(all="ignore"):
        chance = np.ones(speed.shape)
        undecided = ~(2.0 * speed * against > CERTAIN * (sigma * sigma))
        speed, sigma, along, against = (
            column[undecided] for column in (speed, sigma, along, against)
        )
        # Without drift it is 0, also where there is no diffusion either.
        steer = np.where(speed == 0, 0.0, 2.0 * speed / (sigma * sigma))
        whole = _expm1(-steer * (along + against))
        driftless = against / (along + against)
        chance[undecided] = np.where(whole == 0, driftless, _expm1(-steer * against) / whole)
        return chance


def first_passage_time(
    distance: Float64Array,
    speed: Float64Array,
    sigma: Float64Array,
    square: Float64Array,
    chance: Float64Array,
) -> Float64Array:
    """Time of the first passage: inverse Gaussian, or Lévy without drift.

    Args:
        distance: d to the threshold, [n], above 0.
        speed: |μ|, [n], 1/µs.
        sigma: σ, [n], 1/√µs.
        square: z², of standard normal numbers, [n].
        chance: uniform numbers in [0, 1), [n].

    Returns:
        [n] µs; infinite where nothing moves.

    Source: Michael, Schucany and Haas, "Generating random variates using transformations with
        multiple roots", The American Statistician 1976. The roots are 2 d² / w and w / (2 μ²) with
        w = 2 μ d + σ² z² + √(σ² z² (σ² z² + 4 μ d)); the first, shorter one is taken with the
        probability w / (w + 2 μ d). Nothing cancels, and nothing divides by the drift alone.
    """
    spread, pull = sigma * sigma * square, 2.0 * speed * distance
    with np.errstate(all="ignore"):
        whole = pull + spread + np.sqrt(spread * (spread + 2.0 * pull))
        is_short = chance * (whole + pull) <= whole
        above = np.where(is_short, 2.0 * distance * distance, whole)
        return np.asarray(above / np.where(is_short, whole, 2.0 * speed * speed))


def _expm1(x: Float64Array) -> Float64Array:
    """e^x − 1 of the C library, as the compiled twin calls it: NumPy's may round otherwise."""
    return np.asarray(np.frompyfunc(math.expm1, 1, 1)(x), np.float64)
