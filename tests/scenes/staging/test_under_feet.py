"""Skis, boards and blades: they go with the feet, whatever these do."""

import numpy as np
import pytest
from tests.scenes.staged import DURATION_S, stage_text

from texvent_scenes.models.shapes import bounds, moved

TIMES = np.linspace(0.0, DURATION_S, 41)


def lowest(actor, found, time_s):
    """Height of the lowest point of props at an instant, m."""
    drawn = [moved(one.draw(time_s), actor.anchor(one.anchor, time_s)) for one in found]
    return min(bounds(each)[0][2] for each in drawn)


@pytest.mark.parametrize(
    ("text", "places"),
    [("a skier does a backflip", ["left sole", "right sole"]),
     ("a skateboarder does a somersault", ["soles"]),
     ("a figure skater does a flip", ["left sole", "right sole"]),
     ("a skier does a cartwheel", ["left sole", "right sole"])],
)  # fmt: skip
def test_what_is_under_the_feet_turns_over_with_them(text, places):
    (actor,) = stage_text(text)[1].actors
    found = [one for one in actor.props if one.anchor in places]
    assert [one.anchor for one in found] == places
    low = [actor.anchor(places[0], time_s) for time_s in TIMES]
    assert min(one[2, 2] for one in low) < -0.9  # it is upside down
    assert np.ptp([one[2, 3] for one in low]) > 1.2
    assert min(lowest(actor, found, time_s) for time_s in TIMES) > -0.1


@pytest.mark.parametrize(
    "text",
    ["a skier skis to the left", "a girl skateboards to the right", "a surfer surfs to the left",
     "a boy does a kickflip", "a figure skater skates to the left"],
)  # fmt: skip
def test_who_stands_on_boards_or_skis_has_the_feet_on_them_and_these_on_the_ground(text):
    (actor,) = stage_text(text)[1].actors
    below = [one for one in actor.props if one.thickness_m]
    assert below
    assert actor.track.at(0.0).position[2] == pytest.approx(max(o.thickness_m for o in below))
    assert lowest(actor, below, 0.0) == pytest.approx(0.0, abs=0.04)
