"""Intermediate frames from motion vectors that come with the frames."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from texvent.config import InterpolateConfig
from texvent.interpolate.motion.draw_cpu import MIXED
from texvent.interpolate.motion.pair import MotionPair
from texvent.pairs.instants import check_between, float_luma, position
from texvent.runtime.threads import count_threads, run_parts
from texvent.video import FlickeringStream, Frame, FrameStream, MovingStream

MOST_AT_ONCE = 8
"""Intermediate frames that are drawn at a time, each by a thread."""
MOST_RENDERED = 0.15
"""Share of the pixels that motion does not tell; above it, frames are rendered whole where they
can be."""


class MotionInterpolator:
    """Follows every piece of surface along its path; nearer ones hide farther ones.

    Both frames of a pair must carry motion vectors; see `video.Motion`. With vectors to both
    neighbours of a frame, paths are curved. Depth decides what hides what; without it, the faster
    of two things is taken to be the nearer one.

    Source: view morphing by depth, McMillan and Bishop, Plenoptic modeling (SIGGRAPH 1995); layers
        of splats as in Niklaus and Liu, Softmax splatting (CVPR 2020), with depth for their weight.
    """

    bytes_per_pixel: ClassVar[int] = 1200

    def __init__(self, config: InterpolateConfig, stream: FrameStream) -> None:
        del config  # an argument of every interpolator; not used here
        self._stream = stream if isinstance(stream, MovingStream) else None
        self._beats = isinstance(stream, FlickeringStream) and stream.flicker_hz is not None

    def between(self, first: Frame, second: Frame, times_us: Sequence[int]) -> Iterator[Frame]:
        """Frames at `times_us`, every surface where its path leads.

        Args:
            first: the earlier source frame, with motion.
            second: the later source frame, with motion.
            times_us: times of the intermediate frames, µs.

        Returns:
            One frame per time, [H, W] float32 luma, 0..255 scale, drawn while they are read.

        Raises:
            InputError: the frames differ in size, a time is not between theirs, or neither frame
                has vectors to the other.
        """
        check_between(first, second, times_us)
        if self._stream is not None and (self._beats or self._stream.has_moving_light):
            return _rendered(self._stream, times_us)
        # Now, not at the first frame: this may run in the prefetch thread.
        pair = MotionPair.of(first, second)
        return self._draw(pair, [position(first, second, t_us) for t_us in times_us], times_us)

    def _draw(
        self, pair: MotionPair, places: Sequence[float], times_us: Sequence[int]
    ) -> Iterator[Frame]:
        """Frames at τ = `places`, a few at a time; what motion does not tell is rendered."""
        step = max(1, min(count_threads(), MOST_AT_ONCE))
        for start in range(0, len(places), step):
            drawn = run_parts(pair.draw, places[start : start + step])
            if self._stream is not None and np.mean(drawn[0][1] == MIXED) > MOST_RENDERED:
                yield from _rendered(self._stream, times_us[start:])
                return
            for (image, kind), t_us in zip(drawn, times_us[start:], strict=False):
                if self._stream is not None:
                    wanted = _grown(kind == MIXED)
                    image[wanted] = self._stream.luma_of(t_us, wanted)
                yield Frame(image, t_us, is_source=False, transfer=pair.transfer)


def _grown(mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """A mask with the four neighbours of its pixels."""
    grown = mask.copy()
    grown[1:] |= mask[:-1]
    grown[:-1] |= mask[1:]
    grown[:, 1:] |= mask[:, :-1]
    grown[:, :-1] |= mask[:, 1:]
    return grown


def _rendered(stream: MovingStream, times_us: Sequence[int]) -> Iterator[Frame]:
    """Frames of which so much would have to be rendered that they are rendered whole."""
    for t_us in times_us:
        frame = stream.at(t_us)
        yield Frame(float_luma(frame), t_us, is_source=False, transfer=frame.transfer)
