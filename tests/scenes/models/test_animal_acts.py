"""What four-legged animals do in their place: mouths at the ground, feet on it, smooth in time."""

import numpy as np
import pytest

from texvent.scenes.models.animals.acts import ANIMAL_ACTS, MOUTH_ACTS, act_stance, shown_as
from texvent.scenes.models.animals.four_legged.clothing import clothe
from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.models.protocol import Pose
from texvent.scenes.models.shapes import bounds

ANIMALS = ("dog", "cat", "horse", "cow", "zebra", "rabbit", "sheep", "elephant")


def parts_at(noun: str, act: str, time_s: float) -> list:
    model = NOUNS[noun].build(colour=None, scale=1.0, seed=0)
    return list(model.parts(Pose(time_s, 0.0, 0.0, act)))


@pytest.mark.parametrize("noun", ANIMALS)
def test_a_grazing_mouth_is_low(noun: str) -> None:
    model = NOUNS[noun].build(colour=None, scale=1.0, seed=0)
    pose = Pose(0.2, 0.0, 0.0, "graze")
    place = "trunk" if noun == "elephant" else "mouth"
    lowest = min(model.anchor(place, Pose(t, 0.0, 0.0, "graze"))[2, 3] for t in (0.2, 0.4, 0.6))
    assert lowest < 0.3 * model.height
    assert model.anchor("crown", pose)[2, 3] > model.anchor("mouth", pose)[2, 3]


def test_an_elephant_that_sprays_has_its_trunk_over_its_head() -> None:
    model = NOUNS["elephant"].build(colour=None, scale=1.0, seed=0)
    pose = Pose(0.5, 0.0, 0.0, "spray")
    assert model.anchor("trunk", pose)[2, 3] > model.anchor("crown", pose)[2, 3]


def test_a_sweater_is_cloth_around_the_trunk_and_the_head_keeps_its_fur() -> None:
    yellow = (0.7, 0.5, 0.02)
    noun = clothe(NOUNS["dog"], [("sweater", yellow)])
    parts = noun.build(colour=None, scale=1.0, seed=0).parts(Pose(0.0, 0.0, 0.0, "stand"))
    clad = [part for part in parts if part.colour == yellow]
    assert 3 <= len(clad) < 0.5 * len(parts)
    assert clothe(NOUNS["gull"], [("sweater", yellow)]) is NOUNS["gull"]


def test_a_bird_that_perches_stands_on_its_feet() -> None:
    model = NOUNS["bird"].build(colour=None, scale=1.0, seed=0)
    perched, flying = (bounds(model.parts(Pose(0.2, 0.0, 0.0, a))) for a in ("sit", "fly"))
    assert perched[1][2] - perched[0][2] > 1.2 * (flying[1][0] - flying[0][0]) * 0.5
    assert len(model.parts(Pose(0.0, 0.0, 0.0, "peck"))) == len(
        model.parts(Pose(0.0, 1.0, 3.0, "fly"))
    )


@pytest.mark.parametrize("act", sorted(ANIMAL_ACTS))
@pytest.mark.parametrize("noun", ["dog", "horse"])
def test_an_act_moves_parts_smoothly_and_not_into_the_ground(noun: str, act: str) -> None:
    start, moved = parts_at(noun, act, 0.0), 0.0
    size = NOUNS[noun].build(colour=None, scale=1.0, seed=0).height
    for time_s in np.arange(0.0, 2.0, 0.21):
        now, next_ = parts_at(noun, act, time_s), parts_at(noun, act, time_s + 1e-3)
        assert len(now) == len(start)
        step = max(np.abs(a.to_body - b.to_body).max() for a, b in zip(now, next_, strict=True))
        assert step < 0.02 * size
        assert bounds(now)[0][2] > -0.06 * size
        moved = max(
            moved, *(np.abs(a.to_body - b.to_body).max() for a, b in zip(now, start, strict=True))
        )
    assert moved > 0.02 * size


def test_what_is_heard_is_reported_as_what_is_seen() -> None:
    assert shown_as("bark", "bark") == "throw up its head"
    assert shown_as("eat", "nibble") is None
    assert set(ANIMAL_ACTS) >= MOUTH_ACTS
    assert act_stance("stand", 0.3) == act_stance("walk", 0.9)
