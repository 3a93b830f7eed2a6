"""Twenty perturbations of a recording."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import TypeAlias

import numpy as np

from texvent.events import EventStream
from texvent.metrics.controls import (
    Generator,
    add_noise,
    columns_of,
    draw_columns,
    flip,
    shuffle_space,
    shuffle_time,
    stream_of,
)

Perturbation: TypeAlias = Callable[[EventStream, Generator], EventStream]

FRAME_RATE_HZ = 24


def jitter_time(events: EventStream, rng: Generator, *, sd_ms: float) -> EventStream:
    """Times moved by normal noise."""
    columns = columns_of(events)
    columns["t"] += np.rint(rng.normal(0, sd_ms * 1000, len(events))).astype(np.int64)
    return stream_of(columns, events)


def shift_time(events: EventStream, rng: Generator, *, shift_ms: float) -> EventStream:
    """All times moved by the same amount."""
    del rng
    columns = columns_of(events)
    columns["t"] += round(shift_ms * 1000)
    return stream_of(columns, events)


def batch(events: EventStream, rng: Generator, *, rate_hz: int) -> EventStream:
    """Times moved to the end of their frame: what a simulator without time stamps gives."""
    del rng
    columns = columns_of(events)
    frame = -(-columns["t"] * rate_hz // 1_000_000)
    columns["t"] = frame * 1_000_000 // rate_hz
    return stream_of(columns, events)


def shuffle_in_frames(events: EventStream, rng: Generator) -> EventStream:
    """Times exchanged between the events of each 1/24 s."""
    columns = columns_of(events)
    frame = columns["t"] * FRAME_RATE_HZ // 1_000_000
    # Times ascend, so the sorted frame numbers are those of the unshuffled times.
    columns["t"] = columns["t"][np.argsort(np.lexsort((rng.random(len(events)), frame)))]
    return stream_of(columns, events)


def drop(events: EventStream, rng: Generator, *, share: float) -> EventStream:
    """A random share of the events lost."""
    return events[rng.random(len(events)) >= share]


def scatter(events: EventStream, rng: Generator, *, share: float) -> EventStream:
    """A random share of the events moved to random pixels, times and polarities."""
    is_moved = rng.random(len(events)) < share
    columns = columns_of(events)
    moved = draw_columns(rng, int(is_moved.sum()), events.size, events.time_range or (0, 1))
    for name, values in moved.items():
        columns[name][is_moved] = values
    return stream_of(columns, events)


def move_right(events: EventStream, rng: Generator) -> EventStream:
    """Everything one pixel to the right; the last column stays."""
    del rng
    columns = columns_of(events)
    columns["x"] = np.minimum(columns["x"] + 1, events.size.width - 1)
    return stream_of(columns, events)


def jitter_space(events: EventStream, rng: Generator) -> EventStream:
    """Each event up to one pixel away, in x and y."""
    columns = columns_of(events)
    for name, side in (("x", events.size.width), ("y", events.size.height)):
        moved = columns[name] + rng.integers(-1, 2, len(events))
        columns[name] = np.clip(moved, 0, side - 1)
    return stream_of(columns, events)


PERTURBATIONS: Mapping[str, Perturbation] = {
    "jitter 0.5 ms": partial(jitter_time, sd_ms=0.5),
    "jitter 2 ms": partial(jitter_time, sd_ms=2.0),
    "jitter 8 ms": partial(jitter_time, sd_ms=8.0),
    "shift 2 ms": partial(shift_time, shift_ms=2.0),
    "batch 240 Hz": partial(batch, rate_hz=240),
    "batch 24 Hz": partial(batch, rate_hz=24),
    "shuffle in frames": shuffle_in_frames,
    "shuffle all times": shuffle_time,
    "drop 10 %": partial(drop, share=0.1),
    "drop 30 %": partial(drop, share=0.3),
    "drop 50 %": partial(drop, share=0.5),
    "noise 10 %": partial(add_noise, share=0.1),
    "noise 30 %": partial(add_noise, share=0.3),
    "noise 100 %": partial(add_noise, share=1.0),
    "flip 5 %": partial(flip, share=0.05),
    "flip 20 %": partial(flip, share=0.2),
    "flip 100 %": partial(flip, share=1.0),
    "right 1 px": move_right,
    "jitter 1 px": jitter_space,
    "shuffle all pixels": shuffle_space,
}
"""Name → what it does to a stream."""


def perturb(events: EventStream, name: str) -> EventStream:
    """The stream after the perturbation `name`; the same each time."""
    index = list(PERTURBATIONS).index(name)
    return PERTURBATIONS[name](events, np.random.default_rng([2026, index]))
