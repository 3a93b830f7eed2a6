"""Pixels of the physical model for its tests: everything off but what a test asks for."""

import dataclasses
import math

from texvent.simulation.physical.cameras import PRESETS
from texvent.simulation.physical.simulator import PhysicalSimulator

CLEAN = dataclasses.replace(PRESETS["clean"], gamma=1.0)


def clean(*, seed=0, **options) -> PhysicalSimulator:
    return PhysicalSimulator(dataclasses.replace(CLEAN, **options), seed=seed)


def intensity(brightness: float, balance: float = 10.0) -> float:
    """The linear intensity with ln(balance + I) = brightness."""
    return math.exp(brightness) - balance


def poisson_interval(mean: float) -> float:
    """Five standard deviations: missed once in two million tests."""
    return 5 * math.sqrt(mean)


def noisy(**options) -> PhysicalSimulator:
    return clean(**{"noise_scale": 1.0, "noise_decades": 0.0, **options})
