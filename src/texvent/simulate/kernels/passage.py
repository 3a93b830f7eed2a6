"""What a kernel gets and gives when each pixel's voltage is a Brownian motion with drift."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias, cast

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.draws import Purpose
from texvent.simulate.kernels.select import AUTO, load_kernel, load_kernel_when_ready

Float64Array: TypeAlias = NDArray[np.float64]

FIRST_DRAW: int = Purpose.PASSAGE.draw()
DRAWS_PER_EVENT = 4
"""Polarity, two for a normal number, and which of two roots."""
CERTAIN = 40.0
"""e^(−40) is nothing beside 1: where `steer · against` is above, the drift decides."""
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


class Constants(NamedTuple):
    """What makes motion of light, k1 to k6 of the publication."""

    k1: float
    k2: float
    k3: float
    k4: float
    k5: float
    k6: float


class Light(NamedTuple):
    """Light at both ends of an interval, and what it does to the voltages."""

    before: NDArray[Any]
    """[H, W] luma at the start, 0..255 scale, uint8 or float32."""
    now: NDArray[Any]
    """[H, W] luma at the end, of the same type."""
    constants: Constants
    first_row: int = 0
    """Which row of the sensor the first one is: draws are keyed by it."""


FindPassages: TypeAlias = Callable[[Motion, Voltage, np.uint64, float], Passages]
"""`find_passages(motion, voltage, key, duration_us)`, see `passage_reference.find_passages`."""
FindPassagesInLight: TypeAlias = Callable[[Light, Voltage, np.uint64, float], Passages]
"""The same with light instead of the motion it makes."""


def load_find_passages_in_light(dtype: np.dtype[Any], backend: str = AUTO) -> FindPassagesInLight:
    """The function of a backend; "auto" is NumPy until the compiled one is ready.

    Raises:
        ConfigError: no backend has that name.
        MissingDependencyError: what the backend needs is not installed.
    """
    function = load_kernel_when_ready("passage", "find_passages_in_light", backend, dtype.name)
    return cast("FindPassagesInLight", function)


def load_find_passages(backend: str = AUTO) -> FindPassages:
    """The function of a backend. All return equal bits on one machine.

    Raises:
        ConfigError: no backend has that name.
        MissingDependencyError: what the backend needs is not installed.
    """
    return cast("FindPassages", load_kernel("passage", "find_passages", backend))
