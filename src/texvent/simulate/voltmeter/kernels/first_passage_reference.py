"""The definition of first-passage sampling, in NumPy float64: all pixels, one event a round."""

from __future__ import annotations

import math
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.events import NOISE, SIGNAL
from texvent.simulate.backend.elementary import cosine_of_turns, natural_log
from texvent.simulate.packets.interval import FrameInterval
from texvent.simulate.packets.unsorted_events import UnsortedEvents
from texvent.simulate.random.draws import draw_halves, draw_uniforms
from texvent.simulate.voltmeter.kernels.first_passage import (
    CERTAIN,
    DRAWS_PER_PASSAGE,
    FIRST_DRAW,
    LONGEST_US,
    MOST_RESIDUAL,
    Constants,
    Float64Array,
    Light,
    Voltage,
)

_Events: TypeAlias = tuple[NDArray[np.int64], Float64Array, NDArray[np.uint8], NDArray[np.uint8]]
"""Pixel, µs after the first frame, p and label, [n] each."""


class _Going(NamedTuple):
    """What the voltages do in the interval, [n] each."""

    signal: Float64Array
    """Drift that the change of light causes, 1/µs."""
    drift: Float64Array
    """Whole drift μ, leakage included, 1/µs."""
    sigma: Float64Array
    """Diffusion σ, 1/√µs."""
    way: Float64Array
    """Way gone since the last event."""
    since: Float64Array
    """When that was, or the start, µs after the first frame."""
    driven: Float64Array
    """What the signal drove of the way until then."""


def find_passages(
    light: Light, voltage: Voltage, interval: FrameInterval, first_us: int
) -> UnsortedEvents:
    """Alternate between choosing a polarity and sampling a time, until the interval ends.

    Where the light rests, the passage that lies beyond the end is remembered, and its pixel has no
    more to do until then. A change of light on the way ends it: the voltage has gone the share of
    the distance that the time makes up.

    Args:
        light: over the interval; `before` becomes `now`.
        voltage: of every pixel at the start; brought up to date here.
        interval: where in time; its key decides the draws.
        first_us: time of the first frame, µs.

    Returns:
        The events by pixel, then in time; times rounded down.

    Source: Lin et al., "DVS-Voltmeter: stochastic process-based event simulator for dynamic
        vision sensors", ECCV 2022, Algorithm 1.
    """
    start, stop = float(interval.start_us - first_us), float(interval.stop_us - first_us)
    before, now = (luma.reshape(-1).astype(np.float64) for luma in (light.before, light.now))
    light.before[:] = light.now
    must_draw = voltage.is_moving | (before != now)
    voltage.is_moving[:] = before != now
    going = _Going(
        *motion_of(before, now, float(interval.duration_us), light.constants),
        way=_way_gone(voltage, start),
        since=np.full(now.shape, start),
        driven=voltage.signal.astype(np.float64),
    )
    is_due = ~must_draw & (voltage.due_us < stop)
    pixel, order = np.flatnonzero(must_draw | is_due), FIRST_DRAW
    found = [_fire(voltage, going, np.flatnonzero(is_due))]
    while pixel.size:
        _draw(voltage, going, pixel, (interval.key, light.now.shape[1], order))
        found.append(_fire(voltage, going, pixel[voltage.due_us[pixel] < stop]))
        pixel, order = found[-1][0], order + DRAWS_PER_PASSAGE
    voltage.signal[:] = going.driven + going.signal * (stop - going.since)
    pixel, after, p, label = (
        np.concatenate([events[column] for events in found]) for column in range(4)
    )
    # Stable, so a pixel's events keep their order.
    by_pixel = np.argsort(pixel, kind="stable")
    t = interval.start_us + np.floor(after - start).astype(np.int64)
    return UnsortedEvents(pixel[by_pixel], t[by_pixel], p[by_pixel], label[by_pixel])


def _way_gone(voltage: Voltage, time: float) -> Float64Array:
    """Where the voltages stand, short of the thresholds, whatever is rounded."""
    way = np.copysign(1.0, voltage.pace) - voltage.pace * (voltage.due_us - time)
    return np.clip(way, -MOST_RESIDUAL, MOST_RESIDUAL)


def _fire(voltage: Voltage, going: _Going, pixel: NDArray[np.int64]) -> _Events:
    """The events of pixels whose time has come; their voltages begin anew."""
    after, sign = voltage.due_us[pixel], np.sign(voltage.pace[pixel])
    by_signal = going.driven[pixel] + going.signal[pixel] * (after - going.since[pixel])
    label = np.where(sign * by_signal < 0.5, NOISE, SIGNAL).astype(np.uint8)
    going.way[pixel] = going.driven[pixel] = 0.0
    going.since[pixel] = after
    return pixel, after, (sign > 0).astype(np.uint8), label


def _draw(
    voltage: Voltage, going: _Going, pixel: NDArray[np.int64], draw: tuple[np.uint64, int, int]
) -> None:
    """The next passages of some pixels."""
    key, width, order = draw
    y, x = np.divmod(pixel, width)
    drift, sigma = going.drift[pixel], going.sigma[pixel]
    speed, forward = np.abs(drift), np.where(drift >= 0, 1.0, -1.0)
    way = forward * going.way[pixel]
    along, against = 1.0 - way, 1.0 + way
    is_along = draw_uniforms(key, y, x, order) < chance_along(speed, sigma, along, against)
    distance = np.where(is_along, along, against)
    turns, chance = draw_halves(key, y, x, order + 2)
    cosine = cosine_of_turns(turns)
    square = -2.0 * natural_log(1.0 - draw_uniforms(key, y, x, order + 1)) * (cosine * cosine)
    wait = np.minimum(passage_time(distance, speed, sigma, square, chance), LONGEST_US)
    voltage.due_us[pixel] = going.since[pixel] + wait
    voltage.pace[pixel] = np.where(is_along, forward, -forward) * (distance / wait)


def motion_of(
    before: Any, after: Any, duration_us: float, constants: Constants
) -> tuple[Any, Any, Any]:
    """Drift and diffusion of voltages between two frames; also compiled, for single pixels.

    Args:
        before: light at the start, 0..255 scale, float64, any shape.
        after: light at the end.
        duration_us: time between them, µs.
        constants: k1 to k6.

    Returns:
        k1 ΔL / Δt / (L + k2); that and k4 + k5 L; σ = k3 √L / (L + k2) + k6; L the mean of both.

    Equation: (10) and (11) of the publication.
    """
    mean = (before + after) * 0.5
    gain = 1.0 / (mean + constants.k2)
    signal = constants.k1 * (after - before) / duration_us * gain
    drift = signal + constants.k4 + constants.k5 * mean
    return signal, drift, constants.k3 * np.sqrt(mean) * gain + constants.k6


def chance_along(
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
        open_ = ~(2.0 * speed * against > CERTAIN * (sigma * sigma))
        speed, sigma, along, against = (column[open_] for column in (speed, sigma, along, against))
        # Without drift it is 0, also where there is no diffusion either.
        steer = np.where(speed == 0, 0.0, 2.0 * speed / (sigma * sigma))
        whole = _expm1(-steer * (along + against))
        drawn = against / (along + against)
        chance[open_] = np.where(whole == 0, drawn, _expm1(-steer * against) / whole)
        return chance


def passage_time(
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
