"""What a kernel gets and gives when brightness runs in a straight line between two frames.

ESIM and v2e share it: both compare a signal with a reference level per pixel, fire at every
threshold crossed, and let the reference follow in steps.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeAlias, cast

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.kernels.select import AUTO, load_kernel

Float64Array: TypeAlias = NDArray[np.float64]


class Ramp(NamedTuple):
    """Every pixel's change against its reference, a straight line in time, log units."""

    start: Float64Array
    """[H, W] change at the start of the interval."""
    stop: Float64Array
    """[H, W] change at its end."""
    threshold_on: Float64Array
    """[H, W] above 0."""
    threshold_off: Float64Array
    """[H, W] above 0."""


class Rest(NamedTuple):
    """Refractory period: how long a pixel cannot fire after it fired."""

    period_us: int
    """µs; 0 is none."""
    is_level_lost: bool
    """Whether a crossing that fell into the period is forgotten (ESIM: the reference steps over
    it) or may still fire in a later interval (v2e: the reference stays)."""


class RampCrossings(NamedTuple):
    """Events of one interval, by pixel in row-major order, then in time."""

    pixel: NDArray[np.int64]
    """[n] flat index y · W + x."""
    t: NDArray[np.int64]
    """[n] times, µs."""
    p: NDArray[np.uint8]
    """[n] 1 = ON, 0 = OFF."""
    steps: NDArray[np.int64]
    """[H, W] by how many thresholds each reference moves: up (ON) above 0, down (OFF) below."""


CrossRamp: TypeAlias = Callable[[Ramp, NDArray[np.int64], tuple[int, int], Rest], RampCrossings]
"""`cross_ramp(ramp, fired_us, (start_us, stop_us), rest)`, see `ramp_reference.cross_ramp`."""


def load_cross_ramp(backend: str = AUTO) -> CrossRamp:
    """The function of a backend. All return equal bits.

    Raises:
        ConfigError: no backend has that name.
        MissingDependencyError: what the backend needs is not installed.
    """
    return cast("CrossRamp", load_kernel("ramp", "cross_ramp", backend))
