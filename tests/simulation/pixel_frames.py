"""Frames for the tests of the published pixel models: single pixels on known curves."""

from collections.abc import Callable, Iterable

import numpy as np

from texvent.events import EventStream
from texvent.frames import Frame


def frames_of(values: Iterable[float], times_us: Iterable[int]) -> list[Frame]:
    """One-pixel frames of the given intensities."""
    return [
        Frame(np.array([[value]], np.float64), int(t))
        for value, t in zip(values, times_us, strict=True)
    ]


def curve(intensity: Callable[[float], float], *, fps: float, seconds: float) -> list[Frame]:
    """One-pixel frames that sample `intensity(seconds)`."""
    count = round(seconds * fps)
    times = [round(i * 1e6 / fps) for i in range(count + 1)]
    return frames_of([intensity(t * 1e-6) for t in times], times)


def static(value: float, *, fps: float, seconds: float, shape=(1, 1)) -> list[Frame]:
    """A scene in which nothing happens."""
    count = round(seconds * fps)
    pixels = np.full(shape, value, np.float32)
    return [Frame(pixels, round(i * 1e6 / fps)) for i in range(count + 1)]


def moving_texture(
    count: int = 6, shape=(9, 12), *, step_us: int = 41_667, start_us: int = 0, seed: int = 3
) -> list[Frame]:
    """8-bit frames of blurred noise that moves by one pixel per frame."""
    random = np.random.default_rng(seed)
    wide = random.uniform(0, 255, (shape[0], shape[1] + count))
    wide = (wide + np.roll(wide, 1, 0) + np.roll(wide, 1, 1)) / 3
    return [
        Frame(np.round(wide[:, i : i + shape[1]]).astype(np.uint8), start_us + i * step_us)
        for i in range(count)
    ]


def run(simulator, frames: Iterable[Frame]) -> EventStream:
    """All events of the frames."""
    return EventStream.concat([simulator.step(frame) for frame in frames])
