"""Dense inverse search: hand-made cases for kernels and reference, which give equal bits."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples
from tests.interpolate.dis_flow import compiled, reference

from texvent.interpolate.dis_flow.definitions import MARGIN, size_of
from texvent.interpolate.dis_flow.estimator import count_levels

KERNELS = pytest.mark.parametrize("kernels", [reference, compiled], ids=["reference", "compiled"])


def waves(shape, dx=0.0, dy=0.0, seed=0):
    rng = np.random.default_rng(seed)
    y, x = np.mgrid[: shape[0], : shape[1]].astype(np.float64)
    image = np.full(shape, 120.0)
    for _ in range(10):
        length, angle, phase = rng.uniform(6, 25), rng.uniform(0, np.pi), rng.uniform(0, 6)
        along = (x - dx) * np.cos(angle) + (y - dy) * np.sin(angle)
        image += 20 * np.sin(2 * np.pi * along / length + phase)
    return image.astype(np.float32)


def test_images_are_halved_until_they_are_about_four_patches_long():
    assert count_levels((260, 346)) == 3
    assert count_levels((720, 1280)) == 5
    assert count_levels((16, 400)) == 1
    assert count_levels((16, 16)) == 0


@KERNELS
def test_halving_takes_means_and_counts_an_odd_edge_twice(kernels):
    image = np.float32([[1, 3, 5], [5, 7, 9], [2, 4, 6]])
    np.testing.assert_array_equal(kernels.halve(image), [[4, 7], [3, 6]])


@KERNELS
def test_slopes_are_those_of_a_plane_in_levels_per_pixel(kernels):
    y, x = np.mgrid[:20, :30].astype(np.float32)
    level = kernels.make_level(2 * x - 3 * y + 100)
    inner = np.s_[MARGIN + 1 : -MARGIN - 1, MARGIN + 1 : -MARGIN - 1]
    np.testing.assert_array_equal(level[1][inner], 2.0)
    np.testing.assert_array_equal(level[2][inner], -3.0)
    assert size_of(level) == (20, 30)
    assert level[0, 0, 0] == 100
    assert not level[1:, :MARGIN].any()


@KERNELS
def test_doubling_a_flow_doubles_its_vectors_and_joins_their_places(kernels):
    flow = np.float32([[[1, 2], [3, 4]], [[0, 0], [8, 8]]])
    got = kernels.double(flow, (4, 3))
    # Rows 1, 1.5, 2.5, 3 and columns +0, +.25, +.75 of the first component, twice.
    np.testing.assert_allclose(got[0], 2 * np.add.outer([1, 1.5, 2.5, 3], [0, 0.25, 0.75]))
    np.testing.assert_allclose(got[1, :, 0], [0, 4, 12, 16])


@KERNELS
def test_a_patch_that_its_first_flow_explains_is_not_searched(kernels):
    # Flow that is wrong by a half costs a patch of faint texture less than `EXPLAINED`.
    for contrast, stays in ((0.01, True), (1.0, False)):
        start, stop = (kernels.make_level(contrast * waves((24, 32), dx)) for dx in (0.0, 1.0))
        begin = np.full((2, 24, 32), 0.5, np.float32)
        found = kernels.search(start, stop, begin, 4, False)
        assert (found[..., :2] == 0.5).all() == stays


@KERNELS
def test_brighter_light_alone_does_not_move_patches(kernels):
    start, stop = (kernels.make_level(waves((24, 32)) + more) for more in (0, 25))
    found = kernels.search(start, stop, np.zeros((2, 24, 32), np.float32), 3, False)
    assert np.abs(found[..., :2]).max() < 1e-3


@KERNELS
def test_a_pixel_counts_those_patches_more_that_fit_it(kernels):
    # Two patches hold columns 3 to 7. The left one, which has not moved, fits; the right one, which
    # has, is 20 levels off: weights 1 and 1/20.
    start = kernels.make_level(np.tile(20 * np.arange(11, dtype=np.float32), (8, 1)))
    patches = np.zeros((1, 2, 3), np.float32)
    patches[0, 1, 0] = 1.0
    flow = kernels.join(start, start, patches, 3)
    np.testing.assert_allclose(flow[0, 2, :3], 0.0)
    np.testing.assert_allclose(flow[0, 2, 3:8], (1 / 20) / (1 + 1 / 20), rtol=1e-5)
    np.testing.assert_allclose(flow[0, 2, 8:10], 1.0)


@KERNELS
def test_refining_leaves_a_perfect_flow_and_mends_most_of_a_vector_that_is_not(kernels):
    start, stop = (kernels.make_level(waves((24, 32), dx)) for dx in (0.0, 1.0))
    flow = np.zeros((2, 24, 32), np.float32)
    flow[0] = 1.0
    np.testing.assert_allclose(
        kernels.refine(start, stop, flow)[:, 4:-4, 4:-4], flow[:, 4:-4, 4:-4], atol=1e-3
    )
    flow[0, 12, 16] = 3.0
    assert abs(kernels.refine(start, stop, flow)[0, 12, 16] - 1.0) < 0.8


@examples(6)
@given(
    st.sampled_from([(8, 8), (9, 8), (24, 33), (30, 21)]),
    st.floats(0, 40),
    st.sampled_from([3, 4]),
    st.booleans(),
    st.integers(0, 99),
)
def test_compiled_parts_equal_their_definitions(shape, spread, step, is_coarsest, seed):
    rng = np.random.default_rng(seed)
    images = waves(shape, seed=seed), waves(shape, 2.3, 1.1, seed=seed)
    images = [one + rng.normal(0, 1 + spread, shape).astype(np.float32) for one in images]
    flow = rng.normal(0, 1 + spread, (2, *shape)).astype(np.float32)
    wanted = [reference.make_level(one) for one in images]
    for got, level, image in zip(map(compiled.make_level, images), wanted, images, strict=True):
        np.testing.assert_array_equal(got, level)
        np.testing.assert_array_equal(compiled.halve(image), reference.halve(image))
    twice = tuple(2 * side - seed % 2 for side in shape)
    np.testing.assert_array_equal(compiled.double(flow, twice), reference.double(flow, twice))
    patches = reference.search(*wanted, flow, step, is_coarsest)
    np.testing.assert_array_equal(compiled.search(*wanted, flow, step, is_coarsest), patches)
    vectors = rng.normal(0, 1 + shape[0] / 4, (*patches.shape[:2], 2)).astype(np.float32)
    tried = reference.try_vectors(*wanted, patches, step, vectors)
    np.testing.assert_array_equal(compiled.try_vectors(*wanted, patches, step, vectors), tried)
    back = rng.normal(0, 0.3, flow.shape).astype(np.float32) - flow
    confirmed = reference.unconfirmed(*wanted, flow, back)
    np.testing.assert_array_equal(compiled.unconfirmed(*wanted, flow, back), confirmed)
    change = reference.change_along(*wanted, flow)
    np.testing.assert_array_equal(compiled.change_along(*wanted, flow), change)
    joined = np.ascontiguousarray(reference.join(*wanted, tried, step))  # as that of a run
    np.testing.assert_array_equal(compiled.join(*wanted, tried, step), joined)
    np.testing.assert_array_equal(
        compiled.refine(*wanted, joined), reference.refine(*wanted, joined)
    )
