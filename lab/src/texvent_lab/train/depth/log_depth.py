"""Depth as E2Depth's network gives it: the logarithm of metres, in 0..1."""

from __future__ import annotations

from typing import Any

from texvent.metrics.dense_errors import FARTHEST_M
from texvent.networks.weight_files import Tensor

LOG_RANGE = 3.70378
"""Natural logarithm of farthest over nearest depth; the nearest is 1.97 m."""


def encode_depth(depth_m: Tensor) -> Tensor:
    """1 at the farthest depth and beyond, 0 at the nearest and before; NaN stays NaN.

    Args:
        depth_m: metres, 0 or more, any shape; inf for the sky.

    Source: J. Hidalgo-Carrió, D. Gehrig, D. Scaramuzza, "Learning monocular dense depth from
        events", 3DV 2020, equation (1), and its program.
    """
    share = (depth_m / FARTHEST_M).clamp(max=1.0)
    return (1 + share.log() / LOG_RANGE).clamp(0.0, 1.0)


def decode_depth(code: Any) -> Any:
    """Metres of a network's output, a tensor or an array; undoes `encode_depth` in its range."""
    exponent = LOG_RANGE * (code - 1)
    return FARTHEST_M * 2.718281828459045**exponent
