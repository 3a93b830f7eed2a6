"""Where the pixels of a sensor lie in an image: its scale, and the camera's place."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from texvent.capture.camera_path.motion import CameraPose, CameraPose2D, Pose
from texvent.errors import InputError
from texvent.sensor import SensorSize

Float64Array = NDArray[np.float64]
STEPS = 30
"""Halvings of the interval in which the scale is looked for."""
NEAREST = 1e-3
"""Least distance to a plane, by the distance that it had."""
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
    focal_px: float | None = None
    """Focal length in px of the image; only poses need it."""
    reference_m: float = 1.0
    """Depth of surfaces that move by the px that a path states, m."""

    def matrix(self, place: CameraPose, nearness: float = 1.0) -> Float64Array:
        """Where a flat, upright surface is seen.

        Args:
            place: the camera.
            nearness: reference depth, by the depth of the surface.

        Returns:
            [3, 3] sensor px → image px, homogeneous; pixel i covers i to i + 1.
        """
        centre_x, centre_y = self.sensor.width / 2, self.sensor.height / 2
        image_x, image_y = self.image.width / 2, self.image.height / 2
        if isinstance(place, CameraPose2D):
            factor = self.scale / place.zoom
            cos, sin = factor * math.cos(place.roll), factor * math.sin(place.roll)
            x = self.scale * place.x * nearness + image_x - (cos * centre_x - sin * centre_y)
            y = self.scale * place.y * nearness + image_y - (sin * centre_x + cos * centre_y)
            return np.array([[cos, -sin, x], [sin, cos, y], [0.0, 0.0, 1.0]])
        to_first = place.rotation + np.outer(place.position, (0, 0, nearness / self.reference_m))
        return np.asarray(self._to_image() @ to_first @ self._to_rays())

    def homography(self, place: CameraPose, nearness: float = 1.0) -> Float64Array:
        """View of a plane of the image that stays where it was when the image was taken.

        Returns:
            [3, 3] as `matrix`, which puts the plane that far in front of a moved camera instead.
        """
        if isinstance(place, CameraPose2D):
            return self.matrix(place, nearness)
        shift = place.position * (nearness / self.reference_m)
        ahead = max(1 - shift[2], NEAREST)  # a plane that the camera has passed stays in front
        to_first = place.rotation + np.outer(shift, place.rotation[2]) / ahead
        return np.asarray(self._to_image() @ to_first @ self._to_rays())

    def share_ahead(self, place: Pose, nearness: float, points: Float64Array) -> Float64Array:
        """Depth along a moved camera's axis by the depth that a plane had, [n].

        Args:
            place: the camera.
            nearness: of the plane.
            points: [n, 3] px of the sensor, homogeneous.
        """
        image = points @ self.homography(place, nearness).T
        rays = image / image[:, 2:] @ np.linalg.inv(self._to_image()).T
        return np.asarray(
            (rays - place.position * (nearness / self.reference_m)) @ place.rotation[:, 2]
        )

    def _to_rays(self) -> Float64Array:
        """Sensor px → rays in the camera's axes."""
        step = self.scale / float(self.focal_px or 1.0)
        x, y = self.sensor.width / 2, self.sensor.height / 2
        return np.array([[step, 0.0, -step * x], [0.0, step, -step * y], [0.0, 0.0, 1.0]])

    def _to_image(self) -> Float64Array:
        """Rays in the first camera's axes → image px."""
        focal = float(self.focal_px or 1.0)
        x, y = self.image.width / 2, self.image.height / 2
        return np.array([[focal, 0.0, x], [0.0, focal, y], [0.0, 0.0, 1.0]])

    def reach(self, places: Sequence[CameraPose], nearness: Sequence[float] = (1.0,)) -> float:
        """How far corners of the sensor come from the image's centre: 1 is its border.

        Args:
            places: instants of the path.
            nearness: of the surfaces that are looked at.

        Returns:
            The farther of both axes; inf where a corner looks to the side or backward.
        """
        width, height = self.sensor
        corners = np.array([[0, 0, 1], [width, 0, 1], [0, height, 1], [width, height, 1]], float)
        points = np.stack([self.matrix(one, near) for one in places for near in nearness])
        points = points @ corners.T
        depth = points[:, 2]
        if not (depth > 0).all():
            return math.inf
        x = np.abs(points[:, 0] / depth * 2 / self.image.width - 1).max()
        y = np.abs(points[:, 1] / depth * 2 / self.image.height - 1).max()
        return float(max(x, y))


def fitted_view(
    start: View,
    places: Sequence[CameraPose],
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


def _checked(view: View, places: Sequence[CameraPose], nearness: Sequence[float]) -> View:
    reach = view.reach(places, nearness)
    if reach > MOST_REACH:
        far = "to its side or behind it" if math.isinf(reach) else f"{reach / 2:.1f} times its size"
        raise InputError(
            f"the camera path leads {far} away from the image ({view.image}), which is mirrored "
            "beyond its border only once; give a shorter path, a larger image or a smaller sensor"
        )
    return view
