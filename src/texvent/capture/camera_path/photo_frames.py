"""What a moving camera sees of a still image: frames, and any instant between them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.capture.camera_path.motion import CameraPath, Place, Pose
from texvent.capture.camera_path.surfaces import Surfaces
from texvent.capture.camera_path.view import View, fitted_view
from texvent.runtime.threads import count_threads, run_parts
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
PX_ALONG = 16
"""A larger image is averaged in whole blocks first, so that this many of its px, up to twice as
many, lie along a px of the sensor."""
PX_ALONG_DEPTH = 2
"""About as many of images with depth, of which every px is drawn as a piece."""
NEAR_PERCENT, FAR_PERCENT = 1.0, 99.0
"""Percentiles of depth that count as nearest and farthest."""


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
    depth: NDArray[np.float32] | None = None
    """[H, W] m, inf where there is no surface; None: the image is flat."""
    focal_px: float | None = None
    """Focal length in px of the image; only poses need it."""
    facts: Mapping[str, Any] = field(default_factory=dict)
    """Where the image comes from."""
    view: View = field(init=False)
    """Where the sensor's pixels lie in the image."""
    _levels: NDArray[np.float32] = field(init=False)
    _block: int = field(init=False)
    _surfaces: Surfaces | None = field(init=False)

    def __post_init__(self) -> None:
        image = SensorSize(self.levels.shape[1], self.levels.shape[0])
        near, reference, far = _depths(self.depth)
        nearness = (reference / near, reference / far)
        times = np.linspace(self.start_us, self._time(self.intervals), INSTANTS)
        places = [self.path(float(t_us)) for t_us in times]
        start = View(image, self.sensor or image, 1.0, self.focal_px, reference)
        view = fitted_view(start, places, nearness, is_pixelwise=self.sensor is None)
        wanted = view.scale // PX_ALONG if self.depth is None else view.scale / PX_ALONG_DEPTH
        levels, view, block = _averaged(self.levels, view, max(1, round(wanted)))
        object.__setattr__(self, "view", view)
        object.__setattr__(self, "_block", block)
        object.__setattr__(self, "_levels", levels)
        surfaces = None
        if self.depth is not None:
            depth = _picked(self.depth, block, view.image)
            margin, hidden = _margins(view, places, nearness)
            surfaces = Surfaces(view, levels, depth.astype(np.float64), margin, hidden)
        object.__setattr__(self, "_surfaces", surfaces)

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
            levels, depth = self._render(self.path(t_us))
            motion = self._motion(index, depth)
            yield Frame(levels, t_us, motion=motion, transfer=transfer_of(self))

    def at(self, t_us: int) -> Frame:
        """The frame at `t_us`, [H, W] float32 luma on the 0..255 scale."""
        levels, _ = self._render(self.path(t_us))
        return Frame(levels, t_us, is_source=False, transfer=transfer_of(self))

    def gamma_coded(self) -> PhotoFrames:
        """The same camera over the image as gamma-coded levels, where it is linear light."""
        facts = {name: one for name, one in self.facts.items() if name != "transfer"}
        levels = encode_srgb(self.levels / np.float32(WHITE))
        return replace(self, levels=levels, facts=facts)

    def _time(self, index: int) -> int:
        return frame_time_us(index, self.fps, self.start_us)

    def _render(
        self, place: Place | Pose
    ) -> tuple[NDArray[np.float32], NDArray[np.float32] | None]:
        """Levels [h, w], and depth where the image has some."""
        out = np.empty(self.size.shape, np.float32)
        if self._surfaces is not None:
            from texvent.capture.camera_path.layers_cpu import draw_pieces  # brings Numba

            depth = np.empty_like(out)
            draw_pieces(self._surfaces.pieces(place), out, depth, np.empty(out.shape))
            return out, depth
        from texvent.capture.camera_path.area_cpu import sample_rows  # brings Numba

        matrix = self.view.matrix(place)
        rows = -(-len(out) // count_threads())
        tops = range(0, len(out), rows)
        run_parts(
            lambda top: sample_rows(self._levels, matrix, top, out[top : top + rows]), list(tops)
        )
        return out, None

    def _motion(self, index: int, depth: NDArray[np.float32] | None) -> Motion:
        now = self.path(self._time(index))
        forward, backward = (
            self._vectors(now, self.path(self._time(other)), depth)
            if 0 <= other < self.frame_count
            else None
            for other in (index + 1, index - 1)
        )
        return Motion(forward, backward, depth)

    def _vectors(
        self, now: Place | Pose, other: Place | Pose, depth: NDArray[np.float32] | None
    ) -> NDArray[np.float32]:
        """[h, w, 2] from each pixel's centre to where what it shows is seen then, px."""
        width, height = self.size
        x, y = np.arange(width) + 0.5, np.arange(height) + 0.5
        points = np.stack(np.meshgrid(x, y), axis=-1)
        if self._surfaces is not None and depth is not None:
            seen, first = self._surfaces.unproject(points, depth.astype(np.float64), now)
            then = self._surfaces.project(seen, first, other)[0]
            return np.asarray(then - points, dtype=np.float32)
        way = np.linalg.solve(self.view.matrix(other), self.view.matrix(now))
        moved = np.concatenate([points, np.ones((height, width, 1))], axis=-1) @ way.T
        return np.asarray(moved[..., :2] / moved[..., 2:] - points, dtype=np.float32)


def _depths(depth: NDArray[np.float32] | None) -> tuple[float, float, float]:
    """Nearest, median and farthest depth, m."""
    seen = None if depth is None else depth[np.isfinite(depth)]
    if depth is None or seen is None or not seen.size:
        return 1.0, 1.0, 1.0
    near, middle, far = np.percentile(seen, (NEAR_PERCENT, 50.0, FAR_PERCENT))
    return float(near), float(middle), float(far) if np.isfinite(depth).all() else np.inf


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
    focal = None if view.focal_px is None else view.focal_px / block
    size = SensorSize(width, height)
    view = replace(view, image=size, scale=view.scale / block, focal_px=focal)
    return blocks.astype(np.float32), view, block


def _picked(depth: NDArray[np.float32], block: int, size: SensorSize) -> NDArray[np.float32]:
    """Depth in the middle of blocks: a mean over an edge would be the depth of nothing."""
    top, left = (
        (depth.shape[0] - size.height * block) // 2,
        (depth.shape[1] - size.width * block) // 2,
    )
    return depth[top + block // 2 :: block, left + block // 2 :: block][: size.height, : size.width]


def _margins(
    view: View, places: Sequence[Place | Pose], nearness: Sequence[float]
) -> tuple[int, int]:
    """Px of the image beyond its borders that are seen, and by which surfaces part."""
    beyond = max(0.0, view.reach(places, nearness) - 1) / 2
    centre = np.array([view.sensor.width / 2, view.sensor.height / 2, 1.0])
    parted = 0.0
    for place in places:
        near, far = (view.matrix(place, one) @ centre for one in nearness)
        parted = max(parted, float(np.hypot(*(near[:2] / near[2] - far[:2] / far[2]))))
    return int(np.ceil(beyond * max(view.image))) + 2, int(np.ceil(parted)) + 2
