"""Upright animals: one body on a person's joints, with the head and the coat of an animal."""

from __future__ import annotations

import numpy as np
import pytest

from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.models.people.creatures.names import OF_UPRIGHT, UPRIGHT
from texvent.scenes.models.people.roles.dressing import dress
from texvent.scenes.models.protocol import Pose

_STANDING = Pose(0.0, 0.0, 0.0, "stand")


def test_every_upright_animal_is_a_noun_beside_the_animal_itself() -> None:
    assert set(OF_UPRIGHT) <= set(NOUNS)
    assert set(UPRIGHT) <= set(NOUNS)


@pytest.mark.parametrize("name", ["panda", "teddy bear", "frog", "monkey", "duck", "elephant"])
def test_an_upright_animal_stands_on_the_ground_and_plays(name: str) -> None:
    model = NOUNS[UPRIGHT[name]].build(colour=None, scale=1.0, seed=0)
    low = min(float(part.to_body[2, 3]) for part in model.parts(_STANDING))
    assert 0.0 <= low < 0.2
    assert 0.9 < model.height < 2.6
    still = model.parts(Pose(0.0, 0.0, 0.0, "play guitar"))
    later = model.parts(Pose(0.3, 0.0, 0.0, "play guitar"))
    assert len(still) == len(later)
    assert any(
        not np.allclose(one.to_body, other.to_body) for one, other in zip(still, later, strict=True)
    )


def test_trousers_colour_the_legs_and_leave_the_chest_bare() -> None:
    noun = NOUNS["upright kangaroo"]
    blue = (0.02, 0.05, 0.6)

    def colours(clad: bool) -> set[tuple[float, float, float]]:
        one = dress(noun, [("trousers", blue)]) if clad else noun
        return {part.colour for part in one.build(colour=None, scale=1.0, seed=0).parts(_STANDING)}

    assert blue in colours(True)
    assert colours(False) <= colours(True)
