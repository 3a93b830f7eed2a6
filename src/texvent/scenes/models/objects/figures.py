"""Things made from a list of parts: what most nouns without limbs need.

A list is drawn as the thing is seen from its front: y to the right, z up, x towards the viewer.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.machine_acts import STRUCK, STRUCK_SWING_S
from texvent.scenes.models.materials import Material, shade
from texvent.scenes.models.protocol import Habitat, ModelPart, Noun, Pose
from texvent.scenes.models.shapes import (
    Affine,
    Point,
    bounds,
    compose,
    limb,
    moved,
    plank,
    post,
    rod,
    shift,
    turn_x,
    turn_y,
    turn_z,
)
from texvent.scenes.models.variation import paint
from texvent.scenes.models.vehicles.wheels import Wheel, car_wheels
from texvent.scenes.scene import Colour

Draw = Callable[[Material], Sequence[ModelPart]]
"""Parts of a thing whose paint is the material."""
Motion = Callable[[Pose], Affine]
FlatPoint = tuple[float, float]
"""y and z, m."""

_ORIGIN: Point = (0.0, 0.0, 0.0)
_TURNS: dict[str, Callable[[float, Point], Affine]] = {"x": turn_x, "y": turn_y, "z": turn_z}


@dataclass(frozen=True)
class Moving:
    """Parts that move together."""

    draw: Draw
    motion: Motion
    hangs: bool = False
    """Whether they hang at rest, and swing when they are struck."""


@dataclass(frozen=True)
class Figure:
    """What a thing is made of, at its usual size."""

    draw: Draw
    """Parts that stay in place."""
    colours: tuple[Colour, ...]
    """Its usual paints."""
    moving: tuple[Moving, ...] = ()
    wheels: tuple[Wheel, ...] = ()
    is_centred: bool = False


def build_figure(
    figure: Figure, *, colour: Colour | None, scale: float, seed: int
) -> ArticulatedModel:
    """Make a thing from its list of parts; `colour` is its paint."""
    skin = Material(paint(colour, seed, "paint", figure.colours))
    groups = [(each.draw(skin), each.motion) for each in figure.moving]

    def articulate(pose: Pose) -> list[ModelPart]:
        parts = [part for group, motion in groups for part in moved(group, motion(pose))]
        return [*parts, *car_wheels(figure.wheels, pose.distance_m)]

    return ArticulatedModel(
        figure.draw(skin),
        scale=scale,
        articulate=articulate if groups or figure.wheels else None,
        is_centred=figure.is_centred,
        is_wheeled=bool(figure.wheels),
    )


def thing(
    name: str,
    colours: tuple[Colour, ...],
    draw: Draw,
    same: tuple[str, ...] = (),
    *,
    plurals: tuple[str, ...] = (),
    moving: tuple[Moving, ...] = (),
    wheels: tuple[Wheel, ...] = (),
    goes: tuple[Habitat, str, float] = ("fixed", "stand", 0.0),
) -> Noun:
    """A noun made from a list of parts.

    Args:
        name: singular.
        colours: its usual paints.
        draw: parts that stay in place.
        same: synonyms.
        plurals: irregular plurals.
        moving: parts that move.
        wheels: wheels that roll.
        goes: habitat, usual motion and speed, m/s.

    Returns:
        The noun.
    """
    habitat, motion, speed_m_s = goes
    is_centred = habitat == "air" or (habitat == "water" and motion == "swim")
    figure = Figure(draw, colours, moving, wheels, is_centred=is_centred)
    build = partial(build_figure, figure)
    hangs = any(each.hangs for each in moving)
    is_working = bool(moving) and habitat == "fixed" and not hangs
    acts = frozenset({STRUCK}) if hangs else frozenset()
    return Noun(
        name, build, habitat, speed_m_s, motion, same, plurals, acts=acts, is_working=is_working
    )


def placed(place: str, nouns: Iterable[Noun]) -> tuple[Noun, ...]:
    """The nouns with the place where they usually are."""
    return tuple(replace(noun, place=place) for noun in nouns)


def nothing(skin: Material) -> list[ModelPart]:
    """No parts: for things of which all parts move."""
    return []


def spinning(axis: str, turns_hz: float, pivot: Point = _ORIGIN) -> Motion:
    """Steady turning about an axis "x", "y" or "z" through a point."""
    turn = _TURNS[axis]
    return lambda pose: turn(2.0 * math.pi * turns_hz * pose.time_s, pivot)


def swinging(axis: str, reach_rad: float, rate_hz: float, pivot: Point = _ORIGIN) -> Motion:
    """Turning to and fro by up to an angle."""
    turn = _TURNS[axis]
    return lambda pose: turn(
        reach_rad * math.sin(2.0 * math.pi * rate_hz * pose.time_s + 0.5), pivot
    )


def struck(reach_rad: float, pivot: Point) -> Motion:
    """Hanging at rest, and after a blow swinging away from it, towards +x, and back."""

    def motion(pose: Pose) -> Affine:
        share = 0.0 if pose.act_s is None else max(pose.act_s, 0.0) / STRUCK_SWING_S
        return turn_y(-reach_rad * math.sin(math.pi * share) * math.exp(-0.3 * share), pivot)

    return motion


def rolling(radius: float) -> Motion:
    """Rolling along x without slipping; the parts are drawn around the origin."""
    return lambda pose: compose(shift(z=radius), turn_y(pose.distance_m / radius))


def toned(skin: Material, factor: float) -> Material:
    """The same surface, darker (factor < 1) or lighter."""
    return replace(
        skin,
        colour=shade(skin.colour, factor),
        second_colour=shade(skin.second_colour, factor),
    )


def lying(parts: Sequence[ModelPart]) -> list[ModelPart]:
    """A thing laid on its back, centred over the origin."""
    return centred(moved(parts, turn_y(-0.5 * math.pi)))


def centred(parts: Sequence[ModelPart]) -> list[ModelPart]:
    """Parts shifted so that they stand on z = 0, their middle over the origin."""
    low, high = bounds(parts)
    x, y = -0.5 * (low + high)[:2]
    return moved(parts, shift(float(x), float(y), -float(low[2])))


def bar(
    material: Material, start: FlatPoint, end: FlatPoint, wide: float, deep: float, x: float = 0.0
) -> ModelPart:
    """A box from one point of the y-z plane to another, `wide` in the plane and `deep` along x."""
    (y0, z0), (y1, z1) = start, end
    long = max(math.hypot(y1 - y0, z1 - z0), 1e-9)
    across = (0.0, wide * (z1 - z0) / long, -wide * (y1 - y0) / long)
    return plank(material, (x, y0, z0), (x, y1, z1), chord=across, thickness=(deep, 0.0, 0.0))


def disc(
    material: Material, centre: FlatPoint, radius: float, deep: float, x: float = 0.0
) -> ModelPart:
    """A round plate that faces +x."""
    y, z = centre
    return rod(material, (x - 0.5 * deep, y, z), (x + 0.5 * deep, y, z), radius)


def lathe(material: Material, profile: Sequence[FlatPoint], steps: int = 6) -> list[ModelPart]:
    """A round body about the z axis: upright cylinders whose radius follows (z, radius) points."""
    heights = [z for z, _ in profile]
    radii = [radius for _, radius in profile]
    edges = np.linspace(heights[0], heights[-1], steps + 1)
    parts = []
    for low, high in itertools.pairwise(edges):
        wide = 2.0 * float(np.interp(0.5 * (low + high), heights, radii))
        middle = 0.5 * float(low + high)
        parts.append(post(material, (0.0, 0.0, middle), (wide, wide, float(high - low))))
    return parts


def vessel(material: Material, radius: float, tall: float, inside: Material) -> list[ModelPart]:
    """An open round container whose inside shows on top."""
    wide, rim = 2.0 * radius, 0.01 * tall
    return [
        post(material, (0.0, 0.0, 0.5 * tall), (wide, wide, tall)),
        post(inside, (0.0, 0.0, tall), (0.88 * wide, 0.88 * wide, rim)),
    ]


def chain(material: Material, points: Sequence[Point], radius: float) -> list[ModelPart]:
    """Rods from point to point: handles, cables, frames."""
    pairs = itertools.pairwise(points)
    return [limb(material, start, end, radius) for start, end in pairs]


def ring(
    material: Material,
    centre: Point,
    radius: FlatPoint,
    thick: float,
    *,
    axis: str = "x",
    span: FlatPoint = (0.0, 360.0),
    pieces: int = 10,
) -> list[ModelPart]:
    """An ellipse of rods around an axis "x", "y" or "z", or a part of one.

    Args:
        material: its surface.
        centre: its middle, m.
        radius: half its extent to the right and up, as seen along the axis, m.
        thick: radius of the rods, m.
        axis: what it goes around; around "z" its extents are along y and x.
        span: first and last angle, degrees, from the right towards up.
        pieces: number of rods.

    Returns:
        The rods.
    """
    x, y, z = centre
    points: list[Point] = []
    for step in range(pieces + 1):
        angle = math.radians(span[0] + (span[1] - span[0]) * step / pieces)
        right, up = radius[0] * math.cos(angle), radius[1] * math.sin(angle)
        spot = {"x": (x, y + right, z + up), "y": (x + right, y, z + up)}
        points.append(spot.get(axis, (x - up, y + right, z)))
    return chain(material, points, thick)


def rectangle(
    material: Material, middle: FlatPoint, size: FlatPoint, wide: float, deep: float
) -> list[ModelPart]:
    """A frame of four bars that faces +x; `size` is its outer extent."""
    (y, z), (right, up) = middle, (0.5 * size[0] - 0.5 * wide, 0.5 * size[1] - 0.5 * wide)
    return [
        bar(material, (y + side * right, z - up - 0.5 * wide),
            (y + side * right, z + up + 0.5 * wide), wide, deep)
        for side in (1.0, -1.0)
    ] + [
        bar(material, (y - right, z + side * up), (y + right, z + side * up), wide, deep)
        for side in (1.0, -1.0)
    ]  # fmt: skip
