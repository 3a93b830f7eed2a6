"""Paths where two surfaces meet: hand-computed cases; compiled paths equal their definition."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples
from tests.pairs import reference
from tests.pairs.test_warp import warp_between

from texvent.pairs import contested_paths

KERNELS = [reference.warp_between, warp_between]


def ball_flows(step, size=3, shape=(9, 24), x=2):
    """Flows of a small thing from column x on that moves right before a ground at rest."""
    forward, backward = np.zeros((2, *shape, 2), np.float32)
    forward[3:6, x : x + size] = step, 0
    backward[3:6, x + step : x + step + size] = -step, 0
    return forward, backward


@pytest.mark.parametrize("find", [reference.find_sweep, contested_paths.find_sweep])
def test_the_sweep_is_what_a_small_thing_passes_and_covers_in_neither_frame(find):
    sweep = find(*ball_flows(12), 0)
    # In columns 2 to 4 it is at first, in 14 to 16 at last; it passes 5 to 13.
    assert (sweep[3:6, 5:14] == (12, 0)).all()
    assert not sweep[:, :5].any()
    assert not sweep[:, 14:].any()


@pytest.mark.parametrize("find", [reference.find_sweep, contested_paths.find_sweep])
def test_a_path_along_the_edge_stays_in_the_image(find):
    forward, backward = np.zeros((2, 3, 24, 2), np.float32)
    for row, slope in ((0, -0.4), (2, 0.4)):
        forward[row, 2], backward[row, 14] = (12, slope), (-12, -slope)
    sweep = find(forward, backward, 0)
    np.testing.assert_allclose(sweep[0, 3:14], np.tile(np.float32([12, -0.4]), (11, 1)))
    assert not sweep[1].any()


@pytest.mark.parametrize("find", [reference.find_sweep, contested_paths.find_sweep])
@pytest.mark.parametrize("backward", [-12, 0])
def test_nothing_sweeps_where_all_moves_or_the_later_frame_contradicts(find, backward):
    forward = np.broadcast_to(np.float32([12, 0]), (9, 24, 2)).copy()
    other = np.broadcast_to(np.float32([backward, 0]), (9, 24, 2)).copy()
    assert not find(forward, other, 0).any()


@pytest.mark.parametrize("warp", KERNELS, ids=["reference", "cpu"])
@pytest.mark.parametrize("position", [0.25, 0.5, 0.75])
def test_a_small_fast_thing_is_where_it_is_and_nowhere_else(warp, position):
    ground = np.full((9, 24), 40, np.float32)
    first, second = ground.copy(), ground.copy()
    first[3:6, 2:5] = 200
    second[3:6, 14:17] = 200
    got = warp(first, second, *ball_flows(12), position)
    there = ground.copy()
    there[3:6, 2 + round(12 * position) : 5 + round(12 * position)] = 200
    np.testing.assert_allclose(got, there, atol=1e-3)


@examples(15)
@given(
    st.integers(0, 999),
    st.sampled_from([(1, 1), (5, 9), (16, 21)]),
    st.sampled_from([0, 1]),
    st.floats(0.01, 0.99),
)
def test_compiled_paths_equal_their_definition(seed, shape, shift, position):
    rng = np.random.default_rng(seed)
    vectors = tuple(side + shift >> shift for side in shape)
    forward, backward = rng.normal(0, 4, (2, *vectors, 2)).astype(np.float32)
    forward[rng.random(vectors) < 0.5] = (5, 1)
    backward[rng.random(vectors) < 0.5] = (-5, -1)
    sweep = contested_paths.find_sweep(forward, backward, shift)
    expected = reference.find_sweep(forward, backward, shift)
    np.testing.assert_array_equal(sweep if sweep.size else np.zeros_like(forward), expected)
    images = rng.uniform(0, 255, (2, *shape)).astype(np.float32)
    arguments = *images, forward, backward, position
    np.testing.assert_array_equal(warp_between(*arguments), reference.warp_between(*arguments))
