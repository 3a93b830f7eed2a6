"""Logarithm, exponential and cosine: right to the last places, and equal bits when compiled."""

import math

import numba
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples

from texvent.simulation.kernels import compiled_elementary, elementary

RANDOM = np.random.default_rng(0)
POSITIVE = 10.0 ** RANDOM.uniform(-25, 6, 5000)
SIGNED = RANDOM.uniform(-600, 600, 5000)
TURNS = RANDOM.uniform(0, 1, 5000)


def places(ours, true) -> float:
    """Largest distance in units in the last place of the true values."""
    return float(np.max(np.abs(ours - true) / np.spacing(np.abs(true))))


def test_functions_are_right_to_two_units_in_the_last_place():
    assert places(elementary.natural_log(POSITIVE), np.log(POSITIVE)) <= 2
    assert places(elementary.exponential(SIGNED), np.exp(SIGNED)) <= 2
    cosine = elementary.cosine_of_turns(TURNS)
    assert cosine == pytest.approx(np.cos(math.tau * TURNS), abs=1e-15)


@pytest.mark.parametrize("angle", [1e-9, 0.1, 0.25, 0.5, 0.501, 1.0, 3.7, 40.0, 800.0, 1e9])
def test_the_answer_of_a_low_pass_to_a_line_is_right_for_any_angle(angle):
    decay, gain = elementary.decay_and_gain(np.array([angle]))
    assert decay == pytest.approx(math.exp(-angle), rel=1e-15, abs=1e-300)
    assert gain == pytest.approx(-math.expm1(-angle) / angle, rel=1e-15)


def test_special_values_are_exact():
    assert elementary.natural_log(np.array([1.0])) == 0.0
    assert elementary.exponential(np.array([0.0])) == 1.0
    assert elementary.exponential(np.array([1e9])) == elementary.exponential(np.array([700.0]))
    assert elementary.cosine_of_turns(np.array([0.0, 0.5])) == pytest.approx([1.0, -1.0], abs=1e-15)


@numba.njit
def _all_compiled(x, turns):
    decay, gain = compiled_elementary.decay_and_gain(x)
    log, exponential = compiled_elementary.natural_log(x), compiled_elementary.exponential(-x)
    return log, exponential, decay, gain, compiled_elementary.cosine_of_turns(turns)


@examples(300)
@given(st.floats(1e-25, 1e9), st.floats(0, 1, exclude_max=True))
def test_numpy_and_numba_give_equal_bits(x, turns):
    one, turn = np.array([x]), np.array([turns])
    ours = elementary.natural_log(one), elementary.exponential(-one)
    ours += (*elementary.decay_and_gain(one), elementary.cosine_of_turns(turn))
    compiled = _all_compiled(np.float64(x), np.float64(turns))
    assert [float(value[0]) for value in ours] == [float(value) for value in compiled]
