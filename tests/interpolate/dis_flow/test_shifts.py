"""Shifts of the whole frame that are larger than the search of patches."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples
from tests.interpolate.dis_flow import compiled, reference

from texvent.interpolate.dis_flow.estimator import DisFlow, count_levels, make_pyramid
from texvent.interpolate.dis_flow.frame_motion import find_shift, leads_outside

WIDTH, HEIGHT = 96, 72


def texture(seed, cell=4, side=200):
    """Random levels in cells, joined by a few means, [side, side]."""
    rng = np.random.default_rng(seed)
    image = np.kron(rng.uniform(0, 255, (side // cell, side // cell)), np.ones((cell, cell)))
    for _ in range(2):
        image = (image + np.roll(image, 1, 0) + np.roll(image, 1, 1) + np.roll(image, (1, 1))) / 4
    return image.astype(np.float32)


def view(image, x, y, width=WIDTH, height=HEIGHT, scale=1):
    """What a camera sees after everything has moved by (x, y) px, with pixels of that size."""
    seen = image[60 - y : 60 - y + height, 60 - x : 60 - x + width]
    return seen.repeat(scale, axis=0).repeat(scale, axis=1)


def shift_between(first, second):
    return find_shift(*(make_pyramid(one, count_levels(one.shape)) for one in (first, second)))


@pytest.mark.parametrize(("x", "y"), [(20, -6), (-32, 0), (0, 24), (30, 18)])
@pytest.mark.parametrize("scale", [1, 3, 7])
def test_the_shift_of_a_frame_of_any_size_is_found_within_a_cell(x, y, scale):
    first, second = (view(texture(1), *one, scale=scale) for one in ((0, 0), (x, y)))
    found = shift_between(first, second)
    np.testing.assert_allclose(found, (scale * x, scale * y), atol=2 * scale)
    np.testing.assert_array_equal(shift_between(second, first), -found)
    np.testing.assert_array_equal(shift_between(0.2 * first + 9, 0.7 * second), found)
    turned = [np.ascontiguousarray(one.T) for one in (first, second)]
    np.testing.assert_array_equal(shift_between(*turned), found[::-1])


ASIDE, NEAR, FAR = (0, 0), (14, -12), (30, 18)


@pytest.mark.parametrize(
    ("parts", "wanted"),
    [
        # Places in the second frame, or None for another texture, and the correlation with each.
        ({FAR: 0.62, None: 0.78}, FAR),
        ({FAR: 0.38, None: 0.92}, None),
        ({FAR: 0.92, ASIDE: 0.38}, FAR),
        ({FAR: 0.78, ASIDE: 0.62}, None),
        ({FAR: 0.71, NEAR: 0.70}, NEAR),
        ({FAR: 0.84, NEAR: 0.54}, FAR),
    ],
)
@pytest.mark.parametrize("gain", [1.0, 0.1, 0.008])
def test_a_shift_is_told_by_its_agreement(parts, wanted, gain):
    image, other = (texture(seed) - 127.5 for seed in (1, 4))
    second = sum(much * (view(other, 0, 0) if at is None else view(image, *at))
                 for at, much in parts.items())  # fmt: skip
    found = shift_between(gain * view(image, 0, 0), gain * second)
    if wanted is None or gain < 0.01:  # detail of less than two levels says nothing
        assert found is None
    else:
        np.testing.assert_allclose(found, wanted, atol=2)


def test_motion_that_patches_find_themselves_is_left_to_them():
    image = texture(2)
    assert shift_between(view(image, 0, 0), view(image, 0, 0)) is None
    assert shift_between(view(image, 0, 0), view(image, 7, 3)) is None


def test_unrelated_and_flat_frames_are_not_shifted():
    first, second = (view(texture(seed), 0, 0) for seed in (3, 4))
    assert shift_between(first, second) is None
    flat = np.full((HEIGHT, WIDTH), 80, np.float32)
    assert shift_between(flat, flat + 9) is None


def test_stripes_that_repeat_move_by_less_than_a_period():
    along = np.arange(200)
    image = np.tile(128 + 100 * np.sin(2 * np.pi * along / 16), (200, 1)).astype(np.float32)
    assert shift_between(view(image, 0, 0), view(image, 20, 0)) is None


def test_the_shorter_of_two_shifts_that_agree_alike_counts():
    # Repeats after 40 px: 28 px to the right or 12 to the left. Only 12 px explain both ways alike.
    image = np.tile(texture(5, side=40), (5, 5))
    found = shift_between(view(image, 0, 0), view(image, 28, 0))
    np.testing.assert_allclose(found, (-12, 0), atol=2)


@examples(12)
@given(st.integers(-32, 32), st.integers(-24, 24), st.integers(0, 99))
def test_flow_of_a_shift_of_up_to_a_third_of_the_frame_is_that_shift(x, y, seed):
    image = texture(seed)
    flows = DisFlow().both_ways(view(image, 0, 0), view(image, x, y))
    shift = np.broadcast_to(np.float32([x, y]), (HEIGHT, WIDTH, 2))
    for flow, sign in zip(flows, (1, -1), strict=True):
        error = np.abs(flow - sign * shift).max(axis=-1)
        is_seen = ~leads_outside(np.moveaxis(sign * shift, -1, 0))
        assert np.median(error[is_seen]) < 0.2
        # Small steps are found by patches alone, which guess what leaves the view.
        assert np.mean(error[is_seen] < 1.0) > 0.93


def test_what_rests_before_a_moving_ground_keeps_its_own_flow():
    image, sign = texture(7), texture(8)[:32, :32]
    first, second = (view(image, x, 0).copy() for x in (0, 24))
    for frame in (first, second):
        frame[20:52, 30:62] = sign
    forward, _ = DisFlow().both_ways(first, second)
    np.testing.assert_allclose(np.median(forward[28:44, 38:54], axis=(0, 1)), 0, atol=0.3)
    np.testing.assert_allclose(np.median(forward[:12], axis=(0, 1)), (24, 0), atol=0.3)


@pytest.mark.parametrize("kernels", [reference, compiled], ids=["reference", "compiled"])
def test_a_patch_takes_the_shift_that_fits_it_or_leads_it_out_of_the_view(kernels):
    image = texture(9, side=200)
    start, stop = (kernels.make_level(view(image, x, 0, 32, 8)) for x in (0, 12))
    patches = np.zeros((1, 9, 3), np.float32)
    patches[..., 2] = 1e9  # found nowhere
    vectors = np.tile(np.float32([12, 0]), (1, 9, 1))
    found = kernels.try_vectors(start, stop, patches, 3, vectors)
    np.testing.assert_allclose(found[0, :, :2], [[12, 0]] * 9, atol=1e-3)
    # Patches begin three apart: five stay within the 32 columns, and the middles of three leave.
    assert (found[0, :5, 2] < 1e-3).all()
    assert not found[0, 6:, 2].any()
    patches[..., 2] = 0  # found where they are
    worse = np.tile(np.float32([5, 0]), (1, 9, 1))
    np.testing.assert_array_equal(kernels.try_vectors(start, stop, patches, 3, worse), patches)


@pytest.mark.parametrize("kernels", [reference, compiled], ids=["reference", "compiled"])
def test_texture_that_repeats_goes_with_the_frame(kernels):
    stripes = np.tile(128 + 100 * np.sin(np.arange(40) * np.pi / 8), (8, 1)).astype(np.float32)
    start, stop = (kernels.make_level(np.roll(stripes, x, 1)) for x in (0, 7))
    patches = np.zeros((1, 11, 3), np.float32)
    patches[..., 0] = -9  # fits as well as 7
    vectors = np.tile(np.float32([7, 0]), (1, 11, 1))
    found = kernels.try_vectors(start, stop, patches, 3, vectors)
    np.testing.assert_allclose(found[0, 3:9, 0], 7, atol=1e-3)
