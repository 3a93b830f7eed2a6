"""Filters: by hand, compiled against the reference, packet by packet against the whole."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent._registry import FILTERS as REGISTRY
from texvent.errors import ConfigError, InputError
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.options.parts import read_part
from texvent.sensor import SensorSize
from texvent.transform.filters import kernels_cpu
from texvent.transform.filters.noise_filters import (
    MaskFilter,
    RateLimitFilter,
    RefractoryFilter,
    find_hot_pixels,
    mask_hot_pixels,
)

from . import reference
from .recordings import SIZE, crowded, packets, rows_of, stream, streams

FILTERS = (
    "background-activity:window_us=3",
    "background-activity:window_us=8,support=2,radius=2",
    "background-activity:window_us=8,polarity=true",
    "refractory:period_us=4",
    "rate-limit:rate_hz=2e6,window_us=2",
    "rate-limit:rate_hz=1e6,window_us=7",
    "hot-pixels:factor=1.5,least_events=2",
)


def test_background_activity_by_hand() -> None:
    events = stream([
        (3, 3, 0, 1),  # alone
        (4, 4, 10, 0),  # a diagonal neighbour, 10 µs before
        (4, 4, 11, 0),  # its own pixel does not count, the neighbour is 11 µs ago
        (6, 4, 12, 1),  # two columns away
        (5, 4, 12, 1),  # neighbours on both sides
    ])  # fmt: skip
    kept = events.filter("background-activity", window_us=10)
    assert rows_of(kept) == [(4, 4, 10, 0), (5, 4, 12, 1)]
    assert rows_of(events.filter("background-activity", window_us=10, support=2)) == [(5, 4, 12, 1)]
    same = events.filter("background-activity", window_us=10, polarity=True)
    assert rows_of(same) == [(5, 4, 12, 1)]
    wide = events.filter("background-activity", window_us=10, radius=2)
    assert rows_of(wide)[1] == (6, 4, 12, 1)
    assert len(events.filter("background-activity", window_us=0)) == 1


def test_a_refractory_period_runs_from_the_last_event_that_was_kept() -> None:
    events = stream([(1, 1, t, p) for t, p in ((0, 1), (9, 0), (10, 1), (15, 1), (20, 0))])
    assert events.filter("refractory", period_us=10).t.tolist() == [0, 10, 20]
    assert len(events.filter(RefractoryFilter(period_us=0))) == 5


def test_a_rate_limit_keeps_the_first_events_of_a_window() -> None:
    events = stream([(x, 0, t, 1) for x, t in enumerate([0, 0, 4, 5, 9, 9, 9])])
    assert events.filter("rate-limit", rate_hz=4e5, window_us=5).x.tolist() == [0, 1, 3, 4]
    with pytest.raises(ConfigError, match="give window_us of at least 1000"):
        events.filter("rate-limit", rate_hz=1e3, window_us=5)


@given(st.integers(1, 10**5), st.integers(1, 10**5))
def test_a_window_holds_whole_events(count: int, window_us: int) -> None:
    """Also where the float nearest to the rate lies below it, as 3 / 700e-6 does."""
    for rate_hz in (count / (window_us * 1e-6), count * 1e6 / window_us):
        assert RateLimitFilter(rate_hz=rate_hz, window_us=window_us).most == count
        more = RateLimitFilter(rate_hz=rate_hz * 1.0000001, window_us=window_us)
        assert more.most == count
    if count > 1:
        less = RateLimitFilter(rate_hz=count * 0.9999999e6 / window_us, window_us=window_us)
        assert less.most == count - 1


@pytest.mark.parametrize(
    ("shape", "hot"),
    [
        ((1, 9), [(0, 4)]),
        ((1, 9), [(0, 0), (0, 1)]),
        ((9, 1), [(8, 0)]),
        ((6, 8), [(0, 3), (1, 3)]),
        ((6, 8), [(0, 0), (0, 1)]),
        ((6, 8), [(4, 6), (5, 7)]),
        ((6, 8), [(0, 0)]),
    ],
)
def test_hot_pixels_are_found_at_the_edge_and_on_a_line_of_pixels(
    shape: tuple[int, int], hot: list[tuple[int, int]]
) -> None:
    counts = np.ones(shape, np.int64)
    for place in hot:
        counts[place] = 100
    assert [*map(tuple, np.argwhere(mask_hot_pixels(counts)).tolist())] == hot


def test_a_line_that_ends_at_the_edge_is_not_hot() -> None:
    counts = np.ones((6, 8), np.int64)
    counts[:, 3] = 100
    assert not mask_hot_pixels(counts).any()
    assert not mask_hot_pixels(np.full((1, 1), 100)).any()


def test_hot_pixels_are_found_and_masked() -> None:
    rng = np.random.default_rng(0)
    size = SensorSize(32, 24)
    count = 6000
    x, y = rng.integers(0, 32, count), rng.integers(0, 24, count)
    hot = rng.random(count) < 0.2
    x[hot], y[hot] = 5, 7
    t = np.sort(rng.integers(0, 10**6, count))
    events = EventStream(x, y, t, rng.integers(0, 2, count), size)
    mask = find_hot_pixels(events)
    assert np.argwhere(mask).tolist() == [[7, 5]]
    assert len(events.filter("hot-pixels")) == count - int((hot | (x == 5) & (y == 7)).sum())
    assert events.filter("mask", pixels=mask).equals(events.filter("hot-pixels"))
    assert find_hot_pixels(packets(events, [100, 3000])).tolist() == mask.tolist()


def test_a_mask_fits_its_sensor() -> None:
    events = stream([(1, 2, 3, 1), (2, 1, 4, 0)])
    mask = np.zeros((6, 8), bool)
    mask[2, 1] = True
    assert rows_of(events.filter(MaskFilter(mask))) == [(2, 1, 4, 0)]
    with pytest.raises(InputError, match="for a sensor of 6x8, the events are of 8x6"):
        events.filter("mask", pixels=mask.T)
    with pytest.raises(InputError, match="the mask is int64 of shape"):
        events.filter("mask", pixels=np.zeros((6, 8), np.int64))


def test_no_filter_is_forgotten() -> None:
    assert {read_part(text)[0] for text in FILTERS} | {"mask"} == set(REGISTRY.builtin)


@pytest.mark.parametrize("text", FILTERS)
def test_packets_cut_at_any_event_give_what_the_whole_gives(text: str) -> None:
    events = crowded()
    whole = events.filter(text)
    assert 0 < len(whole) < len(events)
    for cuts in (range(60), range(0, 60, 7), [1], [2, 2, 31], [59]):
        filtered = packets(events, cuts).filter(text)
        assert filtered.collect() == whole
        assert filtered.collect() == whole  # each pass begins anew


@given(
    streams(), st.integers(0, 20), st.integers(1, 4), st.integers(1, 3), st.booleans(),
    st.integers(-(10**15), 10**15),
)  # fmt: skip
def test_the_compiled_filters_equal_the_reference(
    events: EventStream, window: int, support: int, radius: int, polarity: bool, start: int
) -> None:
    plane = events.p if polarity else np.zeros_like(events.p)
    t = events.t + start
    seen = [np.full((2, *SIZE.shape), reference.NEVER, np.int64) for _ in range(2)]
    columns = events.x, events.y, t, plane
    expected = reference.find_supported(*columns, seen[0], window, support, radius)
    found = kernels_cpu.find_supported(*columns, seen[1], window, support, radius)
    np.testing.assert_array_equal(found, expected)
    np.testing.assert_array_equal(*seen)

    kept = [np.full(SIZE.shape, reference.NEVER, np.int64) for _ in range(2)]
    expected = reference.find_rested(events.x, events.y, t, kept[0], window)
    found = kernels_cpu.find_rested(events.x, events.y, t, kept[1], window)
    np.testing.assert_array_equal(found, expected)
    np.testing.assert_array_equal(*kept)


def test_a_filter_by_text() -> None:
    text = "background-activity: window_us=5000 ,support=2,polarity=true"
    assert read_part(text) == (
        "background-activity", {"window_us": 5000, "support": 2, "polarity": True},
    )  # fmt: skip
    for wrong in ("refractory:period_us", "refractory:period_us=", "refractory:a=1,a=2"):
        with pytest.raises(ConfigError, match="write NAME or NAME:OPTION=VALUE"):
            read_part(wrong)


def test_unknown_names_options_and_values_are_refused() -> None:
    events = stream([])
    with pytest.raises(ConfigError, match=r"unknown event filter 'hot-pixel'.*hot-pixels"):
        events.filter("hot-pixel")
    with pytest.raises(ConfigError, match="refractory has no option 'period'"):
        events.filter("refractory", period=5)
    with pytest.raises(ConfigError, match=r"refractory: period_us is 1\.5; it must be a whole"):
        events.filter("refractory:period_us=1.5")
    with pytest.raises(ConfigError, match=r"support is 9; it must be 1\.\.8"):
        events.filter("background-activity", support=9)
    with pytest.raises(ConfigError, match="mask needs pixels"):
        events.filter("mask")
    with pytest.raises(ConfigError, match="options belong to a filter called by its name"):
        events.filter(RefractoryFilter(), period_us=3)


def test_hot_pixels_of_packets_that_can_be_read_once_are_refused_not_lost() -> None:
    once = EventPackets(iter([stream([(1, 1, 1, 1)])]), SIZE)
    with pytest.raises(InputError):
        once.filter("hot-pixels").collect()
