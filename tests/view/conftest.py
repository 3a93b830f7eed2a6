"""A small scene with its events: a bright bar that moves right over noise."""

from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from texvent.events import EventStream
from texvent.frames import Frame, frame_time_us
from texvent.sensor import SensorSize

SIZE = SensorSize(32, 24)
FPS = Fraction(30_000, 1001)
BETWEEN, START_US = 2, 5_000
"""Intermediate frames of a pair, and the time of the first frame."""


@pytest.fixture
def steps() -> list[tuple[Frame, EventStream]]:
    """Dense frames, six of them of the source, with their packets."""
    made, rows = [], np.arange(SIZE.height)
    for index in range(6 * (BETWEEN + 1) - BETWEEN):
        t_us = frame_time_us(index, FPS * (BETWEEN + 1), START_US)
        pixels = np.full((*SIZE.shape, 3), 40, dtype=np.float32)
        pixels[:, index] = (250.4, 180, 20)
        packet = EventStream.empty(SIZE)
        if index:
            x = np.repeat([index, index - 1], SIZE.height)
            p = np.repeat([1, 0], SIZE.height)
            t = np.linspace(made[-1][0].t_us, t_us - 1, 2 * SIZE.height).astype(np.int64)
            packet = EventStream(x, np.tile(rows, 2), t, p, SIZE)
        made.append((Frame(pixels, t_us, is_source=index % (BETWEEN + 1) == 0), packet))
    return made


@pytest.fixture
def folder_is_clean(tmp_path: Path) -> Callable[[], bool]:
    """True while nothing, hidden or not, lies in the test's folder."""
    return lambda: not list(tmp_path.iterdir())
