"""What holds for every representation; a new one is tested the moment it is registered."""

from typing import get_type_hints

import numpy as np
import pytest

from texvent._registry import REPRESENTATIONS
from texvent.errors import ConfigError
from texvent.events import EventStream
from texvent.represent.named import represent

from .definitions import SMALL, random_events

ALL = REPRESENTATIONS.names()


@pytest.mark.parametrize("name", ALL)
def test_no_events_give_zeros_of_the_usual_shape_and_type(name):
    nothing = represent(name, EventStream.empty(SMALL))
    something = represent(name, random_events(1, 30, SMALL))
    assert nothing.shape == something.shape
    assert nothing.shape[-2:] == SMALL.shape
    assert nothing.dtype == something.dtype
    assert not nothing.any()
    assert something.any()


@pytest.mark.parametrize("name", ALL)
def test_convention_the_callers_arrays_stay_as_they_are(name):
    columns = [np.array([1, 2]), np.array([0, 1]), np.array([5, 9]), np.array([0, 1], np.uint8)]
    before = [column.copy() for column in columns]
    result = represent(name, EventStream(*columns, SMALL))
    result[...] = 1
    for column, was in zip(columns, before, strict=True):
        np.testing.assert_array_equal(column, was)


@pytest.mark.parametrize("name", ALL)
def test_one_event_at_the_far_corner_stays_inside(name):
    result = represent(name, EventStream([3], [2], [10**15], [1], SMALL))
    assert not result[..., :2, :3].any()


def test_options_reach_the_representation():
    assert represent("voxel-e2vid", random_events(1, 30, SMALL), bins=7).shape == (7, 3, 4)
    assert represent("event-frame", random_events(1, 30, SMALL), kind="count").shape == (2, 3, 4)


def test_unknown_names_and_options_suggest_the_closest():
    with pytest.raises(ConfigError, match="did you mean 'voxel-zhu'"):
        represent("voxel-zu", EventStream.empty(SMALL))
    with pytest.raises(ConfigError, match=r"voxel-e2vid has no option 'bin'.*did you mean 'bins'"):
        represent("voxel-e2vid", EventStream.empty(SMALL), bin=5)


def test_every_representation_refuses_options_of_another_type():
    for name in REPRESENTATIONS.names():
        for option, hint in get_type_hints(REPRESENTATIONS.load(name)).items():
            if hint in (bool, int, float):
                with pytest.raises(ConfigError, match=f"^{name}: {option} is"):
                    represent(name, EventStream.empty(SMALL), **{option: "5"})
