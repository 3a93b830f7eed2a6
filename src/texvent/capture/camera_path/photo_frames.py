"""What a moving camera sees of a still image: frames, and any instant between them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.capture.camera_path.motion import CameraPath, CameraPose2D
from texvent.capture.camera_path.view import View, fitted_view
from texvent.sensor import SensorSize
from texvent.transfer import WHITE, encode_srgb
from texvent.video import (
    Frame,
    Motion,
    NotebookFrames,
    describe_stream,
    frame_time_us,
    transfer_of,
)

INSTANTS = 300
"""Instants of a path that are looked at to find the scale."""
PX_ALONG = 3
"""A larger image is averaged in whole blocks first, to about this many px along a sensor px."""


@dataclass(frozen=True, eq=False, repr=False)
class PhotoFrames(NotebookFrames):
    """A `RenderableStream` of an image under a camera path; its frames carry exact motion.

    Raises:
        InputError: the path leads too far away from the image.
    """

    levels: NDArray[np.float32]
    """[H, W] luma of the image, 0..255 scale."""
    path: CameraPath
    start_us: int
    """Time of the first frame, µs."""
    fps: Fraction
    intervals: int
    """Frame intervals; there is one frame more."""
    sensor: SensorSize | None = None
    """None: the image's own size, pixel by pixel."""
    facts: Mapping[str, Any] = field(default_factory=dict)
    """Where the image comes from."""
    view: View = field(init=False)
    """Where the sensor's pixels lie in the image."""
    _block: int = field(init=False)
    _image: NDArray[np.float32] = field(init=False)

    def __post_init__(self) -> None:
        image = SensorSize(self.levels.shape[1], self.levels.shape[0])
        times = np.linspace(self.start_us, self._time(self.intervals), INSTANTS)
        places = [self.path(float(t_us)) for t_us in times]
        start = View(image, self.sensor or image)
        view = fitted_view(start, places, is_pixelwise=self.sensor is None)
        wanted = max(1, round(view.scale / PX_ALONG))
        levels, view, block = _averaged(self.levels, view, wanted)
        for name, value in (("view", view), ("_block", block), ("_image", levels)):
            object.__setattr__(self, name, value)

    def __repr__(self) -> str:
        return describe_stream(self)

    @property
    def size(self) -> SensorSize:
        """Of the sensor, px."""
        return self.view.sensor

    @property
    def frame_count(self) -> int:
        """How many frames there are."""
        return self.intervals + 1

    @property
    def is_live(self) -> bool:
        """False: the frames can be made again."""
        return False

    @property
    def metadata(self) -> Mapping[str, Any]:
        """Image, path and scale."""
        scale = self._block * self.view.scale
        return {**self.facts, **self.path.facts, "image_px_per_px": round(scale, 6)}

    def __iter__(self) -> Iterator[Frame]:
        """Frames in time order, with motion to their neighbours."""
        for index in range(self.frame_count):
            t_us = self._time(index)
            place = self.path(t_us)
            levels = self.view.render(self._image, place)
            motion = self._motion(index, place)
            yield Frame(levels, t_us, motion=motion, transfer=transfer_of(self))

    def at(self, t_us: int) -> Frame:
        """The frame at `t_us`, [H, W] float32 luma on the 0..255 scale."""
        levels = self.view.render(self._image, self.path(t_us))
        return Frame(levels, t_us, is_source=False, transfer=transfer_of(self))

    def gamma_coded(self) -> PhotoFrames:
        """The same camera over the image as gamma-coded levels, where it is linear light."""
        facts = {name: one for name, one in self.facts.items() if name != "transfer"}
        levels = encode_srgb(self.levels / np.float32(WHITE))
        return replace(self, levels=levels, facts=facts)

    def _time(self, index: int) -> int:
        return frame_time_us(index, self.fps, self.start_us)

    def _motion(self, index: int, place: CameraPose2D) -> Motion:
        forward, backward = (
            self.view.vectors(place, self.path(self._time(other)))
            if 0 <= other < self.frame_count
            else None
            for other in (index + 1, index - 1)
        )
        return Motion(forward, backward)


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
