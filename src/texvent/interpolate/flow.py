"""Motion-compensated interpolation by DIS optical flow: the default, without weights."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

from texvent.config import InterpolateConfig
from texvent.interpolate.dis_flow.pair_flow import PairFlow
from texvent.pairs.instants import check_between
from texvent.pairs.motion_interpolation import MotionInterpolation
from texvent.video import Frame, FrameStream


class FlowInterpolator:
    """Moves both frames along the optical flow to the instant, and mixes them.

    The flow is computed once per pair, in both directions. Where the two directions disagree, the
    point is occluded in one frame, and the other frame counts more; where both fail, the frames are
    blended in place.

    Deviation: the paper uses RIFE, which needs published weights.
    """

    bytes_per_pixel: ClassVar[int] = 160

    def __init__(self, config: InterpolateConfig, stream: FrameStream) -> None:
        del config, stream  # the arguments of every interpolator; not used here
        self.pair_flow = PairFlow()
        """The flow of the last pair; `CountPolicy` uses it to count frames."""

    def between(self, first: Frame, second: Frame, times_us: Sequence[int]) -> MotionInterpolation:
        """Frames with every point moved along its path from `first` to `second`.

        Args:
            first: the earlier source frame.
            second: the later source frame.
            times_us: times of the intermediate frames, µs.

        Returns:
            One frame per time, [H, W] float32 luma, 0..255 scale; the flow is computed at once,
            each frame when it is asked for.

        Raises:
            InputError: the frames differ in size, or a time is not between theirs.
        """
        check_between(first, second, times_us)
        # Now, not at the first frame: this may run in the prefetch thread.
        flows = self.pair_flow.both_ways(first, second)
        return MotionInterpolation.between(first, second, times_us, flows)
