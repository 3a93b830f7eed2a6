"""Light from all around that reaches a point: less near corners, more before windows (by Numba)."""

from __future__ import annotations

import math
from typing import Any

from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent_scenes.raycast.records import MOST_WINDOWS, Record
from texvent_scenes.raycast.shading.value_noise import mix
from texvent_scenes.raycast.shading.wall import HANGING_EVERY_M, has_window
from texvent_scenes.raycast.vectors import Vector, along, dot, scaled, triple
from texvent_scenes.rendered_scene import Colour

_FLOOR, _NO_GROUND = 6, 10
_CORNER, _CORNER_M = 0.42, 0.45
"""Share of the light that a wall takes away right beside it, and the distance at which that has
fallen to 37 %."""
_WINDOW_HEIGHT_M = 1.6
_WINDOW = 0.55
"""Light of a window before which a surface stands, at a metre, as a share of the sky's."""
_INDOORS = 0.86
"""Share of a room's light that does not come from its windows."""


@jit(error_model="numpy")
def list_windows(instants: NDArray[Any]) -> None:
    """Write the windows of a room into its instant."""
    instant = instants[0]
    instant.window_count = 0
    if instant.ground != _FLOOR or instant.is_corridor:
        return
    room, last = instant.room, int(instant.room / HANGING_EVERY_M)
    for cell in range(-last, last):
        for side in range(4):
            face = side // 2
            wall = -room if side % 2 == 1 else room
            if instant.window_count < MOST_WINDOWS and has_window(instant, cell, side):
                window = instant.windows[instant.window_count]
                window[face], window[1 - face] = wall, HANGING_EVERY_M * (cell + 0.5)
                window[2] = _WINDOW_HEIGHT_M
                instant.window_count += 1


@jit(error_model="numpy", inner=True)
def _beside(distance: float, flat: float) -> float:
    """Share of light beside a plane, whose normal has the component `flat` of the surface's."""
    if distance > 5.0 * _CORNER_M:
        return 1.0
    return 1.0 - _CORNER * (1.0 - abs(flat)) * math.exp(-max(distance, 0.0) / _CORNER_M)


@jit(error_model="numpy", inner=True)
def _window_light(instant: Record, point: Vector, normal: Vector) -> float:
    """Light of a room's windows, as a share of the sky's."""
    total = 0.0
    for index in range(instant.window_count):
        window = triple(instant.windows[index])
        towards = along(window, point, -1.0)
        facing = dot(towards, normal)
        if facing > 0.0:
            is_across = abs(window[0]) == instant.room
            out = abs(towards[0] if is_across else towards[1])
            square = dot(towards, towards)
            total += facing * out / (square * (square + 0.4))
    return _WINDOW * total


@jit(error_model="numpy", inner=True)
def ambient_light(instant: Record, point: Vector, normal: Vector) -> Colour:
    """Light from all around on a surface, without lamps and the sun."""
    light = scaled(triple(instant.ambient), 0.68 + 0.32 * normal[2])
    if instant.ground == _NO_GROUND:
        return light
    share = _beside(point[2], normal[2])
    if instant.ground == _FLOOR:
        share *= _beside(instant.room_x - abs(point[0]), normal[0]) * _INDOORS
        share *= _beside(instant.room - abs(point[1]), normal[1])
        share *= _beside(instant.ceiling - point[2], normal[2])
        sky = mix(triple(instant.sky_top), triple(instant.sky_horizon), 0.5)
        return along(scaled(light, share), sky, _window_light(instant, point, normal))
    return scaled(light, share)
