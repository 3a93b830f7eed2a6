"""What a kernel gets and gives when each pixel's voltage is a Brownian motion with drift.

Where the light rests, drift and diffusion stay what they are, so the passage that was drawn once
holds until its time comes or the light changes, over as many frames as that takes.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias, cast

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.backend.select import AUTO, load_kernel_when_ready
from texvent.simulate.packets.interval import FrameInterval
from texvent.simulate.packets.sorting import SortedEvents
from texvent.simulate.packets.unsorted_events import UnsortedEvents
from texvent.simulate.random.draws import Purpose

Float64Array: TypeAlias = NDArray[np.float64]

FIRST_DRAW: int = Purpose.PASSAGE.draw()
DRAWS_PER_PASSAGE = 3
"""Polarity, the size of a normal number, and its angle with which of two roots."""
CERTAIN = 40.0
"""e^(−40) is nothing beside 1: where `steer · against` is above, the drift decides."""
MOST_RESIDUAL = 1.0 - 2.0**-52
"""Voltage kept between intervals stays this side of both thresholds, whatever is rounded."""
LONGEST_US = 2.0**62
"""What stands for a passage that takes for ever, µs."""
BLOCK = 512
"""Pixels that a fast kernel looks at together, and skips together if nothing happens to them."""


class Voltage(NamedTuple):
    """How the voltages go on if the light stays: straight to the next threshold; [n] each.

    A voltage is measured in thresholds since the last event. At a time t it is
    `±1 − pace · (due − t)`, with the sign of the pace.
    """

    due_us: Float64Array
    """When the threshold is reached, µs after the first frame."""
    pace: Float64Array
    """1/µs, never 0: above 0 towards ON, else OFF."""
    is_moving: NDArray[np.bool_]
    """Whether the light moved in the last interval: then all this held for that interval only."""
    signal: NDArray[np.float32]
    """Part of the way since the last event that the signal drove."""
    soonest_us: Float64Array
    """[blocks] up to when nothing is due in a block; a note of the fast kernel for itself."""


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
    """[H, W] luma at the start, 0..255 scale, uint8 or float32; a kernel turns it into that at the
    end."""
    now: NDArray[Any]
    """[H, W] luma at the end, of the same type."""
    constants: Constants


FindPassages: TypeAlias = Callable[
    [Light, Voltage, FrameInterval, int], UnsortedEvents | SortedEvents
]
"""`find_passages(light, voltage, interval, first_us)`, see `passage_reference.find_passages`."""


def load_find_passages(dtype: np.dtype[Any], backend: str = AUTO) -> FindPassages:
    """The function of a backend; "auto" is NumPy until the compiled one is ready.

    Raises:
        ConfigError: no backend has that name.
        MissingDependencyError: what the backend needs is not installed.
    """
    function = load_kernel_when_ready(__name__, "find_passages", backend, dtype.name)
    return cast("FindPassages", function)


def new_voltage(residual: Float64Array) -> Voltage:
    """The state of pixels at the first frame.

    Args:
        residual: way gone already, any shape, thresholds, between −1 and 1.
    """
    n = residual.size
    return Voltage(
        np.full(n, LONGEST_US),
        (1.0 - residual.reshape(-1)) / LONGEST_US,
        np.ones(n, np.bool_),
        np.zeros(n, np.float32),
        np.full(-(-n // BLOCK), -np.inf),
    )
