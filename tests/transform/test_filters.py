"""Filters against their rules, and hot pixels at edges and on lines."""

from itertools import compress

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples

from texvent._registry import FILTERS
from texvent.errors import ConfigError, InputError
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.options.values import option_names, read_part
from texvent.sensor import SensorSize
from texvent.transform.filters.noise_filters import (
    MaskFilter,
    RateLimitFilter,
    RefractoryFilter,
    find_hot_pixels,
    mask_hot_pixels,
)

from . import reference
from .recordings import CUTS, ROWS, SIZE, packets, rows_of, stream


@pytest.mark.parametrize("name", FILTERS.names())
@examples(120)
@given(rows=ROWS, cuts=CUTS, start=st.sampled_from([0, 10**15, -(10**15)]), data=st.data(),
       folds=st.sampled_from([(1, 1), (2, 1), (4, 3)]))  # fmt: skip
def test_every_filter_keeps_what_its_rule_says_however_packets_are_cut(
    name, rows, cuts, start, data, folds
):
    rule, values = reference.RULES[name]
    assert set(values) == set(option_names(FILTERS.load(name)))
    options = data.draw(st.fixed_dictionaries(values))
    width, height = folds  # the fewer pixels, the more events has each
    events = stream([(x % width, y % height, t + start, p) for x, y, t, p in rows])
    kept = list(compress(rows_of(events), rule(rows_of(events), **options)))
    assert rows_of(events.filter(name, **options)) == kept
    filtered = packets(events, cuts).filter(name, **options)
    assert rows_of(filtered) == kept
    assert rows_of(filtered) == kept, "each pass begins anew"
    assert rows_of(packets(events, range(len(events))).filter(name, **options)) == kept


@given(st.integers(1, 10**5), st.integers(1, 10**5))
def test_a_window_holds_whole_events(count, window_us):
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
def test_hot_pixels_are_found_at_the_edge_and_on_a_line_of_pixels(shape, hot):
    counts = np.ones(shape, np.int64)
    for place in hot:
        counts[place] = 100
    assert [*map(tuple, np.argwhere(mask_hot_pixels(counts)).tolist())] == hot


def test_a_line_that_ends_at_the_edge_is_not_hot():
    counts = np.ones((6, 8), np.int64)
    counts[:, 3] = 100
    assert not mask_hot_pixels(counts).any()
    assert not mask_hot_pixels(np.full((1, 1), 100)).any()


def test_hot_pixels_are_found_and_masked():
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


def test_a_mask_fits_its_sensor():
    events = stream([(1, 2, 3, 1), (2, 1, 4, 0)])
    mask = np.zeros((6, 8), bool)
    mask[2, 1] = True
    assert rows_of(events.filter(MaskFilter(mask))) == [(2, 1, 4, 0)]
    with pytest.raises(InputError, match="for a sensor of 6x8, the events are of 8x6"):
        events.filter("mask", pixels=mask.T)
    with pytest.raises(InputError, match="the mask is int64 of shape"):
        events.filter("mask", pixels=np.zeros((6, 8), np.int64))


def test_a_filter_by_text():
    text = "background-activity: window_us=5000 ,support=2,polarity=true"
    assert read_part(text) == (
        "background-activity", {"window_us": 5000, "support": 2, "polarity": True},
    )  # fmt: skip
    for wrong in ("refractory:period_us", "refractory:period_us=", "refractory:a=1,a=2"):
        with pytest.raises(ConfigError, match="write NAME or NAME:OPTION=VALUE"):
            read_part(wrong)


def test_unknown_names_options_and_values_are_refused():
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


def test_hot_pixels_of_packets_that_can_be_read_once_are_refused_not_lost():
    once = EventPackets(iter([stream([(1, 1, 1, 1)])]), SIZE)
    with pytest.raises(InputError):
        once.filter("hot-pixels").collect()
