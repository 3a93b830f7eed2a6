"""Linear mix of two frames: cheap and without motion, so a moving edge fades instead of moving."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

from texvent.config import InterpolateConfig
from texvent.pairs.motion_interpolation import MotionInterpolation
from texvent.video import Frame, FrameStream


class BlendInterpolator:
    """Cross-fades: intensity changes linearly in time at every pixel."""

    bytes_per_pixel: ClassVar[int] = 30

    def __init__(self, config: InterpolateConfig, stream: FrameStream) -> None:
        del config, stream  # the arguments of every interpolator; not used here

    def between(self, first: Frame, second: Frame, times_us: Sequence[int]) -> MotionInterpolation:
        """Frames `I_1 + τ (I_2 − I_1)`, τ = (t − t_1) / (t_2 − t_1).

        Args:
            first: the earlier source frame.
            second: the later source frame.
            times_us: times of the intermediate frames, µs.

        Returns:
            One frame per time, [H, W] float32 luma, 0..255 scale.

        Raises:
            InputError: the frames differ in size, or a time is not between theirs.
        """
        return MotionInterpolation.between(first, second, times_us, None)
