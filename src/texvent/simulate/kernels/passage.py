"""What a kernel gets and gives when each pixel's voltage is a Brownian motion with drift."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeAlias, cast

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.draws import Purpose
from texvent.simulate.kernels.select import AUTO, load_kernel

Float64Array: TypeAlias = NDArray[np.float64]

FIRST_DRAW: int = Purpose.PASSAGE.draw()
DRAWS_PER_EVENT = 4
"""Polarity, two for a normal number, and which of two roots."""
MOST_RESIDUAL = 1.0 - 2.0**-52
"""Voltage kept between intervals stays this side of both thresholds, whatever is rounded."""


class Motion(NamedTuple):
    """How the voltages move in one interval; voltage in units of the threshold."""

    signal: Float64Array
    """[H, W] drift that the change of light causes, 1/µs."""
    drift: Float64Array
    """[H, W] whole drift μ, leakage included, 1/µs."""
    sigma: Float64Array
    """[H, W] diffusion σ, 1/√µs, at least 0."""


class Voltage(NamedTuple):
    """Where the voltages stand between intervals."""

    residual: Float64Array
    """[H, W] way gone since the last event, between −1 and 1."""
    signal: Float64Array
    """[H, W] part of it that the signal drove."""


class Passages(NamedTuple):
    """Events of one interval, by pixel in row-major order, then in time."""

    pixel: NDArray[np.int64]
    """[n] flat index y · W + x."""
    after_us: Float64Array
    """[n] time since the start of the interval, µs."""
    p: NDArray[np.uint8]
    """[n] 1 = ON, 0 = OFF."""
    is_noise: NDArray[np.bool_]
    """[n] whether the signal drove less than half of the way to the threshold."""


FindPassages: TypeAlias = Callable[[Motion, Voltage, np.uint64, float], Passages]
"""`find_passages(motion, voltage, key, duration_us)`, see `passage_reference.find_passages`."""


def load_find_passages(backend: str = AUTO) -> FindPassages:
    """The function of a backend. All return equal bits on one machine.

    Raises:
        ConfigError: no backend has that name.
        MissingDependencyError: what the backend needs is not installed.
    """
    return cast("FindPassages", load_kernel("passage", "find_passages", backend))
