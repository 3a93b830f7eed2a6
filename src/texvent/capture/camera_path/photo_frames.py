"""View of a moving camera on a still image: frames, and any instant between them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.capture.camera_path.motion import CameraPath, CameraPose2D
from texvent.capture.camera_path.view import View, fitted_view
from texvent.capture.frame_source import FrameSource
from texvent.frames import Frame, MotionVectors, frame_time_us, transfer_of
from texvent.sensor import SensorSize
from texvent.transfer import WHITE, encode_srgb

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
        view = fitted_view(View(image, sensor or image), places, is_pixelwise=sensor is None)
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
    levels: NDArray[np.float32], view: View, block: int
) -> tuple[NDArray[np.float32], View, int]:
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
