"""What a kernel gets and gives when brightness runs in a straight line between two frames.

ESIM and v2e share it: both compare a signal with a reference level per pixel, fire at every
threshold crossed, and let the reference follow in steps.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias, cast

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.backend.select import AUTO, load_kernel_when_ready
from texvent.simulate.crossing.levels import Thresholds
from texvent.simulate.packets.sorting import SortedEvents

Float64Array: TypeAlias = NDArray[np.float64]


class Ramp(NamedTuple):
    """Change of some pixels against their references, a straight line in time, log units."""

    pixel: NDArray[np.int64]
    """[n] flat index y · W + x, ascending: all pixels that may fire."""
    start: Float64Array
    """[n] change at the start of the interval."""
    stop: Float64Array
    """[n] change at its end."""
    threshold_on: Float64Array
    """[n] above 0."""
    threshold_off: Float64Array
    """[n] above 0."""


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
    """[m] flat index."""
    t: NDArray[np.int64]
    """[m] times, µs."""
    p: NDArray[np.uint8]
    """[m] 1 = ON, 0 = OFF."""
    steps: NDArray[np.int64]
    """[n] by how many thresholds the reference of each pixel of the ramp moves: up (ON) above 0,
    down (OFF) below."""


class Candidates(NamedTuple):
    """Pixels that may fire, whose brightness is a logarithm of their luma; [n] each."""

    pixel: NDArray[np.int64]
    """Flat index, ascending."""
    before: NDArray[Any]
    """At the start: luma if there is a table, else brightness."""
    now: NDArray[Any]
    """At the end, likewise."""
    table: Float64Array | None
    """[256] brightness of 8-bit luma, or None."""
    thresholds: Thresholds
    """Of these pixels."""


class Levels(NamedTuple):
    """What pixels compare with; a kernel moves both."""

    reference: Float64Array
    """[H · W] brightness at the last event, log units."""
    fired_us: NDArray[np.int64]
    """[H · W] time of the last event, µs; not looked at, so also [0], without a refractory
    period."""


CrossLevels: TypeAlias = Callable[
    [Candidates, Levels, tuple[int, int], Rest, tuple[int, int]], SortedEvents
]
"""`cross_levels(candidates, levels, (start_us, stop_us), rest, (height, width))`, see
`ramp_reference.cross_levels`."""


def load_cross_levels(dtype: np.dtype[Any], backend: str = AUTO) -> CrossLevels:
    """The function of a backend; "auto" is NumPy until the compiled one is ready.

    Raises:
        ConfigError: no backend has that name.
        MissingDependencyError: what the backend needs is not installed.
    """
    return cast("CrossLevels", load_kernel_when_ready(__name__, "cross_levels", backend, dtype.str))
