"""What holds for every representation; a new one is tested the moment it is registered."""

from typing import get_type_hints

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.transform.recordings import CUTS, packets

from texvent._registry import REPRESENTATIONS
from texvent.errors import ConfigError
from texvent.events import EventStream
from texvent.represent.named import (
    WINDOW_OPTIONS,
    load_representation,
    option_names_of,
    represent,
    represent_window,
)
from texvent.represent.slices import slices

from . import definitions
from .definitions import SMALL, random_events, streams

ALL = REPRESENTATIONS.names()


@pytest.mark.parametrize("name", ALL)
@given(events=streams(), data=st.data())
def test_every_representation_equals_its_definition_with_any_options(name, events, data):
    define, values = definitions.DEFINITIONS[name]
    assert tuple(values) == option_names_of(load_representation(name))
    drawn = data.draw(st.fixed_dictionaries({}, optional=values))
    if "rectify_map" in drawn:
        drawn["normalise"] = False  # a share that only rounding leaves would count as a voxel
    options = definitions.from_first(drawn, events)
    found, expected = represent(name, events, **options), define(events, **options)
    assert found.dtype == expected.dtype
    rounded = expected.dtype.kind == "f"
    np.testing.assert_allclose(found, expected, rtol=3e-7 * rounded, atol=3e-7 * rounded)


@pytest.mark.parametrize("name", ALL)
@given(events=streams(), later_us=st.sampled_from([1, 86_400_000_000, 10**15]))
def test_mirrored_events_give_a_mirrored_array_and_later_ones_the_same(name, events, later_us):
    later = EventStream(events.x, events.y, events.t + later_us, events.p, SMALL)
    found = represent(name, events)
    np.testing.assert_array_equal(represent(name, later), found)
    for axes, axis in (("x", -1), ("y", -2)):
        mirrored = np.flip(represent(name, events.flip(axes)), axis)
        np.testing.assert_allclose(mirrored, found, rtol=3e-7, atol=3e-7)


@pytest.mark.parametrize("name", ALL)
@given(events=streams(least=1), cuts=CUTS, length=st.sampled_from([2, 20_000]))
def test_however_packets_are_cut_their_arrays_are_those_of_the_slices(name, events, cuts, length):
    kind = "count" if length == 2 else "duration_us"
    found = list(packets(events, cuts).represent(name, **{kind: length}))
    parts = slices(events, **{kind: length})
    for number, (one, part) in enumerate(zip(found, parts, strict=True)):
        start = int(events.t[0]) + number * length
        window = (start, start + length)
        alone = represent(name, part) if kind == "count" else represent_window(name, part, window)
        np.testing.assert_array_equal(one, alone)


@pytest.mark.parametrize("name", ALL)
def test_an_option_goes_before_the_window(name):
    events, known = random_events(2, 40, SMALL), option_names_of(load_representation(name))
    window = (0, int(events.t[-1]) + 9)
    filled = {one: window[end] for one, end in WINDOW_OPTIONS.items() if one in known}
    for option in filled:
        given = {option: int(events.t[20])}
        found = represent_window(name, events, window, **given)
        np.testing.assert_array_equal(found, represent(name, events, **{**filled, **given}))
        assert not np.array_equal(found, represent(name, events, **filled))


@pytest.mark.parametrize("name", ALL)
def test_no_events_give_zeros_of_the_usual_shape_and_type(name):
    nothing = represent(name, EventStream.empty(SMALL))
    something = represent(name, random_events(1, 30, SMALL))
    assert (nothing.shape, nothing.dtype) == (something.shape, something.dtype)
    assert something.shape[-2:] == SMALL.shape
    assert something.any()
    assert not nothing.any()


@pytest.mark.parametrize("name", ALL)
def test_convention_the_callers_arrays_stay_as_they_are(name):
    columns = [np.array([1, 2]), np.array([0, 1]), np.array([5, 9]), np.array([0, 1], np.uint8)]
    before = [column.copy() for column in columns]
    result = represent(name, EventStream(*columns, SMALL))
    result[...] = 1
    for column, was in zip(columns, before, strict=True):
        np.testing.assert_array_equal(column, was)


def test_unknown_names_and_options_suggest_the_closest():
    with pytest.raises(ConfigError, match="did you mean 'voxel-zhu'"):
        represent("voxel-zu", EventStream.empty(SMALL))
    with pytest.raises(ConfigError, match=r"voxel-e2vid has no option 'bin'.*did you mean 'bins'"):
        represent("voxel-e2vid", EventStream.empty(SMALL), bin=5)


@pytest.mark.parametrize("name", ALL)
def test_every_representation_refuses_options_of_another_type_and_bins_out_of_range(name):
    hints = get_type_hints(REPRESENTATIONS.load(name))
    for option, hint in hints.items():
        if hint in (bool, int, float):
            with pytest.raises(ConfigError, match=f"^{name}: {option} is"):
                represent(name, EventStream.empty(SMALL), **{option: "5"})
    for bins in (0, 4097) if "bins" in hints else ():
        with pytest.raises(ConfigError, match=r"bins is .*1\.\.4096"):
            represent(name, EventStream.empty(SMALL), bins=bins)
