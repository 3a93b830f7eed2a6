"""The same edits and filters in EventCV (extra `readers`), event by event."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from texvent.events import EventStream

eventcv: Any = pytest.importorskip("eventcv", reason="install texvent[readers] to compare with it")


def columns(events: EventStream) -> NDArray[Any]:
    return np.stack([events.x, events.y, events.t, events.p], axis=1).astype(np.int64)


@pytest.fixture(scope="module")
def pair() -> tuple[EventStream, Any]:
    """The same events here and there."""
    rng = np.random.default_rng(0)
    t = np.sort(rng.integers(1000, 30_000, 3000))
    x, y, p = (rng.integers(0, end, 3000) for end in (20, 16, 2))
    ours = EventStream(x, y, t, p, (20, 16))
    return ours, eventcv.from_numpy(columns(ours), sensor_size=(20, 16), time_unit="us")


def test_filters_keep_the_same_events(pair: tuple[EventStream, Any]) -> None:
    ours, theirs = pair
    for us in (0, 50, 100, 500):
        found = columns(ours.filter("background-activity", window_us=us))
        expected = theirs.background_activity_filter(us)
        np.testing.assert_array_equal(found, expected.numpy().astype(np.int64))
        found = columns(ours.filter("refractory", period_us=us))
        np.testing.assert_array_equal(found, theirs.refractory_filter(us).numpy().astype(np.int64))


def test_the_sensor_is_turned_mirrored_and_cropped_the_same_way(
    pair: tuple[EventStream, Any],
) -> None:
    ours, theirs = pair
    both = [
        *((ours.rotate(90 * k), theirs.rotate90(k)) for k in (1, 2, 3)),
        (ours.flip("x"), theirs.flip_x()),
        (ours.flip("y"), theirs.flip_y()),
        (ours.crop(2, 3, 9, 8), theirs.crop(2, 3, 9, 8)),
    ]
    for mine, other in both:
        np.testing.assert_array_equal(columns(mine), other.numpy().astype(np.int64))
