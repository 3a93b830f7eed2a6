import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.capture.motion_vectors.conventions import (
    CONVENTIONS,
    changes,
    parse_convention,
    to_pixels,
)
from texvent.errors import ConfigError

SIZE = (8, 4)
ONE = np.zeros((4, 8, 2), np.float32)
ONE[1, 2] = 3.0, -1.0


def vector(text, stored=ONE, direction="forward"):
    return to_pixels(stored, parse_convention(text), direction, SIZE)[1, 2].tolist()


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("standard", [3.0, -1.0]),
        ("y-up", [3.0, 1.0]),
        ("from", [-3.0, 1.0]),
        ("ndc", [3.0 * 4, -1.0 * 2]),
        ("ndc,y-up", [3.0 * 4, 1.0 * 2]),
        ("scale=0.5", [1.5, -0.5]),
        ("carla,to,px,y-down", [3.0, -1.0]),
    ],
)
def test_every_word_changes_what_it_says(text, expected):
    assert vector(text) == expected


def test_blender_s_vectors_lead_to_the_previous_frame_and_away_from_the_next_one():
    # Measured: a thing at x = 0.4, 0.9, 1.6 m, 12 px per m, that rises by 0.6 px per frame.
    blender = CONVENTIONS["blender"]
    passed = np.array([[[-6.0, -0.6, -8.4, -0.6]]], np.float32)
    backward = to_pixels(passed[..., :2], blender, "backward", (1, 1))
    forward = to_pixels(passed[..., 2:], blender, "forward", (1, 1))
    assert backward.ravel() == pytest.approx([-6.0, 0.6])
    assert forward.ravel() == pytest.approx([8.4, -0.6])


def test_carla_and_unreal_store_the_motion_since_the_previous_frame():
    # A thing that moved 2 px to the right and 1 px up in an image of 8x4.
    ndc = np.array([2 / 4, 1 / 2], np.float32)
    whole = np.zeros((4, 8, 2), np.float32) + ndc
    assert vector("carla", whole, "backward") == pytest.approx([-2.0, 1.0])
    assert vector("unreal", whole / 4 + 0.5, "backward") == pytest.approx([-2.0, 1.0])


def test_isaac_lab_counts_movement_to_the_left_and_to_the_top_as_positive():
    moved_left_and_up = np.zeros((4, 8, 2), np.float32) + np.float32([2.0, 1.0])
    # So the previous place lies to the right and below.
    assert vector("isaac", moved_left_and_up, "backward") == [2.0, 1.0]


def test_a_coarser_field_is_repeated_and_its_pixels_count_as_several():
    coarse = np.arange(4, dtype=np.float32).reshape(1, 2, 2)
    fine = to_pixels(coarse, parse_convention("standard"), "forward", (4, 2))
    assert fine.shape == (2, 4, 2)
    assert fine[:, :2].reshape(-1, 2).tolist() == [[0.0, 2.0]] * 4
    assert fine[:, 2:].reshape(-1, 2).tolist() == [[4.0, 6.0]] * 4
    in_ndc = to_pixels(coarse, parse_convention("ndc"), "forward", (4, 2))
    assert in_ndc[0, 3].tolist() == [2.0 * 2, 3.0 * 1]  # a share of the image is the same


@pytest.mark.parametrize(
    "text", ["blendr", "scale=0", "scale=x", "scale=e", "scale=1e999", "px,,", ""]
)
def test_unknown_words_are_named(text):
    with pytest.raises(ConfigError, match="motion_convention has"):
        parse_convention(text)


words = st.sampled_from(["to", "from", "ndc", "px", "y-up", "y-down", "scale=2"])


@given(st.sampled_from(sorted(CONVENTIONS)), st.lists(words, max_size=4))
def test_the_words_that_are_named_make_one_convention_of_the_other(name, more):
    given_one = parse_convention(name)
    other = parse_convention(",".join([name, *more]))
    direction = given_one.direction
    text = ",".join([name, *changes(given_one, other, direction)])
    assert changes(parse_convention(text), other, direction) == ()
