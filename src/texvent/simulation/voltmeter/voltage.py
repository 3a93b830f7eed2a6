"""The voltages of DVS-Voltmeter's pixels: state, drift and diffusion."""

from __future__ import annotations

import math
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.simulation.voltmeter.config import Constants

Float64Array: TypeAlias = NDArray[np.float64]

LONGEST_US = 2.0**62
"""Stands for a first passage that never happens, µs."""
BLOCK = 512
"""Pixels that a fast kernel looks at together, and skips together if nothing happens to them."""


class Voltage(NamedTuple):
    """State of the voltages; while the luma does not change, straight to a threshold; [n] each.

    The displacement is the voltage since the last event, in thresholds. At a time t it is
    `±1 − rate · (next_crossing − t)`, with the sign of the rate.
    """

    next_crossing_us: Float64Array
    """Time at which the threshold is reached, µs after the first frame."""
    rate: Float64Array
    """1/µs, never 0: above 0 towards ON, else OFF."""
    has_changed: NDArray[np.bool_]
    """Whether the luma changed in the last interval: then all this held for that interval only."""
    signal_displacement: NDArray[np.float32]
    """Part of the displacement that the signal caused."""
    quiescent_until_us: Float64Array
    """[blocks] time up to which no pixel of a block fires; only the fast kernel reads it."""


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


def drift_and_diffusion(
    before: Any, after: Any, duration_us: float, constants: Constants
) -> tuple[Any, Any, Any]:
    """Drift and diffusion of voltages between two frames; compiled for single pixels too.

    Args:
        before: luma L at the start, 0..255 scale, float64, any shape.
        after: luma at the end.
        duration_us: time between them, µs.
        constants: k1 to k6.

    Returns:
        k1 ΔL / Δt / (L + k2); that and k4 + k5 L; σ = k3 √L / (L + k2) + k6; L the mean of both.

    Equation: (10) and (11) of the publication.
    """
    mean = (before + after) * 0.5
    gain = 1.0 / (mean + constants.k2)
    signal = constants.k1 * (after - before) / duration_us * gain
    drift = signal + constants.k4 + constants.k5 * mean
    return signal, drift, constants.k3 * np.sqrt(mean) * gain + constants.k6
