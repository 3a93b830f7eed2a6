"""The definition of how v2e's pixels follow the light, in NumPy float64."""

from __future__ import annotations

import math

import numpy as np

from texvent.simulate.backend.elementary import natural_log
from texvent.simulate.v2e.kernels.low_pass import (
    DARK_OFFSET,
    SETTLED,
    WHITE_LEVEL,
    Float64Array,
    Light,
    Pixels,
    PixelState,
    Restless,
)


def follow_light(
    light: Light, pixels: Pixels, state: PixelState, elapsed_us: tuple[float, float]
) -> Restless:
    """Move the brightness through the low-pass, and find who has reached a threshold.

    Args:
        light: the frames; `before` becomes `luma`.
        pixels: thresholds and leak.
        state: at the start; its brightness is moved to the end.
        elapsed_us: time from the first frame to the start and to the end of the interval, µs.

    Returns:
        The change is brightness + voltage noise − reference + leak · elapsed.

    Source: v2e (Hu, Liu and Delbruck, CVPRW 2021), section 4.2.
    """
    if light.table is None:
        luma = light.luma.astype(np.float64)
        now, relative = lin_log(luma, light.linear_below), (luma + DARK_OFFSET) / WHITE_LEVEL
    else:
        now, relative = light.table[0][light.luma], light.table[1][light.luma]
    light.before[:] = light.luma
    before, weight = state.brightness.copy(), np.minimum(relative * light.angle, 1.0)
    lag = now - before
    lags = (weight < 1.0) & (np.abs(lag) >= SETTLED)
    state.brightness[:] = np.where(lags, before + weight * lag, now)
    start, stop = before - state.reference, state.brightness - state.reference
    if pixels.leak is not None:
        leak = pixels.leak.astype(np.float64)
        start, stop = start + leak * elapsed_us[0], stop + leak * elapsed_us[1]
    if state.voltage is not None:
        start, stop = start + state.voltage[0], stop + state.voltage[1]
    pixel = np.flatnonzero((stop >= pixels.threshold_on) | (-stop >= pixels.threshold_off))
    return Restless(pixel, start[pixel], stop[pixel])


def lin_log(intensity: Float64Array, linear_below: float) -> Float64Array:
    """Brightness, linear in the dark and logarithmic above.

    Args:
        intensity: 0..255 scale, any shape.
        linear_below: intensity I₀ where the straight line from 0 meets the logarithm.

    Returns:
        `I · ln(I₀) / I₀` up to I₀ and `ln(I)` above, log units.

    Example:
        >>> lin_log(np.array([0.0, 10.0, 20.0, 40.0]), 20.0).round(4).tolist()
        [0.0, 1.4979, 2.9957, 3.6889]
    """
    slope = math.log(linear_below) / linear_below
    log = natural_log(np.maximum(intensity, linear_below))
    return np.where(intensity <= linear_below, intensity * slope, log)
