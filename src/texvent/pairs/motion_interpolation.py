"""Intermediate frames as a rule per pixel: single pixels can be computed without the frame."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.frames import Frame
from texvent.pairs.instants import position
from texvent.runtime.kernel_arrays import read_only
from texvent.sensor import SensorSize
from texvent.transfer import Transfer

FloatImage = NDArray[np.float32]
Flows = tuple[NDArray[np.float32], NDArray[np.float32]]

DRAWN_BYTES = 16 << 20
"""Moved frames are drawn a few at a time, which is faster; this much of them at most."""


@dataclass(frozen=True, eq=False)
class MotionInterpolation:
    """Intermediate frames of one pair; iterating draws them one after the other.

    Every pixel of every intermediate frame depends on the two source frames and their flow alone.
    So a simulator can compute the brightness of some pixels with the functions of
    `pairs.warping`, and gets the same bits as from the drawn frame.
    """

    earlier: FloatImage
    """Luma of the earlier source frame, [H, W], 0..255 scale."""
    later: FloatImage
    """Luma of the later source frame, [H, W]."""
    flows: Flows | None
    """Optical flow from earlier to later and back, [H, W, 2] float32 as (x, y), px, or a vector for
    each 2×2 px: half as many rows and columns, rounded up. None: nothing moves, the frames are
    blended in place."""
    times_us: Sequence[int]
    """Times of the intermediate frames, µs, strictly increasing."""
    positions: Sequence[float]
    """τ of each intermediate frame, 0 = earlier, 1 = later."""
    transfer: Transfer = Transfer.GAMMA
    """Whether luma is gamma-coded or linear."""

    def __post_init__(self) -> None:
        # Numba compiles for arrays that can be written and for those that cannot: one is enough.
        object.__setattr__(self, "earlier", read_only(self.earlier))
        object.__setattr__(self, "later", read_only(self.later))
        if self.flows is not None:
            object.__setattr__(self, "flows", tuple(read_only(flow) for flow in self.flows))

    @classmethod
    def between(
        cls, first: Frame, second: Frame, times_us: Sequence[int], flows: Flows | None
    ) -> MotionInterpolation:
        """Intermediate frames at some times between two source frames."""
        places = [position(first, second, t_us) for t_us in times_us]
        levels = first.float_luma, second.float_luma
        return cls(*levels, flows, tuple(times_us), places, first.transfer)

    @property
    def size(self) -> SensorSize:
        """Width and height, pixels."""
        height, width = self.earlier.shape
        return SensorSize(width, height)

    def __len__(self) -> int:
        return len(self.times_us)

    def __iter__(self) -> Iterator[Frame]:
        step = max(1, DRAWN_BYTES // max(1, self.earlier.nbytes))
        for start in range(0, len(self), step):
            images = self._draw(start, start + step)
            for image, t_us in zip(images, self.times_us[start:], strict=False):
                yield Frame(image, t_us, is_source=False, transfer=self.transfer)

    @property
    def undrawn_frames(self) -> Iterator[UndrawnFrame]:
        """The same frames, each drawn only when its pixels are read."""
        return (UndrawnFrame(self, index) for index in range(len(self)))

    def image(self, index: int) -> FloatImage:
        """Luma of one intermediate frame, [H, W] float32.

        Without flow it is `I_1 + τ (I_2 − I_1)` in float32.
        """
        return next(self._draw(index, index + 1))

    def _draw(self, start: int, stop: int) -> Iterator[FloatImage]:
        stop = min(stop, len(self))
        if self.flows is not None:
            from texvent.pairs import warping  # blending needs no Numba

            yield from warping.warp_pair(self.prepared, start, stop)
            return
        for place in self.positions[start:stop]:
            yield self.earlier + np.float32(place) * (self.later - self.earlier)

    @cached_property
    def prepared(self) -> Any:
        """The pair as the compiled kernels read it, a `pairs.warping.WarpPair`; only with flow."""
        if self.flows is None:
            raise ValueError("the frames of the pair are blended, and no pixel moves")
        from texvent.pairs import warping  # as above

        return warping.prepare_pair(self.earlier, self.later, *self.flows, self.positions)


class UndrawnFrame(Frame):
    """An intermediate frame that is drawn when its pixels are read."""

    def __init__(self, motion: MotionInterpolation, index: int) -> None:
        # A frozen dataclass takes no assignments.
        vars(self).update(t_us=motion.times_us[index], is_source=False)
        vars(self).update(transfer=motion.transfer, _size=motion.size, _undrawn=(motion, index))

    @cached_property
    def pixels(self) -> Any:
        """[H, W] float32 luma. Drawing it releases the source frames."""
        motion, index = vars(self).pop("_undrawn")
        return motion.image(index)

    @property
    def size(self) -> SensorSize:
        """Width and height, pixels."""
        size: SensorSize = vars(self)["_size"]
        return size
