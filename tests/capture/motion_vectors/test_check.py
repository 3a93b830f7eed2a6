import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.capture.motion_vectors import moving_scene as scene

from texvent.capture.motion_vectors.check import Neighbours, judge
from texvent.capture.motion_vectors.conventions import changes, parse_convention, to_pixels

WRONG = ["backward", "from", "y-up", "scale=0.5", "scale=2", "ndc", "from,y-up"]


def neighbours(stored, index=2):
    """A frame, its neighbours, and the same stored field whichever way it is meant."""
    luma = {
        "here": scene.frame(index),
        "forward": scene.frame(index + 1),
        "backward": scene.frame(index - 1),
    }
    both = {"forward": stored, "backward": stored}
    return Neighbours(luma, both)


def test_right_vectors_fit():
    frames = [neighbours(scene.forward(index), index) for index in (1, 2, 3)]
    verdict = judge(frames, parse_convention("standard"), "forward")
    assert verdict.better is None
    assert verdict.error < 1.5 < verdict.still_error
    assert not verdict.is_high


@pytest.mark.parametrize("text", WRONG)
def test_another_convention_is_found_and_named(text):
    convention = parse_convention(text)
    direction = convention.direction
    verdict = judge(
        [neighbours(scene.forward(index), index) for index in (1, 2, 3)], convention, direction
    )
    assert verdict.better is not None
    found = to_pixels(
        scene.forward(2),
        verdict.better,
        verdict.better.direction,
        (scene.WIDTH, scene.HEIGHT),
    )
    expected = {"forward": scene.forward(2), "backward": scene.backward(2)}
    # With even motion, "to the next frame" and "away from the previous one" are the same vectors.
    np.testing.assert_allclose(found, expected[verdict.better.direction], rtol=1e-6, atol=1e-12)
    assert changes(convention, verdict.better, direction)


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
