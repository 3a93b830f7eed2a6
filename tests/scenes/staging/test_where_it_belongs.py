"""Things where their words put them: on heads, afloat, ashore, side by side, under the sky."""

import numpy as np
import pytest
from tests.scenes.staged import box
from tests.scenes.test_short_prompts import staged

from texvent_scenes.checks.water import wet_share
from texvent_scenes.models.places import PLACES

TIMES = np.linspace(0.0, 2.0, 9)


@pytest.mark.parametrize(
    "text",
    ["a cyclist in a red helmet rides past", "three cyclists wearing blue helmets",
     "a motorcyclist with a white helmet", "a cyclist with a green cap"],
)  # fmt: skip
def test_riders_have_on_the_head_what_they_wear(text):
    actors = staged(text)[0].actors
    half = len(actors) // 2
    for rider, worn in zip(actors[:half], actors[half:], strict=True):
        for time_s in TIMES:
            (low, high), (foot, top) = box(rider, time_s), box(worn, time_s)
            assert np.all(low[:2] <= foot[:2])
            assert np.all(top[:2] <= high[:2])
            assert high[2] - 0.3 < foot[2] < high[2] < top[2] + 0.02


@pytest.mark.parametrize(
    ("text", "is_white"),
    [("a man walks up a snowy hill", True), ("a hill in winter", True), ("a hill", False)],
)
def test_a_hill_is_white_under_snow(text, is_white):
    hill = next(one for one in staged(text)[0].actors if one.noun.name == "hill")
    assert (min(hill.place(0.0).parts[0].colour) > 0.5) is is_white


@pytest.mark.parametrize(
    "text", ["a leaf floats on the water", "a bottle floats on a lake", "a ball floats in the sea"]
)
def test_what_floats_on_water_is_in_it_up_to_its_waterline(text):
    scene = staged(text)[0]
    one = scene.actors[0]
    places = np.array([one.middle(float(time_s))[:2] for time_s in TIMES])
    assert wet_share(scene, places) == 1.0
    for low, high in (box(one, time_s) for time_s in TIMES):
        assert low[2] < 0.0 < high[2]


@pytest.mark.parametrize("noun", ["fishing boat", "canoe", "sailboat"])
def test_a_boat_that_lies_on_a_beach_is_on_land(noun):
    scene = staged(f"a {noun} lies on the beach")[0]
    one = scene.actors[0]
    assert wet_share(scene, one.corners(0.0)[:, :2]) == 0.0
    assert one.lowest_m(0.0) == pytest.approx(0.0, abs=0.03)


@pytest.mark.parametrize(
    "text", ["five apples on a plate", "three apples and two oranges on a plate",
             "nine tomatoes on a tray"],
)  # fmt: skip
def test_small_things_for_which_a_row_is_too_long_stand_in_several(text):
    actors = staged(text)[0].actors
    bearer = next(one for one in actors if one.noun.name in ("plate", "tray"))
    low, high = box(bearer, 0.0)
    others = [one.middle(0.0) for one in actors if one.noun.name not in ("plate", "tray", "table")]
    assert all(((low < at) & (at < high))[:2].all() for at in others)
    assert min(np.ptp(others, axis=0)[:2]) > 0.05


@pytest.mark.parametrize(
    ("text", "place"),
    [("a plane in the sky above a city", "city"), ("a kite in the sky over a hill", "grass"),
     ("an eagle in the sky over a forest", "forest"), ("a bird in the sky", "sky")],
)  # fmt: skip
def test_what_is_in_the_sky_is_over_the_place_that_is_said(text, place):
    assert staged(text)[0].place is PLACES[place]


@pytest.mark.parametrize("text", ["twins walk", "twin sisters dance", "triplets sit on a bench"])
def test_twins_look_the_same(text):
    scene = staged(text)[0]
    first, *others = (
        [part.colour for part in one.own_parts(one.pose(0.0))]
        for one in scene.actors if one.object_index == 0
    )  # fmt: skip
    assert others
    assert all(one == first for one in others)
