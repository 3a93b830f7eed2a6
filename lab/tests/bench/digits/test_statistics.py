"""McNemar's test against values by hand, votes."""

import numpy as np
import pytest

from texvent_lab.bench.digits.results import (
    Comparison,
    DigitsReport,
    SetScore,
    compare_classifiers,
    difference_interval,
    vote,
)
from texvent_lab.bench.digits.tables import accuracy_table, best_marks, comparison_table


def pair(both, first, second, neither):
    a = [True] * both + [True] * first + [False] * second + [False] * neither
    b = [True] * both + [False] * first + [True] * second + [False] * neither
    return np.array(a), np.array(b)


@pytest.mark.parametrize(
    ("first", "second", "p"),
    [
        (0, 0, 1.0),
        (1, 1, 1.0),
        (5, 0, 2 / 32),
        (0, 5, 2 / 32),
        (8, 1, 2 * (1 + 9) / 512),
        (10, 4, 2 * (1 + 14 + 91 + 364 + 1001) / 2**14),
    ],
)
def test_mcnemar_agrees_with_binomial_sums_by_hand(first, second, p):
    found = compare_classifiers(*pair(100, first, second, 7))
    assert (found.only_first, found.only_second) == (first, second)
    assert found.p == pytest.approx(p)


def test_the_vote_takes_the_class_named_most_and_of_equals_the_smallest():
    names = [np.array([1, 5, 9]), np.array([2, 5, 3]), np.array([2, 0, 9])]
    assert vote(names).tolist() == [2, 5, 9]
    assert vote([np.array([7]), np.array([4])]).tolist() == [4]


def test_the_interval_of_a_difference_is_walds_with_half_a_recording_in_each_cell():
    # (10.5 - 4.5) / 102, and 1.96 · √(15 - 6² / 102) / 102.
    low, high = difference_interval(10, 4, 100)
    assert low == pytest.approx(0.05882 - 0.07354, abs=1e-5)
    assert high == pytest.approx(0.05882 + 0.07354, abs=1e-5)
    assert difference_interval(4, 10, 100) == pytest.approx((-high, -low))
    low, high = difference_interval(0, 0, 500)
    assert low == -high
    assert 0 < high < 0.005


def set_score(arm, accuracy, **changes):
    values = {"arm": arm, "way": "exact", "choice": "matched", "representation": "surface"}
    values |= {"events": 1.0, "on_share": 0.5, "threshold": 0.2, "is_matched": True}
    values |= {"accuracy": [accuracy], "held_out": [], "judged": []}
    return SetScore(**{**values, **changes})


def digits_report(scores, comparisons):
    return DigitsReport(
        environment={},
        protocol={"recordings": 500},
        recorded_events=1.0,
        recorded_on_share=0.5,
        options={},
        scores=scores,
        ceiling={"surface": []},
        comparisons=[
            Comparison("exact", "matched", "surface", first, second, *counts)
            for (first, second), counts in comparisons.items()
        ],
        few_shot=[],
        few_shot_tested=0,
        seconds=0.0,
    )


def test_tables_mark_the_best_arm_and_those_that_cannot_be_told_apart_from_it():
    scores = [set_score(*one) for one in (("a", 0.9), ("b", 0.95), ("c", 0.93), ("d", 0.5))]
    other = set_score("a", 0.99, way="flow")
    # Holm: .02 counts twice, since d is told first.
    pairs = {("a", "b"): (1, 9, 0.02), ("b", "c"): (9, 3, 0.06), ("b", "d"): (90, 0, 1e-9)}
    pairs[("c", "d")] = (80, 0, 1e-9)
    report = digits_report([*scores, other], pairs)
    marks = {("b", "exact", "matched"): "(best)", ("c", "exact", "matched"): "(≈)"}
    assert best_marks(report, "surface") == marks
    report = digits_report(scores, {**pairs, ("a", "b"): (1, 8, 0.03)})
    assert best_marks(report, "surface") == {**marks, ("a", "exact", "matched"): "(≈)"}
    assert "| 0.930 (≈) |" in accuracy_table(report, "surface")


def test_comparisons_state_the_difference_its_interval_and_holms_p():
    pairs = {("texvent paper", "a"): (10, 4, 0.18), ("texvent paper", "b"): (9, 0, 0.004)}
    scores = [set_score(name, 0.9) for name in ("texvent paper", "a", "b")]
    rows = comparison_table(digits_report(scores, pairs), "surface", "exact", "matched")
    assert "| texvent paper | a | 10 | 4 | +0.012 [-0.003, +0.027] | 0.18 | 0.18 |" in rows
    assert "| 0.004 | 0.008 |" in rows
