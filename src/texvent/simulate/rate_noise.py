"""Noise events of a Poisson process whose rate differs from pixel to pixel."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from texvent.simulate.draws import Purpose, draw_uniforms
from texvent.simulate.firings import Firings, Interval
from texvent.simulate.kernels.select import AUTO, load_kernels


def draw_rate_noise(
    rate_hz: NDArray[np.float64],
    interval: Interval,
    *,
    on_fraction: ArrayLike = 0.5,
    backend: str = AUTO,
) -> Firings:
    """Noise events of one interval, by exponential gaps between them.

    Their number per second does not depend on how time is cut into frames.

    Args:
        rate_hz: events per second of each pixel, both polarities together, [H, W].
        interval: where in time; its key decides the draws.
        on_fraction: probability of ON, one number or [H, W].
        backend: which kernels scan the pixels; all find the same.

    Returns:
        Events labelled as noise: Poisson in number, uniform in time.
    """
    width = rate_hz.shape[1]
    mean = rate_hz * interval.duration_s
    # The first gap −ln(u) / mean ends in the interval where u > e^{−mean}: a compiled scan for the
    # largest mean leaves few pixels to take logarithms of.
    quiet = math.exp(-float(mean.max()))
    pixel = load_kernels(backend).find_noisy_pixels(
        np.ones(rate_hz.shape, np.bool_), interval.key, Purpose.NOISE_TIME.draw(), quiet
    )
    elapsed = np.zeros(len(pixel))
    pixels, fractions, polarities = [pixel[:0]], [elapsed[:0]], [np.empty(0, np.bool_)]
    order = 0
    while len(pixel):
        y, x = np.divmod(pixel, width)
        chance = draw_uniforms(interval.key, y, x, Purpose.NOISE_TIME.draw(order))
        with np.errstate(divide="ignore"):
            elapsed = elapsed - np.log(chance) / mean[y, x]
        inside = elapsed < 1.0
        pixel, elapsed, y, x = pixel[inside], elapsed[inside], y[inside], x[inside]
        polarity = draw_uniforms(interval.key, y, x, Purpose.NOISE_POLARITY.draw(order))
        pixels.append(pixel)
        fractions.append(elapsed)
        polarities.append(polarity < np.broadcast_to(on_fraction, rate_hz.shape)[y, x])
        order += 1
    offset = np.floor(np.concatenate(fractions) * interval.duration_us).astype(np.int64)
    is_on = np.concatenate(polarities).astype(np.uint8)
    return Firings.noise(np.concatenate(pixels), interval.start_us + offset, is_on)
