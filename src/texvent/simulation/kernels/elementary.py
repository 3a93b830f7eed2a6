"""Logarithm, exponential and cosine from additions, products and quotients alone.

Two libraries may round a logarithm differently in its last bit, and an event threshold would show
it. These functions are written once: NumPy runs them on arrays, and `compiled_elementary` compiles
them for kernels, where they fill whole vector registers. Both give equal bits, within two units in
the last place of the true value.

All are Taylor series after a reduction of the argument that is exact or nearly so. Their terms are
grouped by fours, so that a processor need not wait for one before it begins the next.
"""

from __future__ import annotations

from typing import Any

import numpy as np

ROOT_HALF_BITS = 0x3FE6A09E667F3BCD
"""The bits of √½ as float64: mantissas are taken from √½ to √2."""
LN2_HIGH, LN2_LOW = float.fromhex("0x1.62E42FEE00000p-1"), float.fromhex("0x1.A39EF35793C76p-33")
"""ln 2 in two parts; the first has zeros at its end, so a whole multiple of it is exact."""
LOG2_E = float.fromhex("0x1.71547652B82FEp0")
ROUNDER = 6755399441055744.0
"""1.5 · 2⁵²: adding it rounds a float64 to a whole number, which its last bits then hold."""
LARGEST_EXPONENT = 700.0


def natural_log(x: Any) -> Any:
    """Natural logarithm.

    Args:
        x: above 0, not subnormal, finite, float64, any shape.

    Source: ln(2ᵏ m) = k ln 2 + 2 artanh((m − 1) / (m + 1)); the series of artanh.
    """
    bits = np.float64(x).view(np.int64)
    exponent = (bits - ROOT_HALF_BITS) >> 52
    mantissa = np.int64(bits - (exponent << 52)).view(np.float64) - 1.0
    s = mantissa / (2.0 + mantissa)
    z = s * s
    z2 = z * z
    z4 = z2 * z2
    low = (1 / 3 + z * (1 / 5)) + z2 * (1 / 7 + z * (1 / 9))
    middle = (1 / 11 + z * (1 / 13)) + z2 * (1 / 15 + z * (1 / 17))
    high = (1 / 19 + z * (1 / 21)) + z2 * (1 / 23)
    series = z * (low + z4 * (middle + z4 * high))
    twice = 2.0 * s
    whole = exponent * 1.0
    return whole * LN2_HIGH + (twice + (twice * series + whole * LN2_LOW))


def split_exponential(x: Any) -> Any:
    """`2ᵏ` and `e^r − 1` with x = k ln 2 + r, |r| ≤ ln 2 / 2."""
    rounded = x * LOG2_E + ROUNDER
    whole = rounded - ROUNDER
    r = (x - whole * LN2_HIGH) - whole * LN2_LOW
    r2 = r * r
    r4 = r2 * r2
    low = (1.0 + r * 0.5) + r2 * (1 / 6 + r * (1 / 24))
    middle = (1 / 120 + r * (1 / 720)) + r2 * (1 / 5040 + r * (1 / 40320))
    high = (1 / 362880 + r * (1 / 3628800)) + r2 * (1 / 39916800 + r * (1 / 479001600))
    excess = r * (low + r4 * (middle + r4 * (high + r4 * (1 / 6227020800))))
    # The last bits of `rounded` are k, so those of `whole + 1023` shifted are the exponent of 2ᵏ.
    return np.int64((np.float64(rounded).view(np.int64) + 1023) << 52).view(np.float64), excess


def exponential(x: Any) -> Any:
    """`e^x`; beyond ±700, as at ±700.

    Args:
        x: float64, any shape.
    """
    scale, excess = split_exponential(
        np.minimum(np.maximum(x, -LARGEST_EXPONENT), LARGEST_EXPONENT)
    )
    return scale + scale * excess


def decay_and_gain(angle: Any) -> Any:
    """`e^(−a)` and `(1 − e^(−a)) / a`, how a low-pass follows a line for a times its time constant.

    Args:
        angle: a, above 0, float64, any shape.

    Returns:
        Both, exact also for small a, where 1 − e^(−a) would cancel.
    """
    scale, excess = split_exponential(-np.minimum(angle, LARGEST_EXPONENT))
    lost = (1.0 - scale) - scale * excess
    return scale + scale * excess, lost / angle


def cosine_of_turns(turns: Any) -> Any:
    """`cos(2π u)`.

    Args:
        turns: u, 0..1, float64, any shape.

    Source: the series of sin, at 2π (|u − ½| − ¼), which is within a quarter turn.
    """
    x = (2.0 * np.pi) * (np.abs(turns - 0.5) - 0.25)
    z = x * x
    tail = -1 / 39916800 + z * (
        1 / 6227020800
        - z
        * (
            1 / 1307674368000
            - z
            * (1 / 355687428096000 - z * (1 / 121645100408832000 - z * (1 / 51090942171709440000)))
        )
    )
    tail = 1 / 120 + z * (-1 / 5040 + z * (1 / 362880 + z * tail))
    return x + x * (z * (-1 / 6 + z * tail))
