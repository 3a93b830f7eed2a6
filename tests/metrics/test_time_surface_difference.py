import math

import pytest

from texvent.events import EventStream
from texvent.metrics.time_surface_difference import TimeSurfaceDifference

from . import slow
from .recordings import SMALL, random_events


@pytest.mark.parametrize("seed", [0, 1])
def test_surfaces_agree_with_their_slow_twin(seed):
    a, b = random_events(seed, 200), random_events(seed + 10, 200)
    assert TimeSurfaceDifference()(a, b) == pytest.approx(slow.time_surface(a, b))


def test_one_pixel_that_fired_once_decays_from_one():
    # Instants at 10 and 20 ms; only the first stream has fired, at 0.
    a = EventStream([0], [0], [0], [1], SMALL)
    b = EventStream([1], [0], [20_000], [1], SMALL)
    expected = (math.exp(-0.5) + math.exp(-1) + 1) / 2 / (2 * 13 * 12)
    assert TimeSurfaceDifference(instants=2)(a, b) == pytest.approx(expected)
