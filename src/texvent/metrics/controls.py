"""Controls of a similarity score: its value for pairs of streams whose answer is known."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream
from texvent.metrics.protocol import Metric
from texvent.sensor import SensorSize

CONTROLLED = ("lfs", "eqs", "eqs (own RVT)")
"""Metrics that are reported with their controls: their numbers alone mislead."""

Pair: TypeAlias = tuple[EventStream, EventStream]
"""A stream to judge, and its reference."""
Generator: TypeAlias = np.random.Generator
Columns: TypeAlias = dict[str, NDArray[np.int64]]


def columns_of(events: EventStream) -> Columns:
    """x, y, t and p of a stream as int64 arrays of their own."""
    return {name: getattr(events, name).astype(np.int64) for name in "xytp"}


def stream_of(columns: Columns, like: EventStream) -> EventStream:
    """The columns in order of time; times that left the recording are reflected at its ends.

    A perturbed recording is not longer: metrics that average over its length would count
    nearly empty frames, and reward the damage.
    """
    if len(like):
        first, last = like.t[0], like.t[-1]
        columns["t"] = last - np.abs(last - first - np.abs(columns["t"] - first))
    order = np.lexsort(tuple(columns[name] for name in "pxyt"))
    x, y, t, p = (columns[name][order] for name in "xytp")
    return EventStream.from_columns(x, y, t, p, size=like.size)


def draw_columns(rng: Generator, count: int, size: SensorSize, span_us: tuple[int, int]) -> Columns:
    """Events uniform over pixels, times `[start, stop)` and polarities."""
    highs = {"x": size.width, "y": size.height, "t": span_us[1], "p": 2}
    return {
        name: rng.integers(span_us[0] if name == "t" else 0, high, count)
        for name, high in highs.items()
    }


def with_more(events: EventStream, more: Columns) -> EventStream:
    """A stream with further events."""
    columns = columns_of(events)
    return stream_of({name: np.concatenate([columns[name], more[name]]) for name in "xytp"}, events)


def shuffle_time(events: EventStream, rng: Generator) -> EventStream:
    """Times exchanged between all events: the null of the benchmark."""
    columns = columns_of(events)
    columns["t"] = rng.permutation(columns["t"])
    return stream_of(columns, events)


def shuffle_space(events: EventStream, rng: Generator) -> EventStream:
    """Coordinates exchanged between all events."""
    columns = columns_of(events)
    order = rng.permutation(len(events))
    columns["x"], columns["y"] = columns["x"][order], columns["y"][order]
    return stream_of(columns, events)


def flip(events: EventStream, rng: Generator, *, share: float) -> EventStream:
    """The polarity of a random share of the events inverted."""
    columns = columns_of(events)
    columns["p"] ^= rng.random(len(events)) < share
    return stream_of(columns, events)


def add_noise(events: EventStream, rng: Generator, *, share: float) -> EventStream:
    """Uniform random events, as a share of those there are."""
    count = round(share * len(events))
    return with_more(events, draw_columns(rng, count, events.size, events.time_range or (0, 1)))


def split_halves(events: EventStream, seed: int) -> Pair:
    """A random half of the events, and the other half: alike, without an event in common."""
    is_first = np.random.default_rng(seed).random(len(events)) < 0.5
    return events[is_first], events[~is_first]


def _rng(stream: int) -> Generator:
    return np.random.default_rng([2026, stream])


CONTROLS: Mapping[str, Callable[[EventStream], Pair]] = {
    "identity": lambda events: (events, events),
    "split half": lambda events: split_halves(events, seed=2026),
    "shuffle all times": lambda events: (shuffle_time(events, _rng(7)), events),
    "shuffle all pixels": lambda events: (shuffle_space(events, _rng(19)), events),
    "flip 100 %": lambda events: (flip(events, _rng(16), share=1.0), events),
    "noise 30 %": lambda events: (add_noise(events, _rng(12), share=0.3), events),
}
"""Name → the pair made of a reference. A score is worth something only between its split half and
its shuffles."""


def run_controls(metric: Metric, reference: EventStream) -> dict[str, float]:
    """Control → value of the metric."""
    return {name: metric(*pair(reference)) for name, pair in CONTROLS.items()}
