"""Pairs of source frames, decoded and planned in threads that run ahead of the simulator."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import ExitStack, closing

from texvent._registry import INTERPOLATORS
from texvent.config import InterpolateConfig
from texvent.interpolate.count_policy import CountPolicy
from texvent.interpolate.densify import Pair, pair_up
from texvent.runtime.allocator import release_freed_memory
from texvent.runtime.prefetch import prefetch
from texvent.simulate.protocol import Simulator
from texvent.video import Frame, FrameStream

FRAMES_AHEAD = 2
PAIRS_AHEAD = 1
"""What waits to be used; a pair holds two frames and their optical flow."""
RELEASE_EVERY_PAIRS = 128
"""Pairs after which freed memory goes back to the system: some five seconds of video."""


def plan_pairs(
    video: FrameStream, config: InterpolateConfig, simulator: Simulator, threads: ExitStack
) -> Iterator[Pair]:
    """The pairs of a video, with what goes between them.

    One thread decodes, another looks for cuts, counts (Eq. 4) and estimates optical flow; the
    pairs are those of one thread. A live source is read only when its next frame is asked for:
    what it shows may depend on the events, and nothing could interrupt a thread that waits for it.

    Args:
        video: source frames.
        config: how many intermediate frames there are, and what makes them.
        simulator: its α and δ count, unless `config` has others.
        threads: ends the threads when it is closed.

    Raises:
        ConfigError: there is no such interpolator.
        InputError: as `pair_up`, while iterating.
    """
    interpolator = INTERPOLATORS.load(config.interpolate)(config, video)
    policy = CountPolicy(
        config,
        video,
        interpolator,
        balance=simulator.balance,
        contrast_threshold=simulator.contrast_threshold,
    )
    if video.is_live:
        return _release_memory(pair_up(video, interpolator, config, policy))
    frames = threads.enter_context(closing(prefetch(_with_luma(video), depth=FRAMES_AHEAD)))
    pairs = pair_up(frames, interpolator, config, policy)
    ahead = threads.enter_context(closing(prefetch(pairs, depth=PAIRS_AHEAD)))
    return _release_memory(ahead)


def _with_luma(frames: Iterable[Frame]) -> Iterator[Frame]:
    """The frames, with their luma computed: it is kept, so it costs the reading thread only."""
    for frame in frames:
        frame.luma  # noqa: B018  (a cached property)
        yield frame


def _release_memory(pairs: Iterable[Pair]) -> Iterator[Pair]:
    """The pairs; now and then, what earlier ones have freed goes back to the system."""
    for number, pair in enumerate(pairs, start=1):
        yield pair
        if number % RELEASE_EVERY_PAIRS == 0:
            release_freed_memory()
