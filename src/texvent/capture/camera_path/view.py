"""View of a moved camera: its scale over the image, and one affine map per plane of equal depth."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import cv2
import numpy as np
from numpy.typing import NDArray

from texvent.capture.camera_path.motion import CameraPose2D
from texvent.errors import InputError
from texvent.sensor import SensorSize

Float64Array = NDArray[np.float64]
STEPS = 30
"""Halvings of the interval in which the scale is looked for."""
MOST_REACH = 3.0
"""The mirrored image reaches from -3 to 3 if the image reaches from -1 to 1."""


@dataclass(frozen=True)
class View:
    """A sensor over an image; both have their centres in common when the camera has not moved."""

    image: SensorSize
    """Of the image, px."""
    sensor: SensorSize
    """Of the sensor, px."""
    scale: float = 1.0
    """Px of the image per px of the sensor, when the camera has not moved."""
    reference_m: float = 1.0
    """Depth of surfaces that move by the px that a path states, m."""

    def matrix(self, place: CameraPose2D, nearness: float = 1.0) -> Float64Array:
        """Where a flat, upright surface is seen.

        Args:
            place: the camera.
            nearness: reference depth, by the depth of the surface.

        Returns:
            [3, 3] sensor px → image px, homogeneous; pixel i covers i to i + 1.
        """
        centre_x, centre_y = self.sensor.width / 2, self.sensor.height / 2
        image_x, image_y = self.image.width / 2, self.image.height / 2
        factor = self.scale / place.zoom
        cos, sin = factor * math.cos(place.roll), factor * math.sin(place.roll)
        x = self.scale * place.x * nearness + image_x - (cos * centre_x - sin * centre_y)
        y = self.scale * place.y * nearness + image_y - (sin * centre_x + cos * centre_y)
        return np.array([[cos, -sin, x], [sin, cos, y], [0.0, 0.0, 1.0]])

    def reach(self, places: Sequence[CameraPose2D], nearness: Sequence[float] = (1.0,)) -> float:
        """How far corners of the sensor come from the image's centre: 1 is its border.

        Args:
            places: instants of the path.
            nearness: of the surfaces that are looked at.

        Returns:
            The farther of both axes.
        """
        width, height = self.sensor
        corners = np.array([[0, 0, 1], [width, 0, 1], [0, height, 1], [width, height, 1]], float)
        points = np.stack([self.matrix(one, near) for one in places for near in nearness])
        points = points @ corners.T
        x = np.abs(points[:, 0] * 2 / self.image.width - 1).max()
        y = np.abs(points[:, 1] * 2 / self.image.height - 1).max()
        return float(max(x, y))


def fitted_view(
    start: View,
    places: Sequence[CameraPose2D],
    nearness: Sequence[float],
    *,
    is_pixelwise: bool,
) -> View:
    """The view whose scale keeps the sensor in the image on all its path, if it can.

    Args:
        start: the view of scale 1.
        places: instants of the path.
        nearness: of the nearest and the farthest surface.
        is_pixelwise: whether the scale must stay 1.

    Returns:
        The image covers the sensor at all these instants; but if it had to be enlarged for that,
        it covers it at rest only, enlarged no more than needed, and is mirrored at its borders.

    Raises:
        InputError: the path leads away by more than the image's size.
    """
    if is_pixelwise:
        return _checked(start, places, nearness)
    image, sensor = start.image, start.sensor
    most = min(image.width / sensor.width, image.height / sensor.height)
    low, high = 0.0, most
    if replace(start, scale=most).reach(places, nearness) <= 1:
        low = most
    for _ in range(STEPS if low < most else 0):
        middle = (low + high) / 2
        is_inside = replace(start, scale=middle).reach(places, nearness) <= 1
        low, high = (middle, high) if is_inside else (low, middle)
    view = replace(start, scale=max(low, min(1.0, most)))
    return _checked(view, places, nearness)


def _checked(view: View, places: Sequence[CameraPose2D], nearness: Sequence[float]) -> View:
    reach = view.reach(places, nearness)
    if reach > MOST_REACH:
        raise InputError(
            f"the camera path leads {reach / 2:.1f} times its size away from the image "
            f"({view.image}), which is mirrored beyond its border only once; give a shorter path, "
            "a larger image or a smaller sensor"
        )
    return view


Float32Array = NDArray[np.float32]

STEP_PX = 0.25
"""Neighbouring planes part by at most about this many px of the sensor, unless they are `MOST`."""
MOST = 64
MOST_HIDDEN = 64
"""A farther plane goes on behind a nearer one by at most this many px of the image."""
NEAR_PERCENT, FAR_PERCENT = 1.0, 99.0
"""Percentiles of depth that count as nearest and farthest."""
ALL, LATER, EARLIER = slice(None), slice(1, None), slice(None, -1)
NEIGHBOURS = (
    ((ALL, LATER), (ALL, EARLIER)),
    ((ALL, EARLIER), (ALL, LATER)),
    ((LATER, ALL), (EARLIER, ALL)),
    ((EARLIER, ALL), (LATER, ALL)),
)
"""Pixels, and their neighbours on the left, on the right, above and below."""


@dataclass(frozen=True, eq=False)
class Planes:
    """Levels of an image, each pixel in a plane parallel to the image.

    Approximate: behind a nearer plane, the farther one beside it is held.
    """

    view: View
    levels: Float32Array
    """[H, W]"""
    nearness: tuple[float, ...] = (1.0,)
    """Reference depth / depth of each plane, farthest first."""
    plane: NDArray[np.uint8] | None = None
    """[H, W] plane of each pixel; None: one plane."""
    hidden_px: int = 0
    """Px by which farther planes go on behind nearer ones."""
    step: float = 0.0
    """Planes whose nearness differs by at most this are of one surface, without gaps."""

    def render(self, place: CameraPose2D) -> tuple[Float32Array, NDArray[np.uint8]]:
        """Levels and planes that the camera sees, [h, w]; the image is mirrored at its border."""
        levels = self._warp(self.levels, place, 0)
        seen = np.zeros(levels.shape, np.uint8)
        if self.plane is None:
            return levels, seen
        near, (behind, behind_levels) = self.nearness, self._behind
        for index in range(len(self.nearness)):
            following = index + 1 < len(near) and near[index + 1] - near[index] <= self.step
            is_own = (self.plane == index) | (following & (self.plane == index + 1))
            mask = (is_own | (behind == index)).astype(np.float32)
            content = np.where(is_own, self.levels, behind_levels)
            both = self._warp(cv2.merge([mask * content, mask]), place, index)
            levels *= 1 - both[..., 1]
            levels += both[..., 0]
            seen[both[..., 1] > 0.5] = index
        return levels, seen

    def depth(self, seen: NDArray[np.uint8]) -> Float32Array:
        """Depth of the planes that the camera sees, [h, w] m."""
        with np.errstate(divide="ignore"):
            metres = self.view.reference_m / np.array(self.nearness)
        return np.asarray(metres[seen], np.float32)

    def vectors(
        self, now: CameraPose2D, other: CameraPose2D, seen: NDArray[np.uint8]
    ) -> Float32Array:
        """[h, w, 2] from each pixel's centre to its place in the other view, px."""
        result = np.empty((*seen.shape, 2), np.float32)
        for index, near in enumerate(self.nearness):
            of_plane = seen == index
            points = _centres(of_plane)
            to_other = np.linalg.solve(self.view.matrix(other, near), self.view.matrix(now, near))
            result[of_plane] = (points @ to_other.T - points)[:, :2]
        return result

    def _warp(self, image: Float32Array, place: CameraPose2D, index: int) -> Float32Array:
        """The image as seen in one plane: means over the area of each sensor pixel."""
        fineness = max(1, round(self.view.scale / place.zoom))
        size = self.view.sensor.width * fineness, self.view.sensor.height * fineness
        # OpenCV counts from the centres of pixels, these maps from their corners.
        to_sensor = np.array([[1, 0, 0.5], [0, 1, 0.5], [0, 0, fineness]]) / fineness
        to_image = self.view.matrix(place, self.nearness[index]) @ to_sensor
        to_image[:2] -= 0.5 * to_image[2]
        flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
        fine = cv2.warpPerspective(
            image, to_image, size, flags=flags, borderMode=cv2.BORDER_REFLECT
        )
        if fineness == 1:
            return np.asarray(fine, np.float32)
        whole = (self.view.sensor.width, self.view.sensor.height)
        return np.asarray(cv2.resize(fine, whole, interpolation=cv2.INTER_AREA), np.float32)

    @cached_property
    def _behind(self) -> tuple[NDArray[np.int16], Float32Array]:
        """Plane and level hidden behind each pixel: those of the next pixel of a farther plane.

        Planes are -1 where no farther one is near.
        """
        near = np.array(self.nearness)
        farther = np.asarray(self.plane, np.int16)
        least = near[farther] - self.step
        levels, is_open = self.levels.copy(), np.ones(farther.shape, np.bool_)
        for _ in range(min(self.hidden_px, MOST_HIDDEN)):
            before, level_before = farther.copy(), levels.copy()
            for to, of in NEIGHBOURS:
                is_farther = is_open[to] & (near[before[of]] < least[to])
                farther[to] = np.where(is_farther, before[of], farther[to])
                levels[to] = np.where(is_farther, level_before[of], levels[to])
                is_open[to] &= ~is_farther
        return np.where(is_open, np.int16(-1), farther), levels


def split_planes(
    view: View, levels: Float32Array, depth: Float32Array, places: Sequence[CameraPose2D]
) -> Planes:
    """Planes of an image with depth, as many as a camera path parts.

    Args:
        view: the sensor over the image.
        levels: [H, W].
        depth: [H, W] m, inf where there is no surface.
        places: instants of the path.
    """
    near = (view.reference_m / depth).astype(np.float64)
    least, most = (view.reference_m / one for one in depth_range(depth)[::-1])
    parted = _parting_px(view, places, (most, least))
    hidden = _parting_px(view, places, (most, 0.0)) if np.isinf(depth).any() else parted
    count = int(np.clip(np.ceil(parted / STEP_PX), 1, MOST - 1))
    share = (np.clip(near, least, most) - least) / max(most - least, 1e-12)
    plane = np.minimum((share * count).astype(np.int64), count - 1) + 1
    plane[np.isinf(depth)] = 0  # no surface
    step = 2 * (most - least) / count
    _, plane = np.unique(plane, return_inverse=True)
    plane = plane.reshape(depth.shape)
    clipped = np.where(np.isinf(depth), 0.0, np.clip(near, least, most))
    sums = np.bincount(plane.ravel(), weights=clipped.ravel())
    nearness = tuple((sums / np.bincount(plane.ravel())).tolist())
    if len(nearness) == 1:
        return Planes(view, levels, nearness)
    return Planes(view, levels, nearness, plane.astype(np.uint8), int(np.ceil(hidden)) + 2, step)


def depth_range(depth: Float32Array) -> tuple[float, float]:
    """Nearest and farthest depth of surfaces, outliers left out, m; inf if there is no surface."""
    seen = depth[np.isfinite(depth)]
    if not seen.size:
        return np.inf, np.inf
    near, far = np.percentile(seen, (NEAR_PERCENT, FAR_PERCENT))
    return float(near), float(far)


def _parting_px(view: View, places: Sequence[CameraPose2D], nearness: Sequence[float]) -> float:
    """Px of the image by which surfaces of two depths part at most, at the view's centre."""
    centre = np.array([view.sensor.width / 2, view.sensor.height / 2, 1.0])
    parted = 0.0
    for place in places:
        near, far = (view.matrix(place, one) @ centre for one in nearness)
        parted = max(parted, float(np.hypot(*(near - far)[:2])))
    return parted


def _centres(chosen: NDArray[np.bool_]) -> Float64Array:
    """[n, 3] centres of the chosen pixels, homogeneous."""
    if chosen.all():  # without a search: most images are one plane
        rows, columns = (one.ravel() for one in np.indices(chosen.shape))
    else:
        rows, columns = np.nonzero(chosen)
    return np.stack([columns + 0.5, rows + 0.5, np.ones(len(rows))], axis=1)
