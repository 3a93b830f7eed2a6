"""Known scenes, at rest or flickering, simulated by a fitted model."""

import dataclasses

import numpy as np

from texvent.events import EventStream
from texvent.frames import MICROSECONDS, Frame
from texvent.sensor import SensorSize
from texvent.simulation.physical.circuit import WHITE
from texvent.simulation.physical.config import PhysicalConfig
from texvent.simulation.physical.simulator import PhysicalSimulator

STATIC_STEP_US = 500_000
"""Time between frames of a scene at rest, µs."""
STATIC_LEVEL = WHITE / 2
SWITCH_US = 10
"""Time in which the light switches, µs."""


def simulate_static(
    config: PhysicalConfig, size: SensorSize, seconds: float, *, seed: int = 0
) -> EventStream:
    """Events of a scene at rest, by a sensor that has run before: pixels have any phase."""
    config = dataclasses.replace(config, initial_phase="random")
    stop_us = round(seconds * MICROSECONDS)
    times = [*range(0, stop_us, STATIC_STEP_US), stop_us]
    level = np.full((size.height, size.width), STATIC_LEVEL, np.float32)
    return _simulate(config, [(t_us, level) for t_us in times], seed)


def simulate_flicker(
    config: PhysicalConfig, size: SensorSize, hz: float, *, ratio: float, number: int, seed: int = 0
) -> EventStream:
    """Events of a flat field that switches between two brightnesses.

    Each of `number` cycles, after one that is left out, begins with its bright half, which is white
    and `ratio` times as bright as the dark one.
    """
    bright = np.full((size.height, size.width), WHITE, np.float32)
    dark = (bright / ratio).astype(np.float32)
    half_us = MICROSECONDS / 2 / hz
    frames = [(0, dark)]
    for half in range(1, 2 * (number + 1) + 1):
        before, after = (dark, bright) if half % 2 else (bright, dark)
        t_us = round(half * half_us)
        frames += [(t_us, before), (t_us + SWITCH_US, after)]
    frames.append((round((2 * number + 3) * half_us), dark))
    first_us = round(3 * half_us)
    events = _simulate(config, frames, seed)
    return events.cut(first_us, first_us + round(2 * number * half_us))


def _simulate(
    config: PhysicalConfig, frames: list[tuple[int, np.ndarray]], seed: int
) -> EventStream:
    simulator = PhysicalSimulator(config, seed=seed)
    steps = [simulator.step(Frame(pixels, t_us, True)) for t_us, pixels in frames]
    return EventStream.concat(steps)
