"""What four-legged animals do in their place: mouths at the ground, feet on it, smooth in time."""

import numpy as np
import pytest

from texvent.scenes.models.animals.acts import ANIMAL_ACTS, MOUTH_ACTS, act_stance, shown_as
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
    assert model.anchor("mouth", pose)[2, 3] < 0.3 * model.height


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
