"""Small clips for the GPU backend, and what the CPU makes of them."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from texvent.events import EventStream
from texvent.frames import Frame

CLIPS, FRAMES, HEIGHT, WIDTH = 2, 5, 20, 24
SEED = 7
EVERY_SOURCE = (True,) * FRAMES
TWO_PAIRS = (True, False, False, True, False)


def random_clips(dtype: Any, *, seed: int = 0) -> np.ndarray[Any, Any]:
    """[B, T, H, W] brightness that wanders, 0..255 scale; the first columns are nearly black."""
    steps = np.random.default_rng(seed).normal(0, 25, (CLIPS, FRAMES, HEIGHT, WIDTH))
    first = np.where(np.arange(WIDTH) < WIDTH // 4, 4, 100)
    return np.clip(first + steps.cumsum(axis=1), 0, 255).astype(dtype)


def random_times(*, seed: int = 0) -> np.ndarray[Any, Any]:
    """[B, T] µs, other intervals in every clip."""
    return np.random.default_rng(seed).integers(500, 3000, (CLIPS, FRAMES)).cumsum(axis=1)


def on_cpu(
    simulator: Any, frames: Any, times_us: Any, is_source: Sequence[bool] = EVERY_SOURCE
) -> EventStream:
    """The events of one clip, frame by frame, from a simulator that runs on the CPU."""
    return EventStream.concat(
        simulator.step(Frame(pixels, int(t_us), is_source=flag))
        for pixels, t_us, flag in zip(frames, times_us, is_source, strict=True)
    )


def on_gpu(
    torch: Any,
    simulator: Any,
    frames: Any,
    times_us: Any,
    is_source: Sequence[bool] = EVERY_SOURCE,
    *,
    device: str,
    chunks: Sequence[int] = (FRAMES,),
) -> list[EventStream]:
    """The events of every clip, from a GpuSimulator that gets so many frames at a time."""
    parts: list[list[EventStream]] = []
    at = 0
    for size in chunks:
        now = slice(at, at + size)
        events = simulator.step(
            torch.from_numpy(frames[:, now]).to(device), times_us[:, now], is_source[now]
        )
        parts.append([events.stream(clip) for clip in range(len(frames))])
        at += size
    return [EventStream.concat(clip) for clip in zip(*parts, strict=True)]


def rows(events: EventStream) -> np.ndarray[Any, Any]:
    """[n, 5]: t, y, x, p, label."""
    columns = (events.t, events.y, events.x, events.p, events.label)
    return np.stack([np.asarray(column, np.int64) for column in columns], axis=1)
