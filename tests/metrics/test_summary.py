import math

from texvent.metrics.summary import normalise, summarise


def test_summary_counts_undefined_values_instead_of_replacing_them():
    summary = summarise([1.0, math.nan, 2.0, 3.0])
    assert (summary.mean, summary.defined, summary.undefined) == (2.0, 3, 1)
    assert math.isclose(summary.standard_error, 1 / math.sqrt(3))


def test_summary_of_nothing_is_undefined():
    assert math.isnan(summarise([]).mean)
    assert math.isnan(summarise([math.nan]).mean)
    assert math.isnan(summarise([4.0]).standard_error)


def test_normalised_score_is_one_at_the_floor_and_zero_at_the_null_in_both_directions():
    assert normalise(0.15, floor=0.15, null=0.85) == 1.0
    assert normalise(0.85, floor=0.15, null=0.85) == 0.0
    assert math.isclose(normalise(0.5, floor=0.15, null=0.85), 0.5)
    assert math.isclose(normalise(0.5, floor=0.85, null=0.15), 0.5)
    assert normalise(9.0, floor=0.15, null=0.85) == 0.0


def test_normalised_score_is_undefined_where_floor_and_null_agree():
    assert math.isnan(normalise(0.5, floor=0.2, null=0.2))
    assert math.isnan(normalise(math.nan, floor=0.1, null=0.2))
