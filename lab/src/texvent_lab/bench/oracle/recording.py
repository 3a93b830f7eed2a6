"""Recordings of the oracle: the video of a scene, and its true events."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream
from texvent.frames import MICROSECONDS, Frame, Video, frame_time_us
from texvent.sensor import SensorSize
from texvent_lab.bench.oracle.pixel import PixelArray, PixelModel
from texvent_lab.bench.oracle.scenes import Scene, build_scene, camera_level

SIZE = SensorSize(96, 72)
FPS = Fraction(24)
FRAMES = 13
"""Frames of a video: 12 intervals of 1/24 s are half a second."""
STEP_RATE = Fraction(4800)
"""Exposures of the pixels, per second."""
Name = TypeVar("Name")
"""Key of a recording."""

LAST_US = frame_time_us(FRAMES - 1, FPS)
"""Time of the last frame of a video, and of the last true event at most."""


def render_video(scene: Scene, *, frames: int = FRAMES) -> Video:
    """The scene at 24 frames per second in 8 bits, as any camera would give it."""
    times = [frame_time_us(index, FPS) for index in range(frames)]
    levels = [camera_level(scene(t / MICROSECONDS)) for t in times]
    return Video(np.rint(np.stack(levels)).astype(np.uint8), times, FPS)


@dataclass(frozen=True, eq=False)
class TrueFrames:
    """The same video, not rounded, that can also be rendered at any instant.

    With it and the interpolator `exact`, a simulator is judged apart from interpolation.
    """

    scene: Scene
    size: SensorSize = SIZE
    fps: Fraction = FPS
    frame_count: int = FRAMES
    is_live: bool = False

    @property
    def metadata(self) -> Mapping[str, Any]:
        """Nothing: the benchmark stores scenes and seeds."""
        return {}

    def __iter__(self) -> Iterator[Frame]:
        for index in range(self.frame_count):
            t_us = frame_time_us(index, self.fps)
            yield Frame(self._level(t_us), t_us)

    def at(self, t_us: int) -> Frame:
        """The frame at any instant."""
        return Frame(self._level(t_us), t_us, is_source=False)

    def _level(self, t_us: int) -> NDArray[np.float32]:
        return camera_level(self.scene(t_us / MICROSECONDS)).astype(np.float32)


def record(
    scene: Scene,
    recordings: Mapping[Name, tuple[PixelModel, int]],
    size: SensorSize = SIZE,
    *,
    frames: int = FRAMES,
) -> dict[Name, EventStream]:
    """Events of a scene, as several sensors see it at once.

    Args:
        scene: what they see.
        recordings: name → (pixel model, seed of its noise).
        size: width and height of the scene, px.
        frames: of the video of that length; by default that of half a second.

    Returns:
        Name → events, times from 0 to that of the last frame.
    """
    arrays = {name: PixelArray(model, size, seed) for name, (model, seed) in recordings.items()}
    last_us = frame_time_us(frames - 1, FPS)
    step = 0
    while (t_us := frame_time_us(step, STEP_RATE)) <= last_us:
        radiance = scene(t_us / MICROSECONDS)
        for array in arrays.values():
            array.expose(radiance, t_us)
        step += 1
    return {name: array.events() for name, array in arrays.items()}


def oracle_scene(name: str, seed: int) -> Scene:
    """A scene of the benchmark at the benchmark's size."""
    return build_scene(name, seed, SIZE)
