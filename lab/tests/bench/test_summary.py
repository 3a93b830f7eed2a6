import math
import statistics

import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent_lab.bench.summary import mean_text, normalise, summarise

VALUES = st.sampled_from([math.nan, math.inf, -math.inf, 0.0]) | st.floats(-1e6, 1e6)


@given(st.lists(VALUES, max_size=6))
def test_a_summary_is_of_all_that_is_a_number_and_counts_the_rest(values):
    """Infinity is a value: that of a distance to a recording without events."""
    known = [one for one in values if not math.isnan(one)]
    mean = sum(known) / len(known) if known else math.nan
    is_spread = len(known) > 1 and all(map(math.isfinite, known))
    error = statistics.stdev(known) / math.sqrt(len(known)) if is_spread else math.nan
    close = {"rel": 1e-6, "abs": 1e-6, "nan_ok": True}
    assert summarise(values) == (
        pytest.approx(mean, **close), pytest.approx(error, **close),
        len(known), len(values) - len(known),
    )  # fmt: skip
    text = mean_text(values)
    assert (text == "–", "±" in text) == (not known, len(known) > 1)


def test_normalised_score_is_one_at_the_floor_and_zero_at_the_null():
    lower = {"floor": 0.15, "null": 0.85, "better": "lower"}
    assert normalise(0.15, **lower) == 1.0
    assert normalise(0.85, **lower) == 0.0
    assert math.isclose(normalise(0.5, **lower), 0.5)
    assert normalise(9.0, **lower) == 0.0
    higher = {"floor": 0.85, "null": 0.15, "better": "higher"}
    assert math.isclose(normalise(0.5, **higher), 0.5)
    # Half and double are equally far from 1.
    ratio = {"floor": 1.0, "null": 0.25, "better": "one"}
    assert math.isclose(normalise(2.0, **ratio), 0.5)


def test_normalised_score_is_undefined_where_the_null_is_no_worse_than_the_floor():
    assert math.isnan(normalise(0.5, floor=0.2, null=0.2, better="lower"))
    assert math.isnan(normalise(0.5, floor=0.53, null=0.54, better="higher"))
    assert math.isnan(normalise(math.nan, floor=0.1, null=0.2, better="lower"))
    assert math.isnan(normalise(0.1, floor=math.nan, null=0.2, better="lower"))
