import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.calibrate.recording import TimeSpan
from texvent.calibrate.uncertainty import FARTHEST, cut_blocks, vertex, widen


@given(place=st.floats(-1.0, 1.0), height=st.floats(0, 10), bend=st.floats(0.01, 100))
def test_the_vertex_of_any_parabola_is_found(place, height, bend):
    x = np.log([0.5, 1.0, 2.0])
    assert vertex(height + bend * (x - place) ** 2) == pytest.approx(place, abs=1e-6)


def test_without_a_minimum_the_vertex_is_far_away():
    assert vertex(np.array([3.0, 2.0, 1.0])) == FARTHEST
    assert vertex(np.array([1.0, 2.0, 1.5])) == -FARTHEST


def test_ends_are_widened_by_what_other_options_may_shift():
    own, others = np.array([[-0.3, -0.5], [0.6, 0.5]]), np.array([[0.16, 0.0], [0.64, 0.0]])
    np.testing.assert_allclose(widen(own, others), [[-0.5, -0.5], [1.0, 0.5]])


@given(start=st.integers(0, 10**15), length=st.integers(1, 10**7))
def test_blocks_cover_their_span(start, length):
    blocks = cut_blocks(TimeSpan(start, start + length))
    assert 1 <= len(blocks) <= 20
    assert blocks[0].start_us == start
    assert blocks[-1].stop_us == start + length
    assert all(a.stop_us == b.start_us for a, b in itertools.pairwise(blocks))
    assert len(blocks) == 1 or min(b.stop_us - b.start_us for b in blocks) >= 10_000
