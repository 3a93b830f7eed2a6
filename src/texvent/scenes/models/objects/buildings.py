"""Buildings: house, high-rise, barn; windmill and wind turbine with turning sails."""

from __future__ import annotations

import math
from dataclasses import dataclass

from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.materials import (
    CONCRETE,
    DARK,
    GLASS,
    WHITE,
    Material,
    brick,
    cloth,
    plaster,
    roofing,
    shade,
    stone,
    wood,
)
from texvent.scenes.models.protocol import ModelPart, Pose, fixed_noun, working_noun
from texvent.scenes.models.shapes import (
    Point,
    ball,
    blade,
    box,
    compose,
    gable,
    limb,
    moved,
    peak,
    plank,
    post,
    rod,
    shift,
    turn_x,
    turn_z,
)
from texvent.scenes.models.variation import between, choose, fraction, paint
from texvent.scenes.scene import Colour

_WALLS: tuple[Colour, ...] = ((0.62, 0.55, 0.42), (0.66, 0.64, 0.60), (0.50, 0.28, 0.18))
_ROOFS: tuple[Colour, ...] = ((0.30, 0.07, 0.035), (0.10, 0.09, 0.095), (0.20, 0.11, 0.06))


def build_house(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a house with a gabled roof, door, windows and chimney; it faces +x; 8 m wide."""
    wall = plaster(paint(colour, seed, "wall", _WALLS))
    roof = roofing(choose(seed, "roof", _ROOFS))
    frame, door = Material(WHITE), Material((0.16, 0.06, 0.03))
    parts = [
        box(wall, (0.0, 0.0, 1.6), (6.0, 8.0, 3.2)),
        gable(wall, (0.0, 0.0, 3.2), (6.0, 8.0, 2.2)),
        *_gable_roof(roof, (6.0, 8.0), 3.2, 2.2),
        box(brick((0.30, 0.10, 0.06)), (-1.4, 2.3, 5.0), (0.8, 0.8, 2.0)),
        box(door, (3.02, 0.0, 1.1), (0.10, 1.1, 2.2)),
        box(frame, (3.01, 0.0, 1.20), (0.06, 1.4, 2.4)),
        box(CONCRETE, (3.4, 0.0, 0.1), (0.9, 1.8, 0.2)),
    ]
    for y in (2.5, -2.5):
        parts += _window(frame, (3.0, y, 1.8), (1.4, 1.3))
        parts += _window(frame, (-3.0, y, 1.8), (1.4, 1.3))
    for side in (1.0, -1.0):
        parts.append(box(frame, (0.0, side * 4.0, 1.8), (1.6, 0.08, 1.4)))
        parts.append(box(GLASS, (0.0, side * 4.0, 1.8), (1.35, 0.12, 1.15)))
    return ArticulatedModel(parts, scale=scale)


def _window(frame: Material, middle: Point, size: tuple[float, float]) -> list[ModelPart]:
    wide, tall = size
    return [
        box(frame, middle, (0.08, wide, tall)),
        box(GLASS, middle, (0.12, wide - 0.22, tall - 0.22)),
        box(frame, middle, (0.14, 0.07, tall)),
    ]


def _gable_roof(
    roof: Material, foot: tuple[float, float], eaves: float, rise: float
) -> list[ModelPart]:
    """Two slabs from a ridge along y down over the eaves."""
    half, width = 0.5 * foot[0], foot[1] + 0.8
    over = 1.14  # how far beyond the wall the slabs reach, relative to half the width
    parts = []
    for side in (1.0, -1.0):
        low = (side * over * half, 0.0, eaves + (1.0 - over) * rise + 0.08)
        ridge = (-side * 0.05, 0.0, eaves + rise + 0.08)
        across, thick = (0.0, width, 0.0), (0.0, 0.0, 0.18)
        parts.append(plank(roof, low, ridge, chord=across, thickness=thick))
    return parts


def build_high_rise(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a block of 6 to 12 floors with rows of windows; `colour` is its walls."""
    wall = paint(colour, seed, "wall", ((0.40, 0.38, 0.35), (0.48, 0.36, 0.27), (0.30, 0.33, 0.38)))
    floors = int(between(seed, "floors", 6.0, 13.0))
    tall, wide, deep = 3.2 * floors, 13.0, 11.0
    plain, dark = plaster(wall), Material(shade(wall, 0.55))
    parts = [box(plain, (0.0, 0.0, 0.5 * tall), (deep, wide, tall))]
    for floor in range(floors):
        z = 3.2 * floor + 1.9
        glass = Material((0.05, 0.07, 0.09)) if floor else Material((0.10, 0.10, 0.09))
        parts.append(box(glass, (0.0, 0.0, z), (deep + 0.10, wide - 1.2, 1.6)))
        parts.append(box(glass, (0.0, 0.0, z), (deep - 1.2, wide + 0.10, 1.6)))
    for index in range(-2, 3):
        y, x = 2.2 * index, 1.8 * index
        parts.append(box(plain, (0.0, y, 0.5 * tall), (deep + 0.24, 0.7, tall)))
        parts.append(box(plain, (x, 0.0, 0.5 * tall), (0.6, wide + 0.24, tall)))
    parts += [
        box(dark, (0.0, 0.0, tall + 0.15), (deep + 0.5, wide + 0.5, 0.5)),
        box(dark, (-1.0, 1.5, tall + 1.2), (3.0, 4.0, 1.8)),
        box(Material((0.10, 0.06, 0.04)), (0.5 * deep + 0.1, 0.0, 1.3), (0.3, 1.9, 2.6)),
    ]
    return ArticulatedModel(parts, scale=scale)


def build_barn(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a red barn with white edges and a large door on +x, its ridge along x; 9 m wide."""
    wall = wood(colour if colour is not None else (0.32, 0.035, 0.025), scale=0.5)
    roof, white = roofing((0.14, 0.13, 0.13)), Material(WHITE)
    wide, thick = (0.2, 0.0, 0.0), (0.0, 0.26, 0.0)
    across = [
        box(wall, (0.0, 0.0, 2.0), (9.0, 11.0, 4.0)),
        gable(wall, (0.0, 0.0, 4.0), (9.0, 11.0, 3.0)),
        *_gable_roof(roof, (9.0, 11.0), 4.0, 3.1),
        box(white, (0.0, -5.5, 1.6), (3.4, 0.12, 3.2)),
        box(wall, (0.0, -5.5, 1.55), (3.0, 0.18, 2.9)),
        *(
            plank(white, (-x, -5.5, 0.1), (x, -5.5, 3.0), chord=wide, thickness=thick)
            for x in (1.5, -1.5)
        ),
        box(white, (0.0, -5.5, 5.0), (1.2, 0.14, 1.2)),
        box(DARK, (0.0, -5.5, 5.0), (0.9, 0.20, 0.9)),
    ]
    return ArticulatedModel(moved(across, turn_z(0.5 * math.pi)), scale=scale)


def build_windmill(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a Dutch windmill, 13 m, its four sails turning on +x; `colour` is its tower."""
    tower = stone(colour if colour is not None else (0.52, 0.47, 0.38))
    cap, sail = wood((0.17, 0.08, 0.05)), cloth((0.74, 0.70, 0.60))
    spar = Material((0.10, 0.06, 0.04))
    rigid = [
        peak(tower, (0.0, 0.0, 6.2), (6.0, 6.0, 12.4)),
        post(tower, (0.0, 0.0, 4.3), (3.3, 3.3, 8.6)),
        ball(cap, (0.0, 0.0, 9.9), (4.2, 4.0, 5.2)),
        rod(spar, (1.4, 0.0, 9.6), (2.9, 0.0, 9.6), 0.25),
        box(Material((0.10, 0.05, 0.03)), (2.9, 0.0, 1.1), (0.7, 1.2, 2.2)),
        box(GLASS, (2.1, 0.0, 4.4), (0.5, 0.8, 1.0)),
    ]
    return _mill(rigid, _Rotor(_sail(spar, sail), 4, (2.8, 0.0, 9.6), 0.18), scale=scale, seed=seed)


def _sail(spar: Material, cloth: Material) -> list[ModelPart]:
    """One sail pointing up from the hub."""
    return [
        rod(spar, (0.0, 0.0, 0.0), (0.0, 0.0, 6.2), 0.12),
        box(cloth, (0.05, 0.55, 3.8), (0.06, 0.95, 4.6)),
        box(spar, (0.06, 0.55, 3.0), (0.09, 0.95, 0.12)),
        box(spar, (0.06, 0.55, 4.6), (0.09, 0.95, 0.12)),
    ]


def build_wind_turbine(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a wind turbine, 30 m, with three blades turning on +x."""
    white = Material(colour if colour is not None else WHITE)
    rigid = [
        rod(white, (0.0, 0.0, 0.0), (0.0, 0.0, 20.4), 0.55),
        rod(white, (0.0, 0.0, 0.0), (0.0, 0.0, 10.0), 0.68),
        limb(white, (-1.4, 0.0, 20.6), (1.6, 0.0, 20.6), 0.75),
    ]
    one = [
        blade(
            white,
            (0.0, 0.0, -0.4),
            (0.0, 0.0, 10.5),
            chord=(0.25, 1.1, 0.0),
            thickness=(0.3, 0.0, 0.0),
        ),
        ball(white, (0.1, 0.0, 0.0), (1.2, 0.9, 0.9)),
    ]
    return _mill(rigid, _Rotor(one, 3, (2.3, 0.0, 20.6), 0.25), scale=scale, seed=seed)


@dataclass(frozen=True)
class _Rotor:
    """Equal arms around an axis along x."""

    arm: list[ModelPart]
    """One arm, drawn upwards from the origin."""
    count: int
    hub: Point
    turn_hz: float


def _mill(rigid: list[ModelPart], rotor: _Rotor, *, scale: float, seed: int) -> ArticulatedModel:
    start = fraction(seed, "turn")

    def articulate(pose: Pose) -> list[ModelPart]:
        turn = 2.0 * math.pi * (rotor.turn_hz * pose.time_s + start)
        parts: list[ModelPart] = []
        for index in range(rotor.count):
            angle = turn + 2.0 * math.pi * index / rotor.count
            parts += moved(rotor.arm, compose(shift(*rotor.hub), turn_x(angle)))
        return parts

    return ArticulatedModel(rigid, scale=scale, articulate=articulate)


NOUNS = (
    fixed_noun("house", build_house, ("home",)),
    fixed_noun(
        "building", build_high_rise,
        ("tower block",),
    ),
    fixed_noun("barn", build_barn),
    working_noun("windmill", build_windmill, ()),
    working_noun("wind turbine", build_wind_turbine, ("turbine",)),
)  # fmt: skip
