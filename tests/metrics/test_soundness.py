import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.transform.recordings import packets

from texvent.events import EventStream
from texvent.metrics.soundness import Soundness, SoundnessCheck, list_hot_pixels
from texvent.sensor import SensorSize

SIZE = SensorSize(40, 30)


def spread(count: int) -> EventStream:
    """Events at different times, everywhere."""
    rng = np.random.default_rng(0)
    return EventStream(
        rng.integers(0, 40, count),
        rng.integers(0, 30, count),
        np.arange(count) * 7,
        rng.integers(0, 2, count),
        SIZE,
    )


def check(*packets: EventStream) -> Soundness:
    one = SoundnessCheck(packets[0].size)
    for packet in packets:
        one.update(packet)
    report = one.report()
    assert repr(one.report()) == repr(report)  # NaN of nothing included
    return report


def test_spread_events_are_sound() -> None:
    report = check(spread(20_000))
    assert report.complaints() == []
    assert (report.events, report.duplicates, report.hot_pixels) == (20_000, 0, ())


def test_duplicates_and_contradictions_are_counted_by_hand() -> None:
    # (1, 1, 5, ON) three times, (1, 1, 5, OFF) once, (2, 1, 5, ON) once, (1, 1, 6, ON) once.
    x, t, p = [1, 1, 1, 1, 2, 1], [5, 5, 5, 5, 5, 6], [1, 0, 1, 1, 1, 1]
    events = EventStream.from_columns(x, [1] * 6, t, p, size=SIZE)
    report = check(events)
    assert (report.duplicates, report.contradictions) == (2, 1)
    assert "repeat another one exactly" in report.complaints()[0]


@given(cuts=st.lists(st.integers(0, 300), max_size=5))
def test_how_packets_are_cut_changes_nothing(cuts: list[int]) -> None:
    rng = np.random.default_rng(1)
    t = np.sort(rng.integers(0, 20, 300))
    p = rng.integers(0, 2, 300)
    events = EventStream(rng.integers(0, 3, 300), rng.integers(0, 3, 300), t, p, SIZE)
    assert check(*packets(events, cuts)) == check(events)


def test_a_hot_pixel_is_found_and_an_edge_is_not() -> None:
    counts = np.ones((30, 40), dtype=np.int64)
    counts[10, 20] = 500
    counts[:, 5] = 500
    assert list_hot_pixels(counts) == ((20, 10, 500),)
    counts[0, 0] = 700
    assert list_hot_pixels(counts)[0] == (0, 0, 700)


def test_what_many_cameras_do_is_a_note_and_not_a_complaint() -> None:
    report = Soundness(10_000, 200, 0, ((3, 4, 500),), 0.0, 0.5)
    assert report.complaints() == []
    assert report.notes() == [
        "200 events repeat another one exactly",
        "1 hot pixels with 5.0% of the events; the busiest, (3, 4), fired 500 times",
    ]
    doubled = Soundness(10_000, 5_000, 0, ((3, 4, 2_000),), 0.0, 0.5)
    assert len(doubled.complaints()) == 2
    assert doubled.notes() == []


def test_times_of_frames_are_clumped() -> None:
    events = spread(20_000)
    frames = np.sort(np.random.default_rng(2).integers(0, 30, 20_000)) * 33_333
    report = check(EventStream(events.x, events.y, frames, events.p, SIZE))
    assert report.clumped_share == pytest.approx(1.0)
    assert any("crowded timestamps" in text for text in report.complaints())


@pytest.mark.parametrize("size", [SIZE, SensorSize(346, 260), SensorSize(1280, 720)])
@pytest.mark.parametrize("beyond", [0, 1])
def test_a_crowd_is_more_than_ten_and_one_per_thousand_pixels(size, beyond) -> None:
    count = 10 + size.width * size.height // 1000 + beyond
    y, x = np.divmod(np.arange(count), size.width)
    same = np.ones(count, int)
    assert check(EventStream(x, y, 7 * same, same, size)).clumped_share == beyond


def test_a_missing_polarity_is_reported() -> None:
    events = spread(5000)
    only_on = EventStream(events.x, events.y, events.t, np.ones(5000, int), SIZE)
    assert any("one polarity is missing" in text for text in check(only_on).complaints())
