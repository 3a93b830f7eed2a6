"""Colour and relief of the walls of a room, their windows and pictures (Numba)."""

from __future__ import annotations

import math

from texvent.runtime.jit import jit
from texvent_scenes.raycast.records import Record
from texvent_scenes.raycast.shading.material import Patch, painted, patch_axes, sample_material
from texvent_scenes.raycast.shading.value_noise import (
    box_coverage,
    detail_fade,
    lattice,
    mix,
    noise_2d,
)
from texvent_scenes.raycast.vectors import Vector, scaled, triple
from texvent_scenes.rendered_scene import Colour

_BOARDS, _PLASTER, _STONE, _CLOTH = 28, 33, 31, 43
HANGING_EVERY_M = 2.3
_FRAME_M = 0.05
_FRAME = (0.70, 0.69, 0.66)
_DARK_FRAME = (0.10, 0.06, 0.035)
_SKIRTING = (0.3, 0.24, 0.2)
_MOUNT_M = 0.04
_PANEL, _PANEL_M, _RAIL_M = (0.34, 0.2, 0.1), 0.16, 0.86
"""Wood of panelled walls, width of a panel, and height of the rail above them, m."""
_DOOR_EVERY_M, _LIGHT_EVERY_M = 2.9, 2.6
_DOOR_FRAME, _LEAF, _HANDLE = (0.2, 0.19, 0.17), (0.32, 0.16, 0.07), (0.6, 0.6, 0.62)
"""Colours of the doors of corridors; they and the luminous panels above follow one another so."""
_LIGHT = (7.0, 7.0, 6.8)
_TILE_M, _RAIL_SHARE, _LIT_EVERY = 0.6, 0.05, 4
"""Side of the panels of a ceiling that hangs in them, m, share of it that is a rail, and of how
many one shines, along and across."""
_BUMPER_M = 0.82
"""Height of the rail along the walls of corridors, m."""
_BOARD, _BOARD_M, _NOTE_M = (0.3, 0.2, 0.11), (0.55, 0.38), 0.2
"""Colour of the notice boards of corridors, half their sides, and the distance of their notes."""
_PIER_EVERY_M, _PIER_M, _BEAM_M = 4.5, 0.16, 0.11
"""Distance of the piers of a hall and of the beams above them, and half their widths, m."""
_STRIP_M = (0.09, 0.75)
"""Half the sides of the luminous strips between the beams, m."""
_CEILING = (1.7, 1.69, 1.64)
"""White, and lit from below by what floor and walls send back, which is not traced."""


@jit(error_model="numpy", inner=True)
def _box_share(place: tuple[float, float], half: tuple[float, float], feet: Colour) -> float:
    """Share of a pixel within a rectangle around (0, 0)."""
    return box_coverage(place[0], -half[0], half[0], feet[0]) * box_coverage(
        place[1], -half[1], half[1], feet[1]
    )


@jit(error_model="numpy", inner=True)
def _hanging(cell: int, side: int) -> float:
    """Number in [0, 1) that decides what hangs on a stretch of a wall: below .4 a window."""
    return lattice(cell, side, 31)


@jit(error_model="numpy", inner=True)
def has_window(instant: Record, cell: int, side: int) -> bool:
    """Whether there is a window on a stretch of a room's wall; see `_hang`."""
    is_bare = instant.is_hall or instant.wall_surface in (_STONE, _CLOTH)
    return not is_bare and _hanging(cell, side) < 0.4


@jit(error_model="numpy", inner=True)
def _window(
    instant: Record, wall: Colour, at: tuple[float, float], feet: Colour, shape: float
) -> Colour:
    """A wall with a window, in plaster with curtains; `at` is metres from its middle."""
    sky = scaled(mix(triple(instant.sky_top), triple(instant.sky_horizon), 0.5), 2.0)
    crowns = 0.12 * noise_2d(5.0 * at[0] + 40.0 * shape, 0.0, 34) - 0.12 - at[1]
    inside = mix(sky, scaled(sky, 0.3), min(max(crowns / max(feet[1], 0.01) + 0.5, 0.0), 1.0))
    cross = max(
        box_coverage(at[0], -0.02, 0.02, feet[0]), box_coverage(at[1], -0.02, 0.02, feet[1])
    )
    colour = mix(wall, _FRAME, _box_share(at, (0.62 + _FRAME_M, 0.65 + _FRAME_M), feet))
    colour = mix(colour, mix(inside, _FRAME, cross), _box_share(at, (0.62, 0.65), feet))
    if instant.wall_surface != _PLASTER:
        return colour
    fold = (abs(at[0]) - 0.46) / 0.075 + 0.3 * math.sin(5.0 * at[1])
    fade = detail_fade(feet[0] / 0.075)
    cloth = (0.15 + 0.4 * shape, 0.12 + 0.2 * shape, 0.45 - 0.4 * shape)
    cloth = scaled(cloth, 1.0 + 0.45 * fade * math.sin(math.tau * fold))
    hem = (abs(at[0]) - 0.64, at[1] + 0.05)
    colour = mix(colour, cloth, _box_share(hem, (0.18, 0.85), feet))
    return mix(colour, _DARK_FRAME, _box_share((at[0], at[1] - 0.82), (0.92, 0.018), feet))


@jit(error_model="numpy", inner=True)
def _picture(
    wall: Colour, at: tuple[float, float], feet: Colour, half: tuple[float, float], shape: float
) -> Colour:
    """A wall with a framed landscape; `half` are its width and height, m."""
    hue = (0.15 + 0.4 * shape, 0.35 - 0.1 * shape, 0.5 - 0.4 * shape)
    x, y, inside = at[0] / half[0] + 9.0 * shape, at[1] / half[1], hue
    for layer in range(3):
        ridge = 0.45 - 0.5 * layer + 0.35 * noise_2d((2.0 + 2.0 * layer) * x, 0.0, 35 + layer) - y
        low = min(max(ridge * half[1] / max(feet[1], 0.004) + 0.5, 0.0), 1.0)
        inside = mix(inside, scaled(hue, (0.45, 1.25, 0.2)[layer]), low)
    outer = (half[0] + _MOUNT_M + _FRAME_M, half[1] + _MOUNT_M + _FRAME_M)
    colour = mix(wall, _DARK_FRAME, _box_share(at, outer, feet))
    mount = (half[0] + _MOUNT_M, half[1] + _MOUNT_M)
    colour = mix(colour, _FRAME, _box_share(at, mount, feet))
    return mix(colour, inside, _box_share(at, half, feet))


@jit(error_model="numpy", inner=True)
def _hang(
    instant: Record, wall: Colour, place: tuple[float, float], feet: Colour, side: int
) -> Colour:
    """A wall with windows and pictures on it; `place` is metres along and up.

    Each stretch has a window or a picture in its middle, and in plaster two small ones at its end.
    """
    stretch = place[0] / HANGING_EVERY_M
    cell = math.floor(stretch)
    at = (place[0] - HANGING_EVERY_M * (cell + 0.5), place[1] - 1.6)
    shape = lattice(cell, side, 32)
    if has_window(instant, cell, side):
        wall = _window(instant, wall, at, feet, shape)
    else:
        half = (0.28 + 0.2 * shape, 0.24 + 0.14 * lattice(cell, side, 33))
        wall = _picture(wall, at, feet, half, shape)
    if instant.wall_surface != _PLASTER:
        return wall
    end = math.floor(stretch + 0.5)
    aside, shape = place[0] - HANGING_EVERY_M * end, lattice(end, side, 38)
    wall = _picture(wall, (aside, place[1] - 1.88), feet, (0.1, 0.11), shape)
    return _picture(wall, (aside, place[1] - 1.45), feet, (0.08, 0.12), 1.0 - shape)


@jit(error_model="numpy", inner=True)
def _panelled(colour: Colour, place: tuple[float, float], feet: Colour) -> Colour:
    """The lower part of a wall in panels with grooves, below a rail."""
    middle = 0.5 * _PANEL_M  # of a period, so that no pixel across a groove misses half of it
    along = (place[0] - 0.007 + middle) % _PANEL_M
    groove = box_coverage(along, middle - 0.007, middle + 0.007, feet[0])
    panel = scaled(mix(_PANEL, colour, 0.25), 1.0 - 0.7 * groove)
    colour = mix(colour, panel, box_coverage(place[1], 0.0, _RAIL_M, feet[1]))
    return mix(colour, _SKIRTING, box_coverage(place[1], _RAIL_M, _RAIL_M + 0.06, feet[1]))


@jit(error_model="numpy", inner=True)
def _from_middle(place: float, every: float) -> float:
    """Distance from the nearest of the middles that follow one another at a period."""
    return (place + 0.5 * every) % every - 0.5 * every


@jit(error_model="numpy", inner=True)
def _panel_share(point: Vector, feet: Colour) -> float:
    """Share of a pixel of a corridor's ceiling within one of its luminous panels."""
    return _box_share((point[0], _from_middle(point[1], _LIGHT_EVERY_M)), (0.16, 0.6), feet)


@jit(error_model="numpy", inner=True)
def _hung(colour: Colour, place: tuple[float, float], feet: Colour) -> Colour:
    """A ceiling of panels in a grid of rails, each a little lighter or darker than the next."""
    u, v = place[0] / _TILE_M, place[1] / _TILE_M
    shade = lattice(int(u // 1.0), int(v // 1.0), 41) - 0.5
    wide, deep = feet[0] / _TILE_M, feet[1] / _TILE_M
    colour = scaled(colour, 1.0 + 0.16 * shade * detail_fade(max(wide, deep)))
    if lattice(int(u // 1.0), int(v // 1.0), 45) < 0.1:  # an air vent: frames in one another
        out = max(abs(_from_middle(u - 0.5, 1.0)), abs(_from_middle(v - 0.5, 1.0)))
        slot = box_coverage(out % 0.1, 0.05, 0.1, max(wide, deep))
        slot = 0.5 + (slot - 0.5) * detail_fade(max(wide, deep) / 0.1)
        colour = scaled(colour, 1.0 - (0.7 * slot if out < 0.4 else 0.0))
    half = 0.5 * _RAIL_SHARE
    across = box_coverage(_from_middle(u, 1.0), -half, half, wide)
    along = box_coverage(_from_middle(v, 1.0), -half, half, deep)
    return scaled(colour, 1.0 - 0.6 * max(across, along))


@jit(error_model="numpy", inner=True)
def _lit_share(point: Vector, feet: Colour) -> float:
    """Share of a pixel of a ceiling within one of its luminous panels, two panels long."""
    every = _LIT_EVERY * _TILE_M
    x = _from_middle(point[0] - 0.5 * _TILE_M, every)
    y = _from_middle(point[1] - 1.0 * _TILE_M, every)
    return _box_share((x, y), (0.46 * _TILE_M, 0.96 * _TILE_M), feet)


@jit(error_model="numpy", inner=True)
def _pier_wall(wall: Colour, place: tuple[float, float], feet: Colour, top: float) -> Colour:
    """A wall of a hall: piers, rails between them, and a band of paint above the floor."""
    along = _from_middle(place[0], _PIER_EVERY_M)
    wall = mix(wall, scaled(wall, 0.72), box_coverage(place[1], 0.0, 1.1, feet[1]))
    for number in range(1, 4):
        height = 0.25 * number * top
        rail = box_coverage(place[1], height - 0.03, height + 0.03, feet[1])
        wall = mix(wall, scaled(wall, 0.6), rail)
    edge = box_coverage(along, -_PIER_M - 0.03, _PIER_M + 0.03, feet[0])
    wall = mix(wall, scaled(wall, 0.55), edge)
    return mix(wall, scaled(wall, 2.2), box_coverage(along, -_PIER_M, _PIER_M, feet[0]))


@jit(error_model="numpy", inner=True)
def _beamed(colour: Colour, point: Vector, feet: Colour) -> Colour:
    """The ceiling of a hall: beams, and luminous strips between them."""
    x = _from_middle(point[0], _PIER_EVERY_M)
    y = _from_middle(point[1], _PIER_EVERY_M)
    colour = scaled(colour, 0.55)
    beam = max(
        box_coverage(x, -_BEAM_M, _BEAM_M, feet[0]), box_coverage(y, -_BEAM_M, _BEAM_M, feet[1])
    )
    colour = scaled(colour, 1.0 - 0.6 * beam)
    strip = (
        _from_middle(point[0] - 0.5 * _PIER_EVERY_M, 0.5 * _PIER_EVERY_M),
        _from_middle(point[1] - 0.5 * _PIER_EVERY_M, _PIER_EVERY_M),
    )
    return mix(colour, _LIGHT, _box_share(strip, _STRIP_M, feet))


@jit(error_model="numpy", inner=True)
def _notices(wall: Colour, at: tuple[float, float], feet: Colour, cell: int) -> Colour:
    """A wall with a board of paper notes; `at` is metres from its middle."""
    colour = mix(wall, _DARK_FRAME, _box_share(at, (_BOARD_M[0] + 0.03, _BOARD_M[1] + 0.03), feet))
    colour = mix(colour, _BOARD, _box_share(at, _BOARD_M, feet))
    i, j = math.floor(at[0] / _NOTE_M), math.floor(at[1] / (1.25 * _NOTE_M))
    shape = lattice(int(i), int(j), 43 + cell)
    inside = (at[0] - _NOTE_M * (i + 0.5), at[1] - 1.25 * _NOTE_M * (j + 0.5))
    half = (0.07 + 0.02 * shape, 0.09 + 0.03 * lattice(int(j), int(i), 44 + cell))
    note = (0.75 - 0.3 * shape, 0.72 - 0.2 * shape, 0.66 - 0.4 * shape)
    share = _box_share(inside, half, feet) * _box_share(at, _BOARD_M, feet)
    lines = box_coverage((inside[1] + 1.0) % 0.03 - 0.015, -0.006, 0.006, feet[1])
    note = scaled(note, 1.0 - 0.5 * lines * _box_share(inside, (0.055, 0.07), feet))
    return mix(colour, note, share if shape < 0.85 else 0.0)


@jit(error_model="numpy", inner=True)
def _between_doors(wall: Colour, place: tuple[float, float], feet: Colour, side: int) -> Colour:
    """A side wall of a corridor with a rail, and notice boards between most of its doors."""
    rail = box_coverage(place[1], _BUMPER_M, _BUMPER_M + 0.14, feet[1])
    wall = mix(wall, _DOOR_FRAME, rail)
    cell = math.floor(place[0] / _DOOR_EVERY_M)
    number = 2 * int(cell) + side
    if lattice(number, 0, 42) > 0.7:
        return wall
    at = (place[0] - _DOOR_EVERY_M * (cell + 0.5), place[1] - 1.5)
    return _notices(wall, at, feet, number)


@jit(error_model="numpy", inner=True)
def _ceiling_look(
    instant: Record, point: Vector, axes: Patch, feet: Colour
) -> tuple[Colour, Vector]:
    """Reflectance and normal of a ceiling: plaster, or panels of which some shine."""
    sample = sample_material(instant, _PLASTER, point[0], point[1], axes, 1.0)
    look = painted(sample, _CEILING, scaled(_CEILING, 0.9), 1.0)
    colour = look[0]
    if instant.has_panels:
        colour = _hung(colour, (point[0], point[1]), feet)
    if instant.is_corridor:
        colour = mix(colour, _LIGHT, _panel_share(point, feet))
    elif instant.has_panels:
        colour = mix(colour, _LIGHT, _lit_share(point, feet))
    elif instant.is_hall:
        colour = _beamed(colour, point, feet)
    return colour, (-look[1], -look[2], -1.0)


@jit(error_model="numpy", inner=True)
def _door(wall: Colour, at: tuple[float, float], feet: Colour, face: int) -> Colour:
    """A wall with a closed door with a handle; at the end of a corridor with two panes."""
    half, tall = (0.46, 1.03) if face == 0 else (0.8, 1.05)
    low = (at[0], at[1] - tall)
    colour = mix(wall, _DOOR_FRAME, _box_share(low, (half + 0.07, tall + 0.07), feet))
    colour = mix(colour, _LEAF, _box_share(low, (half, tall), feet))
    if face == 0:
        panel = (at[0], abs(at[1] - 1.02) - 0.5)
        colour = scaled(colour, 1.0 - 0.55 * _box_share(panel, (0.33, 0.4), feet))
        colour = mix(colour, _LEAF, _box_share(panel, (0.3, 0.37), feet))
        handle = (at[0] - half + 0.1, at[1] - 1.05)
        plate = (at[0] - half - 0.25, at[1] - 1.6)
        colour = mix(colour, _FRAME, _box_share(plate, (0.1, 0.06), feet))
        return mix(colour, _HANDLE, _box_share(handle, (0.06, 0.025), feet))
    pane = (abs(at[0]) - 0.4, at[1] - 1.25)
    colour = mix(colour, _FRAME, _box_share(pane, (0.26, 0.6), feet))
    return mix(colour, _DARK_FRAME, box_coverage(at[0], -0.012, 0.012, feet[0]))


@jit(error_model="numpy", inner=True)
def wall_look(
    instant: Record, point: Vector, face: int, patch: tuple[Vector, Vector]
) -> tuple[Colour, Vector]:
    """Reflectance and normal of a room's wall or ceiling.

    Walls have a skirting board, windows and pictures, over a floor of boards panels too; those of
    rock or drapery have none, those of halls piers.
    """
    right, down = patch
    a, b = (1, 2) if face == 0 else (0, 2)
    if face == 2:
        a, b = 0, 1
    axes = patch_axes((right[a], right[b], down[a], down[b]))
    side = -1.0 if face == 2 or point[face] > 0.0 else 1.0
    if face == 2:
        feet = (abs(right[0]) + abs(down[0]), abs(right[1]) + abs(down[1]), 0.0)
        return _ceiling_look(instant, point, axes, feet)
    plain = triple(instant.wall_colour)
    sample = sample_material(instant, instant.wall_surface, point[a], point[b], axes, 1.0)
    look = painted(sample, plain, scaled(plain, 0.82), 1.0)
    feet = (abs(right[a]) + abs(down[a]), abs(right[2]) + abs(down[2]), 0.0)
    colour = look[0]
    if instant.is_corridor:
        every = _DOOR_EVERY_M if face == 0 else 1e3
        if face == 0:
            colour = _between_doors(colour, (point[1], point[2]), feet, int(side > 0.0))
        colour = _door(colour, (_from_middle(point[a], every), point[2]), feet, face)
    elif instant.is_hall:
        colour = _pier_wall(colour, (point[a], point[2]), feet, instant.ceiling)
    elif instant.wall_surface not in (_STONE, _CLOTH):
        place = (point[a], point[2])
        colour = _hang(instant, colour, place, feet, 2 * face + int(side > 0.0))
        if instant.ground_surface == _BOARDS:
            colour = _panelled(colour, place, feet)
    colour = mix(colour, _SKIRTING, box_coverage(point[2], 0.0, 0.14, feet[1]))
    if face == 0:
        return colour, (side, -look[1], -look[2])
    return colour, (-look[1], side, -look[2])
