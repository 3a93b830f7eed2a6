"""Cameras at one instant: where they stand, and the image points of points in the world."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.lens import Lens, distort
from texvent.sensor import SensorSize

Float64Array = NDArray[np.float64]


@dataclass(frozen=True)
class PosedCamera:
    """A camera at one instant: a pinhole, or one with a calibrated lens."""

    position: Float64Array
    """[3] metres."""
    rotation: Float64Array
    """[3, 3]; rows are the camera's right, down and forward axes in the world."""
    focal: float
    """Focal length divided by image width: 1.0 is about 53° across. Not read where `lens` is."""
    lens: Lens | None = None
    """Calibrated projection and distortion; None: a pinhole whose axis meets the image's middle."""


class Rays(NamedTuple):
    """The ray through image point (x, y): `origin + depth · (corner + x · right + y · down)`.

    With a lens that distorts, (x, y) is where the ray meets the image that the same camera would
    have without distortion. The direction's component along the optical axis is 1, so the ray
    parameter is depth in metres.
    """

    origin: Float64Array
    """[3] camera position, metres."""
    corner: Float64Array
    """[3] direction through the image's top left corner."""
    right: Float64Array
    """[3] change of direction per pixel to the right."""
    down: Float64Array
    """[3] change of direction per pixel downwards."""


def camera_rays(camera: PosedCamera, size: SensorSize) -> Rays:
    """The rays of a camera whose image has `size` pixels; without its distortion."""
    right_axis, down_axis, forward = np.asarray(camera.rotation, dtype=np.float64)
    lens = camera.lens
    if lens is not None:
        right, down = right_axis / lens.fx, down_axis / lens.fy
        corner = forward - lens.cx * right - lens.cy * down
        return Rays(np.array(camera.position, dtype=np.float64), corner, right, down)
    step = 1.0 / (camera.focal * size.width)
    right, down = right_axis * step, down_axis * step
    corner = forward - 0.5 * size.width * right - 0.5 * size.height * down
    return Rays(np.array(camera.position, dtype=np.float64), corner, right, down)


def project(camera: PosedCamera, size: SensorSize, points: Float64Array) -> Float64Array:
    """Image points of world points.

    Args:
        camera: the camera.
        size: image size, pixels.
        points: [..., 3] metres.

    Returns:
        [..., 3]: x and y in pixels, and depth along the optical axis in metres. A point beside or
        behind the camera (depth <= 0) has no place in the image; its x and y mean nothing. Where
        the lens does not reach, x and y are NaN.
    """
    return place_in_image(camera, size, (points - camera.position) @ camera.rotation.T)


def place_in_image(camera: PosedCamera, size: SensorSize, seen: Float64Array) -> Float64Array:
    """As `project`, for points [..., 3] along the camera's own axes, m."""
    depth = seen[..., 2]
    lens = camera.lens
    if lens is not None:
        plane = seen[..., :2] / np.where(depth == 0.0, np.inf, depth)[..., None]
        place = distort(lens, plane) * [lens.fx, lens.fy] + [lens.cx, lens.cy]
        return np.concatenate([place, depth[..., None]], axis=-1)
    scale = camera.focal * size.width / np.where(depth == 0.0, np.inf, depth)
    x = seen[..., 0] * scale + 0.5 * size.width
    y = seen[..., 1] * scale + 0.5 * size.height
    return np.stack([x, y, depth], axis=-1)
