"""Eq. 4: how many intermediate frames, and when."""

import math
from fractions import Fraction

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from texvent.brightness import balanced_log
from texvent.frames import Frame
from texvent.interpolate.count_policy import count_for_flicker, count_intermediate
from texvent.pairs.instants import intermediate_times_us

BLACK = np.zeros((2, 2), np.uint8)
WHITE = np.full((2, 2), 255, np.uint8)


def count(first, second, *, balance=30.0, threshold=0.2, **options):
    lumas = (Frame(one, 0).luma for one in (first, second))
    return count_intermediate(*lumas, balance=balance, contrast_threshold=threshold, **options)


def test_cap_limits_the_count():
    assert count(BLACK, WHITE, threshold=0.01) == 64
    assert count(BLACK, WHITE, threshold=0.01, cap=7) == 7
    assert count(BLACK, WHITE, cap=0) == 0


@given(
    hnp.arrays(np.float32, (2, 3), elements=st.floats(0, 1e6, width=32)),
    hnp.arrays(np.float32, (2, 3), elements=st.floats(0, 1e6, width=32)),
    st.sampled_from([0.5, 0.9]) | st.floats(0.5, 100),
    st.sampled_from([0.2, 0.01, 1.0, 1e-4]),
)
def test_eq4_equals_its_definition_in_float64(first, second, balance, threshold):
    change = np.abs(balanced_log(first, balance) - balanced_log(second, balance)).max()
    expected = math.floor(change / threshold)
    assert count(first, second, balance=balance, threshold=threshold, cap=10**9) == expected


times = st.integers(-(2**40), 2**40)


@given(times, st.integers(1, 10**7), st.floats(0.01, 1e4), st.integers(0, 99))
def test_light_that_beats_is_shown_in_twelfths_of_its_period(first_us, interval_us, hz, cap):
    count = count_for_flicker(first_us, first_us + interval_us, hz, cap=cap)
    assert count == min(math.ceil(12 * (hz * interval_us / 1e6)) - 1, cap)
    assert count_for_flicker(first_us, first_us + interval_us, None, cap=cap) == 0


@given(times, st.integers(1, 10**7), st.integers(0, 200))
def test_times_lie_strictly_inside_and_increase(first_us, interval_us, wanted):
    second_us = first_us + interval_us
    got = intermediate_times_us(first_us, second_us, wanted)
    assert len(got) == min(wanted, interval_us - 1)
    assert all(a < b for a, b in zip([first_us, *got], [*got, second_us], strict=True))


@given(times, st.integers(2, 10**7), st.integers(1, 64))
def test_times_are_equally_spaced_to_half_a_microsecond(first_us, interval_us, wanted):
    got = intermediate_times_us(first_us, first_us + interval_us, wanted)
    for k, t_us in enumerate(got, start=1):
        exact = Fraction(interval_us * k, len(got) + 1)
        assert abs(t_us - first_us - exact) <= Fraction(1, 2)
