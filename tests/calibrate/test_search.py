"""The search over the options of the circuit, on distances whose minimum is known."""

import dataclasses
import math
import random

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from texvent.calibrate.recording import TimeSpan
from texvent.calibrate.search import COORDINATES, STEPS, Candidate, Distance, Search
from texvent.calibrate.uncertainty import FARTHEST, _judge_option, cut_blocks
from texvent.events import EventStream
from texvent.sensor import SensorSize

from .conftest import TRUTH


class Bowl(Search):
    """A search whose distance grows with the logarithm of each option over its best value."""

    def __init__(self, best, keep):
        nothing = EventStream.empty(SensorSize(2, 2))
        super().__init__([], nothing, TimeSpan(0, 1), lambda line: None, keep=keep)
        self.best = best

    def match_counts(self, config):
        away = sum(abs(math.log(getattr(config, name) / one)) for name, one in self.best.items())
        return Candidate(config, Distance(away, 0.0, 0.0, 0.0))


def between(limits):
    return st.floats(math.log(limits[0]), math.log(limits[1])).map(math.exp)


OPTIONS = st.fixed_dictionaries({name: between(ends) for name, ends in COORDINATES.items()})


@given(best=OPTIONS, start=OPTIONS, keep=st.sampled_from([(), *((one,) for one in COORDINATES)]))
def test_each_option_comes_within_a_step_of_its_best_value_from_any_side(best, start, keep):
    search = Bowl(best, keep)
    found = search.run(search.match_counts(dataclasses.replace(TRUTH, **start))).config
    for name, (low, high) in COORDINATES.items():
        value, step = getattr(found, name), STEPS[-1]
        if name in keep:
            assert value == start[name]
        else:
            assert low <= value <= high
            is_at_end = value * step > high or value / step < low
            assert is_at_end or 1 / step <= value / best[name] <= step


class Noisy(Bowl):
    """Counts that follow the thresholds, and an overlap that is drawn anew each time."""

    match_counts = Search.match_counts

    def measure(self, config):
        on, off = (config.contrast_threshold_on, config.contrast_threshold_off)
        found = Distance(self.chance.random(), 0.0, math.log(0.2 / on), math.log(0.3 / off))
        self.measured.append((found.total, config))
        return found


@example(seed=0, threshold=math.sqrt(0.2 * 0.5), ratio=0.2 / 0.5)  # ON is right, OFF is not
@example(seed=0, threshold=math.sqrt(0.5 * 0.3), ratio=0.5 / 0.3)
@given(seed=st.integers(0, 99), threshold=st.floats(0.1, 0.6), ratio=st.floats(0.6, 1.7))
def test_of_all_thresholds_that_are_tried_the_nearest_stay(seed, threshold, ratio):
    search = Noisy({}, ())
    search.chance, search.measured = random.Random(seed), []
    start = dataclasses.replace(TRUTH, contrast_threshold=threshold, on_off_ratio=ratio)
    found = search.match_counts(start)
    assert (found.distance.total, found.config) == min(search.measured, key=lambda one: one[0])
    last = search.measured[-1][1]
    assert last.contrast_threshold_on == pytest.approx(0.2, rel=0.01)
    assert last.contrast_threshold_off == pytest.approx(0.3, rel=0.01)


class Coupled(Bowl):
    """A search whose threshold goes with a power of an option, where counts are matched."""

    def match_counts(self, config):
        shift = getattr(config, self.name) / getattr(TRUTH, self.name)
        threshold = TRUTH.contrast_threshold * shift**self.power
        return super().match_counts(dataclasses.replace(config, contrast_threshold=threshold))

    def simulate(self, config):
        return EventStream.empty(SensorSize(2, 2))


@given(name=st.sampled_from(list(COORDINATES)), power=st.floats(-1.0, 1.0))
def test_how_the_threshold_goes_with_an_option_is_its_power(name, power):
    search = Coupled({}, ())
    search.name, search.power = name, power
    nothing, blocks = EventStream.empty(SensorSize(2, 2)), cut_blocks(TimeSpan(0, 100_000))
    option = _judge_option(search, nothing, blocks, TRUTH, name)
    assert option.slopes == pytest.approx([power, 0.0], abs=1e-9)
    assert option.is_unknown  # nothing tells it
    reach = abs(power) * FARTHEST
    assert option.threshold_ends()[:, 0] == pytest.approx([-reach, reach])
