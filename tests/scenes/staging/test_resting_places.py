"""Walls, runways, lanes and falls: where things come to rest, and on which side."""

import itertools

import numpy as np
import pytest
from tests.scenes.every_row import for_every
from tests.scenes.staged import DURATION_S, SIZE, box, moved, stage, stage_text, thing
from tests.scenes.staging.test_containers import lost_relations
from tests.scenes.test_short_prompts import staged

from texvent_scenes.checks.in_view import find_unseen
from texvent_scenes.checks.surroundings.water import find_wet_and_dry, wet_share
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.places import PLACES
from texvent_scenes.models.shapes import bounds, compose
from texvent_scenes.models.shapes import moved as moved_by
from texvent_scenes.models.tables import nouns_with, trait_values


@pytest.mark.parametrize(
    "text", ["a clock on a brick wall", "two posters on a wall", "a tv on a plain wall"]
)
def test_what_hangs_on_a_wall_is_on_its_face_and_not_on_its_top(text):
    said, scene = stage_text(text)
    *hung, wall = scene.actors
    for one in hung:
        low, high = box(one, 0.0)
        assert low[2] > 0.0
        assert high[2] < box(wall, 0.0)[1][2]
    assert lost_relations(said, scene) == []
    tall = float(box(wall, 0.0)[1][2])
    assert lost_relations(said, moved(scene, hung[-1], (0, 0, tall))) == ["on"]


@pytest.mark.parametrize(
    ("text", "place", "tall_m", "does"),
    [
        ("a man stands in front of a wall in an office", "office", (2.5, 2.9), "stand"),
        ("a man stands in front of a brick wall in an office", "office", (1.0, 1.8), "stand"),
        ("a baby in a chair", "indoor", None, "sit"),
        ("an old man feeding pigeons on a bench", "grass", None, "feed"),
        ("a paper boat floats on a puddle", "grass", None, "sway"),
        ("a rainbow over green hills", "grass", None, None),
        ("a plane on a runway", "runway", None, "stand"),
        ("an office chair rolls across the floor", "indoor", None, "roll"),
    ],
)
def test_things_are_where_and_as_they_usually_are(text, place, tall_m, does):
    said, scene = stage_text(text)
    assert said.place.name == place
    assert does in (None, said.objects[0].motions[0].kind)
    if tall_m is not None:
        assert tall_m[0] < scene.actors[-1].model.height < tall_m[1]


@pytest.mark.parametrize("text", ["a cat on a brick wall", "a bird sits on a wall"])
def test_animals_are_on_top_of_a_wall(text):
    one, wall = stage_text(text)[1].actors
    assert one.middle(0.0)[2] > box(wall, 0.0)[1][2]


@pytest.mark.parametrize(
    ("text", "shift"),
    [("a vase on a stool", (0.25, 0, 0)), ("a ball on a table", (0, 0, -0.7)),
     ("a lamp on a desk", (0, 1.5, 0)), ("a dog on a rock", (1.6, 0, 0)),
     ("three cherries on a cake", (0.2, 0, 0))],
)  # fmt: skip
def test_what_is_on_something_has_it_below_most_of_its_foot(text, shift):
    said, scene = stage_text(text)
    assert lost_relations(said, scene) == []
    first, *_ = scene.actors
    assert lost_relations(said, moved(scene, first, shift)) == ["on"]


@pytest.mark.parametrize("noun", ["bottle", "glass", "vase", "candle"])
@pytest.mark.parametrize("verb", ["falls and lies on the floor", "lies on the floor"])
def test_a_tall_thing_that_lies_is_on_its_side_on_the_ground(noun, verb):
    (one,) = stage_text(f"a {noun} {verb}")[1].actors
    low, high = box(one, DURATION_S)
    assert (high - low)[2] < 0.8 * one.model.height
    assert abs(one.lowest_m(DURATION_S)) < 0.1 * one.model.height


@pytest.mark.parametrize("text", ["a book lies on a table", "an apple lies on the floor"])
def test_a_low_thing_that_lies_is_as_it_stands(text):
    one = stage_text(text)[1].actors[0]
    assert one.track.at(1.0).pitch == 0.0


@pytest.mark.parametrize(
    "text",
    ["an airplane lands on a runway", "a jet takes off from a runway",
     "a plane lands towards the camera on a runway", "an airplane stands on a runway"],
)  # fmt: skip
def test_an_aircraft_on_the_ground_has_the_strip_under_it(text):
    scene = stage_text(text)[1]
    one, strip = scene.actors[0], scene.still
    paved = int(np.argmax(np.linalg.norm(strip.to_world[:, :, 0], axis=1)))  # the longest part
    to_strip = np.linalg.inv(np.vstack([strip.to_world[paved], [0, 0, 0, 1]]))
    met = [time for time in np.linspace(0.0, DURATION_S, 9) if one.lowest_m(time) < 0.5]
    assert met
    for time in met:
        across = to_strip @ [*one.middle(time), 1.0]
        assert abs(across[:2]).max() < 1.0


@pytest.mark.parametrize(
    ("text", "sign"),
    [("a taxi waits behind a van", -1), ("two trucks behind a bus", -1),
     ("a bus stands in front of a car", 1)],
)  # fmt: skip
def test_vehicles_at_rest_are_one_behind_the_other_in_a_lane(text, sign):
    said, scene = stage_text(text)
    assert lost_relations(said, scene) == []
    *own, other = scene.actors
    yaw = other.track.at(0.0).yaw
    for one in own:
        off = (one.middle(0.0) - other.middle(0.0))[:2]
        along = off @ [np.cos(yaw), np.sin(yaw)]
        assert sign * along > 0.5 * (one.model.length + other.model.length)
        assert np.hypot(*off) - abs(along) < 1.0


@pytest.mark.parametrize(
    "text",
    ["a cyclist brakes in front of a pedestrian", "a man walks and stops in front of a bench"],
)
def test_who_stops_before_something_comes_to_rest_short_of_it(text):
    said, scene = stage_text(text)
    assert lost_relations(said, scene) == []
    one, other = scene.actors
    gone = one.middle(DURATION_S) - one.middle(0.0)
    assert (other.middle(DURATION_S) - one.middle(DURATION_S)) @ gone > 0.0
    assert lost_relations(said, moved(scene, other, -2.0 * gone)) != []


def test_several_things_that_are_passed_stand_one_after_the_other():
    said, scene = stage_text("a woman runs past a fountain and two benches")
    assert find_unseen(scene, said, SIZE, DURATION_S).out_of_view == ()
    fountain, *benches = scene.actors[1:]
    (low, high) = box(fountain, 0.0)
    assert all(box(one, 0.0)[0][0] > high[0] or box(one, 0.0)[1][0] < low[0] for one in benches)


def test_traits_name_nouns():
    assert nouns_with("hangs on a wall") | nouns_with("only a background") <= NOUNS.keys()
    put = trait_values("drawn put up")
    assert {*put, *put.values()} <= NOUNS.keys()


@pytest.mark.parametrize(("noun", "least_m", "most_m"), [
    ("football", 0.21, 0.23), ("basketball", 0.23, 0.25), ("tennis ball", 0.06, 0.07),
    ("ball", 0.15, 0.3), ("ping-pong ball", 0.035, 0.045), ("volleyball", 0.2, 0.22),
])  # fmt: skip
def test_balls_have_the_sizes_of_their_rules(noun, least_m, most_m):
    assert least_m <= NOUNS[noun].build(colour=None, scale=1.0, seed=0).height <= most_m


@pytest.mark.parametrize("text", ["a wall clock", "a wall clock ticks in a kitchen"])
def test_what_hangs_on_a_wall_by_its_name_does(text):
    clock, wall = stage_text(text)[1].actors
    assert clock.lowest_m(0.0) > 0.5
    assert wall.noun.name == "wall"


@pytest.mark.parametrize("text", ["a girl goes down a slide", "two boys sliding down a slide"])
def test_a_slide_is_slid_down_seated(text):
    own = [one for one in stage_text(text)[1].actors if one.noun.name != "slide"]
    for one in own:
        assert one.track.at(0.5).activity == one.track.at(DURATION_S).activity == "sit on ground"
        assert one.lowest_m(0.0) > 1.0 > 0.1 > abs(one.lowest_m(DURATION_S))


@pytest.mark.parametrize(
    "text", ["a car exits a tunnel, dashcam view", "a van drives through a tunnel, dashcam footage"]
)
def test_a_dashcam_is_in_the_car_that_goes_through_a_passage(text):
    scene = stage_text(text)[1]
    assert [one.noun.name for one in scene.actors] == ["tunnel"]
    (tunnel,) = scene.actors
    along = [scene.camera(at).position[1] - tunnel.middle(at)[1] for at in (0.0, DURATION_S)]
    assert along[0] < 0.0 < along[1]


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


@for_every(itertools.product(("drone", "pigeon", "cat", "helicopter"), ("building", "car", "taxi"),
                             (1, 2), range(3)))  # fmt: skip
def test_what_is_on_a_roof_goes_into_nothing_that_rises_there(row):
    who, what, count, seed = row
    count = 1 if who == "helicopter" else count
    *own, under = stage(thing(who, ("stand",), count=count), thing(what, ("stand",)),
                        relations=(("on", 0, 1),), seed=seed).actors  # fmt: skip
    rest = under.place(0.0)
    back = np.linalg.inv(np.vstack([rest.to_world, (0.0, 0.0, 0.0, 1.0)]))[:3]
    parts = np.array([bounds([one]) for one in rest.parts])
    for placed in (one.place(0.0) for one in own if who != "helicopter" or what == "building"):
        for one in moved_by(placed.parts, compose(back, placed.to_world)):
            low, high = bounds([one])
            slim = 0.25 * (high - low)
            assert not ((parts[:, 0] < high - slim) & (parts[:, 1] > low + slim)).all(axis=1).any()


@pytest.mark.parametrize("noun", sorted(nouns_with("has approaches")))
@pytest.mark.parametrize(
    "text",
    ["a {} over a river", "a car drives over a {} over a river", "a river with a {} and a boat"],
)
def test_a_river_runs_under_a_bridge_or_it_is_told(text, noun):
    said, scene = stage_text(text.format(noun))
    bridge = next(one for one in scene.actors if one.noun.name == noun)
    is_over = wet_share(scene, bridge.middle(0.0)[None, :2]) == 1.0
    assert is_over == (noun not in [one.value for one in find_wet_and_dry(scene, said, DURATION_S)])
    assert is_over or "boat" in text


@for_every(itertools.product(("man", "boy"), ("water", "coffee", "juice"), ("glass", "mug", "cup")))
def test_what_is_poured_ends_in_the_vessel(row):
    person, vessel = stage_text("a {} pours {} into a {}".format(*row))[1].actors
    (jet,) = (one for one in person.props if one.anchor == "hands")
    for time_s in (0.1, 0.9, 1.7):
        low, high = bounds(moved_by(jet.draw(time_s), person.anchor("hands", time_s)))
        top_m, middle = box(vessel, time_s)[1][2], vessel.middle(time_s)
        assert np.abs(0.5 * (low + high) - middle)[:2].max() < 0.5 * vessel.model.width
        assert low[2] < top_m < high[2]
