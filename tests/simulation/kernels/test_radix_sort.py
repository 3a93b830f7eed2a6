"""Order of packets: that of the definition, for any order that events come in."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples
from tests.simulation.references import sorting

from texvent.errors import InputError
from texvent.simulation.kernels import radix_sort
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
