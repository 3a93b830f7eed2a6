import itertools
from dataclasses import replace
from unittest import mock

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from tests.capture.motion_vectors import moving_scene as scene

from texvent.capture.motion_vectors import check
from texvent.capture.motion_vectors.check import Neighbours, judge
from texvent.capture.motion_vectors.conventions import parse_convention, scaled


@given(st.floats(-6, 6), st.floats(-6, 6), st.booleans())
def test_exact_vectors_are_never_refused(x, y, is_backward):
    row, column = np.mgrid[:40, :56].astype(np.float64)

    def image(index):
        moved = scene.texture(column - x * index, row - y * index, 0.9)
        return np.asarray(moved, np.float32)

    vector = np.float32([-x, -y] if is_backward else [x, y])
    stored = np.zeros((40, 56, 2), np.float32) + vector
    frame = Neighbours(
        {"here": image(1), "forward": image(2), "backward": image(0)},
        {"forward": stored, "backward": stored},
    )
    direction = "backward" if is_backward else "forward"
    verdict = judge([frame], parse_convention(direction), direction)
    assert verdict is None or (verdict.better is None and not verdict.is_high)


def test_nothing_is_said_where_nothing_moves():
    still = np.zeros((scene.HEIGHT, scene.WIDTH, 2), np.float32)
    image = scene.frame(0)
    frame = Neighbours({"here": image, "forward": image}, {"forward": still})
    assert judge([frame], parse_convention("standard"), "forward") is None


def test_vectors_of_another_film_explain_little():
    rng = np.random.default_rng(3)
    stored = np.zeros((scene.HEIGHT, scene.WIDTH, 2), np.float32) + np.float32([4.0, 4.0])
    images = [rng.uniform(0, 255, (scene.HEIGHT, scene.WIDTH)).astype(np.float32) for _ in range(3)]
    frame = Neighbours(
        dict(zip(("backward", "here", "forward"), images, strict=True)),
        {"forward": stored, "backward": stored},
    )
    verdict = judge([frame], parse_convention("standard"), "forward")
    assert verdict.better is None
    assert verdict.is_high


@given(st.integers(1, 400), st.integers(1, 400))
def test_samples_lie_on_a_grid_over_the_whole_frame_as_dense_as_their_number_allows(width, height):
    image = np.zeros((height, width), np.float32)
    with mock.patch.object(check, "MOST_SAMPLES", 500):
        samples = check._Samples.of(Neighbours({"here": image}, {}))
    step = next(n for n in itertools.count(1) if width * height <= 500 * n * n)
    grid = [(row, x) for row in range(0, height, step) for x in range(0, width, step)]
    assert list(zip(samples.rows, samples.columns, strict=True)) == grid


def level_at(image, x, y):
    """Level between pixels, weighted by hand; places outside take the nearest edge."""
    x, y = (min(max(place, 0), length - 1) for place, length in ((x, 10), (y, 8)))
    left, top = min(int(x), 8), min(int(y), 6)
    (a, b), (c, d) = image[top : top + 2, left : left + 2].tolist()
    upper, lower = (one + (x - left) * (other - one) for one, other in ((a, b), (c, d)))
    return upper + (y - top) * (lower - upper)


@given(st.integers(0, 2**32), st.sampled_from([0.5, 2.0]), st.booleans())
def test_pixels_that_move_in_either_meaning_are_compared_in_both(seed, scale, is_turned):
    draws = np.random.default_rng(seed)
    images = draws.uniform(0, 255, (3, 8, 10)).astype(np.float32)
    luma = dict(zip(("here", "forward", "backward"), images, strict=True))
    stored = draws.uniform(-1.2, 1.2, (8, 10, 2)).astype(np.float32)
    frame = Neighbours(luma, {"forward": stored, "backward": stored})
    meant = replace(parse_convention("forward"), direction="forward")
    other = replace(meant, scale=scale, direction="backward" if is_turned else "forward")
    fields = [
        (one.direction, scaled(stored, one, one.direction, (10, 8), 1)) for one in (meant, other)
    ]
    expected = []
    for y, x in np.ndindex(8, 10):
        ways = [(side, *field[y, x].tolist()) for side, field in fields]
        if any(abs(step) > check.MOVING_PX for _, *steps in ways for step in steps):
            seen = [level_at(luma[side], x + right, y + down) for side, right, down in ways]
            levels = [*seen, luma["forward"][y, x]]
            expected.append([abs(luma["here"][y, x] - one) for one in levels])
    samples = check._Samples.of(frame)
    still = samples.difference("forward", None)
    found = np.transpose(check._errors(samples, other, check._follow(samples, meant), still))
    # OpenCV takes the nearest 1/32 px.
    np.testing.assert_allclose(found, np.reshape(expected, (-1, 3)), atol=8)
