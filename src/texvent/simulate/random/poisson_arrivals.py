"""Arrivals of a Poisson process over all pixels, drawn by the gaps between them."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.backend.select import Kernel
from texvent.simulate.random.draws import Purpose

FIRST_DRAW: int = Purpose.NOISE_TIME.draw()


class Arrivals(NamedTuple):
    """Arrivals in one interval, by pixel, then in time."""

    pixel: NDArray[np.int64]
    """[n] flat index y · W + x."""
    fraction: NDArray[np.float64]
    """[n] when, as a share of the interval, 0 to below 1."""
    order: NDArray[np.int64]
    """[n] number of the arrival in its row, from 0; further draws are keyed by it."""


DrawArrivals: TypeAlias = Callable[[NDArray[np.float64], float, np.uint64, int], Arrivals]
"""`draw_arrivals(cumulative_hz, duration_s, key, stream)`, see
`poisson_arrivals_reference.draw_arrivals`."""
DRAW_ARRIVALS = Kernel[DrawArrivals](__name__, "draw_arrivals")
