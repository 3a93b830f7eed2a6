"""Noise addition (Eq. 6): background activity in dark, resting regions, and the paper's ablations.

λ1 is a rate per pixel and second and λ2 the length of the sub-interval times a sensor factor, so
the expected noise does not depend on how many intermediate frames there are. Noise never changes
the reference brightness.
"""

from __future__ import annotations

import functools
import math
from statistics import NormalDist
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError
from texvent.runtime.read_only import read_only
from texvent.simulate.backend.select import AUTO
from texvent.simulate.packets.interval import FrameInterval, place_in
from texvent.simulate.packets.limits import check_event_number
from texvent.simulate.packets.unsorted_events import UnsortedEvents
from texvent.simulate.random.draws import UNIT, Purpose, draw_normals
from texvent.simulate.texvent.kernels.noise_blocks import PLACE_NOISE, NoiseBlock
from texvent.simulate.texvent.kernels.scan import NOISE_BLOCK

NoiseKind = Literal["adaptive", "gaussian", "random", "none"]
BoolArray = NDArray[np.bool_]
Float64Array = NDArray[np.float64]

# What a uniform number cannot resolve need not be in the table.
_CERTAIN = 1.0 - UNIT
LARGE_MEAN = 1e4
"""Events of a block from which on only the middle of the Poisson distribution is summed up."""


def draw_noise(
    pixels: int, span: FrameInterval, *, mean: float, on_fraction: float, backend: str = AUTO
) -> UnsortedEvents:
    """Poisson events at every pixel, uniform in time: what `low_light_background` then selects of.

    Args:
        pixels: number of pixels of the frame.
        span: when, and the key of the draws.
        mean: λ1 · λ2, expected events per pixel in this sub-interval.
        on_fraction: probability of ON.
        backend: which kernels draw; all draw the same.

    Returns:
        The noise events, ordered by pixel and polarity.

    Equation: (6), section 3.2.2: Poisson(λ1 λ2); drawn per block of pixels, see `kernels/scan.py`.
    Deviation: the paper gives noise no polarity and no time. Eq. 7 would put all of it at the end,
        because its change is below δ; real background activity is uniform in time.
    """
    check_event_number(mean * -(-pixels // NOISE_BLOCK) * NOISE_BLOCK)
    noise = NoiseBlock(span.key, poisson_cumulative(mean * NOISE_BLOCK), float(on_fraction))
    places = PLACE_NOISE.load(backend)(noise, pixels)
    return UnsortedEvents.noise(places.pixel, place_in(span, places.fraction), places.p)


def low_light_background(
    luma: NDArray[Any], pixel: NDArray[np.int64], fired: NDArray[np.int64], *, intensity: float
) -> BoolArray:
    """Whether noise may fire at a pixel: the mask M of Eq. 6.

    Args:
        luma: intensity of the current frame, [H, W], 0..255 scale.
        pixel: flat index of the pixels asked about, [n].
        fired: flat index of the pixels with |change| ≥ δ, ascending; all others are background.
        intensity: σ: darker pixels are low-light.

    Returns:
        M = (I^j < σ) · (Δ < δ) at these pixels, [n].

    Equation: (6), section 3.2.2.
    Deviation: the paper names source frames here and sub-frames in Eq. 5; this uses sub-frames.
    """
    is_dark = luma.reshape(-1)[pixel] < intensity
    return np.asarray(is_dark & is_background(pixel, fired))


def is_background(pixel: NDArray[np.int64], fired: NDArray[np.int64]) -> BoolArray:
    """Whether a pixel is not among those that fired, [n]; `fired` must ascend."""
    place = np.searchsorted(fired, pixel)
    # Beyond the last one lies what no pixel equals.
    return np.asarray(np.append(fired, -1)[place] != pixel)


@functools.lru_cache(maxsize=64)
def poisson_cumulative(mean: float) -> Float64Array:
    """P(count ≤ k) for k = 0, 1, ... until what is left is below the spacing of the uniforms.

    A uniform u then draws the count `number of entries ≤ u` (inversion): one table per length of
    the sub-intervals, only comparisons per block of pixels.

    Args:
        mean: of the Poisson distribution, at least 0.

    Returns:
        [n] read-only, non-decreasing, n ≥ 1.

    Example:
        >>> poisson_cumulative(1.0)[:3].round(4).tolist()
        [0.3679, 0.7358, 0.9197]
    """
    if mean == 0:
        return read_only(np.ones(1))
    last = math.ceil(mean + 12 * math.sqrt(mean) + 40)
    log_mean = math.log(mean)
    # What lies so far below a large mean vanishes, as above; the table stays as long.
    first = max(0, math.floor(mean - 12 * math.sqrt(mean))) if mean > LARGE_MEAN else 0
    mass = [math.exp(k * log_mean - mean - math.lgamma(k + 1)) for k in range(first, last)]
    cumulative = np.concatenate([np.zeros(first), np.cumsum(mass)])
    return read_only(cumulative[: int(np.searchsorted(cumulative, _CERTAIN)) + 1])


def draw_voltage_noise(
    shape: tuple[int, int], key: np.uint64, *, threshold: float, mean: float
) -> Float64Array:
    """Gaussian noise to add to the brightness before Eq. 5 compares it (ablation E10).

    Args:
        shape: (height, width).
        key: of `draws.frame_key`.
        threshold: δ, log units.
        mean: expected noise events per resting pixel in this sub-interval, below 1.

    Returns:
        [H, W], log units.

    Source: supplement 9.1, which only names "Gaussian noise". This reading: a zero-mean voltage
        whose sd lets a resting pixel fire as often as Eq. 6 would.
    """
    y, x = np.ogrid[: shape[0], : shape[1]]
    return voltage_noise_sd(threshold, mean) * draw_normals(key, y, x, Purpose.VOLTAGE.draw())


def voltage_noise_sd(threshold: float, mean: float) -> float:
    """The sd with which a resting pixel's noise reaches ±δ with probability `mean`.

    `P(|n| ≥ δ) = mean`, so sd = δ / Φ⁻¹(1 − mean / 2).

    Raises:
        InputError: `mean` is not below 1: a comparison cannot fire more than once.

    Example:
        >>> round(voltage_noise_sd(0.2, 0.0455), 4)  # two sd: 4.55 % lie outside
        0.1
    """
    if mean == 0:
        return 0.0
    if mean >= 1:
        raise InputError(
            f"Gaussian noise of {mean:g} events per pixel in one sub-interval cannot be reached by "
            "one comparison; it must be below 1: lower noise_rate_hz or noise_scale, or use more "
            "intermediate frames"
        )
    # Φ⁻¹(1 − q) = −Φ⁻¹(q), which keeps its digits for small q.
    return threshold / -NormalDist().inv_cdf(mean / 2)
