"""The definition of threshold crossings on a straight line, in NumPy float64."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.crossing.ramp import RefractoryPeriod
from texvent.simulate.packets import check_event_number

Float64Array = NDArray[np.float64]


class Ramp(NamedTuple):
    """Change of some pixels against their references, a straight line in time, log units."""

    pixel: NDArray[np.int64]
    """[n] flat index y · W + x, ascending: all pixels that may fire."""
    start: Float64Array
    """[n] change at the start of the interval."""
    stop: Float64Array
    """[n] change at its end."""
    threshold_on: Float64Array
    """[n] above 0."""
    threshold_off: Float64Array
    """[n] above 0."""


class RampCrossings(NamedTuple):
    """Events of one interval, by pixel in row-major order, then in time."""

    pixel: NDArray[np.int64]
    """[m] flat index."""
    t: NDArray[np.int64]
    """[m] times, µs."""
    p: NDArray[np.uint8]
    """[m] 1 = ON, 0 = OFF."""
    steps: NDArray[np.int64]
    """[n] by how many thresholds the reference of each pixel of the ramp moves; OFF below 0."""


def cross_ramp(
    ramp: Ramp, fired_us: NDArray[np.int64], span_us: tuple[int, int], refractory: RefractoryPeriod
) -> RampCrossings:
    """Every threshold that each pixel's change crosses, at the time the line crosses it.

    The change is d(u) = start + u · (stop − start), u in 0..1. The k-th ON event happens where
    d reaches k · θ_on, the k-th OFF event where it reaches −k · θ_off, for every k that
    `stop` has reached. A level that `start` had reached already fires at once: the pixel was held
    back (refractory period), or its threshold has just fallen.

    Args:
        ramp: where the lines run, and the thresholds.
        fired_us: time of each pixel's last event, µs, [H · W]; brought up to date here, but not
            looked at without a refractory period.
        span_us: start (included) and stop (excluded) of the interval, µs.
        refractory: the refractory period.

    Returns:
        The events, times rounded down, never the stop itself; and the steps of the references.

    Source: Rebecq, Gehrig and Scaramuzza, "ESIM: an open event camera simulator", CoRL 2018,
        section 3.1: linear interpolation of log intensity between samples.
    """
    start_us, stop_us = span_us
    threshold = np.where(ramp.stop > 0, ramp.threshold_on, ramp.threshold_off)
    check_event_number(float(np.abs(ramp.stop / threshold).sum()))
    steps = np.zeros(ramp.start.shape, np.int64)
    pixels, times, polarities = [], [], []
    for sign, threshold in ((1, ramp.threshold_on), (-1, ramp.threshold_off)):
        first, last = sign * ramp.start, sign * ramp.stop
        own = np.flatnonzero(last >= threshold)
        k = 1
        while len(own):
            level = k * threshold[own]
            begin = first[own]
            fraction = np.zeros_like(level)
            np.divide(level - begin, last[own] - begin, out=fraction, where=begin < level)
            offset = np.floor(fraction * (stop_us - start_us)).astype(np.int64)
            t = np.minimum(start_us + offset, stop_us - 1)
            fires = np.ones(len(own), np.bool_)
            if refractory.period_us > 0:
                fires = t - fired_us[ramp.pixel[own]] >= refractory.period_us
                fired_us[ramp.pixel[own[fires]]] = t[fires]
            fired = ramp.pixel[own[fires]]
            steps[own] += sign * (1 if refractory.is_level_lost else fires)
            pixels.append(fired)
            times.append(t[fires])
            polarities.append(np.full(len(fired), sign > 0, np.uint8))
            k += 1
            own = own[last[own] >= k * threshold[own]]
    pixel = np.concatenate([np.empty(0, np.int64), *pixels])
    # Stable, so a pixel's events keep their order k = 1, 2, ...
    order = np.argsort(pixel, kind="stable")
    t = np.concatenate([np.empty(0, np.int64), *times])
    p = np.concatenate([np.empty(0, np.uint8), *polarities])
    return RampCrossings(pixel[order], t[order], p[order], steps)
