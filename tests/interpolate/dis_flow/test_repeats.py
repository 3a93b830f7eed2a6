"""Texture that repeats takes the nearest place it fits, unless its surroundings say otherwise."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from texvent.interpolate.dis_flow import flow_cpu, flow_reference
from texvent.interpolate.dis_flow.estimator import DisFlow

HEIGHT, WIDTH = 72, 96
KERNELS = pytest.mark.parametrize("kernels", [flow_reference, flow_cpu], ids=["reference", "cpu"])


def stripes(moved, period, angle=0.0, height=HEIGHT, width=WIDTH):
    y, x = np.mgrid[:height, :width]
    along = x * np.cos(angle) + y * np.sin(angle)
    waves = 128 + 100 * np.sin(2 * np.pi * (along - moved) / period)
    return waves.astype(np.float32)


def noise(seed, height=HEIGHT, width=WIDTH):
    image = np.random.default_rng(seed).uniform(0, 255, (height, width))
    for axis in (0, 1, 0, 1):
        image = (image + np.roll(image, 1, axis)) / 2
    return image.astype(np.float32)


def patches_at(kernels, start, stop, flow):
    """Patches that all have one flow, with their costs."""
    height, width = start.shape
    levels = kernels.make_level(start), kernels.make_level(stop)
    whole = np.broadcast_to(np.float32(flow)[:, None, None], (2, height, width)).copy()
    return *levels, kernels.search(*levels, whole, False)


@KERNELS
def test_stripes_that_fit_two_places_take_the_nearer_one(kernels):
    # They repeat after 8 px: moved by 2 px to the right, or by 6 to the left.
    start, stop, patches = patches_at(
        kernels, stripes(0, 8)[:32, :48], stripes(2, 8)[:32, :48], (-6, 0)
    )
    assert np.median(patches[..., 0]) < -5.9
    found = kernels.take_nearest(start, stop, patches)
    np.testing.assert_allclose(found[:, 1:-1, 0], 2.0, atol=0.1)


@KERNELS
def test_the_nearer_one_stays(kernels):
    start, stop, patches = patches_at(
        kernels, stripes(0, 8)[:32, :48], stripes(2, 8)[:32, :48], (2, 0)
    )
    np.testing.assert_array_equal(kernels.take_nearest(start, stop, patches), patches)


@KERNELS
def test_texture_that_does_not_repeat_and_flat_images_keep_their_flow(kernels):
    image = noise(1, 40, 56)
    for start, stop in ((image[:, :48], image[:, 8:]), (0 * image, 0 * image)):
        *levels, patches = patches_at(kernels, start[:32], stop[:32, :48], (-8, 0))
        np.testing.assert_array_equal(kernels.take_nearest(*levels, patches), patches)


@KERNELS
def test_an_edge_along_which_a_patch_slides_is_no_texture_that_repeats(kernels):
    x = np.arange(48, dtype=np.float32)
    edge = np.tile(128 + 100 * np.tanh((x - 24) / 2), (32, 1)).astype(np.float32)
    start, stop, patches = patches_at(kernels, edge, edge, (0, 4))
    assert np.median(patches[..., 1]) == 4.0
    np.testing.assert_array_equal(kernels.take_nearest(start, stop, patches), patches)


@KERNELS
def test_a_striped_thing_whose_outline_has_moved_keeps_its_flow(kernels):
    # A patch within cannot tell 5 px to the right from 3 px to the left; those at its border can.
    y, x = np.mgrid[:48, :64]

    def show(moved):
        inside = np.hypot(x - 30 - moved, y - 24) < 15
        return np.where(inside, stripes(moved, 8, 0.0, 48, 64), 0.5 * noise(3, 48, 64))

    *levels, patches = patches_at(
        kernels, *(show(moved).astype(np.float32) for moved in (0, 5)), (5, 0)
    )
    found = kernels.take_nearest(*levels, patches)
    assert np.abs(found[5:10, 7:12, 0] - 5.0).max() < 0.1


@settings(max_examples=6, deadline=None)
@given(st.integers(5, 14), st.floats(0, 3), st.floats(0, 40), st.integers(0, 99))
def test_the_compiled_form_equals_the_definition(period, angle, spread, seed):
    rng = np.random.default_rng(seed)
    images = (stripes(moved, period, angle, 30, 41) for moved in (0, rng.uniform(0, period)))
    start, stop = (
        flow_cpu.make_level(one + rng.normal(0, spread, one.shape).astype(np.float32))
        for one in images
    )
    begin = rng.normal(0, 4, (2, 30, 41)).astype(np.float32)
    patches = flow_cpu.search(start, stop, begin, False)
    before = patches.copy()
    found = flow_cpu.take_nearest(start, stop, patches)
    np.testing.assert_array_equal(found, flow_reference.take_nearest(start, stop, patches))
    np.testing.assert_array_equal(patches, before)
    short2, long2 = ((one[..., :2] ** 2).sum(axis=-1) for one in (found, patches))
    assert (short2 <= long2).all()


@pytest.mark.parametrize(("period", "angle", "moved"), [(10, 0.0, 2), (10, 0.5, 3), (24, 0.5, 2)])
def test_fine_and_slanted_stripes_move_by_less_than_half_a_period(period, angle, moved):
    size = 144, 192
    flow, back = DisFlow().both_ways(
        stripes(0, period, angle, *size), stripes(moved, period, angle, *size)
    )
    across = np.float32([np.cos(angle), np.sin(angle)])
    inner = np.s_[16:-16, 16:-16]
    assert np.mean(np.abs((flow @ across)[inner] - moved) < 0.3) > 0.9
    assert np.mean(np.abs((back @ across)[inner] + moved) < 0.3) > 0.9
