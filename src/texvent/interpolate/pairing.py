"""Source frames → pairs of frames, with the intermediate frames that go between them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import ExitStack, closing
from dataclasses import replace

from texvent._registry import INTERPOLATORS
from texvent.config import InterpolateConfig
from texvent.frames import Frame, FrameStream, MovingStream, StreamChecker
from texvent.interpolate.count_policy import CountPolicy
from texvent.interpolate.protocol import Interpolator
from texvent.pairs.deflicker import steady_frames
from texvent.pairs.frame_pair import FramePair, hold_earlier
from texvent.pairs.instants import intermediate_times_us
from texvent.pairs.on_device import pixels_on
from texvent.pairs.scene_change import SceneChange, detect_scene_change
from texvent.pairs.time_jump import watch_steps
from texvent.runtime.devices import Device, explain_device_memory
from texvent.runtime.memory import release_freed_memory
from texvent.runtime.work.worker_threads import prefetch

FRAMES_AHEAD = 2
PAIRS_AHEAD = 1
"""Frames and pairs that wait to be used; a pair holds two frames and their optical flow."""
RELEASE_EVERY_PAIRS = 128
"""Pairs after which freed memory goes back to the system: some five seconds of video."""
NEVER_SMEARS = frozenset({"none", "exact"})
"""Interpolators that mix no frames: they cannot smear a cut, so none is looked for."""


def plan_pairs(
    video: FrameStream,
    config: InterpolateConfig,
    threads: ExitStack,
    *,
    balance: float,
    contrast_threshold: float,
    counts_motion: bool = False,
    gpu: Device | None = None,
    is_resident: bool = False,
) -> Iterator[FramePair]:
    """The pairs of a video, prepared in threads that run ahead of the caller.

    One thread decodes, another detects scene changes, counts (Eq. 4) and estimates optical flow;
    the pairs are those of one thread. A live source is read only when its next frame is needed:
    what it shows may depend on the events, and nothing could interrupt a thread that waits for it.

    Args:
        video: source frames.
        config: how many intermediate frames there are, and what makes them.
        threads: ends the threads when it is closed.
        balance: the simulator's α, for Eq. 4.
        contrast_threshold: the simulator's δ, for Eq. 4.
        counts_motion: whether the simulator gains from more frames under fast motion; then
            motion counts unless `config.frames_per_pixel` is set.
        gpu: torch.device of an interpolator's network; None: the CPU.
        is_resident: whether the simulator is on it too, so that frames go up and stay there.

    Raises:
        ConfigError: there is no such interpolator.
        InputError: as `pair_frames` and `watch_steps`, while iterating.
    """
    if config.interpolate == "motion" and isinstance(video, MovingStream):
        # Every instant of such a stream is known: nothing can be cut, and nothing flickers unseen.
        video = video.with_motion()
        config = replace(config, detect_cuts=False, deflicker=False)
    kind = INTERPOLATORS.load(config.interpolate)
    on_gpu = {"device": gpu} if gpu is not None and getattr(kind, "takes_device", False) else {}
    interpolator = kind(config, video, **on_gpu)
    device = gpu if is_resident else None
    policy = CountPolicy(
        config,
        video,
        interpolator,
        balance=balance,
        contrast_threshold=contrast_threshold,
        counts_motion=counts_motion,
        device=device,
    )
    watched = watch_steps(video, is_live=video.is_live)
    if video.is_live:
        pairs = pair_frames(watched, interpolator, config, policy)
        return _release_memory(pairs)
    ready = _with_luma(watched) if device is None else _begin_copies(watched, device)
    frames = threads.enter_context(closing(prefetch(ready, depth=FRAMES_AHEAD)))
    pairs = pair_frames(frames, interpolator, config, policy)
    ahead = threads.enter_context(closing(prefetch(pairs, depth=PAIRS_AHEAD)))
    return _release_memory(ahead)


def pair_frames(
    frames: Iterable[Frame],
    interpolator: Interpolator,
    config: InterpolateConfig,
    policy: CountPolicy,
) -> Iterator[FramePair]:
    """Source frames as pairs with the frames between them; the first pair has no earlier frame.

    Source frames keep their pixels unless `config` removes flicker; at most two are held at a time.
    What a pair costs once, such as its optical flow, is computed here; its intermediate frames are
    made when `FramePair.between` is read. So one thread may run ahead here while another reads.

    Args:
        frames: source frames.
        interpolator: makes the intermediate frames.
        config: whether flicker and cuts are looked for.
        policy: how many intermediate frames there are.

    Raises:
        InputError: a source frame has another size than the first, a time that does not
            increase, or a pixel that is NaN, infinite or negative.

    Equation: (4), section 3.2.1.
    Deviation: the paper interpolates across scene cuts; here the earlier image is held and the
        change happens within the last millisecond. Light that is known to beat between the
        frames gets enough intermediate frames to be seen, where they can be rendered.
    """
    previous: Frame | None = None
    checked = map(StreamChecker().check, frames)
    for frame in steady_frames(checked) if config.deflicker else checked:
        if previous is None:
            yield FramePair(None, frame, SceneChange.NONE, (), ())
        else:
            yield _make_pair(previous, frame, interpolator, config, policy)
        previous = frame


def _make_pair(
    previous: Frame,
    frame: Frame,
    interpolator: Interpolator,
    config: InterpolateConfig,
    policy: CountPolicy,
) -> FramePair:
    policy.look_at(previous, frame)
    change = _scene_change(previous, frame, config)
    if change is not SceneChange.NONE:
        return FramePair(previous, frame, change, (), hold_earlier(previous, frame))
    count = policy.count(previous, frame)
    times_us = intermediate_times_us(previous.t_us, frame.t_us, count)
    between: Iterable[Frame] = ()
    if times_us:
        between = interpolator.between(previous, frame, times_us)
    return FramePair(previous, frame, change, times_us, between)


def _scene_change(first: Frame, second: Frame, config: InterpolateConfig) -> SceneChange:
    if not config.detect_cuts or config.interpolate in NEVER_SMEARS:
        return SceneChange.NONE
    return detect_scene_change(first, second)


def _with_luma(frames: Iterable[Frame]) -> Iterator[Frame]:
    """The frames with their luma computed; it is cached, so it costs the reading thread only."""
    for frame in frames:
        frame.luma  # noqa: B018  (a cached property)
        yield frame


def _begin_copies(frames: Iterable[Frame], device: Device) -> Iterator[Frame]:
    """The frames, each on its way to the device."""
    for frame in frames:
        with explain_device_memory(device, frame.size):
            pixels_on(frame, device)
        yield frame


def _release_memory(pairs: Iterable[FramePair]) -> Iterator[FramePair]:
    """The pairs; now and then, what earlier ones have freed goes back to the system."""
    for number, pair in enumerate(pairs, start=1):
        yield pair
        if number % RELEASE_EVERY_PAIRS == 0:
            release_freed_memory()
