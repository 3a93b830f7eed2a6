"""Shapes placed in body coordinates: balls, rods, limbs, cones, planks and blades.

All lengths are metres; `size` is always the full extent, `radius` half of it. Maps are [3, 4]
affine matrices from unit-shape to body coordinates (`ModelPart.to_body`), always with a positive
determinant: a mirror image would turn surfaces inside out.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import fields, is_dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.scenes.models.materials import Material
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.scene import Shape

Affine = NDArray[np.float64]
Point = tuple[float, float, float]

_PARALLEL = 0.95  # cosine from which a direction counts as parallel to the reference axis


def part(shape: Shape, material: Material, to_body: Affine) -> ModelPart:
    """A placed unit shape with a material."""
    return ModelPart(
        shape=shape,
        to_body=to_body,
        colour=material.colour,
        second_colour=material.second_colour,
        texture=material.texture,
        texture_scale=material.scale,
        emission=material.emission,
    )


def ball(material: Material, centre: Point, size: Point) -> ModelPart:
    """An ellipsoid with axes along x, y, z."""
    return part(Shape.ELLIPSOID, material, placed_upright(centre, size))


def rod(
    material: Material, start: Point, end: Point, radius: float, *, side_radius: float | None = None
) -> ModelPart:
    """A cylinder from one point to another; `side_radius` is its half thickness along y."""
    side = radius if side_radius is None else side_radius
    return part(Shape.CYLINDER, material, placed_between(start, end, radius, side, 0.0))


def limb(
    material: Material, start: Point, end: Point, radius: float, *, side_radius: float | None = None
) -> ModelPart:
    """An ellipsoid whose long axis runs between two joints and reaches a little beyond them.

    Args:
        material: its surface.
        start: first joint, m.
        end: second joint, m.
        radius: half thickness, m.
        side_radius: half thickness along y (for a limb in the x-z plane), m; None = `radius`.

    Returns:
        The part; its local z runs from start to end, so stripes ring the limb.
    """
    side = radius if side_radius is None else side_radius
    return part(Shape.ELLIPSOID, material, placed_between(start, end, radius, side, 0.6 * radius))


def spike(material: Material, base: Point, tip: Point, radius: float) -> ModelPart:
    """A cone from the middle of its base to its tip."""
    return part(Shape.CONE, material, placed_between(base, tip, radius, radius, 0.0))


def plank(
    material: Material, start: Point, end: Point, *, chord: Point, thickness: Point
) -> ModelPart:
    """A slanted box spanned by three vectors: wings, roofs, blades."""
    return part(Shape.BOX, material, placed_spanned(start, end, chord, thickness))


def blade(
    material: Material, start: Point, end: Point, *, chord: Point, thickness: Point
) -> ModelPart:
    """A flat ellipsoid spanned by three vectors: feathered wings, leaves."""
    return part(Shape.ELLIPSOID, material, placed_spanned(start, end, chord, thickness))


def point(values: Sequence[float] | Affine) -> Point:
    """The first three numbers of some."""
    x, y, z = map(float, values[:3])
    return x, y, z


def part_way(start: Point, end: Point, share: float) -> Point:
    """`start` at share 0, `end` at share 1."""
    x, y, z = (a + share * (b - a) for a, b in zip(start, end, strict=True))
    return (x, y, z)


def mixed(first: Any, second: Any, share: float) -> Any:
    """Between numbers, tuples or dataclasses of them; flags are those of the second."""
    if is_dataclass(first):
        names = [one.name for one in fields(first)]
        pairs = {one: (getattr(first, one), getattr(second, one)) for one in names}
        return replace(second, **{one: mixed(*pair, share) for one, pair in pairs.items()})
    if isinstance(first, tuple):
        return tuple(mixed(a, b, share) for a, b in zip(first, second, strict=True))
    return second if isinstance(first, bool) else first + share * (second - first)


def moved(parts: Iterable[ModelPart], motion: Affine) -> list[ModelPart]:
    """The same parts carried along by a motion."""
    parts = list(parts)
    maps = compose(motion, np.array([each.to_body for each in parts]).reshape(-1, 3, 4))
    return [each.at(to_body) for each, to_body in zip(parts, maps, strict=True)]


def compose(outer: Affine, inner: Affine) -> Affine:
    """The map that applies `inner`, then `outer`; `inner` may be many maps, [..., 3, 4]."""
    product = outer[:, :3] @ inner
    product[..., 3] += outer[:, 3]
    return product


def shift(x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Affine:
    """A translation, m."""
    return np.array([[1.0, 0.0, 0.0, x], [0.0, 1.0, 0.0, y], [0.0, 0.0, 1.0, z]])


def turn_x(angle: float, pivot: Point = (0.0, 0.0, 0.0)) -> Affine:
    """A roll about an axis along x: positive lifts the left side (+y)."""
    return turn_about("x", angle, pivot)


def turn_y(angle: float, pivot: Point = (0.0, 0.0, 0.0)) -> Affine:
    """A turn about an axis along y: positive as a wheel that rolls towards +x."""
    return turn_about("y", angle, pivot)


def turn_z(angle: float, pivot: Point = (0.0, 0.0, 0.0)) -> Affine:
    """A turn about an upright axis: positive turns the nose left, from +x to +y."""
    return turn_about("z", angle, pivot)


def turn_about(axis: str, angle: float, pivot: Point = (0.0, 0.0, 0.0)) -> Affine:
    """A turn about an axis along "x", "y" or "z"."""
    turn, centre = rotation(axis, angle), np.array(pivot)
    return np.column_stack([turn, centre - turn @ centre])


def rotation(axis: str, angle: float) -> Affine:
    """[3, 3] rotation about "x", "y" or "z", rad."""
    c, s = math.cos(angle), math.sin(angle)
    if axis == "x":
        return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
    if axis == "y":
        return np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def bounds(parts: Iterable[ModelPart]) -> tuple[Affine, Affine]:
    """Two arrays [3]: least and greatest x, y, z of all parts, m."""
    maps: dict[Shape, list[Affine]] = {}
    for each in parts:
        maps.setdefault(each.shape, []).append(each.to_body)
    corners = [half_extents(shape, np.array(placed)) for shape, placed in maps.items()]
    lows, highs = (np.concatenate(ends) for ends in zip(*corners, strict=True))
    return lows.min(axis=0), highs.max(axis=0)


def half_extents(shape: Shape, to_body: Affine) -> tuple[Affine, Affine]:
    """Lowest and highest body coordinates of placed unit shapes.

    Args:
        shape: the unit shape.
        to_body: [..., 3, 4] maps to body coordinates.

    Returns:
        Two arrays [..., 3]: least and greatest x, y, z, m.
    """
    linear, middle = to_body[..., :3], to_body[..., 3]
    if shape is Shape.ELLIPSOID:
        reach = np.linalg.norm(linear, axis=-1)
        return middle - reach, middle + reach
    if shape in (Shape.BOX, Shape.MESH):
        reach = np.abs(linear).sum(axis=-1)
        return middle - reach, middle + reach
    round_reach = np.hypot(linear[..., 0], linear[..., 1])
    axis = linear[..., 2]
    if shape is Shape.CYLINDER:
        reach = round_reach + np.abs(axis)
        return middle - reach, middle + reach
    base, tip = middle - axis, middle + axis
    return np.minimum(base - round_reach, tip), np.maximum(base + round_reach, tip)


def placed_upright(centre: Point, size: Point) -> Affine:
    """The map of a unit shape with a middle and full extents along x, y, z."""
    x, y, z = centre
    half_x, half_y, half_z = (0.5 * extent for extent in size)
    return np.array([[half_x, 0.0, 0.0, x], [0.0, half_y, 0.0, y], [0.0, 0.0, half_z, z]])


def placed_between(start: Point, end: Point, radius: float, side: float, overlap: float) -> Affine:
    """The map of a unit shape between two points.

    Its local z runs from start to end; its local y is as near to body y as it can be.
    """
    dx, dy, dz = end[0] - start[0], end[1] - start[1], end[2] - start[2]
    length = max(math.sqrt(dx * dx + dy * dy + dz * dz), 1e-9)
    dx, dy, dz = dx / length, dy / length, dz / length
    # First local axis = reference × direction; the reference is y, or z for a limb along y.
    if abs(dy) < _PARALLEL:
        norm = math.hypot(dx, dz)
        ax, ay, az = dz / norm, 0.0, -dx / norm
    else:
        norm = math.hypot(dx, dy)
        ax, ay, az = -dy / norm, dx / norm, 0.0
    bx, by, bz = dy * az - dz * ay, dz * ax - dx * az, dx * ay - dy * ax
    half = 0.5 * length + overlap
    return np.array(
        [
            [ax * radius, bx * side, dx * half, 0.5 * (start[0] + end[0])],
            [ay * radius, by * side, dy * half, 0.5 * (start[1] + end[1])],
            [az * radius, bz * side, dz * half, 0.5 * (start[2] + end[2])],
        ]
    )


def placed_spanned(start: Point, end: Point, chord: Point, thickness: Point) -> Affine:
    """The map of a unit shape spanned by three vectors.

    Columns: half chord, half thickness, half span; flipped if they were left-handed.
    """
    a, b = np.array(start), np.array(end)
    columns = 0.5 * np.column_stack([np.array(chord), np.array(thickness), b - a])
    if np.linalg.det(columns) < 0.0:
        columns[:, 1] = -columns[:, 1]
    return np.column_stack([columns, 0.5 * (a + b)])
