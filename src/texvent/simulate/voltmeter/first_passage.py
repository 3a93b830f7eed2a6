"""First passages of Brownian motion with drift: the state of the voltages, and kernel by backend.

Where the luma does not change, drift and diffusion stay as they are. So a first passage that was
drawn once holds until it happens or the luma changes, over as many frames as that takes.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.backend.select import Kernel
from texvent.simulate.packets.interval import FrameInterval
from texvent.simulate.packets.sorting import SortedEvents
from texvent.simulate.packets.unsorted_events import UnsortedEvents
from texvent.simulate.random.draws import Purpose

Float64Array: TypeAlias = NDArray[np.float64]

FIRST_DRAW: int = Purpose.FIRST_PASSAGE.draw()
DRAWS_PER_PASSAGE = 3
"""Polarity, the size of a normal number, and its angle with which of two roots."""
CERTAIN = 40.0
"""e^(−40) vanishes beside 1: where `s · against` is above, the drift decides the direction."""
MOST_DISPLACEMENT = 1.0 - 2.0**-52
"""Displacements kept between intervals stay between both thresholds, whatever is rounded."""
LONGEST_US = 2.0**62
"""Stands for a first passage that never happens, µs."""
BLOCK = 512
"""Pixels that a fast kernel looks at together, and skips together if nothing happens to them."""


class Voltage(NamedTuple):
    """How the voltages go on while the luma does not change: straight to a threshold; [n] each.

    The displacement is the voltage since the last event, in thresholds. At a time t it is
    `±1 − rate · (next_crossing − t)`, with the sign of the rate.
    """

    next_crossing_us: Float64Array
    """When the threshold is reached, µs after the first frame."""
    rate: Float64Array
    """1/µs, never 0: above 0 towards ON, else OFF."""
    has_changed: NDArray[np.bool_]
    """Whether the luma changed in the last interval: then all this held for that interval only."""
    signal_displacement: NDArray[np.float32]
    """Part of the displacement that the signal caused."""
    quiescent_until_us: Float64Array
    """[blocks] time up to which no pixel of a block fires; only the fast kernel reads it."""


class Constants(NamedTuple):
    """What turns luma into drift and diffusion: k1 to k6 of the publication."""

    k1: float
    k2: float
    k3: float
    k4: float
    k5: float
    k6: float


class FirstPassageInput(NamedTuple):
    """Luma at both ends of an interval, and what turns it into drift and diffusion."""

    before: NDArray[Any]
    """[H, W] luma at the start, 0..255 scale, uint8 or float32; a kernel overwrites it with
    `now`."""
    now: NDArray[Any]
    """[H, W] luma at the end, of the same type."""
    constants: Constants


def most_passages(light: FirstPassageInput, duration_us: int) -> float:
    """A bound on the expected number of events of an interval, without a look at each pixel.

    A drift μ crosses |μ| thresholds per µs, a diffusion σ between two thresholds σ²; and
    √L / (L + k2) is at most 1 / (2 √k2).
    """
    k1, k2, k3, k4, k5, k6 = light.constants
    highest = max(float(light.before.max()), float(light.now.max()))
    diffusion = k3 / (2.0 * math.sqrt(k2)) + k6
    per_us = abs(k4) + abs(k5) * highest + diffusion * diffusion
    return light.now.size * (per_us * duration_us + 2.0 * k1)


FindFirstPassages: TypeAlias = Callable[
    [FirstPassageInput, Voltage, FrameInterval, int], UnsortedEvents | SortedEvents
]
"""`find_first_passages(light, voltage, interval, first_us)`, see
`reference.find_first_passages`."""
FIND_FIRST_PASSAGES = Kernel[FindFirstPassages](__name__, "find_first_passages")


def new_voltage(displacement: Float64Array) -> Voltage:
    """The state of pixels at the first frame.

    Args:
        displacement: any shape, thresholds, between −1 and 1.
    """
    n = displacement.size
    return Voltage(
        np.full(n, LONGEST_US),
        (1.0 - displacement.reshape(-1)) / LONGEST_US,
        np.ones(n, np.bool_),
        np.zeros(n, np.float32),
        np.full(-(-n // BLOCK), -np.inf),
    )
