"""Ranges of options: both bounds are allowed, and nothing beyond them."""

import math
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.config import check_range, check_whole
from texvent.errors import ConfigError

BOUNDS = st.lists(st.integers(-(10**9), 10**9), min_size=2, max_size=2).map(sorted)
REFUSAL = r"it is .*; it must be "


@given(BOUNDS, st.sampled_from([int, float, Fraction]))
def test_a_range_holds_its_bounds_and_nothing_beyond_them(bounds, kind):
    low, high = map(kind, bounds)
    for value in (low, high, (low + high) / 2, None):
        check_range("it", value, low, high)
    below, above = math.nextafter(low, -math.inf), math.nextafter(high, math.inf)
    for value in (below, above, math.inf, -math.inf, math.nan):
        with pytest.raises(ConfigError, match=REFUSAL):
            check_range("it", value, low, high)
    for value in bounds:
        check_whole("it", value, *bounds)
    for value in (bounds[0] - 1, bounds[1] + 1, bounds[0] + 0.5, True, math.nan, "3"):
        with pytest.raises(ConfigError, match=REFUSAL):
            check_whole("it", value, *bounds)
