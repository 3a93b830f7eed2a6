"""Points on the surface of a body, and where hands reach it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.scene import Float64Array, Shape
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.body_boxes import own_parts

_BAND_M = 0.14
"""Half of the width of the strip before the worker in which a spot is looked for."""
_BIN_M = 0.04
_COARSE_M = 2.0
"""Length of a thing from which on the points of its faces are farther apart than bins, m."""
_GAP_BINS = 2
"""Bins to either side between which points of a large face may lie."""
_INSET_M = 0.16
"""How far from its near edge a level surface is worked on."""
_DEEPEST_M = 0.24
"""How far beyond what is nearest the spot lies: a muzzle keeps the worker off."""
_EDGE_SHARE = 0.6
"""Share of a thing's height that its top has at least."""
_BELOW_TOP_M = 0.14
"""How far below its top a low upright thing is worked on, m."""
_CHEST_M = 1.22
"""Height at which an upright surface is worked on, for an adult."""
_OVERHEAD_M = 1.32
"""What is level up to this height is worked on from above, for an adult."""


@dataclass(frozen=True)
class Surface:
    """Points of a body's surface in the world."""

    points: Float64Array
    """[n, 3] m."""

    def joined(self, other: Surface) -> Surface:
        """The points of both."""
        return Surface(np.vstack([self.points, other.points]))

    def gap(self, places: Float64Array) -> float:
        """Least distance between any of the places [k, 3] and the points, m."""
        apart = self.points[None] - places[:, None]
        return float(np.sqrt((apart**2).sum(axis=2).min()))

    def nearest(self, facing: float, spot: Float64Array, size: float) -> float:
        """How far the body comes out towards the worker before the spot, below the head, m."""
        heading = np.array([math.cos(facing), math.sin(facing)])
        across = np.array([-heading[1], heading[0]])
        ways = self.points[:, :2] - spot[:2]
        low = (np.abs(ways @ across) < 0.22 * size) & (self.points[:, 2] < 1.35 * size)
        return float(max(-(ways[low] @ heading).min(), 0.0)) if low.any() else 0.0

    def half_at(self, spot: Float64Array, facing: float) -> float:
        """Half of the width across a facing direction about a spot's height, m."""
        across = np.array([-math.sin(facing), math.cos(facing)])
        near = self.points[np.abs(self.points[:, 2] - spot[2]) < 0.15]
        if len(near) < 2:
            near = self.points
        return 0.5 * float(np.ptp(near[:, :2] @ across))

    def find_spot(
        self, facing: float, middle: tuple[float, float], size: float, *, is_front: bool
    ) -> tuple[Float64Array, bool]:
        """Where hands reach the body first.

        Args:
            facing: heading of who reaches, rad.
            middle: ground point [2] that is faced.
            size: of who reaches, relative to an adult.
            is_front: whether an upright face is wanted.

        Returns:
            The point [3], and whether the surface there is upright.
        """
        heading = np.array([math.cos(facing), math.sin(facing)])
        across = np.array([-heading[1], heading[0]])
        sideways = np.abs((self.points[:, :2] - np.array(middle)) @ across)
        inside = sideways < max(_BAND_M, float(sideways.min()) + 0.05)
        points = self.points[inside]
        ahead = points[:, :2] @ heading
        top = float(points[:, 2].max())
        bins = np.floor((ahead - ahead.min()) / _BIN_M).astype(int)
        heights = np.full(bins.max() + 1, -np.inf)
        np.maximum.at(heights, bins, points[:, 2])
        if np.ptp(self.points[:, :2] @ heading) > _COARSE_M:
            heights = _without_gaps(heights)
        low_top = min(top, _OVERHEAD_M * size)
        edge = int(np.argmax(heights >= _EDGE_SHARE * low_top))
        later = heights[edge : edge + max(int(_INSET_M / _BIN_M), 1)]
        height = float(later[np.isfinite(later)][-1])
        if not is_front and height < _OVERHEAD_M * size:
            inset = min(_INSET_M, 0.5 * float(ahead.max() - ahead.min()))
            inset = max(min(inset, _DEEPEST_M * size - edge * _BIN_M), 0.0)
            along = float(ahead.min()) + edge * _BIN_M + inset
            number = min(edge + int(inset / _BIN_M), len(heights) - 1)
            height = heights[number] if np.isfinite(heights[number]) else height
            return self._at(along, heading, across, middle, float(height)), False
        chest = min(_CHEST_M * size, max(0.75 * top, top - _BELOW_TOP_M))
        level = points[np.abs(points[:, 2] - chest) < 0.10]
        near = level if len(level) else points
        along = float((near[:, :2] @ heading).min())
        return self._at(along, heading, across, middle, chest), True

    @staticmethod
    def _at(
        along: float, heading: Float64Array, across: Float64Array, middle: tuple[float, float],
        height: float,
    ) -> Float64Array:  # fmt: skip
        ground = along * heading + float(np.array(middle) @ across) * across
        return np.array([ground[0], ground[1], height])


def _without_gaps(heights: Float64Array) -> Float64Array:
    """Heights over bins; what lies between two higher ones nearby lacks points of the top."""
    reach = 2 * _GAP_BINS + 1
    padded = np.pad(heights, _GAP_BINS, constant_values=-np.inf)
    most = np.lib.stride_tricks.sliding_window_view(padded, reach).max(axis=1)
    padded = np.pad(most, _GAP_BINS, constant_values=np.inf)
    return np.asarray(np.lib.stride_tricks.sliding_window_view(padded, reach).min(axis=1))


def sample_surface(actor: Actor, time_s: float) -> Surface:
    """Points on all parts of an actor, about 3 cm apart on what is near hands' size."""
    to_world = actor.trajectory.at(time_s).to_world()
    clouds = []
    for part in own_parts(actor, time_s):
        local = _unit_points(part)
        body = local @ part.to_body[:, :3].T + part.to_body[:, 3]
        clouds.append(body @ to_world[:, :3].T + to_world[:, 3])
    return Surface(np.vstack(clouds))


def _unit_points(part: ModelPart) -> Float64Array:
    """[n, 3] points on a unit shape, denser along its longer axes."""
    extents = 2.0 * np.linalg.norm(part.to_body[:, :3], axis=0)
    counts = np.clip(np.ceil(extents / 0.05), 3, 40).astype(int)
    if part.mesh is not None:
        return np.asarray(part.mesh.vertices, dtype=np.float64)
    if part.shape is Shape.BOX:
        return _box_points(counts)
    angles = np.linspace(0.0, 2.0 * math.pi, max(12, int(counts[:2].max()) * 2), endpoint=False)
    levels = np.linspace(-1.0, 1.0, max(5, int(counts[2])))
    angle, level = (axis.ravel() for axis in np.meshgrid(angles, levels))
    if part.shape is Shape.ELLIPSOID:
        radius = np.sqrt(np.maximum(1.0 - level**2, 0.0))
    elif part.shape is Shape.CONE:
        radius = 0.5 * (1.0 - level)
    else:
        radius = np.ones_like(level)
    side = np.stack([radius * np.cos(angle), radius * np.sin(angle), level], axis=1)
    if part.shape is Shape.ELLIPSOID:
        return side
    discs = [
        np.stack([r * np.cos(angles), r * np.sin(angles), np.full_like(angles, z)], axis=1)
        for z in (-1.0, 1.0) for r in np.linspace(0.0, 1.0, max(3, int(counts[:2].max()) // 2))
    ]  # fmt: skip
    return np.vstack([side, *discs])


def _box_points(counts: Float64Array) -> Float64Array:
    faces = []
    for axis in range(3):
        others = [k for k in range(3) if k != axis]
        grid = np.meshgrid(*(np.linspace(-1.0, 1.0, int(counts[k])) for k in others))
        flat = [value.ravel() for value in grid]
        for sign in (-1.0, 1.0):
            face = np.zeros((len(flat[0]), 3))
            face[:, axis] = sign
            for k, values in zip(others, flat, strict=True):
                face[:, k] = values
            faces.append(face)
    return np.vstack(faces)
