from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent.view.windows import (
    cut_counts,
    cut_windows,
    still_window_us,
)

SIZE = SensorSize(4, 4)


def at_times(*times: int) -> EventStream:
    zeros = [0] * len(times)
    return EventStream.from_columns(zeros, zeros, list(times), zeros, size=SIZE)


def counted(events: list[EventStream], step: Fraction, window: int) -> list[tuple[int, int, int]]:
    return [
        (one.start_us, one.stop_us, one.event_count)
        for one in cut_windows(events, step_us=step, window_us=window)
    ]


def test_windows_by_hand_from_the_first_event_on() -> None:
    events = [at_times(100, 105, 110), at_times(110, 119, 131)]
    assert counted(events, Fraction(10), 10) == [
        (100, 110, 2),
        (110, 120, 3),
        (120, 130, 0),
        (130, 140, 1),
    ]


def test_windows_may_overlap_or_leave_gaps() -> None:
    events = [at_times(0, 5, 10, 15, 20)]
    assert [n for *_, n in counted(events, Fraction(10), 20)] == [4, 3, 1]
    assert [n for *_, n in counted(events, Fraction(10), 1)] == [1, 1, 1]


@given(
    times=st.lists(st.integers(0, 3000), min_size=1, max_size=40).map(sorted),
    cut=st.integers(0, 40),
    step=st.fractions(Fraction(50, 3), 900, max_denominator=7),
)
def test_windows_side_by_side_hold_every_event_once(
    times: list[int], cut: int, step: Fraction
) -> None:
    window = round(step)
    found = counted([at_times(*times[:cut]), at_times(*times[cut:])], step, window)
    for index, (start, stop, count) in enumerate(found):
        assert start == times[0] + round(index * step)
        assert count == sum(start <= t < stop for t in times)
    if step.denominator == 1:
        assert sum(count for *_, count in found) == len(times)


@pytest.mark.parametrize(("span", "window"), [(10**7, 40_000), (500_000, 10_000), (3, 1)])
def test_stills_gather_a_fiftieth_but_at_most_40_ms(span: int, window: int) -> None:
    assert still_window_us((5, 5 + span)) == window


@pytest.mark.parametrize("packet", [1, 7, 1000])
def test_slices_of_equal_count_hold_that_many_events_and_leave_none_out(packet: int) -> None:
    events = busy_stream()
    parts = (events[start : start + packet] for start in range(0, len(events), packet))
    windows = list(cut_counts(parts, size=events.size, count=60))
    counts = [window.event_count for window in windows]
    assert counts[:-1] == [60] * (len(counts) - 1)
    assert sum(counts) == len(events)
    for before, after in pairwise(windows):
        assert before.stop_us == after.start_us


def busy_stream() -> EventStream:
    """250 events with distinct times on a small sensor, so that pixels fire again and again."""
    step = np.arange(250)
    return EventStream(step * 7 % 8, step * 5 % 6, 100 + step * 61, step // 3 % 2, SensorSize(8, 6))
