"""An image as planes of equal depth, and the view of a moved camera: one homography per plane."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import cv2
import numpy as np
from numpy.typing import NDArray

from texvent.capture.camera_path.motion import CameraPose, Pose
from texvent.capture.camera_path.view import View

Float32Array = NDArray[np.float32]
Float64Array = NDArray[np.float64]

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

    def render(self, place: CameraPose) -> tuple[Float32Array, NDArray[np.uint8]]:
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

    def depth(self, place: CameraPose, seen: NDArray[np.uint8]) -> Float32Array:
        """Depth along the camera's axis of the planes that it sees, [h, w] m."""
        with np.errstate(divide="ignore"):
            metres = self.view.reference_m / np.array(self.nearness)
        depth = metres[seen]
        if isinstance(place, Pose):
            for index, near in enumerate(self.nearness):
                of_plane = seen == index
                share = self.view.share_ahead(place, near, _centres(of_plane))
                depth[of_plane] *= share
        return depth.astype(np.float32)

    def vectors(self, now: CameraPose, other: CameraPose, seen: NDArray[np.uint8]) -> Float32Array:
        """[h, w, 2] from each pixel's centre to its place in the other view, px."""
        result = np.empty((*seen.shape, 2), np.float32)
        for index, near in enumerate(self.nearness):
            of_plane = seen == index
            points = _centres(of_plane)
            to_other = np.linalg.solve(
                self.view.homography(other, near), self.view.homography(now, near)
            )
            moved = points @ to_other.T
            result[of_plane] = moved[:, :2] / moved[:, 2:] - points[:, :2]
        return result

    def _warp(self, image: Float32Array, place: CameraPose, index: int) -> Float32Array:
        """The image as seen in one plane: means over the area of each sensor pixel."""
        fineness = max(1, round(self.view.scale / getattr(place, "zoom", 1.0)))
        size = self.view.sensor.width * fineness, self.view.sensor.height * fineness
        # OpenCV counts from the centres of pixels, homographies from their corners.
        to_sensor = np.array([[1, 0, 0.5], [0, 1, 0.5], [0, 0, fineness]]) / fineness
        to_image = self.view.homography(place, self.nearness[index]) @ to_sensor
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
    view: View, levels: Float32Array, depth: Float32Array, places: Sequence[CameraPose]
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


def _parting_px(view: View, places: Sequence[CameraPose], nearness: Sequence[float]) -> float:
    """Px of the image by which surfaces of two depths part at most, at the view's centre."""
    centre = np.array([view.sensor.width / 2, view.sensor.height / 2, 1.0])
    parted = 0.0
    for place in places:
        near, far = (view.matrix(place, one) @ centre for one in nearness)
        parted = max(parted, float(np.hypot(*(near[:2] / near[2] - far[:2] / far[2]))))
    return parted


def _centres(chosen: NDArray[np.bool_]) -> Float64Array:
    """[n, 3] centres of the chosen pixels, homogeneous."""
    if chosen.all():  # without a search: most images are one plane
        rows, columns = (one.ravel() for one in np.indices(chosen.shape))
    else:
        rows, columns = np.nonzero(chosen)
    return np.stack([columns + 0.5, rows + 0.5, np.ones(len(rows))], axis=1)
