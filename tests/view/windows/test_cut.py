from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.refusals import Call, Refusal, check_refusal

from texvent.errors import ConfigError, InputError, OutputError
from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent.view.drawing.canvas import png_bytes
from texvent.view.windows import cut_counts, cut_windows, still_window_us

SIZE = SensorSize(4, 4)


def at_times(*times: int) -> EventStream:
    zeros = [0] * len(times)
    return EventStream.from_columns(zeros, zeros, list(times), zeros, size=SIZE)


@given(
    times=st.lists(st.integers(0, 3000), min_size=1, max_size=40).map(sorted),
    cut=st.integers(0, 40),
    step=st.fractions(Fraction(50, 3), 900, max_denominator=7),
    window=st.integers(1, 1000),
)
def test_windows_may_overlap_or_leave_gaps_and_count_the_events_in_them(times, cut, step, window):
    parts = [at_times(*times[:cut]), at_times(*times[cut:])]
    found = [
        (one.start_us, one.stop_us, one.event_count)
        for one in cut_windows(parts, step_us=step, window_us=window)
    ]
    starts = [times[0] + round(index * step) for index in range(3000)]
    assert found == [
        (start, start + window, sum(start <= t < start + window for t in times))
        for start in starts
        if start <= times[-1]
    ]


@pytest.mark.parametrize(("span", "window"), [(10**7, 40_000), (500_000, 10_000), (3, 1)])
def test_stills_gather_a_fiftieth_but_at_most_40_ms(span, window):
    assert still_window_us((5, 5 + span)) == window


@pytest.mark.parametrize("packet", [1, 7, 1000])
def test_slices_of_equal_count_hold_that_many_events_and_leave_none_out(packet):
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


def cut(*times: int, step_us: int = 1000, window_us: int = 1000) -> Call:
    return lambda _: [
        *cut_windows([at_times(*times)], step_us=Fraction(step_us), window_us=window_us)
    ]


REFUSED: dict[str, Refusal] = {
    "window": (cut(0, window_us=0), ConfigError, "window 0 µs, step 1000 µs; both must be above 0",
               cut(0, window_us=1)),
    "pause": (cut(0, 1_000_000, 19_000_001), InputError,
              "no event from 1 to 19 s: 18,000 images would be empty; show a part (--time START,",
              cut(0, 1_000_000, 19_000_000)),
    "width": (lambda _: png_bytes(np.zeros((1, 1_000_001), np.uint8)), OutputError,
              "an image of shape (1, 1000001) cannot be written as PNG",
              lambda _: png_bytes(np.zeros((1, 1_000_000), np.uint8))),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_windows_and_images_have_limits(name):
    check_refusal(REFUSED[name], None)
