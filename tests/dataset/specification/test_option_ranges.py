from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.dataset.specification.specification import draw_options, extreme_options


@given(
    low=st.floats(1e-3, 1e3),
    width=st.floats(0, 1e3),
    kind=st.sampled_from(["uniform", "log_uniform"]),
    key=st.integers(),
)
def test_a_drawn_value_lies_in_its_range(low: float, width: float, kind: str, key: int) -> None:
    (value,) = draw_options({"fps": {kind: [low, low + width]}}, key).values()
    assert low * (1 - 1e-12) <= value <= (low + width) * (1 + 1e-12)


def test_draws_fill_their_range_evenly_and_do_not_depend_on_each_other() -> None:
    options = {"a": {"uniform": [0.0, 1.0]}, "b": {"uniform": [0.0, 1.0]}}
    drawn = [draw_options(options, number) for number in range(2000)]
    a, b = [one["a"] for one in drawn], [one["b"] for one in drawn]
    # Standard errors: mean .0065, correlation .022.
    assert abs(sum(a) / 2000 - 0.5) < 0.03
    mean = sum(x * y for x, y in zip(a, b, strict=True)) / 2000
    assert abs(mean - 0.25) < 0.03
    assert [draw_options({"a": options["a"]}, number)["a"] for number in range(5)] == a[:5]


def test_whole_numbers_and_choices_reach_every_value() -> None:
    options = {"n": {"integer": [1, 3]}, "c": {"choice": ["x", "y"]}}
    drawn = [draw_options(options, number) for number in range(200)]
    assert {one["n"] for one in drawn} == {1, 2, 3}
    assert {one["c"] for one in drawn} == {"x", "y"}


def test_log_uniform_has_its_median_at_the_geometric_mean() -> None:
    drawn = [draw_options({"a": {"log_uniform": [0.01, 1.0]}}, key)["a"] for key in range(2000)]
    below = sum(value < math.sqrt(0.01) for value in drawn)
    assert below == pytest.approx(1000, abs=100)


def test_every_end_of_a_range_is_among_the_extremes() -> None:
    options = {"a": {"uniform": [1, 2]}, "b": {"choice": ["x", "y", "z"]}, "c": 3}
    assert extreme_options(options) == [
        {"a": 1, "b": "x", "c": 3},
        {"a": 2, "b": "x", "c": 3},
        {"a": 1, "b": "y", "c": 3},
        {"a": 1, "b": "z", "c": 3},
    ]
