"""The definition of first-passage sampling: one pixel and one event after the other."""

import math

import numpy as np

from texvent.events import NOISE, SIGNAL
from texvent.runtime.jit import jit
from texvent.simulation.kernels.compiled_elementary import cosine_of_turns, natural_log
from texvent.simulation.packets import FrameInterval, UnsortedEvents
from texvent.simulation.random.compiled_draws import draw_halves_at, draw_uniform_at, place_of
from texvent.simulation.voltmeter.first_passage import (
    CERTAIN,
    DRAWS_PER_PASSAGE,
    FIRST_DRAW,
    MOST_DISPLACEMENT,
)
from texvent.simulation.voltmeter.voltage import (
    LONGEST_US,
    FirstPassageInput,
    Voltage,
    drift_and_diffusion,
)


def find_first_passages(
    light: FirstPassageInput, voltage: Voltage, interval: FrameInterval, first_us: int
) -> UnsortedEvents:
    """As `voltmeter.first_passage.find_first_passages`."""
    start, stop = float(interval.start_us - first_us), float(interval.stop_us - first_us)
    before, now = (luma.reshape(-1).astype(np.float64) for luma in (light.before, light.now))
    light.before[:] = light.now
    must_draw = voltage.has_changed | (before != now)
    voltage.has_changed[:] = before != now
    motion = drift_and_diffusion(before, now, float(interval.duration_us), light.constants)
    found: list[tuple[int, ...]] = []
    for i in np.flatnonzero(must_draw | (voltage.next_crossing_us < stop)).tolist():
        passage, signal, events = _pass_thresholds(
            (float(motion[0][i]), float(motion[1][i]), float(motion[2][i])),
            (voltage.next_crossing_us[i], voltage.rate[i], float(voltage.signal_displacement[i])),
            bool(must_draw[i]),
            (start, stop),
            (interval.key, np.uint64(place_of(*divmod(i, light.now.shape[1])))),
        )
        voltage.next_crossing_us[i], voltage.rate[i] = passage
        voltage.signal_displacement[i] = signal
        found += [(i, interval.start_us + after, p, label) for after, p, label in events]
    pixel, t, p, label = np.array(found, np.int64).reshape(-1, 4).T
    return UnsortedEvents(pixel, t, p.astype(np.uint8), label.astype(np.uint8))


@jit(error_model="numpy")
def _pass_thresholds(
    motion: tuple[float, float, float],
    state: tuple[float, float, float],
    must_draw: bool,
    span: tuple[float, float],
    source: tuple[np.uint64, np.uint64],
) -> tuple[tuple[float, float], float, list[tuple[int, int, int]]]:
    """A pixel's next passage, its displacement by the signal; and events: µs, p and label."""
    (signal_drift, drift, sigma), (next_us, rate, by_signal), (start, stop) = motion, state, span
    # Between the thresholds, whatever is rounded.
    displacement = math.copysign(1.0, rate) - rate * (next_us - start)
    displacement = min(max(displacement, -MOST_DISPLACEMENT), MOST_DISPLACEMENT)
    since, order, events = start, FIRST_DRAW, [(0, 0, 0)][:0]
    while must_draw or next_us < stop:
        if not must_draw:
            sign = 1.0 if rate > 0 else -1.0
            by_signal += signal_drift * (next_us - since)
            label = NOISE if sign * by_signal < 0.5 else SIGNAL
            events.append((math.floor(next_us - start), int(rate > 0), label))
            displacement, by_signal, since = 0.0, 0.0, next_us
        wait, rate = _draw_passage(drift, sigma, displacement, source, order)
        next_us, order, must_draw = since + wait, order + DRAWS_PER_PASSAGE, False
    return (next_us, rate), by_signal + signal_drift * (stop - since), events


@jit(error_model="numpy")
def _draw_passage(
    drift: float, sigma: float, displacement: float, source: tuple[np.uint64, np.uint64], order: int
) -> tuple[float, float]:
    """Time until the next passage, µs, and the rate of the displacement until then."""
    (key, place), speed, direction = source, abs(drift), 1.0 if drift >= 0 else -1.0
    along, against = 1.0 - direction * displacement, 1.0 + direction * displacement
    probability = probability_along_drift(speed, sigma, along, against)
    is_along = draw_uniform_at(key, place, order) < probability
    distance = along if is_along else against
    turns, chance = draw_halves_at(key, place, order + 2)
    cosine = cosine_of_turns(turns)
    radius = -2.0 * natural_log(1.0 - draw_uniform_at(key, place, order + 1))
    wait = first_passage_time(distance, speed, sigma, radius * (cosine * cosine), chance)
    wait = min(wait, LONGEST_US)
    return wait, (direction if is_along else -direction) * (distance / wait)


@jit(error_model="numpy")
def probability_along_drift(speed: float, sigma: float, along: float, against: float) -> float:
    """Probability that the threshold in the direction of the drift is reached first.

    `(1 − e^{−s b}) / (1 − e^{−s (a + b)})` with s = 2 μ / σ²; b / (a + b) without drift.

    Args:
        speed: |μ|.
        sigma: σ.
        along: distance a to the threshold ahead, above 0.
        against: distance b to the threshold behind, above 0.
    """
    if 2.0 * speed * against > CERTAIN * (sigma * sigma):
        return 1.0
    # Without drift it is 0, also where there is no diffusion either.
    steer = 0.0 if speed == 0 else 2.0 * speed / (sigma * sigma)
    whole = math.expm1(-steer * (along + against))
    return against / (along + against) if whole == 0 else math.expm1(-steer * against) / whole


@jit(error_model="numpy")
def first_passage_time(
    distance: float, speed: float, sigma: float, square: float, chance: float
) -> float:
    """Time of the first passage, µs: inverse Gaussian, or Lévy without drift.

    Args:
        distance: d to the threshold, above 0.
        speed: |μ|, 1/µs.
        sigma: σ, 1/√µs.
        square: z², of a standard normal number.
        chance: uniform number in [0, 1).

    Source: Michael, Schucany and Haas, "Generating random variates using transformations with
        multiple roots", The American Statistician 1976. The roots are 2 d² / w and w / (2 μ²) with
        w = 2 μ d + σ² z² + √(σ² z² (σ² z² + 4 μ d)); the first, shorter one is taken with the
        probability w / (w + 2 μ d). Nothing cancels, and nothing divides by the drift alone.
    """
    spread, pull = sigma * sigma * square, 2.0 * speed * distance
    whole = pull + spread + math.sqrt(spread * (spread + 2.0 * pull))
    if chance * (whole + pull) <= whole:
        return 2.0 * distance * distance / whole
    return whole / (2.0 * speed * speed)
