"""Candidates by hand, and bounds that leave out no pixel; `test_fused` has their events."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from tests.pairs.reference import sample_along

from texvent.pairs.warp_cpu import prepare_pair
from texvent.runtime.kernel_arrays import read_only
from texvent.simulate.fused import candidates
from texvent.simulate.fused.bounds import (
    PairArrays,
    PreparedPair,
    ReferenceLevels,
    bound_cells,
    list_active,
)


def find_candidates(arrays, positions, levels):
    """All candidates of a pair."""
    prepared = PreparedPair(prepare_pair(*arrays), bound_cells(arrays))
    rows = (0, arrays.earlier.shape[0])
    return candidates.find_in_rows(arrays, positions, levels, prepared, rows)


STILL = np.zeros((1, 1, 2), np.float32)
THIRDS = np.array([1 / 3, 2 / 3])
UP = math.exp(0.2)


def pair_of(*arrays):
    return PairArrays(*map(read_only, arrays))


def own_levels(*, is_step=False, balance=30.0, up=UP):
    return ReferenceLevels(np.empty((0, 0)), balance, up, 1 / up, is_step)


def at_rest(first, second):
    """One pixel without flow: its luma changes evenly."""
    return pair_of(np.float32([[first]]), np.float32([[second]]), STILL, STILL)


def test_a_pixel_is_listed_where_it_passes_a_level_and_its_reference_goes_along():
    # α + I: 50, 70, 90, 110; ln steps .336, .251, .201: with δ = .3 the first fires (A := 70), then
    # ln(90/70) = .251 does not, and ln(110/70) = .452 does.
    levels = own_levels(up=math.exp(0.3))
    found = find_candidates(at_rest(20, 80), THIRDS, levels)
    assert found.segment.tolist() == [0, 2]
    np.testing.assert_allclose(found.before, [20, 60], rtol=1e-6)
    np.testing.assert_allclose(found.now, [40, 80], rtol=1e-6)


def test_a_reference_that_steps_stays_behind():
    # The same, A := 50 · e^.3 = 67.5, and ln(90/67.5) = .288 does not fire, ln(110/67.5) = .488
    # does. Falling levels are the mirror image.
    levels = own_levels(is_step=True, up=math.exp(0.3))
    assert find_candidates(at_rest(20, 80), THIRDS, levels).segment.tolist() == [0, 2]
    # 110, 90, 70, 50: .2007, .452 (fires, A := 81.5), .488 (fires).
    assert find_candidates(at_rest(80, 20), THIRDS, levels).segment.tolist() == [1, 2]


def test_where_it_is_open_whether_a_pixel_fires_all_its_later_pictures_are_listed():
    # The change is δ but for rounding, so the finishing pass must see everything from there on.
    levels = own_levels(up=60 / 50)
    arrays = pair_of(np.float32([[20]]), np.float32([[30]]), STILL, STILL)
    assert find_candidates(arrays, np.array([0.99999]), levels).segment.tolist() == [1]
    for is_step in (False, True):
        levels = own_levels(is_step=is_step, up=60 / 50)
        late = find_candidates(at_rest(20, 30), np.array([1.0, 0.5, 0.3]), levels)
        assert late.segment.tolist() == [0, 1, 2, 3]


def test_pixels_that_cannot_fire_are_not_followed():
    # A texture that moves by a quarter of a pixel changes by less than δ nearly everywhere; a flat
    # image never does, however fast its flow claims to be.
    ramp = np.tile(100 + 4 * np.arange(32, dtype=np.float32), (32, 1))
    slow = np.full((32, 32, 2), 0.25, np.float32)
    flat = np.full((32, 32), 100, np.float32)
    fast = np.full((32, 32, 2), 40.0, np.float32)
    active = np.empty(32, np.int64)
    for arrays in (pair_of(ramp, ramp + 1, slow, -slow), pair_of(flat, flat, fast, -fast)):
        bounds = bound_cells(arrays)
        assert [list_active(arrays, own_levels(), bounds, row, active) for row in range(32)] == [
            0
        ] * 32
    arrays = pair_of(ramp, ramp, fast, -fast)
    bounds = bound_cells(arrays)
    assert list_active(arrays, own_levels(), bounds, 3, active) == 32


@pytest.mark.parametrize("shape", [(1, 5), (5, 1), (33, 40)])
@pytest.mark.parametrize("speed", [0.1, 0.5, 1.0, 3.0])
def test_no_pixel_is_left_out_whose_trigger_level_a_sample_reaches(shape, speed):
    # Noise bends most between pixels. Each level is the most that any sample reaches.
    image = np.random.default_rng(3).uniform(0, 255, shape).astype(np.float32)
    forward = np.random.default_rng(4).uniform(-speed, speed, (*shape, 2)).astype(np.float32)
    shares = itertools.product(np.linspace(-1, 1, 9, dtype=np.float32), repeat=2)
    seen = np.float64([sample_along(image, forward, forward * share)[0] for share in shares])
    arrays = pair_of(image, image, forward, -forward)
    bounds, active = bound_cells(arrays), np.empty(shape[1], np.int64)
    for levels in (
        ReferenceLevels((seen.max(axis=0) + 30.0) / UP, 30.0, UP, 1e-9, False),
        ReferenceLevels((seen.min(axis=0) + 30.0) * UP, 30.0, 1e9, 1 / UP, False),
    ):
        found = [list_active(arrays, levels, bounds, row, active) for row in range(shape[0])]
        assert found == [shape[1]] * shape[0]
