"""What is small or cut off and plainly seen is no loss; what is lost stays one."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from texvent.generate.seen_things import image_points
from texvent.generate.seen_words.plain import ease_faults, ease_names
from texvent.generate.sights import Glimpse, Sight
from texvent.sensor import SensorSize

SIZE = SensorSize(173, 130)
POINTS = image_points(SIZE)
SMALL, OTHER = 1, 2


def picture(colour: float, radius: float = 5.0, nouns=("ball", "ball")) -> SimpleNamespace:
    """A disc of a grey level on a ground of 0.3, seen at three instants."""
    inside = np.linalg.norm(POINTS - [80.0, 60.0], axis=1) <= radius
    levels = np.where(inside, colour, 0.3)[:, None].repeat(3, axis=1)
    scene = SimpleNamespace(
        actors=(), class_names={SMALL: nouns[0], OTHER: nouns[1]}, object_of={SMALL: 0, OTHER: 1}
    )
    views = [SimpleNamespace(instance=np.where(inside, SMALL, 0))] * 3
    return SimpleNamespace(
        scene=scene, size=SIZE, points=POINTS, views=views, colours=lambda number: levels
    )


def glimpses(share: float, inside: float, unhidden: float = 1.0) -> dict[int, Sight]:
    points = round(share * len(POINTS))
    return {SMALL: Sight([Glimpse(points, round(points / unhidden), 0.3, inside)] * 9)}


@pytest.mark.parametrize(
    ("colour", "radius", "left"),
    [(0.9, 5.0, None), (0.4, 5.0, "too small"), (0.9, 1.0, "too small")],
    ids=["white", "like the ground", "speck"],
)
def test_what_is_small_is_seen_where_its_colour_stands_out(colour, radius, left):
    of = picture(colour, radius)
    assert ease_faults(of, {SMALL: "too small"}, {}) == {SMALL: left}
    kept = ease_names(of, {("name", 0): "too small", ("colour", 0): "not red"})
    assert (("name", 0) in kept) == (left is not None)
    assert ("colour", 0) in kept


@pytest.mark.parametrize(
    ("share", "inside", "other", "left"),
    [
        (0.02, 0.35, None, None),
        (0.02, 0.35, "hidden", "cut off"),
        (0.02, 0.1, None, "cut off"),
        (0.3, 0.35, "hidden", None),
        (0.3, 0.1, "hidden", "cut off"),
    ],
    ids=["beside a whole one", "alone", "a sliver", "a table top", "a piece of anything"],
)
def test_a_piece_is_told_beside_a_whole_one_or_by_its_surface(share, inside, other, left):
    faults = {SMALL: "cut off", OTHER: other}
    eased = ease_faults(picture(0.4), faults, glimpses(share, inside))
    assert eased == {SMALL: left, OTHER: other}
    strange = picture(0.4, nouns=("ball", "cat"))
    if share < 0.1:
        assert ease_faults(strange, faults, glimpses(share, inside))[SMALL] == "cut off"


def test_what_lies_behind_others_stays_hidden():
    faults = {SMALL: "mostly hidden", OTHER: None}
    assert ease_faults(picture(0.4), faults, glimpses(0.02, 1.0, unhidden=0.1)) == faults
    assert ease_faults(picture(0.9), {SMALL: "hidden"}, {}) == {SMALL: "hidden"}
