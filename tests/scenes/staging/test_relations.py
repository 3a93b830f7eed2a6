"""Places and relations: where things are, and where they go."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.scenes.every_row import for_every
from tests.scenes.staged import stage, thing

from texvent.sensor import SensorSize
from texvent_scenes.defaults import complete
from texvent_scenes.description import to_description
from texvent_scenes.models.activities import ACTIVITIES, TO_AND_FROM_SEATS, TRAVELLING
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.places import PLACES, is_room
from texvent_scenes.raycast.render import render
from texvent_scenes.spec.scene import Motion, Scene, SceneObject
from texvent_scenes.staging.placement.object_groups import GAP_M
from texvent_scenes.staging.placement.object_groups import overlap as groups_overlap
from texvent_scenes.staging.placement.object_placement import ObjectPlacer
from texvent_scenes.staging.surroundings.road_line import RoadLine

TIMES = np.linspace(0.0, 2.0, 9)


def overlap(first, second, time_s):
    """Share of the first one's box that lies in the second one's, over the ground."""
    boxes = [actor.corners(time_s)[:, :2] for actor in (first, second)]
    low = np.maximum(boxes[0].min(axis=0), boxes[1].min(axis=0))
    high = np.minimum(boxes[0].max(axis=0), boxes[1].max(axis=0))
    return float(np.prod(np.maximum(high - low, 0.0)) / np.prod(np.ptp(boxes[0], axis=0)))


@pytest.mark.parametrize(("noun", "other"), [("box", "man"), ("car", "tree"), ("dog", "horse")])
def test_objects_just_at_their_gap_are_apart_whichever_way_the_last_bit_rounds(noun, other):
    said = Scene(objects=(SceneObject(noun=noun), SceneObject(noun=other)))
    placer = ObjectPlacer(
        complete(to_description(said), NOUNS), NOUNS, seed=1, duration_s=1.0, level_m={}
    )
    one, two = map(placer.build_group, (0, 1))
    side = float(one.half[0] + two.half[0] + GAP_M * min(one.size_m, two.size_m))
    for reach, is_near in ((side - 1e-14, False), (side + 1e-14, False), (side - 1e-6, True)):
        assert groups_overlap(np.array([reach, 0.0, 0.0]), one, two) == is_near


@pytest.mark.parametrize(
    ("noun", "target", "share"),
    [("cat", "table", 1.0), ("man", "tree", 1.0), ("elephant", "chair", 0.0)],
)
def test_what_fits_is_under_its_target_and_what_does_not_is_beside_it(noun, target, share):
    one, other = stage(thing(noun, ("stand",)), thing(target), relations=(("under", 0, 1),)).actors
    assert overlap(one, other, 1.0) == pytest.approx(share, abs=0.1)
    assert np.hypot(*(one.middle(0.0) - other.middle(0.0))[:2]) > 0.1


@pytest.mark.parametrize(
    ("noun", "target"), [("bird", "flower"), ("drone", "man"), ("butterfly", "tree")]
)
@pytest.mark.parametrize("relation", ["beside", "at", "left of"])
def test_what_hovers_beside_a_thing_is_as_high_as_it(noun, target, relation):
    objects = thing(noun, ("hover",)), thing(target, ("stand",))
    one, other = stage(*objects, relations=((relation, 0, 1),)).actors
    low, high = (corners[:, 2] for corners in (one.corners(0.0), other.corners(0.0)))
    assert low.min() > 0.0
    assert low.min() <= high.max()


@pytest.mark.parametrize("relation", ["overtake", "past"])
def test_a_car_overtakes_a_truck_without_touching_it(relation):
    objects = thing("car", ("drive", "right")), thing("truck", ("drive",))
    car, truck = stage(*objects, relations=((relation, 0, 1),), place="road").actors
    ahead = [float(car.middle(t)[0] - truck.middle(t)[0]) for t in (0.0, 2.0)]
    assert ahead[0] < 0.0 < ahead[1]
    assert max(overlap(car, truck, t) for t in TIMES) == 0.0


def test_what_begins_after_the_clip_is_reported():
    jumps = Motion("jump", start_s=5.0)
    walks = SceneObject("man", motions=(Motion("walk"), jumps))
    assert stage(walks).not_shown == ("the man's jump after 5 s (the clip ends at 2 s)",)
    assert stage(walks, duration_s=8.0).not_shown == ()


@pytest.mark.parametrize("count", [1, 4])
def test_people_at_a_table_sit_on_chairs_around_it_and_face_it(count):
    objects = thing("person", count=count), thing("table")
    *people, table = stage(*objects, relations=(("at", 0, 1),), place="indoor").actors
    assert len({tuple(np.round(one.middle(0.0)[:2], 2)) for one in people}) == count
    for one in people:
        state = one.track.at(0.0)
        inwards = (table.middle(0.0) - one.middle(0.0))[:2]
        assert state.activity == "sit"
        assert state.to_world()[:2, 0] @ inwards > 0.4 * np.linalg.norm(inwards)
        assert any(prop.anchor == "ground" for prop in one.props)
        assert overlap(one, table, 0.0) < 0.5


@for_every([None, *sorted(set(ACTIVITIES) - TO_AND_FROM_SEATS)])
def test_who_is_on_a_seat_or_at_a_table_sits_unless_what_they_do_is_done_standing(kind):
    for relation, target in (("on", "chair"), ("at", "table")):
        motions = () if kind is None else ((kind,),)
        objects = thing("man", *motions), thing(target)
        man, *others = stage(*objects, relations=((relation, 0, 1),)).actors
        is_done_seated = kind is not None and ACTIVITIES[kind].is_done_seated
        doing = f"sit and {kind}" if is_done_seated else kind or "sit"
        assert man.track.at(0.0).activity == doing, relation
        is_on = relation == "on" and kind not in TRAVELLING
        feet = man.track.at(0.0).to_world()[:2, 3]  # a rod is long: the box is no measure
        for box in (one.corners(0.0)[:, :2] for one in others if is_on):
            assert ((box.min(axis=0) < feet) & (feet < box.max(axis=0))).all(), relation
        has_chair = any(prop.anchor == "ground" for prop in man.props)
        assert relation == "on" or not doing.startswith("sit") or "ground" in doing or has_chair


WAYS = ((), (("stand",),), (("walk", "left"),), (("walk", "left"), ("run", "left")))


@pytest.mark.parametrize("kind", ["behind", "front"])
def test_a_thing_stands_as_far_aside_of_who_goes_as_of_who_stands(kind):
    """It is seen past the body, however long the way is."""
    aside = []
    for way in WAYS:
        objects = thing("man", *way), thing("car", ("stand",))
        _, car = stage(*objects, relations=((kind, 0, 1),)).actors
        aside.append(car.middle(0.0)[0])
    assert aside == pytest.approx([aside[0]] * len(WAYS), abs=0.1)


def test_who_is_on_what_moves_goes_along():
    objects = thing("cat", ("sit",)), thing("bus", ("drive", "left"))
    cat, bus = stage(*objects, place="road", relations=(("on", 0, 1),)).actors
    away = [cat.middle(time_s) - bus.middle(time_s) for time_s in (0.0, 1.0, 2.0)]
    np.testing.assert_allclose(away, np.tile(away[0], (3, 1)), atol=1e-6)
    assert np.linalg.norm(bus.middle(2.0) - bus.middle(0.0)) > 1.0


@pytest.mark.parametrize("place", PLACES)
def test_every_place_can_be_drawn_and_a_room_holds_its_furniture(place):
    scene = stage(thing("dog"), place=place)
    image = render(scene, 0.5, SensorSize(48, 36))
    assert np.isfinite(image).all()
    assert image.std() > 1.0
    if is_room(place):
        room = scene.environment(0.0).room_half_size
        assert (np.abs(scene.still.to_world[:, :2, 3]) <= room + 0.1).all()


def test_a_name_belongs_to_one_place_and_scenery_has_models():
    names = [name for one in PLACES.values() for name in one.names]
    assert len(names) == len(set(names))
    assert all(one.names for one in PLACES.values())
    assert {one.noun for place in PLACES.values() for one in place.scenery} <= set(NOUNS)


@given(st.floats(-4.0, 4.0), st.floats(-40.0, 40.0))
def test_points_at_a_distance_lie_on_the_line(angle, along):
    road = RoadLine(angle, (3.0, -2.0))
    x, y, heading = road.at(along)
    assert math.hypot(x - 3.0, y + 2.0) == pytest.approx(abs(along))
    assert road.distance(np.array([[x, y]]))[0] == pytest.approx(0.0, abs=1e-9)
    left = np.array([[x - 0.5 * math.sin(heading), y + 0.5 * math.cos(heading)]])
    assert road.across(left)[0] == pytest.approx(0.5)
