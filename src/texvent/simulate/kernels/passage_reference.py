"""The definition of first-passage sampling, in NumPy float64: all pixels, one event a round."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from texvent.simulate.draws import draw_uniforms
from texvent.simulate.kernels.elementary import cosine_of_turns, natural_log
from texvent.simulate.kernels.passage import (
    CERTAIN,
    DRAWS_PER_EVENT,
    FIRST_DRAW,
    MOST_RESIDUAL,
    Constants,
    Float64Array,
    Light,
    Motion,
    Passages,
    Voltage,
)


def find_passages(motion: Motion, voltage: Voltage, key: np.uint64, duration_us: float) -> Passages:
    """Alternate between choosing a polarity and sampling a time, until the interval ends.

    Args:
        motion: drift and diffusion of every pixel.
        voltage: where every pixel stands; brought up to date here.
        key: of `draws.frame_key`.
        duration_us: length of the interval, µs.

    Returns:
        The events.

    Source: Lin et al., "DVS-Voltmeter: stochastic process-based event simulator for dynamic
        vision sensors", ECCV 2022, Algorithm 1.
    """
    return _find(motion, voltage, key, duration_us, 0)


def find_passages_in_light(
    light: Light, voltage: Voltage, key: np.uint64, duration_us: float
) -> Passages:
    """The same for the motion that light makes; see `motion_of`."""
    before, now = (luma.astype(np.float64) for luma in (light.before, light.now))
    motion = Motion(*motion_of(before, now, duration_us, light.constants))
    return _find(motion, voltage, key, duration_us, light.first_row)


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


def _find(
    motion: Motion, voltage: Voltage, key: np.uint64, duration_us: float, first_row: int
) -> Passages:
    height, width = motion.drift.shape
    pixel = np.arange(height * width)
    signal, drift, sigma = (array.reshape(-1) for array in motion)
    residual, driven = (array.reshape(-1) for array in voltage)
    now = np.zeros(pixel.size)
    found = []
    order = FIRST_DRAW
    while pixel.size:
        y, x = np.divmod(pixel + first_row * width, width)
        chances = [draw_uniforms(key, y, x, order + i) for i in range(DRAWS_PER_EVENT)]
        way, speed = residual[pixel], np.abs(drift[pixel])
        forward = np.where(drift[pixel] >= 0, 1.0, -1.0)
        along, against = 1.0 - forward * way, 1.0 + forward * way
        is_along = chances[0] < chance_along(speed, sigma[pixel], along, against)
        sign = np.where(is_along, forward, -forward)
        distance = np.where(is_along, along, against)
        normal = np.sqrt(-2.0 * natural_log(1.0 - chances[1])) * cosine_of_turns(chances[2])
        gap = passage_time(distance, speed, sigma[pixel], normal, chances[3])
        fires = now + gap < duration_us

        rest = pixel[~fires]
        left = duration_us - now[~fires]
        gone = residual[rest] + sign[~fires] * distance[~fires] * (left / gap[~fires])
        residual[rest] = np.clip(gone, -MOST_RESIDUAL, MOST_RESIDUAL)
        driven[rest] += signal[rest] * left

        pixel, now, gap, sign = pixel[fires], (now + gap)[fires], gap[fires], sign[fires]
        is_noise = sign * (driven[pixel] + signal[pixel] * gap) < 0.5
        residual[pixel] = driven[pixel] = 0.0
        found.append(Passages(pixel, now, (sign > 0).astype(np.uint8), is_noise))
        order += DRAWS_PER_EVENT
    pixels = np.concatenate([events.pixel for events in found])
    # Stable, so a pixel's events keep their order.
    by_pixel = np.argsort(pixels, kind="stable")
    return Passages(
        pixels[by_pixel] + first_row * width,
        np.concatenate([events.after_us for events in found])[by_pixel],
        np.concatenate([events.p for events in found])[by_pixel],
        np.concatenate([events.is_noise for events in found])[by_pixel],
    )


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
        steer = 2.0 * speed / (sigma * sigma)
        # Without diffusion the drift decides; `inf` below would be 0 · ∞ where there is neither.
        steer = np.where(speed == 0, 0.0, steer)
        chance = np.ones(steer.shape)
        open_ = ~(steer * against > CERTAIN)
        whole = _expm1(-steer[open_] * (along + against)[open_])
        part = _expm1(-steer[open_] * against[open_])
        drawn = against[open_] / (along + against)[open_]
        chance[open_] = np.where(whole == 0, drawn, part / whole)
        return chance


def passage_time(
    distance: Float64Array,
    speed: Float64Array,
    sigma: Float64Array,
    normal: Float64Array,
    chance: Float64Array,
) -> Float64Array:
    """Time of the first passage: inverse Gaussian, or Lévy without drift.

    Args:
        distance: to the threshold, [n], above 0.
        speed: |μ|, [n], 1/µs.
        sigma: σ, [n], 1/√µs.
        normal: standard normal numbers, [n].
        chance: uniform numbers in [0, 1), [n].

    Returns:
        [n] µs; infinite where nothing moves.

    Source: Michael, Schucany and Haas, "Generating random variates using transformations with
        multiple roots", The American Statistician 1976: the roots x and mean² / x of a quadratic,
        here written so that nothing cancels.
    """
    spread, pull = sigma * sigma * normal * normal, 2.0 * speed * distance
    with np.errstate(all="ignore"):
        mean = distance / speed
        w, q = spread / pull, pull / spread
        with_drift = mean / (1.0 + w + np.sqrt(w * (w + 2.0)))
        with_noise = 2.0 * distance * distance / spread / (1.0 + q + np.sqrt(1.0 + 2.0 * q))
        short = np.where(spread < pull, with_drift, with_noise)
        long = mean * mean / short
        time = np.where((speed == 0) | (chance * (mean + short) <= mean), short, long)
        return np.where((spread == 0) & (speed == 0), np.inf, time)


def _expm1(x: Float64Array) -> Float64Array:
    """e^x − 1 of the C library, as the compiled twin calls it: NumPy's may round otherwise."""
    return np.asarray(np.frompyfunc(math.expm1, 1, 1)(x), np.float64)
