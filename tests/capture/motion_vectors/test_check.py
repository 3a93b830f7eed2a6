import itertools
from unittest import mock

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from tests.capture.motion_vectors import moving_scene as scene

from texvent.capture.motion_vectors import check
from texvent.capture.motion_vectors.check import Neighbours, judge
from texvent.capture.motion_vectors.conventions import parse_convention


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
