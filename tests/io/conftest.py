"""Streams that event files must carry unchanged."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from texvent.events import EventStream
from texvent.sensor import SensorSize

METADATA = {
    "prompt": 'a "red" car 🚗 drives left',
    "seed": 0,
    "threshold": 0.25,
    "nested": {"list": [1, 2.5, None], "yes": True},
}


def make_events(
    count: int, *, size: SensorSize | None = None, span_us: int = 50_000, seed: int = 3
) -> EventStream:
    size = size or SensorSize(64, 48)
    rng = np.random.default_rng(seed)
    return EventStream(
        rng.integers(0, size.width, count),
        rng.integers(0, size.height, count),
        np.sort(rng.integers(0, span_us, count)),
        rng.integers(0, 2, count),
        size,
        METADATA,
    )


STREAMS: dict[str, Callable[[], EventStream]] = {
    "no event": lambda: EventStream.empty(SensorSize(7, 5), METADATA),
    "one event": lambda: make_events(1),
    "equal times": lambda: EventStream.from_columns(
        [0, 1, 2, 3], [0, 0, 0, 0], [9, 9, 9, 9], [1, 0, 1, 0], size=SensorSize(4, 1)
    ),
    "largest coordinates": lambda: EventStream.from_columns(
        [0, 65_534, 65_534],
        [65_534, 0, 65_534],
        [0, 1, 2],
        [0, 1, 1],
        size=SensorSize(65_535, 65_535),
    ),
    "times past 32 bits": lambda: EventStream.from_columns(
        [1, 2, 3], [1, 2, 3], [2**32 - 1, 2**32, 2**32 + 1], [1, 0, 1], size=SensorSize(9, 9)
    ),
    "more than one chunk": lambda: make_events(150_000),
}


@pytest.fixture(params=STREAMS, ids=lambda name: name.replace(" ", "-"))
def stream(request: pytest.FixtureRequest) -> EventStream:
    return STREAMS[request.param]()


@pytest.fixture
def folder_is_clean(tmp_path: Path) -> Callable[[], bool]:
    """True while nothing, hidden or not, lies in the test's folder."""
    return lambda: not list(tmp_path.iterdir())
