"""Intermediate frames from motion vectors that come with the frames."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from texvent.config import InterpolateConfig
from texvent.errors import InputError
from texvent.frames import Frame, FrameStream, MotionVectors, MovingStream
from texvent.interpolate.motion.draw import FrameSide, draw
from texvent.interpolate.motion.layers import (
    FURTHEST,
    GAMMA,
    SPEED_ORDER,
    WHITE,
    Floats,
    make_layers,
)
from texvent.interpolate.motion.paths import (
    LEAST_MOTION_PX,
    bend_of,
    list_fragments,
    make_paths,
    reverse_vectors,
)
from texvent.pairs.instants import position
from texvent.runtime.threads import count_threads, run_parts
from texvent.transfer import Transfer

MOST_AT_ONCE = 8
"""Intermediate frames that are drawn at a time, each by a thread."""
NEAREST_M = 1e-3
"""Smaller depths count as this, m."""
MARGIN_PX = 3
"""Margin around moving pixels in which others may change."""


class MotionInterpolator:
    """Follows every fragment of surface along its path; nearer ones hide farther ones.

    Both frames of a pair must carry motion vectors (`frames.MotionVectors`). With vectors to both
    neighbours of a frame, paths are curved. Depth decides what hides what; without it, the faster
    of two surfaces is taken to be the nearer one.

    Source: view morphing by depth, McMillan and Bishop, Plenoptic modeling (SIGGRAPH 1995); layers
        of splats as in Niklaus and Liu, Softmax splatting (CVPR 2020), with depth for their weight.
    """

    bytes_per_pixel: ClassVar[int] = 1200

    def __init__(self, config: InterpolateConfig, stream: FrameStream) -> None:
        del config  # an argument of every interpolator; not used here
        self._stream = stream if isinstance(stream, MovingStream) else None

    def between(self, first: Frame, second: Frame, times_us: Sequence[int]) -> Iterator[Frame]:
        """Frames at `times_us`, every surface where its path leads.

        Args:
            first: the earlier source frame, with motion.
            second: the later source frame, with motion.
            times_us: times of the intermediate frames, µs.

        Returns:
            One frame per time, [H, W] float32 luma, 0..255 scale, drawn while they are read.

        Raises:
            InputError: neither frame has vectors to the other.
        """
        if self._stream is not None:
            return self._stream.between(first, second, times_us)
        # Now, not at the first frame: this may run in the prefetch thread.
        pair = MotionPair.of(first, second)
        return self._draw(pair, [position(first, second, t_us) for t_us in times_us], times_us)

    def _draw(
        self, pair: MotionPair, places: Sequence[float], times_us: Sequence[int]
    ) -> Iterator[Frame]:
        """Frames at τ = `places`, a few at a time."""
        step = max(1, min(count_threads(), MOST_AT_ONCE))
        for start in range(0, len(places), step):
            drawn = run_parts(pair.draw, places[start : start + step])
            for image, t_us in zip(drawn, times_us[start:], strict=False):
                yield Frame(image, t_us, is_source=False, transfer=pair.transfer)


@dataclass(frozen=True, eq=False)
class MotionPair:
    """Two frames with motion vectors, ready to be drawn at any instant between them."""

    first: Floats
    """[H, W] levels of the earlier frame."""
    second: Floats
    """[H, W] levels of the later frame."""
    part: tuple[slice, slice]
    """Rows and columns in which something moves; the frames are mixed in place elsewhere."""
    sides: tuple[FrameSide, FrameSide]
    """Both frames in that part."""
    transfer: Transfer
    """Coding of the frames; levels are always gamma-coded here."""

    @classmethod
    def of(cls, first: Frame, second: Frame) -> MotionPair:
        """The pair of two frames with motion.

        Raises:
            InputError: neither frame has vectors to the other.
        """
        start, stop = first.motion or MotionVectors(), second.motion or MotionVectors()
        if start.forward is None and stop.backward is None:
            raise InputError(
                f"interpolate is 'motion', but the frames at {first.t_us} and {second.t_us} µs "
                "have no motion vectors to each other; give `motion`, or use interpolate flow"
            )
        levels = _coded(first), _coded(second)
        orders = _order(start, start.forward, first), _order(stop, stop.backward, second)
        forward, backward = start.forward, stop.backward
        if forward is None:
            forward = reverse_vectors(_floats(backward), orders[1])
        if backward is None:
            backward = reverse_vectors(_floats(forward), orders[0])
        part = moving_part(forward, backward)
        cut = [
            np.ascontiguousarray(one[part])
            for one in (
                *levels,
                *orders,
                _floats(forward),
                _floats(backward),
                bend_of(start.forward, start.backward),
                bend_of(stop.forward, stop.backward),
            )
        ]
        sides = _frame_side(cut[0::2], cut[1::2]), _frame_side(cut[1::2], cut[0::2])
        return cls(*levels, part, sides, first.transfer)

    def draw(self, place: float) -> Floats:
        """The image at τ = `place`, [H, W]."""
        position = np.float32(place)
        image = self.first + position * (self.second - self.first)
        if image[self.part].size:
            inside = np.empty_like(image[self.part])
            draw(*self.sides, position, inside)
            image[self.part] = inside
        if self.transfer is Transfer.LINEAR:
            light = (np.maximum(image, 0) / np.float32(WHITE)) ** np.float32(GAMMA)
            image = np.asarray(np.float32(WHITE) * light, np.float32)
        return image


def _coded(frame: Frame) -> Floats:
    """Gamma-coded luma, by the curve that the kernels undo where they add light up."""
    luma = frame.float_luma
    if frame.transfer is Transfer.LINEAR:
        luma = _floats(np.float32(WHITE) * (luma / np.float32(WHITE)) ** np.float32(1 / GAMMA))
    return luma


def moving_part(forward: Floats, backward: Floats) -> tuple[slice, slice]:
    """Rows and columns that hold everything that moves between two frames, with a margin."""
    height, width = forward.shape[:2]
    size = np.array([height, width])
    low, high = size, np.zeros(2, int)
    for vectors in (forward, backward):
        known = np.asarray(np.isfinite(vectors).all(axis=2))
        with np.errstate(invalid="ignore"):
            moves: NDArray[np.bool_] = ~(np.abs(vectors).max(axis=2) < LEAST_MOTION_PX)
        where = np.argwhere(moves)
        if not len(where):
            continue
        there = where[known[moves]] + vectors[moves & known][:, ::-1]
        places = np.concatenate([where, there])
        low = np.minimum(low, np.floor(places.min(axis=0)).astype(int) - MARGIN_PX)
        high = np.maximum(high, np.ceil(places.max(axis=0)).astype(int) + 1 + MARGIN_PX)
    low = np.clip(low, 0, size)
    high = np.clip(high, low, size)
    return slice(int(low[0]), int(high[0])), slice(int(low[1]), int(high[1]))


def _frame_side(own: list[Floats], other: list[Floats]) -> FrameSide:
    """One frame by its levels, order, vectors and bends, and those of the other frame."""
    image, order, vectors, bend = own
    layers = make_layers(image, order, vectors)
    paths = make_paths(vectors, bend, other[3], order, other[1], layers.tolerance)
    return FrameSide(layers, list_fragments(layers, paths))


def _order(motion: MotionVectors, vectors: NDArray[np.float32] | None, frame: Frame) -> Floats:
    """Logarithm of depth; without depth, faster pixels count as nearer."""
    if motion.depth is not None:
        depth = np.where(np.isnan(motion.depth), np.inf, motion.depth)
        return _floats(np.minimum(np.log(np.maximum(depth, NEAREST_M)), FURTHEST))
    if vectors is None:
        return np.zeros(frame.size.shape, np.float32)
    speed = np.nan_to_num(np.hypot(vectors[..., 0], vectors[..., 1]))
    return _floats(-SPEED_ORDER * speed)


def _floats(array: NDArray[np.float32] | None) -> Floats:
    return np.ascontiguousarray(array, dtype=np.float32)
