"""Frames of a moving camera on a still image, and any instant between them.

A view is the scale of the sensor over the image, and the image as the moved sensor sees it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from texvent.capture.camera_path.motion import CameraPath, CameraPose2D
from texvent.capture.frame_source import FrameSource
from texvent.errors import InputError
from texvent.frames import Frame, MotionVectors, frame_time_us, transfer_of
from texvent.sensor import SensorSize
from texvent.transfer import WHITE, encode_srgb

Float32Array = NDArray[np.float32]
Float64Array = NDArray[np.float64]
STEPS = 30
"""Halvings of the interval in which the scale is looked for."""
MOST_REACH = 3.0
"""The mirrored image reaches from -3 to 3 if the image reaches from -1 to 1."""


@dataclass(frozen=True)
class SensorView:
    """A sensor over an image; both have their centres in common when the camera has not moved."""

    image: SensorSize
    """Size of the image, px."""
    sensor: SensorSize
    """Size of the sensor, px."""
    scale: float = 1.0
    """Px of the image per px of the sensor, when the camera has not moved."""

    def matrix(self, place: CameraPose2D) -> Float64Array:
        """Affine map [3, 3] of sensor px to image px, homogeneous; pixel i covers i to i + 1."""
        centre_x, centre_y = self.sensor.width / 2, self.sensor.height / 2
        image_x, image_y = self.image.width / 2, self.image.height / 2
        x = self.scale * place.x + image_x - self.scale * centre_x
        y = self.scale * place.y + image_y - self.scale * centre_y
        return np.array([[self.scale, 0.0, x], [0.0, self.scale, y], [0.0, 0.0, 1.0]])

    def reach(self, places: Sequence[CameraPose2D]) -> float:
        """Distance of the sensor's farthest corner from the image's centre: 1 is its border."""
        width, height = self.sensor
        corners = np.array([[0, 0, 1], [width, 0, 1], [0, height, 1], [width, height, 1]], float)
        points = np.stack([self.matrix(one) for one in places]) @ corners.T
        x = np.abs(points[:, 0] * 2 / self.image.width - 1).max()
        y = np.abs(points[:, 1] * 2 / self.image.height - 1).max()
        return float(max(x, y))

    def render(self, levels: Float32Array, place: CameraPose2D) -> Float32Array:
        """The image as the camera sees it: means over the area of each sensor pixel.

        Args:
            levels: [H, W] of the image, which is mirrored at its border.
            place: the camera.

        Returns:
            [h, w] of the sensor.
        """
        fineness = max(1, round(self.scale))
        size = self.sensor.width * fineness, self.sensor.height * fineness
        # OpenCV counts from the centres of pixels, this map from their corners.
        to_sensor = np.array([[1, 0, 0.5], [0, 1, 0.5], [0, 0, fineness]]) / fineness
        to_image = self.matrix(place) @ to_sensor
        to_image[:2] -= 0.5 * to_image[2]
        flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
        border = cv2.BORDER_REFLECT
        fine = cv2.warpPerspective(levels, to_image, size, flags=flags, borderMode=border)
        if fineness > 1:
            fine = cv2.resize(fine, tuple(self.sensor), interpolation=cv2.INTER_AREA)
        return np.asarray(fine, np.float32)

    def vectors(self, now: CameraPose2D, other: CameraPose2D) -> Float32Array:
        """[h, w, 2] from each pixel's centre to its place in the other view, px."""
        moved = np.array([now.x - other.x, now.y - other.y], np.float32)
        return np.broadcast_to(moved, (*self.sensor.shape, 2)).copy()


def fitted_view(
    start: SensorView, places: Sequence[CameraPose2D], *, is_pixelwise: bool
) -> SensorView:
    """The view whose scale keeps the sensor in the image on all its path, if it can.

    Returns:
        The image covers the sensor at all these instants; but if it had to be enlarged for that,
        it covers it at rest only, enlarged no more than needed, and is mirrored at its borders.

    Raises:
        InputError: the path leads away by more than the image's size.
    """
    view = start
    if not is_pixelwise:
        image, sensor = start.image, start.sensor
        most = min(image.width / sensor.width, image.height / sensor.height)
        low, high = 0.0, most
        if replace(start, scale=most).reach(places) <= 1:
            low = most
        for _ in range(STEPS if low < most else 0):
            middle = (low + high) / 2
            is_inside = replace(start, scale=middle).reach(places) <= 1
            low, high = (middle, high) if is_inside else (low, middle)
        view = replace(start, scale=max(low, min(1.0, most)))
    reach = view.reach(places)
    if reach > MOST_REACH:
        raise InputError(
            f"the camera path leads {reach / 2:.1f} times its size away from the image "
            f"({view.image}), which is mirrored beyond its border only once; give a shorter path, "
            "a larger image or a smaller sensor"
        )
    return view


INSTANTS = 300
"""Instants of a path that are looked at to find the scale."""
PX_ALONG = 3
"""A larger image is averaged in whole blocks first, to about this many px along a sensor px."""


class PhotoFrames(FrameSource):
    """A `RenderableStream` of an image under a camera path; its frames carry exact motion.

    Args:
        levels: [H, W] luma of the image, 0..255 scale.
        path: of the camera.
        fps: frames per second.
        intervals: frame intervals; there is one frame more.
        sensor: size of the frames; None: the image's own, pixel by pixel.
        facts: where the image comes from.

    Raises:
        InputError: the path leads too far away from the image.
    """

    def __init__(
        self,
        levels: NDArray[np.float32],
        path: CameraPath,
        fps: Fraction,
        intervals: int,
        sensor: SensorSize | None,
        facts: Mapping[str, Any],
    ) -> None:
        self._arguments = levels, path, fps, intervals, sensor, facts
        self._path, self._fps, self._count = path, fps, intervals + 1
        image = SensorSize(levels.shape[1], levels.shape[0])
        times = np.linspace(0, frame_time_us(intervals, fps, 0), INSTANTS)
        places = [path(float(t_us)) for t_us in times]
        view = fitted_view(SensorView(image, sensor or image), places, is_pixelwise=sensor is None)
        wanted = max(1, round(view.scale / PX_ALONG))
        self._image, self.view, block = _averaged(levels, view, wanted)
        scale = round(block * self.view.scale, 6)
        metadata = {**facts, **path.facts, "image_px_per_px": scale}
        super().__init__(self.view.sensor, fps, intervals + 1, metadata)

    def __iter__(self) -> Iterator[Frame]:
        """Frames in time order, with motion to their neighbours."""
        for index in range(self._count):
            t_us = self._time(index)
            place = self._path(t_us)
            levels = self.view.render(self._image, place)
            motion = self._motion(index, place)
            yield Frame(levels, t_us, motion=motion, transfer=transfer_of(self))

    def at(self, t_us: int) -> Frame:
        """The frame at `t_us`, [H, W] float32 luma on the 0..255 scale."""
        levels = self.view.render(self._image, self._path(t_us))
        return Frame(levels, t_us, is_source=False, transfer=transfer_of(self))

    def gamma_coded(self) -> PhotoFrames:
        """The same camera over the image as gamma-coded levels, where it is linear light."""
        levels, path, fps, intervals, sensor, facts = self._arguments
        levels = encode_srgb(levels / np.float32(WHITE))
        facts = {name: one for name, one in facts.items() if name != "transfer"}
        return PhotoFrames(levels, path, fps, intervals, sensor, facts)

    def _time(self, index: int) -> int:
        return frame_time_us(index, self._fps, 0)

    def _motion(self, index: int, place: CameraPose2D) -> MotionVectors:
        forward, backward = (
            self.view.vectors(place, self._path(self._time(other)))
            if 0 <= other < self._count
            else None
            for other in (index + 1, index - 1)
        )
        return MotionVectors(forward, backward)


def _averaged(
    levels: NDArray[np.float32], view: SensorView, block: int
) -> tuple[NDArray[np.float32], SensorView, int]:
    """The image averaged in whole blocks, the same view of it, and the side of the blocks."""
    width, height = view.image.width // block, view.image.height // block
    if block == 1 or not (width and height):
        return np.ascontiguousarray(levels), view, 1
    top, left = (view.image.height - height * block) // 2, (view.image.width - width * block) // 2
    inside = levels[top : top + height * block, left : left + width * block]
    blocks = inside.reshape(height, block, width, block).mean(axis=(1, 3), dtype=np.float64)
    size = SensorSize(width, height)
    view = replace(view, image=size, scale=view.scale / block)
    return blocks.astype(np.float32), view, block
