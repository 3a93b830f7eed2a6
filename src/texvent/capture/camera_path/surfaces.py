"""An image with depth as pieces of surface, and what a moved camera sees of them."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from texvent.capture.camera_path.motion import Place, Pose
from texvent.capture.camera_path.view import View

Float64Array = NDArray[np.float64]

ONE_SURFACE = 0.05
"""Neighbours whose depths differ by at most this share are of one surface."""
MOST_HIDDEN = 64
"""Farther surfaces go on behind nearer ones by at most this many px."""


@dataclass(frozen=True, eq=False)
class Surfaces:
    """A piece for each pixel, and pieces of farther surfaces that go on behind nearer ones.

    Approximate: what is behind a nearer surface is what is seen at its edge, held; pieces are
    upright rectangles, also where the camera turns about its axis.
    """

    view: View
    levels: NDArray[np.float32]
    """[H, W]"""
    depth: Float64Array
    """[H, W] m, above 0; inf where there is no surface."""
    margin: int = 0
    """Px by which the image is mirrored beyond its borders."""
    hidden_px: int = 0
    """Px by which farther surfaces go on behind nearer ones."""
    _layers: tuple[_Layer, ...] = field(init=False, repr=False)
    _order: NDArray[np.int64] = field(init=False, repr=False)
    """Places of all pieces, nearest first, when the camera has not moved."""

    def __post_init__(self) -> None:
        pad = (self.margin, self.margin)
        levels = np.pad(self.levels, pad, mode="symmetric").astype(np.float64)
        depth = np.pad(self.depth, pad, mode="symmetric")
        whole = np.ones(depth.shape, np.bool_)
        front = _Layer(levels, depth, whole)
        behind = _behind(levels, depth, min(self.hidden_px, MOST_HIDDEN))
        layers = (front, behind) if behind.kept.any() else (front,)
        object.__setattr__(self, "_layers", layers)
        order = np.argsort(np.concatenate([one.depth[one.kept] for one in layers]), kind="stable")
        object.__setattr__(self, "_order", order)

    def pieces(self, place: Place | Pose) -> Float64Array:
        """[n, 6] as `draw_pieces` takes them, nearest first."""
        pieces = np.concatenate([self._of_layer(layer, place) for layer in self._layers])
        if isinstance(place, Place):  # such a camera changes no depth
            return pieces[self._order]
        return pieces[np.argsort(pieces[:, 5], kind="stable")]

    def project(
        self, points: Float64Array, depth: Float64Array, place: Place | Pose
    ) -> tuple[Float64Array, Float64Array]:
        """Where points of the image are seen.

        Args:
            points: [..., 2] px of the image, without margin.
            depth: [...] m.
            place: the camera.

        Returns:
            [..., 2] px of the sensor, and [...] depth along its optical axis.
        """
        view = self.view
        middle = np.array([view.image.width, view.image.height]) / 2
        centre = np.array([view.sensor.width, view.sensor.height]) / 2
        if isinstance(place, Place):
            near = (points - middle) / view.scale
            near = near - np.array([place.x, place.y]) * (self.view.reference_m / depth)[..., None]
            return centre + place.zoom * near @ _turn(place.roll), depth
        focal = float(view.focal_px or 1.0)
        rays = np.concatenate([(points - middle) / focal, np.ones((*depth.shape, 1))], axis=-1)
        seen = (rays - place.position / depth[..., None]) @ place.rotation
        ahead = np.where(seen[..., 2] > NEAREST, seen[..., 2], np.nan)
        shown = centre + seen[..., :2] / ahead[..., None] * (focal / view.scale)
        return shown, depth * ahead

    def unproject(
        self, points: Float64Array, depth: Float64Array, place: Place | Pose
    ) -> tuple[Float64Array, Float64Array]:
        """Points of the image, and their depth there, that are seen at px of the sensor."""
        view = self.view
        middle = np.array([view.image.width, view.image.height]) / 2
        centre = np.array([view.sensor.width, view.sensor.height]) / 2
        if isinstance(place, Place):
            near = (points - centre) / place.zoom @ _turn(place.roll).T
            near = near + np.array([place.x, place.y]) * (self.view.reference_m / depth)[..., None]
            return middle + near * view.scale, depth
        focal = float(view.focal_px or 1.0)
        rays = (points - centre) * (view.scale / focal)
        rays = np.concatenate([rays, np.ones((*depth.shape, 1))], axis=-1)
        first = rays @ place.rotation.T + place.position / depth[..., None]
        return middle + first[..., :2] / first[..., 2:] * focal, depth * first[..., 2]

    def _of_layer(self, layer: _Layer, place: Place | Pose) -> Float64Array:
        rows, columns = layer.depth.shape
        x = np.arange(columns) + (0.5 - self.margin)
        y = np.arange(rows) + (0.5 - self.margin)
        points = np.stack(np.meshgrid(x, y), axis=-1)
        shown, depth = self.project(points, layer.depth, place)
        with np.errstate(invalid="ignore"):
            growth = np.where(np.isinf(layer.depth), 1.0, layer.depth / depth)
        zoom = place.zoom if isinstance(place, Place) else 1.0
        half = growth * (0.5 * zoom / self.view.scale)
        left, right = _edges(shown[..., 0], half, layer.joined_x)
        top, bottom = (one.T for one in _edges(shown[..., 1].T, half.T, layer.joined_y.T))
        columns = left, right, top, bottom, layer.levels, depth
        pieces = np.stack([one[layer.kept] for one in columns], axis=-1)
        if isinstance(place, Pose):
            pieces = pieces[~np.isnan(pieces[:, :4]).any(axis=1)]
        return np.asarray(pieces)


ALL, LATER, EARLIER = slice(None), slice(1, None), slice(None, -1)
NEIGHBOURS = (
    ((ALL, LATER), (ALL, EARLIER)),
    ((ALL, EARLIER), (ALL, LATER)),
    ((LATER, ALL), (EARLIER, ALL)),
    ((EARLIER, ALL), (LATER, ALL)),
)
"""Pixels, and their neighbours on the left, on the right, above and below."""
NEAREST = 1e-3
"""What comes nearer than this share of its first depth is behind the camera, or as good as."""


@dataclass(frozen=True, eq=False)
class _Layer:
    """Pieces on the grid of the image's pixels."""

    levels: Float64Array
    depth: Float64Array
    kept: NDArray[np.bool_]

    @cached_property
    def joined_x(self) -> NDArray[np.bool_]:
        """[H, W - 1] whether a piece and its right neighbour are of one surface."""
        return _near(self.depth[:, 1:], self.depth[:, :-1]) & self.kept[:, 1:] & self.kept[:, :-1]

    @cached_property
    def joined_y(self) -> NDArray[np.bool_]:
        """[H - 1, W] the same for the neighbour below."""
        return _near(self.depth[1:], self.depth[:-1]) & self.kept[1:] & self.kept[:-1]


def _near(one: Float64Array, other: Float64Array) -> NDArray[np.bool_]:
    same = (one == other) | (np.maximum(one, other) <= np.minimum(one, other) * (1 + ONE_SURFACE))
    return np.asarray(same)


def _edges(
    centre: Float64Array, half: Float64Array, joined: NDArray[np.bool_]
) -> tuple[Float64Array, Float64Array]:
    """Left and right ends of pieces, which reach to the middle of neighbours of their surface."""
    left, right = centre - half, centre + half
    middle = (centre[:, 1:] + centre[:, :-1]) / 2
    right[:, :-1] = np.where(joined, middle, right[:, :-1])
    left[:, 1:] = np.where(joined, middle, left[:, 1:])
    return left, right


def _behind(levels: Float64Array, depth: Float64Array, reach: int) -> _Layer:
    """What goes on behind nearer surfaces: the next farther one in the row, else in the column."""
    levels, far = levels.copy(), depth.copy()
    is_open = np.ones(depth.shape, np.bool_)
    for _ in range(reach):
        before, level_before = far.copy(), levels.copy()
        for to, of in NEIGHBOURS:
            is_farther = is_open[to] & (before[of] > depth[to] * (1 + ONE_SURFACE))
            far[to] = np.where(is_farther, before[of], far[to])
            levels[to] = np.where(is_farther, level_before[of], levels[to])
            is_open[to] &= ~is_farther
    return _Layer(levels, far, ~is_open)


def _turn(roll: float) -> Float64Array:
    """Row vectors times this are turned by -roll."""
    cos, sin = math.cos(roll), math.sin(roll)
    return np.array([[cos, -sin], [sin, cos]])
