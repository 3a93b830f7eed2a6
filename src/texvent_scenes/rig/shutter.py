"""Frames of a camera with exposure time and a global or rolling shutter.

A frame is the mean of the light (linear, before gamma coding) of instants spread evenly over its
exposure, as many as pixels that the fastest parts move in it, and one more. Under a rolling shutter
every row has an exposure of its own; its instants are taken at the nearest of a grid on which
nothing moves by more than 1/64 pixel, so that rows share them.

A frame's time is the middle of the exposure of the image's middle.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from texvent.frames import MICROSECONDS, frame_time_us
from texvent.sensor import SensorSize
from texvent_scenes.rendered_scene import RenderedScene
from texvent_scenes.rig.config import RigConfig
from texvent_scenes.rig.description import Float64Array

if TYPE_CHECKING:
    from texvent_scenes.raycast.optics import Optics

MOST_INSTANTS = 64
"""Largest number of instants of an exposure."""
GRID_PX = 1 / 64
"""Most that anything moves between two instants of the grid."""
FASTEST_SHARE = 0.995
"""Share of the pixels that move no faster than what counts as fastest."""
_LOOK_S = 1e-3
"""Motion is measured over this time, s."""


@dataclass(frozen=True, eq=False)
class ExposedFrame:
    """A frame and when its rows saw light."""

    pixels: NDArray[np.uint8]
    """[H, W, 3] RGB, gamma-coded (sRGB)."""
    t_us: int
    """The middle of the exposure of the image's middle, µs."""
    first_row_s: float
    """Start of the exposure of the first row, s."""
    row_s: float
    """From one row's exposure to the next one's, s; 0 under a global shutter."""
    exposure_s: float
    """Exposure of each row, s."""

    @property
    def end_s(self) -> float:
        """End of the exposure of the last row, s."""
        rows = int(self.pixels.shape[0])
        return self.first_row_s + self.exposure_s + self.row_s * (rows - 1)


@dataclass(frozen=True)
class Shutter:
    """Exposure times of the rows of an image, relative to the frame's time."""

    exposure_s: float
    row_s: float
    """From one row to the next, s; 0 = global."""
    height: int
    """Rows."""

    @property
    def half_s(self) -> float:
        """Half the time from the first row's start to the last row's end."""
        return 0.5 * (self.exposure_s + self.row_s * (self.height - 1))

    def instants_s(self, count: int) -> Float64Array:
        """[H, count] instants, s from the frame's time: middles of equal parts of the exposure."""
        parts = (np.arange(count) + 0.5) / count - 0.5
        middles = self.row_s * (np.arange(self.height) - 0.5 * (self.height - 1))
        return np.asarray(middles[:, None] + self.exposure_s * parts)


def make_shutter(config: RigConfig, size: SensorSize) -> Shutter:
    """The shutter that a config states, for images of that size."""
    rolling = config.shutter == "rolling" and size.height > 1
    return Shutter(
        config.exposure, config.readout / (size.height - 1) if rolling else 0.0, size.height
    )


def frame_times_us(fps: Fraction, shutter: Shutter, stop_us: int) -> list[int]:
    """Times of the frames at that rate whose exposures lie within 0 and `stop_us`."""
    half_us, times = shutter.half_s * MICROSECONDS, []
    index = 0
    while (time := frame_time_us(index, fps)) + half_us <= stop_us:
        if time - half_us >= 0.0:
            times.append(time)
        index += 1
    return times


def expose_frames(
    scene: RenderedScene,
    size: SensorSize,
    shutter: Shutter,
    times_us: list[int],
    *,
    samples: int,
    shadows: bool,
    optics: Optics,
) -> Iterator[ExposedFrame]:
    """The frames at some times."""
    # Imported here: the kernels load Numba.
    from texvent.transfer import encode_srgb
    from texvent_scenes.raycast.render import world_at

    for t_us in times_us:
        time_s = t_us / MICROSECONDS
        light = expose(scene, size, shutter, time_s, samples=samples, shadows=shadows)
        world = world_at(scene, time_s, size, shadows=False)
        everywhere = np.ones(size.shape, dtype=np.bool_)
        passed = optics.passed(light.astype(np.float32), world, everywhere).reshape(light.shape)
        pixels = np.clip(np.round(encode_srgb(passed)), 0, 255).astype(np.uint8)
        first_s = time_s - shutter.half_s
        yield ExposedFrame(pixels, t_us, first_s, shutter.row_s, shutter.exposure_s)


def expose(
    scene: RenderedScene,
    size: SensorSize,
    shutter: Shutter,
    time_s: float,
    *,
    samples: int = 2,
    shadows: bool = True,
) -> Float64Array:
    """Linear light [H, W, 3], 0..1, that a perfect lens passes; arguments as `expose_frames`."""
    from texvent_scenes.raycast.render import light_of_rows, world_at

    speed = fastest_px_s(scene, size, time_s)
    count = count_instants(speed, shutter.exposure_s)
    light = np.zeros((size.height, size.width, 3))
    for instant_s, runs in _plan(shutter, count, speed):
        world = world_at(scene, time_s + instant_s, size, shadows=shadows, samples=samples)
        for first, last in runs:
            light[first:last] += light_of_rows(world, (first, last), size, samples=samples)
    return light / count


def count_instants(speed_px_s: float, exposure_s: float) -> int:
    """Instants of an exposure: one pixel of motion apart, at most `MOST_INSTANTS`."""
    if exposure_s == 0.0:
        return 1
    return min(math.ceil(speed_px_s * exposure_s) + 1, MOST_INSTANTS)


def fastest_px_s(scene: RenderedScene, size: SensorSize, time_s: float) -> float:
    """Speed that `FASTEST_SHARE` of the pixels do not exceed, px/s."""
    from texvent_scenes.raycast.ground_truth import cast_centres, move_to
    from texvent_scenes.raycast.render import world_at

    seen = cast_centres(world_at(scene, time_s, size), size)
    place = move_to(scene, (time_s, time_s + _LOOK_S), size, seen)
    moved = (place[:, :2] - seen.points)[place[:, 2] > 0.0]
    speed = np.hypot(moved[:, 0], moved[:, 1]) / _LOOK_S
    known = speed[np.isfinite(speed)]
    return float(np.quantile(known, FASTEST_SHARE)) if known.size else 0.0


def _plan(
    shutter: Shutter, count: int, speed_px_s: float
) -> Iterator[tuple[float, list[tuple[int, int]]]]:
    """Instants, s from the frame's time, each with the runs of rows that it counts for."""
    instants = shutter.instants_s(count)
    if shutter.row_s == 0.0:
        for instant in instants[0]:
            yield float(instant), [(0, shutter.height)]
        return
    step = GRID_PX / max(speed_px_s, GRID_PX)
    number = np.round(instants / step).astype(np.int64)
    for one in np.unique(number):
        runs = []
        for column in (number == one).T:
            edges = np.flatnonzero(np.diff(np.concatenate([[False], column, [False]])))
            runs += [(int(edges[at]), int(edges[at + 1])) for at in range(0, len(edges), 2)]
        yield float(one * step), runs
