"""Source frames → dense frames: every source frame untouched, intermediate frames between them."""

from __future__ import annotations

from collections.abc import Iterator

from texvent.config import InterpolateConfig
from texvent.interpolate.count_policy import CountPolicy
from texvent.interpolate.pairing import pair_frames
from texvent.interpolate.protocol import Interpolator
from texvent.pairs.frame_pair import OnSceneChange, notify_scene_change
from texvent.video import Frame, FrameStream


def densify(
    stream: FrameStream,
    interpolator: Interpolator,
    config: InterpolateConfig,
    *,
    balance: float,
    contrast_threshold: float,
    counts_motion: bool = False,
    on_scene_change: OnSceneChange | None = None,
) -> Iterator[Frame]:
    """The frames of `stream` with intermediate frames between them.

    A run does not need this: its simulator takes pairs of frames and draws what is between them
    itself. At most two source frames are held at a time.

    Args:
        stream: source frames.
        interpolator: makes the intermediate frames.
        config: how many there are, and whether cuts and flicker are looked for.
        balance: the simulator's α, for Eq. 4.
        contrast_threshold: the simulator's δ, for Eq. 4.
        counts_motion: whether the simulator gains from more frames under fast motion; then
            motion counts unless `config.frames_per_pixel` is set.
        on_scene_change: called at every cut and flash, before the frames that show it.

    Yields:
        Source frames as they came (`is_source` True, pixels untouched unless `config` removes
        flicker), and between them the intermediate frames (`is_source` False, [H, W] float32
        luma); times strictly increase.

    Raises:
        InputError: a source frame has another size than the first, a time that does not
            increase, or a pixel that is NaN, infinite or negative.

    Equation: (4), section 3.2.1.
    Deviation: the paper interpolates across scene cuts; here the earlier image is held and the
        change happens within the last millisecond. Light that is known to beat between the
        frames gets enough intermediate frames to be seen, where they can be rendered.
    """
    policy = CountPolicy(
        config,
        stream,
        interpolator,
        balance=balance,
        contrast_threshold=contrast_threshold,
        counts_motion=counts_motion,
    )
    for pair in pair_frames(stream, interpolator, config, policy):
        notify_scene_change(pair, on_scene_change)
        yield from pair.frames
