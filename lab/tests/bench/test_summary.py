import math

from texvent_lab.bench.summary import normalise, summarise


def test_summary_counts_undefined_values_instead_of_replacing_them():
    summary = summarise([1.0, math.nan, 2.0, 3.0])
    assert (summary.mean, summary.defined, summary.undefined) == (2.0, 3, 1)
    assert math.isclose(summary.standard_error, 1 / math.sqrt(3))


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
