"""A small scene with its events: a bright bar that moves right over noise."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent.video import Frame, frame_time_us

SIZE = SensorSize(32, 24)
FPS = Fraction(30_000, 1001)
METADATA = {"prompt": "a bar moves right", "seed": 0, "simulator": "texvent", "preset": "paper"}


def make_steps(
    frames: int, *, size: SensorSize = SIZE, between: int = 2, start_us: int = 5_000
) -> Iterator[tuple[Frame, EventStream]]:
    """Dense frames with their packets: `between` intermediate frames per pair."""
    before_us = start_us
    for index in range(frames * (between + 1) - between):
        t_us = frame_time_us(index, FPS * (between + 1), start_us)
        column = index % size.width
        pixels = np.full((*size.shape, 3), 40, dtype=np.float32)
        pixels[:, column] = (250.4, 180, 20)
        packet = EventStream.empty(size)
        if index:
            rows = np.arange(size.height)
            x = np.concatenate([np.full(size.height, column), np.full(size.height, column - 1)])
            p = np.repeat([1, 0], size.height)
            t = np.linspace(before_us, t_us - 1, 2 * size.height).astype(np.int64)
            packet = EventStream(x % size.width, np.tile(rows, 2), t, p, size)
        yield Frame(pixels, t_us, is_source=index % (between + 1) == 0), packet
        before_us = t_us


@pytest.fixture
def steps() -> list[tuple[Frame, EventStream]]:
    return list(make_steps(6))


@pytest.fixture
def folder_is_clean(tmp_path: Path) -> Callable[[], bool]:
    """True while nothing, hidden or not, lies in the test's folder."""
    return lambda: not list(tmp_path.iterdir())
