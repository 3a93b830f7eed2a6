"""Intermediate frames from motion vectors that come with the frames."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from texvent.config import InterpolateConfig
from texvent.errors import InputError
from texvent.interpolate.motion.draw_cpu import MIXED, Side, draw
from texvent.interpolate.motion.layers_cpu import FURTHEST, SPEED_ORDER, Floats, make_layers
from texvent.interpolate.motion.paths_cpu import (
    bend_of,
    list_pieces,
    make_paths,
    reverse_vectors,
)
from texvent.pairs.instants import check_between, float_luma, position
from texvent.runtime.threads import count_threads, run_parts
from texvent.video import Frame, FrameStream, Motion, MovingStream

NEAREST_M = 1e-3
"""Smaller depths count as this, m."""


class MotionInterpolator:
    """Follows every piece of surface along its path; nearer ones hide farther ones.

    Both frames of a pair must carry motion vectors; see `video.Motion`. With vectors to both
    neighbours of a frame, paths are curved. Depth decides what hides what; without it, the faster
    of two things is taken to be the nearer one.

    Source: view morphing by depth, McMillan and Bishop, Plenoptic modeling (SIGGRAPH 1995); layers
        of splats as in Niklaus and Liu, Softmax splatting (CVPR 2020), with depth for their weight.
    """

    bytes_per_pixel: ClassVar[int] = 600

    def __init__(self, config: InterpolateConfig, stream: FrameStream) -> None:
        del config  # an argument of every interpolator; not used here
        self._stream = stream if isinstance(stream, MovingStream) else None

    def between(self, first: Frame, second: Frame, times_us: Sequence[int]) -> Iterator[Frame]:
        """Frames at `times_us`, every surface where its path leads.

        Args:
            first: the earlier source frame, with motion.
            second: the later source frame, with motion.
            times_us: times of the intermediate frames, µs.

        Yields:
            One frame per time, [H, W] float32 luma, 0..255 scale.

        Raises:
            InputError: the frames differ in size, a time is not between theirs, or neither frame
                has vectors to the other.
        """
        check_between(first, second, times_us)
        sides = make_sides(first, second)
        step = max(1, count_threads())
        for start in range(0, len(times_us), step):
            chosen = times_us[start : start + step]
            images = run_parts(lambda t_us: draw_at(sides, position(first, second, t_us)), chosen)
            for (image, kind), t_us in zip(images, chosen, strict=True):
                if self._stream is not None:
                    wanted = kind == MIXED
                    image[wanted] = self._stream.luma_of(t_us, wanted)
                yield Frame(image, t_us, is_source=False)


def make_sides(first: Frame, second: Frame) -> tuple[Side, Side]:
    """Both frames of a pair as the kernels read them.

    Raises:
        InputError: neither frame has vectors to the other.
    """
    start, stop = first.motion or Motion(), second.motion or Motion()
    forward, backward = start.forward, stop.backward
    if forward is None and backward is None:
        raise InputError(
            f"interpolate is 'motion', but the frames at {first.t_us} µs and {second.t_us} µs have "
            "no motion vectors to each other; give vectors for every frame, or use interpolate flow"
        )
    orders = _order(start, first, forward), _order(stop, second, backward)
    if forward is None:
        forward = reverse_vectors(_floats(backward), orders[1])
    if backward is None:
        backward = reverse_vectors(_floats(forward), orders[0])
    bends = bend_of(start.forward, start.backward), bend_of(stop.forward, stop.backward)
    sides = []
    for frame, vectors, own, other in ((first, forward, 0, 1), (second, backward, 1, 0)):
        vectors = _floats(vectors)
        layers = make_layers(float_luma(frame), orders[own], vectors)
        arrays = bends[own], bends[other], orders[own], orders[other], layers.tolerance
        sides.append(Side(layers, list_pieces(layers, make_paths(vectors, *arrays))))
    return sides[0], sides[1]


def draw_at(sides: tuple[Side, Side], place: float) -> tuple[Floats, NDArray[np.uint8]]:
    """The image at τ = `place`, [H, W], and for each pixel `FOLLOWED` or `MIXED`."""
    shape = sides[0].layers.order.shape
    image, kind = np.empty(shape, np.float32), np.empty(shape, np.uint8)
    draw(*sides, np.float32(place), image, kind)
    return image, kind


def _order(motion: Motion, frame: Frame, vectors: NDArray[np.float32] | None) -> Floats:
    """Ln depth; without depth, what moves faster is nearer."""
    if motion.depth is not None:
        depth = np.where(np.isnan(motion.depth), np.inf, motion.depth)
        with np.errstate(divide="ignore"):
            return _floats(np.minimum(np.log(np.maximum(depth, NEAREST_M)), FURTHEST))
    if vectors is None:
        return np.zeros(frame.size.shape, np.float32)
    speed = np.nan_to_num(np.hypot(vectors[..., 0], vectors[..., 1]))
    return _floats(-SPEED_ORDER * speed)


def _floats(array: NDArray[np.float32] | None) -> Floats:
    return np.ascontiguousarray(array, dtype=np.float32)
