"""The definition of threshold crossings on a straight line, pixel by pixel."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.simulation.crossing.ramp import RefractoryPeriod

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
    steps, events = np.zeros(ramp.start.shape, np.int64), []
    for n, pixel in enumerate(ramp.pixel):
        sign = 1 if ramp.stop[n] > 0 else -1
        threshold = (ramp.threshold_on if sign > 0 else ramp.threshold_off)[n]
        first, last, k = sign * ramp.start[n], sign * ramp.stop[n], 1
        while last >= k * threshold:
            fraction = (k * threshold - first) / (last - first) if first < k * threshold else 0.0
            t = min(start_us + math.floor(fraction * (stop_us - start_us)), stop_us - 1)
            rests = refractory.period_us > 0 and t - fired_us[pixel] < refractory.period_us
            if not rests:
                events.append((pixel, t, int(sign > 0)))
            if not rests and refractory.period_us > 0:
                fired_us[pixel] = t
            steps[n] += sign if refractory.is_level_lost or not rests else 0
            k += 1
    pixel, t, p = np.array(events, np.int64).reshape(-1, 3).T
    return RampCrossings(pixel, t, p.astype(np.uint8), steps)
