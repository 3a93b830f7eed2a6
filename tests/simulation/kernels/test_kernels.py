"""Order of packets, and elementary functions: those of the definitions, compiled or not."""

import math

import numba
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples
from tests.simulation.references import sorting

from texvent.errors import InputError
from texvent.simulation.kernels import compiled_elementary, elementary, radix_sort
from texvent.simulation.packets import UnsortedEvents

DURATIONS = (1, 2, 255, 5000, 8192, 41_667, 3_000_000, 2**40)


def events(seed: int, count: int, shape: tuple[int, int], duration_us: int, *, start_us: int):
    rng = np.random.default_rng(seed)
    return UnsortedEvents(
        rng.integers(0, shape[0] * shape[1], count),
        start_us + rng.integers(0, duration_us, count),
        rng.integers(0, 2, count).astype(np.uint8),
        rng.integers(0, 2, count).astype(np.uint8),
    )


def by_pixel(unordered: UnsortedEvents) -> UnsortedEvents:
    order = np.lexsort((unordered.label, unordered.p, unordered.pixel))
    return UnsortedEvents(*(column[order] for column in unordered))


@examples(200)
@given(
    st.integers(0, 2**32),
    st.sampled_from([0, 1, 5, 700, 9000]),
    st.tuples(st.integers(1, 50), st.integers(1, 50)),
    st.sampled_from(DURATIONS),
    st.booleans(),
)
def test_backends_sort_events_alike(seed, count, shape, duration_us, is_by_pixel):
    start_us = seed - 2**31
    given_events = events(seed, count, shape, duration_us, start_us=start_us)
    if is_by_pixel:
        given_events = by_pixel(given_events)
    span_us = (start_us, start_us + duration_us)
    one, two = (
        module.sort_events(given_events, span_us, shape) for module in (sorting, radix_sort)
    )
    assert [column.dtype for column in one] == [column.dtype for column in two]
    assert all(np.array_equal(a, b) for a, b in zip(one, two, strict=True))


def test_every_pixel_of_an_odd_width_keeps_its_place():
    """Rows are found by a product with 1 / width, which must not miss at a row's ends."""
    shape = (3, 65_535)
    pixel = np.arange(shape[0] * shape[1])
    byte = np.zeros(len(pixel), np.uint8)
    columns = radix_sort.sort_events(
        UnsortedEvents(pixel, pixel * 0 + 7, byte, byte), (7, 8), shape
    )
    assert np.array_equal(columns.y, pixel // shape[1])
    assert np.array_equal(columns.x, pixel % shape[1])


def test_an_interval_too_long_for_the_keys_is_refused():
    longest_us = 2**43  # of 64 bits, 21 are for 640x480 pixels, p and label
    assert radix_sort.key_bits(longest_us - 1, (480, 640)) == 21
    with pytest.raises(InputError, match=r"8\.79609e\+06 s apart; with 640x480 pixels at most"):
        radix_sort.key_bits(longest_us, (480, 640))


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
