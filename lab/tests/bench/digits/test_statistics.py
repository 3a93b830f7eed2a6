"""McNemar's test against values by hand, votes, marks of the table."""

import numpy as np
import pytest

from texvent_lab.bench.digits.results import (
    DigitsReport,
    SetScore,
    compare_with_best,
    digits_table,
    mcnemar_p,
    vote,
)


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
    assert mcnemar_p(*pair(100, first, second, 7)) == pytest.approx(p)


def test_the_vote_takes_the_class_named_most_and_of_equals_the_smallest():
    assert vote(np.array([[1, 5, 9], [2, 5, 3], [2, 0, 9]])).tolist() == [2, 5, 9]
    assert vote(np.array([[7], [4]])).tolist() == [4]


def test_arms_are_compared_with_the_best_by_holms_correction():
    labels = np.arange(40) % 10
    wrong = (labels + 1) % 10
    predictions = {
        "best": labels[None],
        # Five recordings are lost: p = 2 / 32, the larger of two; all 40: p = 2 / 2^40, doubled.
        "alike": np.where(np.arange(40) < 5, wrong, labels)[None],
        "worse": wrong[None],
    }
    found = compare_with_best(predictions, labels)
    assert found == {"best": None, "alike": 2 / 32, "worse": pytest.approx(4 / 2**40)}


def test_the_table_marks_the_best_arm_and_those_like_it():
    facts = {"way": "exact", "representation": "surface", "events": 1.0, "on_share": 0.5}
    rows = (("a", 0.9, 0.02), ("b", 0.95, None), ("c", 0.93, 0.06))
    scores = [
        SetScore(arm=arm, accuracy=[mean], p=p, threshold=0.2, is_matched=arm != "a", **facts)
        for arm, mean, p in rows
    ]
    report = DigitsReport(
        environment={},
        protocol={},
        recorded_events=1.0,
        recorded_on_share=0.5,
        scores=scores,
        ceiling={"surface": [0.5, 0.6]},
        seconds=0.0,
    )
    lines = digits_table(report).splitlines()
    assert [line.split("|")[1].strip() for line in lines[2:5]] == ["b", "c", "a"]
    assert lines[2].endswith("| 0.950 (best) |")
    assert lines[3].endswith("| 0.930 (≈) |")
    assert lines[4].endswith("| 1 (count not reached) | 0.500 | 0.900 |")
    assert lines[5].endswith("| 0.550 ± 0.050 |")
