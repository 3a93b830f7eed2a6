"""Candidates by hand, and bounds that leave out no pixel; `test_fused` has their events."""

import itertools
import math

import numpy as np
import pytest
from tests.pairs.reference import sample_along

from texvent.pairs.warping import prepare_pair, warp_pair
from texvent.simulation.fused import candidates
from texvent.simulation.fused.bounds import BoundedPair, ReferenceLevels, bound_paths, list_active

STILL = np.zeros((1, 1, 2), np.float32)
THIRDS = (1 / 3, 2 / 3)
UP = math.exp(0.2)


def bounded_pair(*arrays, positions=THIRDS):
    """Two frames and the flows between them, with bounds."""
    pair = prepare_pair(*arrays, positions)
    return BoundedPair(pair, *bound_paths(pair))


def find_candidates(bounded, levels):
    """All candidates of a pair."""
    return candidates.find_in_rows(bounded, levels, (0, len(bounded.pair.first)))


def own_levels(*, is_step=False, balance=30.0, up=UP):
    return ReferenceLevels(np.empty((0, 0)), balance, up, 1 / up, is_step)


def at_rest(first, second, positions=THIRDS):
    """One pixel without flow: its luma changes evenly."""
    arrays = np.float32([[first]]), np.float32([[second]]), STILL, STILL
    return bounded_pair(*arrays, positions=positions)


def test_a_pixel_is_listed_where_it_passes_a_level_and_its_reference_goes_along():
    # α + I: 50, 70, 90, 110; ln steps .336, .251, .201: with δ = .3 the first fires (A := 70), then
    # ln(90/70) = .251 does not, and ln(110/70) = .452 does.
    levels = own_levels(up=math.exp(0.3))
    found = find_candidates(at_rest(20, 80), levels)
    assert found.segment.tolist() == [0, 2]
    np.testing.assert_allclose(found.before, [20, 60], rtol=1e-6)
    np.testing.assert_allclose(found.now, [40, 80], rtol=1e-6)


def test_a_reference_that_steps_stays_behind():
    # The same, A := 50 · e^.3 = 67.5, and ln(90/67.5) = .288 does not fire, ln(110/67.5) = .488
    # does. Falling levels are the mirror image.
    levels = own_levels(is_step=True, up=math.exp(0.3))
    assert find_candidates(at_rest(20, 80), levels).segment.tolist() == [0, 2]
    # 110, 90, 70, 50: .2007, .452 (fires, A := 81.5), .488 (fires).
    assert find_candidates(at_rest(80, 20), levels).segment.tolist() == [1, 2]


def test_where_it_is_open_whether_a_pixel_fires_all_its_later_pictures_are_listed():
    # The change is δ but for rounding, so the finishing pass must see everything from there on.
    levels = own_levels(up=60 / 50)
    assert find_candidates(at_rest(20, 30, [0.99999]), levels).segment.tolist() == [1]
    for is_step in (False, True):
        levels = own_levels(is_step=is_step, up=60 / 50)
        late = find_candidates(at_rest(20, 30, [1.0, 0.5, 0.3]), levels)
        assert late.segment.tolist() == [0, 1, 2, 3]


def test_pixels_that_cannot_fire_are_not_followed():
    # A texture that moves by a quarter of a pixel changes by less than δ nearly everywhere; a flat
    # image never does, however fast its flow claims to be.
    ramp = np.tile(100 + 4 * np.arange(32, dtype=np.float32), (32, 1))
    slow = np.full((32, 32, 2), 0.25, np.float32)
    flat = np.full((32, 32), 100, np.float32)
    fast = np.full((32, 32, 2), 40.0, np.float32)
    active = np.empty(32, np.int64)
    for arrays in ((ramp, ramp + 1, slow, -slow), (flat, flat, fast, -fast)):
        bounded = bounded_pair(*arrays)
        assert not any(list_active(bounded, own_levels(), row, active) for row in range(32))
    assert list_active(bounded_pair(ramp, ramp, fast, -fast), own_levels(), 3, active) > 20


@pytest.mark.parametrize("shape", [(1, 5), (5, 1), (33, 40)])
@pytest.mark.parametrize("speed", [0.1, 0.5, 1.0])
def test_no_pixel_is_left_out_whose_trigger_level_a_sample_reaches(shape, speed):
    # Noise bends most between pixels. Each level is the most that any sample reaches.
    image = np.random.default_rng(3).uniform(0, 255, shape).astype(np.float32)
    forward = np.random.default_rng(4).uniform(-speed, speed, (*shape, 2)).astype(np.float32)
    shares = itertools.product(np.linspace(-1, 1, 9, dtype=np.float32), repeat=2)
    seen = np.float64([sample_along(image, forward, forward * share)[0] for share in shares])
    check_all_are_listed(bounded_pair(image, image, forward, -forward), seen)


@pytest.mark.parametrize(
    ("shape", "is_coarse"), [((1, 5), False), ((33, 40), False), ((33, 41), True)]
)
@pytest.mark.parametrize("speed", [1.0, 3.0, 30.0])
@pytest.mark.parametrize("back", [None, 0.5, 20.0])
def test_no_pixel_is_left_out_whose_trigger_level_an_intermediate_frame_reaches(
    shape, is_coarse, speed, back
):
    # Noise in which a small thing passes: paths that agree, paths that are chosen, and the sweep.
    rng = np.random.default_rng(5)
    first, second = rng.uniform(0, 255, (2, *shape)).astype(np.float32)
    height, width = vectors = tuple((side + 1) // 2 for side in shape) if is_coarse else shape
    forward = rng.uniform(-speed, speed, (*vectors, 2)).astype(np.float32)
    backward = -forward + rng.normal(0, speed / 9, forward.shape).astype(np.float32)
    if back is not None:  # drawn by itself, so that either direction may be the faster one
        backward = rng.uniform(-back, back, forward.shape).astype(np.float32)
    forward[height // 3 : height // 2, width // 4 : width // 2] = (speed, 1)
    positions = np.linspace(0.1, 0.9, 7)
    bounded = bounded_pair(first, second, forward, backward, positions=positions)
    seen = [*warp_pair(bounded.pair, 0, len(positions)), second]
    check_all_are_listed(bounded, np.float64(seen))


def check_all_are_listed(bounded, seen):
    """Every pixel whose trigger level is the brightest, or darkest, of what is seen [n, H, W]."""
    height, width = bounded.pair.first.shape
    active = np.empty(width, np.int64)
    for levels in (
        ReferenceLevels((seen.max(axis=0) + 30.0) / UP, 30.0, UP, 1e-9, False),
        ReferenceLevels((seen.min(axis=0) + 30.0) * UP, 30.0, 1e9, 1 / UP, False),
    ):
        found = [list_active(bounded, levels, row, active) for row in range(height)]
        assert found == [width] * height
