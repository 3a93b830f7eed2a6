"""Pair of source frames with its intermediate frames: interpolators make it, simulators use it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.frames import Frame
from texvent.pairs.motion_interpolation import MotionInterpolation
from texvent.pairs.scene_change import SceneChange

CHANGE_DURATION_US = 1_000
"""A cut or flash takes at most this long, µs; the earlier image is held until then."""

OnSceneChange: TypeAlias = Callable[[SceneChange, int], None]
"""Called at every cut and flash: what it is, and the time of the first frame after it, µs."""


@dataclass(frozen=True, eq=False)
class FramePair:
    """Two source frames and the intermediate frames between them."""

    first: Frame | None
    """The earlier source frame; None for the first frame of a stream."""
    second: Frame
    """The later source frame."""
    change: SceneChange
    """Cut or flash between the two, if any."""
    times_us: Sequence[int]
    """Times of the intermediate frames, µs; none at a scene change."""
    between: Iterable[Frame]
    """The intermediate frames, made while they are read: a `MotionInterpolation` where they are
    moved or blended source frames, empty where there are none."""

    @property
    def frames(self) -> Iterator[Frame]:
        """The intermediate frames, then the later frame; to be read once."""
        yield from self.between
        yield self.second

    @property
    def earlier(self) -> Frame:
        """The earlier frame of a pair that is not the first of a stream."""
        if self.first is None:
            raise ValueError("the first frame of a stream has no frame before it")
        return self.first

    @property
    def motion(self) -> MotionInterpolation:
        """Motion between the two frames; without intermediate frames if there are none."""
        if isinstance(self.between, MotionInterpolation):
            return self.between
        return MotionInterpolation.between(self.earlier, self.second, (), None)

    @property
    def undrawn_frames(self) -> Iterator[Frame]:
        """As `frames`, but each intermediate frame is drawn only when its pixels are read."""
        yield from self.motion.undrawn_frames
        yield self.second

    @property
    def edges_us(self) -> NDArray[np.int64]:
        """Times of both source frames and of the frames of `motion`, [K + 2], µs."""
        return np.array([self.earlier.t_us, *self.motion.times_us, self.second.t_us])


def notify_scene_change(pair: FramePair, on_scene_change: OnSceneChange | None) -> None:
    """Tell the callback of the cut or flash in a pair, if there is one."""
    if pair.change is not SceneChange.NONE and on_scene_change is not None:
        on_scene_change(pair.change, pair.second.t_us)


def hold_earlier(first: Frame, second: Frame) -> MotionInterpolation:
    """The earlier image once more, just before the later frame.

    Returns:
        One frame with the luma of `first`, `CHANGE_DURATION_US` (or half the interval, if that is
        less) before `second`; none where there is no whole microsecond between the two.
    """
    wait_us = min(CHANGE_DURATION_US, (second.t_us - first.t_us) // 2)
    times_us = (second.t_us - wait_us,) if wait_us > 0 else ()
    positions = (0.0,) * len(times_us)
    levels = first.float_luma, second.float_luma
    return MotionInterpolation(*levels, None, times_us, positions, first.transfer)
