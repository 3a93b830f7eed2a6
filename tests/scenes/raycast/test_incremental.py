"""Instants between frames: which blocks something passes, and which pixels are sure, by hand."""

import itertools
import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples

from texvent.sensor import SensorSize
from texvent_scenes.raycast.adaptive_sampling import UNKNOWN
from texvent_scenes.raycast.incremental import (
    BLOCK,
    SURE_PX,
    block_speeds,
    predict_surface_ids,
    spread_speeds,
    widen_speeds,
)

SIZE = SensorSize(22, 17)  # the last blocks are partial ones
BLOCKS = -(-SIZE.height // BLOCK), -(-SIZE.width // BLOCK)
seeds = given(seed=st.integers(0, 2**32 - 1))


def drawn_speeds(rng, most_px, shape=BLOCKS):
    speeds = rng.uniform(0.0, most_px, shape) * (rng.random(shape) < 0.3)
    speeds[rng.random(shape) < 0.05] = np.inf
    return speeds.astype(np.float32)


@seeds
@examples(30)
def test_speeds_reach_half_a_displacement_around(seed):
    speeds = drawn_speeds(np.random.default_rng(seed), 40.0)
    expected = speeds.copy()
    for at, to in itertools.product(np.ndindex(BLOCKS), repeat=2):
        away = max(abs(a - b) for a, b in zip(at, to, strict=True))
        if speeds[at] < math.inf and away <= int(speeds[at] / 2 / BLOCK):
            expected[to] = max(expected[to], speeds[at])
    np.testing.assert_array_equal(widen_speeds(speeds), expected)


@seeds
@examples(30)
def test_a_block_is_as_fast_as_all_that_passes_it(seed):
    rng = np.random.default_rng(seed)
    vectors = np.zeros((*SIZE.shape, 2), np.float32)
    moving = rng.random(SIZE.shape) < 0.02
    vectors[moving] = rng.uniform(-15.0, 15.0, (moving.sum(), 2))
    vectors[rng.random(SIZE.shape) < 0.005] = np.nan
    speeds = np.zeros(BLOCKS, np.float32)
    spread_speeds(vectors, speeds)
    expected = np.zeros(BLOCKS)
    for (row, column), (dx, dy) in zip(np.ndindex(SIZE.shape), vectors.reshape(-1, 2), strict=True):
        length = math.hypot(dx, dy) if np.isfinite([dx, dy]).all() else math.inf
        steps = 1 + int(length / BLOCK) if length < math.inf else 0
        for share in np.arange(steps + 1) / max(steps, 1):
            ends = [column, row] if length == math.inf else [column + share * dx, row + share * dy]
            x, y = (math.floor(one) for one in ends)
            if 0 <= x < SIZE.width and 0 <= y < SIZE.height:
                block = y // BLOCK, x // BLOCK
                expected[block] = max(expected[block], length)
    np.testing.assert_allclose(speeds, expected, rtol=1e-6)


def test_without_a_field_nothing_is_known_and_of_two_fields_the_faster_counts():
    slow, fast = (np.full((*SIZE.shape, 2), one, np.float32) for one in (0.3, 0.4))
    np.testing.assert_allclose(block_speeds(SIZE, slow, fast), 0.4 * math.sqrt(2), rtol=1e-6)
    assert np.isinf(block_speeds(SIZE, slow, None)).all()


@seeds
@examples(30)
def test_what_nothing_reaches_stays_what_it_is(seed):
    rng = np.random.default_rng(seed)
    before = rng.choice(np.array([3, 3, 3, 3, 3, 3, 3, 7, UNKNOWN], np.int64), BLOCKS)
    before = before.repeat(BLOCK, axis=0).repeat(BLOCK, axis=1)[: SIZE.height, : SIZE.width]
    after = before.copy()
    after[rng.random(SIZE.shape) < 0.01] = 7
    moved, wanted = drawn_speeds(rng, 2.0 * SURE_PX), rng.random(SIZE.shape) < 0.8
    codes = np.full(SIZE.shape, UNKNOWN)
    predict_surface_ids(before, after, wanted, moved, codes)
    for row, column in np.ndindex(SIZE.shape):
        displacement, code = moved[row // BLOCK, column // BLOCK], before[row, column]
        reach = 1 + int(displacement / 2) if displacement <= SURE_PX else None
        near = slice(max(row - (reach or 0), 0), row + (reach or 0) + 1)
        beside = slice(max(column - (reach or 0), 0), column + (reach or 0) + 1)
        around = np.append(before[near, beside], after[near, beside])
        is_sure = wanted[row, column] and reach is not None and (around == code).all()
        assert codes[row, column] == (code if is_sure else UNKNOWN)
