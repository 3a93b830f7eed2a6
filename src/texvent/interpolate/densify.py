"""Source frames → dense frames: every source frame untouched, intermediate frames between them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TypeAlias

from texvent.config import InterpolateConfig
from texvent.interpolate.count import intermediate_times_us
from texvent.interpolate.cuts import Jump, detect_jump
from texvent.interpolate.gain_jumps import steady_frames
from texvent.interpolate.policy import CountPolicy
from texvent.interpolate.position import float_luma
from texvent.interpolate.protocol import Interpolator
from texvent.video import Frame, FrameStream, StreamChecker

JUMP_DURATION_US = 1_000
"""A cut or flash takes at most this long, µs; the old picture is held until then."""

OnCut: TypeAlias = Callable[[Jump, int], None]
"""Told of every jump: what it is, and the time of the first frame after it, µs."""

NEVER_SMEARS = frozenset({"none", "exact"})
"""Interpolators that mix no frames, so that a cut cannot be smeared and is not looked for."""


def densify(
    stream: FrameStream,
    interpolator: Interpolator,
    config: InterpolateConfig,
    *,
    balance: float,
    contrast_threshold: float,
    on_cut: OnCut | None = None,
) -> Iterator[Frame]:
    """The frames of `stream` with intermediate frames between them.

    At most two source frames are held at a time, so memory does not grow with the clip.

    Args:
        stream: source frames.
        interpolator: what makes the intermediate frames.
        config: how many there are, and whether cuts and flicker are looked for.
        balance: the simulator's α, for Eq. 4 unless `config.count_balance` is set.
        contrast_threshold: the simulator's δ, for Eq. 4 unless `config.count_threshold` is set.
        on_cut: called at every cut and flash.

    Yields:
        Source frames as they came (`is_source` True, pixels untouched unless the flicker guard
        is on), and between them the intermediate frames (`is_source` False, [H, W] float32 luma);
        times strictly increase.

    Raises:
        InputError: a source frame has another size than the first, a time that does not
            increase, or a pixel that is NaN, infinite or negative.

    Equation: (4), section 3.2.1.
    Deviation: the paper interpolates across scene cuts; here the earlier picture is held and the
        change happens within the last millisecond. Light that is known to beat between the
        frames gets enough intermediate frames to be seen, where they can be rendered.
    """
    checker = StreamChecker()
    policy = CountPolicy(
        config,
        stream,
        interpolator,
        balance=balance,
        contrast_threshold=contrast_threshold,
    )
    previous: Frame | None = None
    frames = map(checker.check, stream)
    for frame in steady_frames(frames) if config.flicker_guard else frames:
        if previous is not None:
            jump = _jump(previous, frame, config)
            if jump is not Jump.NONE:
                if on_cut is not None:
                    on_cut(jump, frame.t_us)
                yield from hold(previous, frame)
            else:
                count = policy.count(previous, frame)
                times_us = intermediate_times_us(previous.t_us, frame.t_us, count)
                if times_us:
                    yield from interpolator.between(previous, frame, times_us)
        yield frame
        previous = frame


def hold(first: Frame, second: Frame) -> Iterator[Frame]:
    """The earlier picture once more, just before the later one.

    Yields:
        One frame with the luma of `first`, `JUMP_DURATION_US` (or half the interval, if that is
        less) before `second`; nothing where there is no whole microsecond between the two.
    """
    wait_us = min(JUMP_DURATION_US, (second.t_us - first.t_us) // 2)
    if wait_us > 0:
        yield Frame(float_luma(first), second.t_us - wait_us, is_source=False)


def _jump(first: Frame, second: Frame, config: InterpolateConfig) -> Jump:
    if not config.detect_cuts or config.interpolate in NEVER_SMEARS:
        return Jump.NONE
    return detect_jump(first, second)
