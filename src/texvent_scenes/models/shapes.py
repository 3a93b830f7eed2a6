"""Shapes placed in body coordinates, such as balls, rods and limbs, and models made of them.

All lengths are metres; `size` is always the full extent, `radius` half of it. Maps are [3, 4]
affine matrices from unit-shape to body coordinates (`ModelPart.to_body`), always with a positive
determinant: a mirror image would turn surfaces inside out.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from copy import copy
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from texvent_scenes.models.materials import Material
from texvent_scenes.models.protocol import ModelPart, Pose
from texvent_scenes.rendered_scene import Shape

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


def moved(parts: Iterable[ModelPart], motion: Affine) -> list[ModelPart]:
    """The same parts carried along by a motion."""
    parts = list(parts)
    if not parts:
        return parts
    maps = compose(motion, np.concatenate([each.to_body for each in parts]).reshape(-1, 3, 4))
    return [each.at(to_body) for each, to_body in zip(parts, maps, strict=True)]


def compose(outer: Affine, inner: Affine) -> Affine:
    """The map that applies `inner`, then `outer`; `inner` may be many maps, [..., 3, 4]."""
    product = outer[:, :3] @ inner
    product[..., 3] += outer[:, 3]
    return product


def shift(x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Affine:
    """A translation, m."""
    return np.array([[1.0, 0.0, 0.0, x], [0.0, 1.0, 0.0, y], [0.0, 0.0, 1.0, z]])


def turn_about(axis: str, angle: float, pivot: Point = (0.0, 0.0, 0.0)) -> Affine:
    """A turn about an axis along "x", "y" or "z", from y to z, from z to x or from x to y."""
    turn, centre = rotation(axis, angle), np.array(pivot)
    return affine(turn, centre - turn @ centre)


def affine(linear: Affine, offset: Affine) -> Affine:
    """[3, 4] map of a linear part and an offset; a fifth of the time of `np.column_stack`."""
    result = np.empty((3, 4))
    result[:, :3], result[:, 3] = linear, offset
    return result


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


def placed_along(start: Point, end: Point) -> Affine:
    """Axes at the start, in m: z towards the end, y as near to body y as it can be."""
    axes = placed_between(start, end, 1.0, 1.0, 0.0)
    axes[:, 2] /= max(0.5 * math.dist(start, end), 1e-9)
    axes[:, 3] = start
    return axes


def placed_spanned(start: Point, end: Point, chord: Point, thickness: Point) -> Affine:
    """The map of a unit shape spanned by three vectors.

    Columns: half chord, half thickness, half span; flipped if they were left-handed.
    """
    a, b = np.array(start), np.array(end)
    columns = 0.5 * np.column_stack([np.array(chord), np.array(thickness), b - a])
    if np.linalg.det(columns) < 0.0:
        columns[:, 1] = -columns[:, 1]
    return np.column_stack([columns, 0.5 * (a + b)])


Articulation = Callable[[Pose], Sequence[ModelPart]]
Anchorage = Callable[[str, Pose], Affine | None]
"""Axes [3, 4] at a named place of a body at its usual size."""

# Poses that together show how far limbs, wings and rotors reach: times and distances spread
# evenly by the golden ratio and its two-dimensional counterpart, out of step with any cycle.
SAMPLE_POSES = tuple(
    Pose(
        time_s=5.0 * (0.6180339887 * step % 1.0),
        distance_m=6.0 * (0.7548776662 * step % 1.0),
        speed_m_s=3.0,
        activity=what,
    )
    for what in ("stand", "move", "run")
    for step in range(12)
)
STANDING_POSES = SAMPLE_POSES[:12]
"""Sample poses of nouns whose parts move by time, not by gait."""


class ArticulatedModel:
    """A `Model` from parts drawn at its usual size.

    Its length, width and height are measured, not declared, so they are true for every seed: the
    least box around the origin (from the ground up, unless `is_centred`) that holds all parts
    over a sample of poses.
    """

    def __init__(
        self,
        rigid: Sequence[ModelPart],
        *,
        articulate: Articulation | None = None,
        is_centred: bool = False,
        anchor: Anchorage | None = None,
        poses: Sequence[Pose] = SAMPLE_POSES,
        is_wheeled: bool = False,
    ) -> None:
        """Measure the figure.

        Args:
            rigid: parts that never move in the body.
            articulate: gives the parts that move; None = there are none.
            is_centred: whether the origin is its middle rather than the ground below it.
            anchor: places at which other things are held; None = those of its box.
            poses: what its size is measured over.
            is_wheeled: whether it rolls on wheels; what does not rolls as a whole.
        """
        self._articulate = articulate
        self._anchor = anchor
        self.is_centred = is_centred
        self.is_wheeled = is_wheeled
        self._usual_rigid, self._usual_box = list(rigid), _measure(rigid, articulate, poses)
        self._take_scale(1.0)

    def scaled(self, scale: float, articulate: Articulation | None = None) -> ArticulatedModel:
        """The body that many times its usual size, perhaps in other colours; not measured again."""
        other = copy(self)
        other._articulate = articulate or self._articulate
        other._take_scale(float(scale))
        return other

    def _take_scale(self, scale: float) -> None:
        self.scale = scale
        self._rigid = [_scaled(each, scale) for each in self._usual_rigid]
        low, high = (scale * corner for corner in self._usual_box)
        reach = np.maximum(np.abs(low), np.abs(high))
        self.length = float(2.0 * reach[0])
        self.width = float(2.0 * reach[1])
        self.height = float(2.0 * reach[2]) if self.is_centred else float(high[2])

    def parts(self, pose: Pose) -> Sequence[ModelPart]:
        """The shapes at that pose, rigid ones first."""
        if self._articulate is None:
            return list(self._rigid)
        usual = self._at_usual_size(pose)
        return [*self._rigid, *(_scaled(each, self.scale) for each in self._articulate(usual))]

    def anchor(self, name: str, pose: Pose) -> Affine | None:
        """Axes [3, 4] at a named place, m; None = this model names no places."""
        if self._anchor is None:
            return None
        axes = self._anchor(name, self._at_usual_size(pose))
        if axes is None:
            return None
        return affine(axes[:, :3], self.scale * axes[:, 3])

    def _at_usual_size(self, pose: Pose) -> Pose:
        """The same instant of a body of the usual size."""
        if self.scale == 1.0:
            return pose
        grips = tuple(
            (name, (x / self.scale, y / self.scale, z / self.scale))
            for name, (x, y, z) in pose.grips
        )
        return replace(
            pose,
            distance_m=pose.distance_m / self.scale,
            speed_m_s=pose.speed_m_s / self.scale,
            grips=grips,
        )


def _measure(
    rigid: Sequence[ModelPart], articulate: Articulation | None, poses: Sequence[Pose]
) -> tuple[Affine, Affine]:
    """Lowest and highest x, y, z that the parts reach, at the usual size, m."""
    parts = list(rigid)
    if articulate is not None:
        for pose in poses:
            parts += articulate(pose)
    return bounds(parts)


def _scaled(each: ModelPart, scale: float) -> ModelPart:
    return each if scale == 1.0 else each.at(scale * each.to_body)
