"""Instants between two frames with known motion: against the reference, and by hand."""

from dataclasses import replace
from math import floor

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples
from tests.interpolate.motion.reference import level_at
from tests.interpolate.motion.scenes import (
    BACKGROUND_M,
    HEIGHT,
    OBJECT_M,
    WIDTH,
    bar_frame,
    bar_pair,
    field,
    texture,
    views,
)

from texvent.frames import Frame, MotionVectors
from texvent.interpolate.motion.interpolator import MotionPair, moving_part
from texvent.interpolate.motion.paths import reverse_vectors

FLAT = np.full((HEIGHT, WIDTH), BACKGROUND_M, np.float32)


def moving_texture(x: float, y: float, *, forward: bool = True, backward: bool = True):
    first = MotionVectors(forward=field(x, y) if forward else None, depth=FLAT)
    second = MotionVectors(backward=field(-x, -y) if backward else None, depth=FLAT)
    return (
        Frame(texture().astype(np.float32), 0, motion=first),
        Frame(texture(x, y).astype(np.float32), 1000, motion=second),
    )


def both_at(
    first: Frame, second: Frame, place: float, pixels: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Levels of the chosen pixels, [n, 2] of x and y, by the kernels and by the reference."""
    image = MotionPair.of(first, second).draw(place)
    one, two = views(first, second)
    expected = [level_at(one, two, place, x, y) for x, y in pixels.tolist()]
    return image[pixels[:, 1], pixels[:, 0]], np.array(expected)


PIXELS = np.stack(np.meshgrid(np.arange(WIDTH), np.arange(HEIGHT)), axis=2).reshape(-1, 2)


@pytest.mark.parametrize("place", [0.3, 1.0])
def test_a_bar_before_a_background_is_drawn_as_defined(place):
    # The bar is upright: two rows at the image's edges and one inside.
    rows = PIXELS[np.isin(PIXELS[:, 1], (0, 5, HEIGHT - 1))]
    image, expected = both_at(*bar_pair(), place, rows)
    np.testing.assert_allclose(image, expected, rtol=0, atol=0.02)


@pytest.mark.long
@pytest.mark.parametrize("shares", [(0.6, 0.8), (0.6, 1.4), (1.7, 0.5), (1.3, 1.6)])
def test_random_surfaces_are_drawn_as_defined(shares):
    """The two frames bend a path to the same side or to others, one more than twice the other."""
    random = np.random.default_rng(5)
    for _ in range(2):
        depth = np.where(random.random((HEIGHT, WIDTH)) < 0.2, OBJECT_M, BACKGROUND_M)
        depth = depth * random.uniform(0.9, 1.1, depth.shape)  # surfaces slope
        turn = random.normal(0, 0.05, (2, 2))
        y, x = np.mgrid[:HEIGHT, :WIDTH]
        bent = np.stack([x, y], axis=2) @ turn + random.normal(0, 1.5, 2)
        vectors = np.where((depth < 10)[..., None], bent + 1.0, bent).astype(np.float32)
        frames = [
            Frame(
                random.uniform(20, 220, (HEIGHT, WIDTH)).astype(np.float32),
                1000 * index,
                motion=MotionVectors(
                    forward=vectors, backward=-share * vectors, depth=depth.astype(np.float32)
                ),
            )
            for index, share in enumerate(shares)
        ]
        image, expected = both_at(*frames, 0.4, random.permutation(PIXELS)[:30])
        # A place exactly on a limit may fall to either side in float32.
        assert np.mean(np.abs(image - expected) > 0.05) < 0.02


def test_an_edge_moves_by_parts_of_a_pixel():
    """The bar starts at 4 and moves 2.5 px: its edges cross pixels smoothly, nothing smears."""
    pair = MotionPair.of(*bar_pair())
    for place in (0.1, 0.2, 0.5, 0.8):
        image = pair.draw(place)
        left = 4.0 + 2.5 * place
        assert np.abs(image - bar_frame(left, left + 4.0)).max() < 6.0


def test_what_the_nearer_thing_reveals_comes_from_the_frame_that_shows_it():
    first, second = bar_pair(start=4.0, step=6.0, wide=3.0)
    image = MotionPair.of(first, second).draw(0.5)
    assert image[:, 4] == pytest.approx(160.0, abs=0.5)  # covered at first, free by now
    assert image[:, 8] == pytest.approx(40.0, abs=0.5)  # the bar is here, in neither frame
    assert image[:, 12] == pytest.approx(160.0, abs=0.5)  # covered in the end, not yet


def test_without_depth_the_faster_thing_is_nearer():
    first, second = bar_pair(start=4.0, step=6.0, wide=3.0)
    bare = [
        Frame(one.pixels, one.t_us, motion=MotionVectors(one.motion.forward, one.motion.backward))
        for one in (first, second)
    ]
    image = MotionPair.of(*bare).draw(0.5)
    assert image[:, 8] == pytest.approx(40.0, abs=1.0)
    assert image[:, 4] == pytest.approx(160.0, abs=1.0)


@given(st.integers(0, 2**32), st.sampled_from([0.0, 0.2, 0.9]))
def test_vectors_that_are_not_given_are_those_of_the_nearest_pixel_that_arrives(seed, unknown):
    rng = np.random.default_rng(seed)
    vectors = rng.uniform(-5, 5, (6, 8, 2)).astype(np.float32)
    vectors[rng.random((6, 8)) < unknown] = np.nan
    order = rng.integers(0, 9, (6, 8)).astype(np.float32)
    sources = [(*one, *vectors[one].tolist()) for one in np.ndindex(6, 8)]
    arrivals = [(floor(y + dy), floor(x + dx), y, x) for y, x, dx, dy in sources if dx == dx]
    expected = np.full((6, 8, 2), np.nan)
    for row, column in np.ndindex(6, 8):
        here = [
            (order[y, x], y, x)
            for top, left, y, x in arrivals
            if top in (row - 1, row) and left in (column - 1, column)
        ]
        if here:
            expected[row, column] = -vectors[min(here)[1:]]
    np.testing.assert_array_equal(reverse_vectors(vectors, order), expected)


@pytest.mark.parametrize(("missing", "number"), [("forward", 0), ("backward", 1)])
def test_a_side_that_is_missing_is_the_other_one_turned_round(missing, number):
    frames = bar_pair(start=4.0, step=6.0, wide=3.0)
    given, own = frames[1 - number].motion, frames[number].motion
    turned = reverse_vectors(given.backward if number == 0 else given.forward, given.depth)
    images = []
    for side in (None, turned):
        motion = replace(own, **{missing: side})
        pair = [replace(one, motion=motion) if one is frames[number] else one for one in frames]
        images.append(MotionPair.of(*pair).draw(0.5))
    np.testing.assert_array_equal(*images)


def test_paths_are_curved_with_vectors_to_both_neighbours():
    """Constant acceleration: places 0, 1 and 4 px at three frames; 2.25 px halfway."""
    shape = (HEIGHT, WIDTH)
    place = {-1: 0.0, 0: 1.0, 1: 4.0, 2: 9.0}
    frames = [
        Frame(
            texture(place[index]).astype(np.float32),
            1000 * index,
            motion=MotionVectors(
                forward=field(place[index + 1] - place[index], 0.0),
                backward=field(place[index - 1] - place[index], 0.0),
                depth=np.full(shape, 5.0, np.float32),
            ),
        )
        for index in (0, 1)
    ]
    image = MotionPair.of(*frames).draw(0.5)
    assert np.abs(image - texture(2.25))[3:-3, 5:-4].max() < 0.6


def test_a_bounce_between_frames_is_followed_straight():
    """Before the pair it came from the other side: the bends disagree, so the path is straight."""
    first, second = moving_texture(3.0, 0.0)
    bounced = MotionVectors(forward=field(3.0, 0.0), backward=field(3.0, 0.0), depth=FLAT)
    going_on = MotionVectors(forward=field(3.0, 0.0), backward=field(-3.0, 0.0), depth=FLAT)
    pair = MotionPair.of(
        Frame(first.pixels, 0, motion=bounced), Frame(second.pixels, 1000, motion=going_on)
    )
    image = pair.draw(0.5)
    assert np.abs(image - texture(1.5))[3:-3, 4:-4].max() < 0.5


def test_frames_at_rest_are_mixed_in_place():
    flat = MotionVectors(forward=field(0, 0), backward=field(0, 0), depth=FLAT)
    dark = Frame(np.full((HEIGHT, WIDTH), 50, np.float32), 0, motion=flat)
    light = Frame(np.full((HEIGHT, WIDTH), 90, np.float32), 1000, motion=flat)
    image = MotionPair.of(dark, light).draw(0.25)
    assert image == pytest.approx(60.0)
    same = MotionPair.of(dark, dark).draw(0.25)
    assert (same == 50).all()


def test_where_no_path_leads_both_frames_are_mixed():
    first, second = moving_texture(2.0, 0.0)
    forward, backward = first.motion.forward.copy(), second.motion.backward.copy()
    forward[3:8, 3:9] = backward[3:8, 3:9] = np.nan
    frames = (
        Frame(first.pixels, 0, motion=MotionVectors(forward=forward, depth=FLAT)),
        Frame(second.pixels, 1000, motion=MotionVectors(backward=backward, depth=FLAT)),
    )
    image = MotionPair.of(*frames).draw(0.5)
    assert image[5, 6] == pytest.approx((first.luma[5, 6] + second.luma[5, 6]) / 2, abs=0.01)


@examples(25)
@given(
    x=st.floats(-6, 6),
    y=st.floats(-6, 6),
    place=st.floats(0, 1),
    depth=st.sampled_from([1e-6, 0.5, 300.0, np.inf, np.nan]),
)
def test_levels_stay_within_those_of_the_frames(x, y, place, depth):
    first, second = moving_texture(x, y)
    first.motion.depth[3:6, 3:6] = depth
    try:
        image = MotionPair.of(first, second).draw(place)
    finally:
        first.motion.depth[3:6, 3:6] = BACKGROUND_M
    assert np.isfinite(image).all()
    low, high = min(first.luma.min(), second.luma.min()), max(first.luma.max(), second.luma.max())
    assert image.min() >= low - 0.01
    assert image.max() <= high + 0.01


@pytest.mark.parametrize("seed", range(6))
def test_the_part_that_moves_holds_where_each_moving_pixel_is_and_goes(seed):
    rng = np.random.default_rng(seed)
    forward, backward = np.zeros((2, 60, 90, 2), np.float32)
    row, column = rng.integers(2, 56), rng.integers(2, 86)
    forward[row, column] = rng.uniform(-20, 20, 2)
    backward[rng.integers(60), rng.integers(90)] = np.nan  # it is not in the other frame
    rows, columns = moving_part(forward, backward)
    y, x = np.argwhere(np.isnan(backward[..., 0]))[0]
    end = np.add((row, column), forward[row, column][::-1])
    for place in ((row, column), (y, x), end):
        if ((np.floor(place) >= 0) & (np.ceil(place) < (60, 90))).all():
            assert rows.start <= place[0] < rows.stop
            assert columns.start <= place[1] < columns.stop
    assert moving_part(*np.zeros((2, 60, 90, 2), np.float32))[0] == slice(60, 60)
