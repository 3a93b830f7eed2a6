"""A sample with a car that drives right, a man who stands, and events anywhere."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.dataset.layouts.layout import LayoutSample
from texvent.events import EventStream
from texvent.frames import FrameStream
from texvent.sensor import SensorSize
from texvent.truth.boxes import BOX_RECORD

SIZE = SensorSize(64, 48)
INSTANTS = np.arange(0, 250_001, 40_000)
"""A label every 40 ms: the ends of windows of 50 ms lie between."""
CAR, MAN = 0, 1


def crossing_boxes() -> np.ndarray[Any, Any]:
    """The car moves 1 px in 10 ms, at first partly out of the picture; the man comes at 120 ms."""
    rows = []
    for t_us in INSTANTS.tolist():
        rows.append((t_us, t_us / 10_000 - 4, 10, 20, 15, CAR, 7, 1))
        if t_us >= 120_000:
            rows.append((t_us, 40, 20, 8, 20, MAN, 9, 1))
    return np.array(rows, BOX_RECORD)


def crossing_events(count: int = 30_000) -> EventStream:
    chance = np.random.default_rng(5)
    t = np.sort(chance.integers(0, 240_000, count))
    t[:100], t[1000:1100] = 0, 50_000  # on the edges of windows
    t.sort()
    x, y, p = (chance.integers(0, end, count) for end in (SIZE.width, SIZE.height, 2))
    x[9_000:9_200], y[9_000:9_200] = 3, 5  # a pixel that fires often
    return EventStream.from_columns(x, y, t, p, size=SIZE)


def crossing(**changes: Any) -> LayoutSample:
    @contextmanager
    def frames() -> Iterator[FrameStream]:
        pixels = np.random.default_rng(1).integers(0, 255, (7, *SIZE.shape, 3), dtype=np.uint8)
        times_us = INSTANTS + changes.get("start_us", 0)
        yield open_frames(pixels, CaptureConfig(), t_us=times_us)

    facts: dict[str, Any] = {
        "key": "abc",
        "split": "train",
        "place": "train/abc",
        "made_of": "",
        "size": SIZE,
        "start_us": 0,
        "stop_us": 240_000,
        "boxes": crossing_boxes(),
        "instants_us": INSTANTS,
        "read_events": crossing_events,
        "read_frames": frames,
    }
    return LayoutSample(**{**facts, **changes})
