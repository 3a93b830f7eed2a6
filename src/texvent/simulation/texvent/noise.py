"""Noise addition (Eq. 6): background activity in dark, resting regions, and the paper's ablations.

λ1 is a rate per pixel and second and λ2 the length of the sub-interval times a sensor factor, so
the expected noise does not depend on how many intermediate frames there are. Noise never changes
the reference brightness.

Eq. 6 is a Poisson process of `mean` = λ1·λ2 events per pixel. The frame is cut into runs
of `NOISE_BLOCK` pixels in row-major order. Block b draws how many events its pixels would have if
all were noisy, and for each a place and a time, both uniform; then the mask of Eq. 6 is applied
where they fell. A Poisson number per block with uniform places is the same distribution as a
Poisson number per pixel, and costs time only where noise is. All draws are hashes
(`draws.draw_words`) of the frame's key, with y, x = b div 2¹⁶, b mod 2¹⁶:

    u  = uniform(NOISE_COUNT.draw())        count: Poisson quantile of u, mean · NOISE_BLOCK
    wₖ = word(NOISE_PLACE.draw(k))          k = 0..count−1; its top 12 bits: pixel in the block;
                                            its other 52 · 2⁻⁵²: time, fraction of the interval
    vₖ = uniform(NOISE_POLARITY.draw(k))    ON where vₖ < on_fraction

Places beyond the last pixel of the frame are dropped. Blocks know nothing of each other, so bands,
threads, chunks and GPUs draw the same noise.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from statistics import NormalDist
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError
from texvent.runtime.jit import jit
from texvent.runtime.kernel_arrays import read_only
from texvent.simulation.kernels.radix_sort import sort_almost_sorted, sort_keys
from texvent.simulation.packets import FrameInterval, check_event_number
from texvent.simulation.random.compiled_draws import draw_uniform, draw_word
from texvent.simulation.random.draws import UNIT, Purpose, draw_normals
from texvent.simulation.texvent.config import TexventConfig

BoolArray = NDArray[np.bool_]
Float64Array = NDArray[np.float64]

NOISE_BLOCK = 4096
"""Pixels per noise block."""
NOISE_PLACE_SHIFT = 52
"""Bits of a place word below the pixel in its block."""
TIME_UNIT = 2.0**-NOISE_PLACE_SHIFT
"""Spacing of the times, as fractions of the interval: the rest of a word below the place."""
# What a uniform number cannot resolve need not be in the table.
_CERTAIN = 1.0 - UNIT
LARGE_MEAN = 1e4
"""Events of a block from which on only the middle of the Poisson distribution is summed up."""


def is_background(pixel: NDArray[np.int64], fired: NDArray[np.int64]) -> BoolArray:
    """Whether a pixel is not among those that fired, [n]; `fired` must ascend."""
    place = np.searchsorted(fired, pixel)
    # −1 after the last one: no pixel equals it.
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
    # Numbers so far below a large mean have no probability; the table stays as long.
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


class NoisePlaces(NamedTuple):
    """Noise events, by pixel, then by p."""

    pixel: NDArray[np.int64]
    """[n] flat index y · W + x, ascending."""
    fraction: NDArray[np.float64]
    """[n] time as a fraction 0..1 of the interval; 1 is left out."""
    p: NDArray[np.uint8]
    """[n] 1 = ON, 0 = OFF."""


QUIET = NoisePlaces(np.empty(0, np.int64), np.empty(0), np.empty(0, np.uint8))


_COUNT, _PLACE, _POLARITY = (
    int(purpose.draw())
    for purpose in (Purpose.NOISE_COUNT, Purpose.NOISE_PLACE, Purpose.NOISE_POLARITY)
)
_SHIFT, _TIME = np.uint64(NOISE_PLACE_SHIFT), np.uint64((1 << NOISE_PLACE_SHIFT) - 1)
_1, _INDEX_BITS = np.uint64(1), np.uint64(31)
_INDEX = np.uint64((1 << 31) - 1)
FEW_PIXELS = NOISE_BLOCK // 32
"""With an event for fewer pixels than these, 32 a block, sorting them by digits is faster."""


def place_noise(key: np.uint64, mean: float, on_fraction: float, pixels: int) -> NoisePlaces:
    """Place, time and polarity of noise in one sub-interval, before any mask.

    Args:
        key: of `draws.frame_key`.
        mean: expected number of events per pixel.
        on_fraction: probability of ON.
        pixels: number of pixels of the frame.

    Equation: (6), section 3.2.2: Poisson(λ1 λ2).
    Deviation: drawn per block of `NOISE_BLOCK` pixels and spread uniformly over its pixels, which
        is the same distribution as a Poisson number per pixel.
    """
    return NoisePlaces(
        *_place_noise(key, poisson_cumulative(mean * NOISE_BLOCK), on_fraction, pixels)
    )


@jit
def _place_noise(
    key: np.uint64, cumulative: NDArray[np.float64], on_fraction: float, pixels: int
) -> Any:
    blocks = -(-pixels // NOISE_BLOCK)
    count = np.empty(blocks, np.int64)
    for b in range(blocks):
        count[b] = _count_up_to(draw_uniform(key, b >> 16, b & 0xFFFF, _COUNT), cumulative)
    total = count.sum()
    keys, fraction, found = np.empty(total, np.uint64), np.empty(total), 0
    for b in range(blocks):
        for k in range(count[b]):
            word = draw_word(key, b >> 16, b & 0xFFFF, _PLACE + k)
            pixel = b * NOISE_BLOCK + np.int64(word >> _SHIFT)
            if pixel < pixels:
                is_on = draw_uniform(key, b >> 16, b & 0xFFFF, _POLARITY + k) < on_fraction
                place = np.uint64(pixel) << _1 | np.uint64(is_on)
                keys[found] = place << _INDEX_BITS | np.uint64(found)
                fraction[found] = np.float64(word & _TIME) * TIME_UNIT
                found += 1
    return _by_place(keys[:found], fraction, pixels)


@jit
def _count_up_to(chance: float, cumulative: NDArray[np.float64]) -> int:
    """Number of entries up to `chance`, one by one, because most often it is none or few."""
    count = 0
    while count < cumulative.size and cumulative[count] <= chance:
        count += 1
    return count


@jit
def _by_place(keys: NDArray[np.uint64], fraction: NDArray[np.float64], pixels: int) -> Any:
    if keys.size * FEW_PIXELS < pixels:
        # Blocks follow each other already.
        sort_almost_sorted(keys)
    else:
        bits = 32
        while pixels >> (bits - 32):
            bits += 1
        keys = sort_keys(keys, np.empty_like(keys), 31, bits)
    pixel, p = np.empty(keys.size, np.int64), np.empty(keys.size, np.uint8)
    ordered = np.empty(keys.size)
    for i in range(keys.size):
        place = keys[i] >> _INDEX_BITS
        pixel[i], p[i] = place >> _1, place & _1
        ordered[i] = fraction[np.int64(keys[i] & _INDEX)]
    return pixel, ordered, p


def draw_noise(
    config: TexventConfig,
    span: FrameInterval,
    size: int,
    luma_of: Callable[[NDArray[np.int64]], NDArray[Any]],
) -> NoisePlaces:
    """Noise events of Eq. 6 in dark pixels, or, as ablation E11, in any.

    Args:
        config: options.
        span: the sub-interval.
        size: number of pixels.
        luma_of: luma at the end of the sub-interval, 0..255 scale, of pixels given by flat index.

    Returns:
        Noise events, also at pixels that fire in this sub-interval: adaptive noise leaves those
        out (`is_background`), so that in all M = (I^j < σ) · (Δ < δ).

    Raises:
        InputError: more events than memory holds.

    Equation: (6), section 3.2.2; drawn per block of pixels, see `place_noise`.
    Deviation: the paper names source frames here and sub-frames in Eq. 5; this uses sub-frames. It
        gives noise no polarity and no time. Eq. 7 would put all of it at the end, because its
        change is below δ; real background activity is uniform in time.
    """
    if not config.has_added_noise:
        return QUIET
    mean = config.expected_noise(span.duration_s)
    # Drawn for whole blocks, then cut to the frame.
    check_event_number(mean * -(-size // NOISE_BLOCK) * NOISE_BLOCK)
    noise = place_noise(span.key, mean, config.noise_on_fraction, size)
    if config.noise == "random" or not len(noise.pixel):
        return noise
    dark = np.flatnonzero(luma_of(noise.pixel) < config.noise_intensity)
    if not len(dark):
        return QUIET
    return NoisePlaces(noise.pixel[dark], noise.fraction[dark], noise.p[dark])
