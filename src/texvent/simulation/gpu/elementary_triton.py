"""The functions of `kernels.elementary` as Triton functions: same bits, of float64 tensors."""

from __future__ import annotations

import triton
import triton.language as tl

from texvent.simulation.kernels import elementary

# Kernels may read module-level numbers only as constexpr.
_ROOT_HALF_BITS = tl.constexpr(elementary.ROOT_HALF_BITS)
_LN2_HIGH, _LN2_LOW = tl.constexpr(elementary.LN2_HIGH), tl.constexpr(elementary.LN2_LOW)
_LOG2_E, _ROUNDER = tl.constexpr(elementary.LOG2_E), tl.constexpr(elementary.ROUNDER)
_LIMIT = tl.constexpr(elementary.LARGEST_EXPONENT)


@triton.jit
def natural_log(x: tl.tensor) -> tl.tensor:
    """See `elementary.natural_log`."""
    bits = x.to(tl.int64, bitcast=True)
    exponent = (bits - _ROOT_HALF_BITS) >> 52
    mantissa = (bits - (exponent << 52)).to(tl.float64, bitcast=True) - 1.0
    s = mantissa / (2.0 + mantissa)
    z = s * s
    z2 = z * z
    z4 = z2 * z2
    low = (1 / 3 + z * (1 / 5)) + z2 * (1 / 7 + z * (1 / 9))
    middle = (1 / 11 + z * (1 / 13)) + z2 * (1 / 15 + z * (1 / 17))
    high = (1 / 19 + z * (1 / 21)) + z2 * (1 / 23)
    series = z * (low + z4 * (middle + z4 * high))
    twice = 2.0 * s
    whole = exponent.to(tl.float64)
    return whole * _LN2_HIGH + (twice + (twice * series + whole * _LN2_LOW))


@triton.jit
def _split_exponential(x: tl.tensor) -> tl.tuple:
    """See `elementary.split_exponential`."""
    rounded = x * _LOG2_E + _ROUNDER
    whole = rounded - _ROUNDER
    r = (x - whole * _LN2_HIGH) - whole * _LN2_LOW
    r2 = r * r
    r4 = r2 * r2
    low = (1.0 + r * 0.5) + r2 * (1 / 6 + r * (1 / 24))
    middle = (1 / 120 + r * (1 / 720)) + r2 * (1 / 5040 + r * (1 / 40320))
    high = (1 / 362880 + r * (1 / 3628800)) + r2 * (1 / 39916800 + r * (1 / 479001600))
    excess = r * (low + r4 * (middle + r4 * (high + r4 * (1 / 6227020800))))
    scale = (rounded.to(tl.int64, bitcast=True) + 1023) << 52
    return scale.to(tl.float64, bitcast=True), excess


@triton.jit
def exponential(x: tl.tensor) -> tl.tensor:
    """See `elementary.exponential`."""
    scale, excess = _split_exponential(tl.minimum(tl.maximum(x, -_LIMIT), _LIMIT))
    return scale + scale * excess


@triton.jit
def decay_and_gain(angle: tl.tensor) -> tl.tuple:
    """See `elementary.decay_and_gain`."""
    scale, excess = _split_exponential(-tl.minimum(angle, _LIMIT))
    lost = (1.0 - scale) - scale * excess
    return scale + scale * excess, lost / angle
