"""How words change the light of a place."""

from __future__ import annotations

import numpy as np
import pytest

from texvent.scenes.description import Illumination
from texvent.scenes.models.places import PLACES
from texvent.scenes.staging.surroundings.lighting import (
    choose_lighting,
    tint_of,
    towards_light,
    usual_lighting,
)

AHEAD = np.array((0.0, 1.0, 0.0))
USUAL = np.array((0.0, 0.6, 0.8))


@pytest.mark.parametrize(
    ("direction", "axis", "sign"), [("left", 0, -1), ("right", 0, 1), ("back", 1, 1),
                                    ("front", 1, -1), ("above", 2, 1)]
)  # fmt: skip
def test_light_comes_from_where_it_is_said_to(direction, axis, sign):
    towards = towards_light(USUAL, AHEAD, Illumination(direction=direction))
    assert np.linalg.norm(towards) == pytest.approx(1.0)
    assert towards[2] > 0.0
    assert sign * towards[axis] > 0.8
    low = towards_light(USUAL, AHEAD, Illumination(direction=direction, is_low=True))
    assert 0.0 < low[2] < 0.3


def test_a_tint_has_its_colour():
    def tint(name: str) -> tuple[float, float, float]:
        found = tint_of(Illumination(tint=name))
        assert found is not None
        return found

    red, _, blue = tint("warm")
    assert red > blue
    red, _, blue = tint("cold")
    assert red < blue
    assert tint("#0000ff") == pytest.approx((0.15, 0.15, 1.0))


def test_soft_light_casts_no_shadow_and_hard_light_darkens_them():
    usual = usual_lighting(PLACES["road"], "day")
    soft = choose_lighting(PLACES["road"], Illumination(hardness="soft"))
    hard = choose_lighting(PLACES["road"], Illumination(hardness="hard"))
    assert not soft.shadows
    assert soft.sun[0] / soft.ambient[0] < usual.sun[0] / usual.ambient[0]
    assert hard.shadows
    assert hard.sun[0] / hard.ambient[0] > usual.sun[0] / usual.ambient[0]
