"""Colour and relief of the ground, roads, rivers, a shore, and walls of a room (Numba)."""

from __future__ import annotations

import math

from texvent.runtime.jit import jit
from texvent_scenes.raycast.records import Record
from texvent_scenes.raycast.shading.material import (
    Look,
    Patch,
    land_look,
    mixed,
    painted,
    patch_axes,
    sample_material,
)
from texvent_scenes.raycast.shading.value_noise import (
    box_coverage,
    detail_fade,
    lattice,
    mix,
    noise_2d,
    smooth,
    square_wave,
)
from texvent_scenes.raycast.vectors import Vector, scaled, triple
from texvent_scenes.rendered_scene import Colour

_WHITE_PAINT = (0.62, 0.62, 0.60)
_KERB = (0.46, 0.46, 0.44)
_DASH_M = 6.0
_LINE_M = 0.14
_DIRT_ROAD = 3
_CITY = 5
_RIVER = 11
_LAKE = 12
_WATER = 30
_BREAKERS_M, _ROLL_M_S = 6.0, 2.0
"""Distance from one line of foam to the next, and their speed."""
_FOAM = (0.82, 0.84, 0.84)
_FLOW_M_S = 0.9
_DRIFT_M_S = 0.25

Strip = tuple[float, float, float, float]
"""Metres along and across a strip, and cosine and sine of its direction there."""


@jit(error_model="numpy")
def strip_place(instant: Record, x: float, y: float) -> Strip:
    """Position of a ground point along and across the main road's line."""
    cosine, sine, _, x0, y0 = instant.road
    return (
        (x - x0) * cosine + (y - y0) * sine,
        (y - y0) * cosine - (x - x0) * sine,
        cosine,
        sine,
    )


@jit(error_model="numpy", inner=True)
def _crossing_place(instant: Record, number: int, x: float, y: float) -> Strip:
    x0, y0, cosine, sine = instant.crossings[number]
    return (
        (x - x0) * cosine + (y - y0) * sine,
        (y - y0) * cosine - (x - x0) * sine,
        cosine,
        sine,
    )


@jit(error_model="numpy", inner=True)
def _feet(strip: Strip, patch: Patch) -> tuple[float, float]:
    """Metres that a pixel covers along and across a strip."""
    cosine, sine = strip[2], strip[3]
    return (
        abs(patch[0] * cosine + patch[1] * sine) + abs(patch[2] * cosine + patch[3] * sine),
        abs(patch[1] * cosine - patch[0] * sine) + abs(patch[3] * cosine - patch[2] * sine),
    )


@jit(error_model="numpy", inner=True)
def _inside_share(instant: Record, strip: Strip, foot: float) -> float:
    """Share of a pixel that shows the strip rather than what lies beside it."""
    half = instant.road[2]
    if instant.ground in (2, _CITY):
        return box_coverage(strip[1], -half, half, foot)
    far = 1.0 if instant.ground == _DIRT_ROAD else 2.5
    wobble = far * (
        0.35 * noise_2d(0.35 * strip[0] / far, 0.0, 3) + 0.12 * noise_2d(1.3 * strip[0], 9.0, 4)
    )
    soft = max(0.6, 1.5 * foot)
    if instant.ground == _LAKE:
        return smooth((strip[1] + 2.0 * wobble) / soft + 0.5)
    return smooth((half + wobble - abs(strip[1])) / soft + 0.5)


@jit(error_model="numpy", inner=True)
def _line_marks(strip: Strip, half: float, feet: tuple[float, float]) -> float:
    """Share of white paint: edge lines and a dashed middle line."""
    edge = box_coverage(abs(strip[1]), half - 3.0 * _LINE_M, half - 2.0 * _LINE_M, feet[1])
    middle = box_coverage(strip[1], -0.5 * _LINE_M, 0.5 * _LINE_M, feet[1])
    return max(edge, middle * square_wave(strip[0] / _DASH_M, feet[0] / _DASH_M))


@jit(error_model="numpy", inner=True)
def _asphalt(instant: Record, x: float, y: float, axes: Patch, marks: float) -> Look:
    """Carriageway with worn paint; `marks` is its share of a pixel."""
    sample = sample_material(instant, instant.road_surface, x, y, axes, 1.0)
    tar = triple(instant.second_colour)
    surface = painted(sample, tar, scaled(tar, 2.2), 1.0)
    brightness = min(sample[0] + sample[1], 1.3)
    colour = mix(surface[0], scaled(_WHITE_PAINT, 0.55 + 0.45 * brightness), 0.9 * marks)
    return colour, surface[1], surface[2]


@jit(error_model="numpy", inner=True)
def _track(
    instant: Record, x: float, y: float, axes: Patch, strip: Strip, feet: tuple[float, float]
) -> Look:
    """A dirt road with two ruts."""
    sample = sample_material(instant, instant.road_surface, x, y, axes, 1.0)
    wobble = 0.3 * noise_2d(0.35 * strip[0], 0.0, 3)
    rut = smooth(1.6 - abs(abs(strip[1] + wobble) - 0.85) / 0.35)
    factor = 1.0 - 0.28 * rut * detail_fade(feet[1] / 1.5)
    soil = triple(instant.second_colour)
    return painted(sample, soil, scaled(soil, 1.3), factor)


@jit(error_model="numpy", inner=True)
def _foam_share(instant: Record, strip: Strip, feet: tuple[float, float]) -> float:
    """Share of foam on high waves: lines of it roll onto a shore, fewer far out."""
    if instant.wave_height <= 1.0 or instant.ground != _LAKE:
        return 0.0
    far = max(strip[1], 0.0)
    seaward = far + _ROLL_M_S * instant.time
    place = (seaward + 3.0 * noise_2d(0.12 * strip[0], 0.0, 5)) / _BREAKERS_M
    behind = place - math.floor(place)
    patchy = noise_2d(0.5 * strip[0], 0.9 * seaward, 6)
    sharp = _BREAKERS_M / max(feet[1], 0.5)
    line = smooth((0.24 + 0.26 * patchy - behind) * min(sharp, 6.0) + 0.5)
    near = math.exp(-far / (8.0 * instant.wave_height))
    return 0.9 * near * (0.15 + (line - 0.15) * detail_fade(feet[1] / _BREAKERS_M))


@jit(error_model="numpy", inner=True)
def _water(instant: Record, strip: Strip, axes: Patch, view_up: float, foam: float) -> Look:
    """Rippled water that flows along the strip and mirrors the sky."""
    speed = _FLOW_M_S if instant.ground == _RIVER else _DRIFT_M_S
    turned = (
        axes[0] * strip[2] + axes[1] * strip[3], axes[1] * strip[2] - axes[0] * strip[3],
        axes[2], axes[3],
    )  # fmt: skip
    place = strip[0] - speed * instant.time
    sample = sample_material(instant, _WATER, place, strip[1], turned, 1.0)
    mirror = 0.06 + 0.44 * (1.0 - min(abs(view_up), 1.0)) ** 4  # ripples too small to be seen
    deep = mix(triple(instant.second_colour), triple(instant.sky_horizon), mirror)
    bright = mix(deep, triple(instant.sky_horizon), 0.65)
    look = painted(sample, deep, bright, 1.0)
    # Ripples lie flat: their slopes turn what is mirrored, not the water's own shade.
    return mix(look[0], _FOAM, foam), 0.0, 0.0


@jit(error_model="numpy", inner=True)
def _carriageway(
    instant: Record,
    point: tuple[float, float],
    axes: Patch,
    main: tuple[Strip, tuple[float, float], float],
    other: tuple[Strip, tuple[float, float], float],
) -> Look:
    """Asphalt of the main road, of one that crosses it, or of both."""
    half = instant.road[2]
    strip, feet, inside = main
    marks = 0.0
    if inside > 0.0:
        marks = inside * _line_marks(strip, half, feet) * (1.0 - other[2])
    if other[2] > 0.0:
        marks += (1.0 - inside) * other[2] * _line_marks(other[0], half, other[1])
    return _asphalt(instant, point[0], point[1], axes, marks)


@jit(error_model="numpy", inner=True)
def _road_look(
    instant: Record, x: float, y: float, patch: Patch, axes: Patch, strip: Strip
) -> Look:
    """A road with those that cross it, and what lies beside it."""
    half = instant.road[2]
    feet = _feet(strip, patch)
    inside = _inside_share(instant, strip, feet[1])
    other, other_feet, beyond = strip, feet, 0.0
    kerb = box_coverage(abs(strip[1]), half, half + 0.3, feet[1])
    for number in range(instant.crossing_count):
        place = _crossing_place(instant, number, x, y)
        spread = _feet(place, patch)
        share = _inside_share(instant, place, spread[1])
        kerb = max(kerb, box_coverage(abs(place[1]), half, half + 0.3, spread[1]))
        if share > beyond:
            other, other_feet, beyond = place, spread, share
    covered = inside + (1.0 - inside) * beyond
    if covered <= 0.0:
        return _kerbed(land_look(instant, x, y, axes), instant, kerb)
    if instant.ground == _DIRT_ROAD:
        if inside >= beyond:
            surface = _track(instant, x, y, axes, strip, feet)
        else:
            surface = _track(instant, x, y, axes, other, other_feet)
    else:
        surface = _carriageway(
            instant, (x, y), axes, (strip, feet, inside), (other, other_feet, beyond)
        )
    if covered >= 1.0:
        return surface
    return mixed(_kerbed(land_look(instant, x, y, axes), instant, kerb), surface, covered)


@jit(error_model="numpy", inner=True)
def _kerbed(land: Look, instant: Record, kerb: float) -> Look:
    if instant.ground != _CITY or kerb == 0.0:
        return land
    colour: Colour = mix(land[0], _KERB, kerb)
    return colour, land[1], land[2]


@jit(error_model="numpy", inner=True)
def strip_look(
    instant: Record, x: float, y: float, patch: Patch, axes: Patch, view_up: float
) -> Look:
    """Reflectance and relief of a ground with a road, a river or a shore.

    Args:
        instant: the scene.
        x: metres east.
        y: metres north.
        patch: what one pixel covers there.
        axes: of that patch, from `patch_axes`.
        view_up: z of the ray's unit direction.
    """
    strip = strip_place(instant, x, y)
    if instant.ground not in (_RIVER, _LAKE):
        return _road_look(instant, x, y, patch, axes, strip)
    feet = _feet(strip, patch)
    wet = _inside_share(instant, strip, feet[1])
    if wet >= 1.0:
        return _water(instant, strip, axes, view_up, _foam_share(instant, strip, feet))
    land = land_look(instant, x, y, axes)
    edge = strip[1] + 1.2 if instant.ground == _LAKE else instant.road[2] + 1.2 - abs(strip[1])
    bank = 0.6 * smooth(edge / 2.0)
    land = scaled(mix(land[0], (0.20, 0.155, 0.10), bank), 1.0 - 0.25 * bank), land[1], land[2]
    if wet <= 0.0:
        return land
    foam = _foam_share(instant, strip, feet)
    return mixed(land, _water(instant, strip, axes, view_up, foam), wet)


@jit(error_model="numpy", inner=True)
def glossy_share(instant: Record, point: Vector, foot: float) -> tuple[float, float]:
    """Share of the ground that is water or wet, and the roughness of it.

    `foot` is the length that a pixel covers, metres.
    """
    if instant.ground in (_RIVER, _LAKE):
        return _inside_share(instant, strip_place(instant, point[0], point[1]), foot), 0.05
    if instant.wetness == 0.0 or instant.ground not in (0, 2, _CITY):
        return 0.0, 0.0
    share = 1.0
    if instant.ground == 2:
        share = _inside_share(instant, strip_place(instant, point[0], point[1]), foot)
    puddle = 0.0
    if share > 0.0:
        hollow = noise_2d(0.31 * point[0], 0.31 * point[1], 7)
        hollow += 0.4 * noise_2d(0.9 * point[0], 0.9 * point[1], 8) * detail_fade(0.9 * foot)
        puddle = smooth(1.6 * hollow + 0.3) * detail_fade(0.31 * foot)
    return share * instant.wetness * (0.3 + 0.7 * puddle), 0.28 - 0.24 * puddle


_BOARDS, _PLASTER, _STONE, _CLOTH = 28, 33, 31, 43
HANGING_EVERY_M = 2.3
_FRAME_M = 0.05
_FRAME = (0.70, 0.69, 0.66)
_DARK_FRAME = (0.10, 0.06, 0.035)
_SKIRTING = (0.3, 0.24, 0.2)
_MOUNT_M = 0.04
_PANEL, _PANEL_M, _RAIL_M = (0.34, 0.2, 0.1), 0.16, 0.86
"""Wood of panelled walls, width of a panel, and height of the rail above them, m."""
_CEILING = (1.7, 1.69, 1.64)
"""White, and lit from below by what floor and walls send back, which is not traced."""


@jit(error_model="numpy", inner=True)
def ground_look(
    instant: Record, point: Vector, patch: tuple[Vector, Vector], view_up: float
) -> Look:
    """Reflectance and relief of the ground.

    Args:
        instant: the scene.
        point: on the ground, metres.
        patch: what one pixel covers there, from `texture.surface_patch`.
        view_up: z of the ray's unit direction.
    """
    flat = (patch[0][0], patch[0][1], patch[1][0], patch[1][1])
    axes = patch_axes(flat)
    if instant.ground in (2, 3, 5, 11, 12):
        return strip_look(instant, point[0], point[1], flat, axes, view_up)
    return land_look(instant, point[0], point[1], axes)


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
    return instant.wall_surface not in (_STONE, _CLOTH) and _hanging(cell, side) < 0.4


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
def wall_look(
    instant: Record, point: Vector, face: int, patch: tuple[Vector, Vector]
) -> tuple[Colour, Vector]:
    """Reflectance and normal of a room's wall or ceiling.

    Walls have a skirting board, windows and pictures, over a floor of boards panels too; those of
    rock or drapery have none.
    """
    right, down = patch
    a, b = (1, 2) if face == 0 else (0, 2)
    if face == 2:
        a, b = 0, 1
    axes = patch_axes((right[a], right[b], down[a], down[b]))
    side = -1.0 if face == 2 or point[face] > 0.0 else 1.0
    if face == 2:
        sample = sample_material(instant, _PLASTER, point[0], point[1], axes, 1.0)
        look = painted(sample, _CEILING, scaled(_CEILING, 0.9), 1.0)
        return look[0], (-look[1], -look[2], -1.0)
    plain = triple(instant.wall_colour)
    sample = sample_material(instant, instant.wall_surface, point[a], point[b], axes, 1.0)
    look = painted(sample, plain, scaled(plain, 0.82), 1.0)
    feet = (abs(right[a]) + abs(down[a]), abs(right[2]) + abs(down[2]), 0.0)
    colour = look[0]
    if instant.wall_surface not in (_STONE, _CLOTH):
        place = (point[a], point[2])
        colour = _hang(instant, colour, place, feet, 2 * face + int(side > 0.0))
        if instant.ground_surface == _BOARDS:
            colour = _panelled(colour, place, feet)
    colour = mix(colour, _SKIRTING, box_coverage(point[2], 0.0, 0.14, feet[1]))
    if face == 0:
        return colour, (side, -look[1], -look[2])
    return colour, (-look[1], side, -look[2])
