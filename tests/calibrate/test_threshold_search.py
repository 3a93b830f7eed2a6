import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.calibrate.threshold_search import HIGHEST, LOWEST, MAX_STEPS, find_threshold


class Counter:
    """A simulator whose count falls as a power of the threshold."""

    def __init__(self, at_one, power):
        self.at_one, self.power, self.calls = at_one, power, []

    def __call__(self, threshold):
        self.calls.append(threshold)
        return round(self.at_one * threshold**-self.power)


def test_a_count_that_falls_as_one_over_the_threshold_is_matched_in_two_steps():
    counter = Counter(10_000, 1.0)
    match = find_threshold(counter, 100_000, start=0.2)
    assert match.threshold == pytest.approx(0.1)
    assert match.is_matched
    assert len(counter.calls) == 2


@given(power=st.floats(0.5, 3.0), wanted=st.floats(0.02, 1.0))
def test_any_power_law_is_matched_within_nine_steps(power, wanted):
    counter = Counter(1_000_000, power)
    match = find_threshold(counter, round(1_000_000 * wanted**-power), start=0.2)
    assert match.is_matched
    assert match.ratio == pytest.approx(1, abs=0.02)
    assert len(counter.calls) <= MAX_STEPS


def test_a_count_that_cannot_be_reached_gives_the_closest_threshold():
    counter = Counter(10, 1.0)
    match = find_threshold(counter, 1_000_000, start=0.2)
    assert not match.is_matched
    assert match.threshold == LOWEST
    too_many = find_threshold(Counter(1_000_000, 0.1), 10, start=0.2)
    assert too_many.threshold == HIGHEST


def test_a_simulator_without_events_keeps_its_threshold():
    match = find_threshold(lambda threshold: 0, 1000, start=0.2)
    assert match.threshold == 0.2
    assert match.ratio == 0
    assert not match.is_matched


def test_a_jump_over_the_target_ends_with_the_closer_side():
    match = find_threshold(lambda threshold: 1000 if threshold < 0.3 else 10, 900, start=0.2)
    assert match.ratio == pytest.approx(1000 / 900)
    assert not match.is_matched
