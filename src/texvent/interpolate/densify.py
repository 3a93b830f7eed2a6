"""Source frames → dense frames: every source frame untouched, intermediate frames between them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from texvent.config import InterpolateConfig
from texvent.interpolate.count import intermediate_times_us
from texvent.interpolate.count_policy import CountPolicy
from texvent.interpolate.protocol import Interpolator
from texvent.pairs.deflicker import steady_frames
from texvent.pairs.instants import float_luma
from texvent.pairs.motion_interpolation import Paths
from texvent.pairs.scene_change import Jump, detect_jump
from texvent.video import Frame, FrameStream, StreamChecker

JUMP_DURATION_US = 1_000
"""A cut or flash takes at most this long, µs; the old picture is held until then."""

OnCut: TypeAlias = Callable[[Jump, int], None]
"""Told of every jump: what it is, and the time of the first frame after it, µs."""

NEVER_SMEARS = frozenset({"none", "exact"})
"""Interpolators that mix no frames, so that a cut cannot be smeared and is not looked for."""


@dataclass(frozen=True, eq=False)
class Pair:
    """What follows one source frame, up to and including the next."""

    first: Frame | None
    """The earlier source frame; None before the first frame of a stream."""
    second: Frame
    """The later source frame."""
    jump: Jump
    """Whether a cut or a flash lies between the two."""
    times_us: Sequence[int]
    """Times of the intermediate frames, µs; none at a jump."""
    between: Iterable[Frame]
    """The frames between the two, made when they are asked for: `Paths` where they are frames
    moved or blended, empty where there are none."""

    @property
    def frames(self) -> Iterator[Frame]:
        """The frames between the two, then the later one; to be read once."""
        yield from self.between
        yield self.second


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
    policy = CountPolicy(
        config,
        stream,
        interpolator,
        balance=balance,
        contrast_threshold=contrast_threshold,
    )
    yield from dense_frames(pair_up(stream, interpolator, config, policy), on_cut)


def pair_up(
    frames: Iterable[Frame],
    interpolator: Interpolator,
    config: InterpolateConfig,
    policy: CountPolicy,
) -> Iterator[Pair]:
    """Source frames as pairs that know what goes between them; the first has no earlier frame.

    What a pair costs once, such as its optical flow, is paid here; its pictures are made when
    `Pair.between` is read. So a thread may run ahead here while another one reads the pictures.

    Raises:
        InputError: as `densify`.
    """
    previous: Frame | None = None
    checked = map(StreamChecker().check, frames)
    for frame in steady_frames(checked) if config.deflicker else checked:
        jump = Jump.NONE if previous is None else _jump(previous, frame, config)
        times_us: Sequence[int] = ()
        between: Iterable[Frame] = ()
        if previous is not None and jump is not Jump.NONE:
            between = hold(previous, frame)
        elif previous is not None:
            count = policy.count(previous, frame)
            times_us = intermediate_times_us(previous.t_us, frame.t_us, count)
            if times_us:
                between = interpolator.between(previous, frame, times_us)
        yield Pair(previous, frame, jump, times_us, between)
        previous = frame


def dense_frames(pairs: Iterable[Pair], on_cut: OnCut | None = None) -> Iterator[Frame]:
    """The frames of all pairs; `on_cut` is told of each jump before the frames that show it."""
    for pair in pairs:
        tell_jump(pair, on_cut)
        yield from pair.frames


def tell_jump(pair: Pair, on_cut: OnCut | None) -> None:
    """Tell of the jump in a pair, if there is one."""
    if pair.jump is not Jump.NONE and on_cut is not None:
        on_cut(pair.jump, pair.second.t_us)


def hold(first: Frame, second: Frame) -> Paths:
    """The earlier picture once more, just before the later one.

    Returns:
        One frame with the luma of `first`, `JUMP_DURATION_US` (or half the interval, if that is
        less) before `second`; nothing where there is no whole microsecond between the two.
    """
    wait_us = min(JUMP_DURATION_US, (second.t_us - first.t_us) // 2)
    times_us = (second.t_us - wait_us,) if wait_us > 0 else ()
    return Paths(float_luma(first), float_luma(second), None, times_us, (0.0,) * len(times_us))


def _jump(first: Frame, second: Frame, config: InterpolateConfig) -> Jump:
    if not config.detect_cuts or config.interpolate in NEVER_SMEARS:
        return Jump.NONE
    return detect_jump(first, second)
