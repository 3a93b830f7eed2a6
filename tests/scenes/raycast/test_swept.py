"""Swept regions: what changes fast between two instants lies in blocks that something passes."""

from itertools import pairwise

import numpy as np
import pytest
from tests.scenes.staged import stage_text

from texvent.sensor import SensorSize
from texvent_scenes.raycast.changed_tiles import changed_shapes, shadow_windows
from texvent_scenes.raycast.incremental import BLOCK
from texvent_scenes.raycast.render import render, world_and_shapes
from texvent_scenes.raycast.swept import swept_speeds

SIZE = SensorSize(88, 64)
SHAPE = SIZE.height // BLOCK, SIZE.width // BLOCK
STEP_S = 1e-3
MOVING = (
    "a drone hovers above a field", "a fan spins on a table in an office", "a windmill on a hill",
    "a red ball bounces on a wooden floor", "a wheel spins",
    "a car drives left on a road", "a helicopter flies over a meadow",
)  # fmt: skip


def instants(text, count=6):
    _, scene = stage_text(text)
    times = [0.4 + STEP_S * number for number in range(count)]
    return scene, times, [world_and_shapes(scene, time_s, SIZE) for time_s in times]


@pytest.mark.parametrize("text", MOVING)
def test_what_changes_lies_in_blocks_that_something_passes(text):
    scene, times, drawn = instants(text)
    swept = swept_speeds(drawn, SHAPE, BLOCK, 1.0)
    back = swept_speeds(drawn[::-1], SHAPE, BLOCK, 1.0)  # nothing is faster one way
    np.testing.assert_allclose(back[::-1], swept)
    images = [render(scene, time_s, SIZE) for time_s in times]
    for before, after, speeds in zip(images, images[1:], swept, strict=False):
        change = np.abs(after - before).max(axis=2)
        blocks = change.reshape(SHAPE[0], BLOCK, SHAPE[1], BLOCK).max(axis=(1, 3))
        assert blocks[speeds == 0.0].max(initial=0.0) < 0.5
    assert (swept == 0.0).mean() > 0.2


@pytest.mark.parametrize("text", [MOVING[0], "a quadcopter flies past a tree"])
def test_what_begins_or_ceases_to_glow_has_a_shadow_at_both_instants(text):
    """What glows casts none of the sun's light, so its shadow comes and goes."""
    _, scene = stage_text(text)
    coarse = [world_and_shapes(scene, 0.1 * number, SIZE) for number in range(12)]
    pairs = [
        (a, b)
        for a, b in pairwise(coarse)
        if ((a.world.shapes["emission"] > 0.0) != (b.world.shapes["emission"] > 0.0)).any()
    ]
    found = [shadow_windows(*pair, changed_shapes(*pair)) for pair in pairs]
    known = [one for one in found if one]
    assert known
    for before, _, after, _ in known:
        assert before.shape == after.shape
        assert len(before)


@pytest.mark.parametrize("text", MOVING[:4])
def test_a_change_that_nothing_passes_is_found(text):
    """The property can fail: without the largest of the windows something changes outside."""
    scene, times, drawn = instants(text, 2)
    swept = swept_speeds(drawn, SHAPE, BLOCK, 1.0)
    images = [render(scene, time_s, SIZE) for time_s in times]
    change = np.abs(images[1] - images[0]).max(axis=2)
    blocks = change.reshape(SHAPE[0], BLOCK, SHAPE[1], BLOCK).max(axis=(1, 3))
    assert (blocks[swept[0] > 0.0] > 0.5).any()


def test_where_the_camera_moves_nothing_is_known():
    assert swept_speeds(instants("the camera pans through a kitchen")[2], SHAPE, BLOCK, 1.0) is None


def test_a_shape_counts_with_the_displacement_of_its_fastest_point():
    """Without shadows: that of the windows of a car, or more inside of them, as wheels turn."""
    _, scene = stage_text("a car drives left on a road")
    times = (0.4, 0.4 + STEP_S)
    drawn = [world_and_shapes(scene, time_s, SIZE, shadows=False) for time_s in times]
    swept = swept_speeds(drawn, SHAPE, BLOCK, 1.0)
    first, last = (one.world.shapes["window"] for one in drawn)
    moved = np.abs(last - first).max()
    finite = swept[np.isfinite(swept)]
    assert 0.9 * moved <= finite.max() < 12.0 * moved
