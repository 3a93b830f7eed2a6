"""Bodies stand where their kind may be, none through another; what nobody holds is not strewn."""

import itertools
import math
from functools import partial

import numpy as np
import pytest
from tests.scenes.every_row import for_every
from tests.scenes.staged import SIZE, road_of, stage, thing

from texvent.errors import ConfigError
from texvent_scenes.defaults import complete
from texvent_scenes.description import to_description
from texvent_scenes.models.activities import HAND_NOUNS
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.places import PLACES
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.rendered_scene import Ground
from texvent_scenes.scene_input import describe_scene, understand
from texvent_scenes.spec.scene import Camera, CameraMove, Motion, Place, Scene, SceneObject
from texvent_scenes.staging.actors import Actor, seeded
from texvent_scenes.staging.compose import compose_scene, kind_of
from texvent_scenes.staging.placement.zones import zone_of
from texvent_scenes.staging.surroundings.pieces import ViewClearance
from texvent_scenes.staging.surroundings.road_line import RoadLine
from texvent_scenes.staging.surroundings.scenery import scatter

TIMES_S = np.linspace(0.0, 2.0, 9)
STREETS = {
    "oncoming": (thing("car", ("drive", "left")), thing("truck", ("drive", "right"))),
    "stop": (thing("bus stop", ("stand",)), thing("bus", ("drive", "left")),
             thing("man", ("stand",)), thing("dog", ("walk", "left"))),
    "crossing": (thing("man", ("walk", "across")), thing("car", ("drive", "right")),
                 thing("woman", ("walk", "across"))),
    "parked": (thing("car", ("stand",)), thing("bench", ("stand",)), thing("man", ("wave",)),
               thing("car", ("drive", "left"))),
    "traffic": (thing("car", ("drive",), count=2), thing("truck", ("drive",))),
    "standing": (thing("taxi", ("stand",)), thing("fire hydrant", ("stand",)),
                 thing("cow", ("stand",)), thing("sign", ("stand",))),
}  # fmt: skip


def boxes(actor: Actor) -> np.ndarray:
    """[instants, 2, 3] least and greatest corners."""
    corners = np.array([actor.corners(t) for t in TIMES_S])
    return np.stack([corners.min(axis=1), corners.max(axis=1)], axis=1)


@pytest.mark.parametrize("noun", ["car", "bus", "truck", "cyclist"])
@pytest.mark.parametrize("ways", [("left",), ("right",), (None, "left"), (None, "right")])
def test_who_turns_comes_from_one_road_and_goes_on_along_another(noun, ways):
    said = (("turn", way) if way else ("drive",) for way in ways)
    scene = stage(thing(noun, *said), place="road", duration_s=4.0)
    body, seen = scene.actors[0], scene.environment(0.0)
    line = RoadLine(seen.road_angle, tuple(seen.road_offset), tuple(seen.road_crossings.tolist()))
    ends = [body.middle(time_s)[:2] for time_s in (0.0, 4.0)]
    turned = math.remainder(body.track.at(4.0).yaw - body.track.at(0.0).yaw, 2.0 * math.pi)
    assert turned * (1.0 if ways[-1] == "left" else -1.0) > 0.5
    assert line.distance(np.array(ends)).max() <= seen.road_half_width


@pytest.mark.parametrize("place", ["city", "road"])
@pytest.mark.parametrize("name", STREETS)
def test_who_drives_has_a_lane_and_others_the_pavement_unless_they_cross(name, place):
    for seed in range(3):
        scene = stage(*STREETS[name], place=place, seed=seed)
        road, half_m = road_of(scene)
        for one in scene.actors:
            across = road.across(np.vstack([one.corners(t)[:, :2] for t in TIMES_S]))
            turn = one.track.at(1.0).yaw - road.angle
            if zone_of(one.noun) == "road":
                assert abs(math.sin(turn)) < 0.05
                assert np.abs(across).max() < half_m + 0.05
                if one.is_mover:  # traffic keeps to the right
                    assert across.mean() * math.cos(turn) <= 1e-6 or len(STREETS[name]) == 1
            elif one.goes_across:
                assert abs(math.cos(turn)) < 0.05
            else:
                assert np.abs(across).min() >= half_m
        for one, other in itertools.combinations(scene.actors, 2):
            a, b = boxes(one), boxes(other)
            apart = np.maximum(a[:, 0] - b[:, 1], b[:, 0] - a[:, 1]).max(axis=1)
            assert apart.min() > -0.05, (one.noun.name, other.noun.name)


def test_a_barrier_rests_on_the_road():
    scene = stage(thing("barrier", ("stand",)), thing("fire hydrant", ("stand",)), place="road")
    road, half_m = road_of(scene)
    assert road.distance(scene.actors[0].middle(0.0)[None, :2]).max() < half_m


def test_who_waits_at_a_crosswalk_stands_in_a_lane_beyond_those_who_cross():
    said = understand("a person walks across a crosswalk while a truck waits", NOUNS)
    for seed in range(3):
        scene = compose_scene(said, seed=seed, size=SIZE, duration_s=2.0)
        road, half_m = road_of(scene)
        bodies = {one.noun.name: one for one in scene.actors}
        truck, walker = bodies["truck"], bodies["person"]
        assert abs(math.cos(walker.track.at(1.0).yaw - road.angle)) < 0.05
        assert abs(math.sin(truck.track.at(1.0).yaw - road.angle)) < 0.05
        assert np.abs(road.across(truck.corners(1.0)[:, :2])).max() < half_m
        ahead = np.array([math.cos(truck.track.yaw), math.sin(truck.track.yaw), 0.0])
        way = np.vstack([walker.corners(t) for t in TIMES_S]) @ ahead
        assert way.min() > (truck.corners(0.0) @ ahead).max()


@pytest.mark.parametrize("kind", ["stand", "drive"])
def test_rails_lie_under_the_train_and_others_beside_them(kind):
    scene = stage(thing("man", ("stand",)), thing("train", (kind,)), place="railway")
    train = next(one for one in scene.actors if one.noun.name == "train")
    x, y, _ = train.middle(0.0)
    view = ViewClearance([scene.camera(0.0)], [], 9.0, None, RoadLine(1.0))
    rule = next(one for one in PLACES["railway"].scenery if one.noun == "railway track")
    (rails,) = scatter([rule], view, scene.actors, NOUNS, draw=partial(seeded, 0, "rails"))
    line = RoadLine(rails.yaw, rails.position)
    assert abs(line.across(np.array([[x, y]]))[0]) < 1e-6
    assert abs(math.sin(rails.yaw - train.track.at(0.0).yaw)) < 1e-6
    man = next(one for one in scene.actors if one.noun.name == "man")
    assert np.abs(line.across(man.corners(1.0)[:, :2])).min() > 1.0


@pytest.mark.parametrize("place", [name for name, one in PLACES.items() if one.has_shore])
def test_what_stands_on_land_is_not_in_the_water(place):
    for seed in range(2):
        scene = stage(thing("pine", ("stand",), count=3), thing("man", ("walk", "left")),
                      thing("house", ("stand",), placement="far"), place=place,
                      seed=seed)  # fmt: skip
        road, half_m = road_of(scene)
        half_m = half_m if PLACES[place].ground is Ground.RIVER else 0.0
        for one in scene.actors:
            assert road.across(one.corners(0.0)[:, :2]).max() < -half_m
        aside = road.across(scene.still.to_world[:, :2, 3])
        aside = -np.abs(aside) if half_m else aside  # a river has two banks
        assert aside.max(initial=-9.0) < 1.0 - half_m


SMALL = sorted(nouns_with("in hand or on something") & NOUNS.keys())


def test_what_nobody_has_is_not_strewn_about_and_is_said_to_be_missing():
    scene = stage(thing("man", ("stand",)), *(SceneObject(noun) for noun in SMALL))
    assert [one.noun.name for one in scene.actors] == ["man"]
    for noun in SMALL:
        assert any(line.startswith(f"the {noun} (") for line in scene.not_shown)
    shown = stage(thing("man", ("stand",)), SceneObject("cup", position_m=(1.0, 0.0)),
                  SceneObject("book", motions=(Motion("spin"),)))  # fmt: skip
    assert [one.noun.name for one in shown.actors] == ["man", "cup", "book"]
    assert not shown.not_shown


@pytest.mark.parametrize("noun", sorted({*SMALL} - HAND_NOUNS)[::4])
def test_a_person_with_a_small_thing_has_it(noun):
    scene = stage(thing("man", ("walk", "left")), SceneObject(noun), relations=(("with", 0, 1),))
    man, *things = scene.actors
    for one in things:  # the body has clothes on
        assert one.track.anchor is not None
        gap = [np.linalg.norm(one.middle(t) - man.middle(t)) for t in TIMES_S]
        assert max(gap) < 1.3


PEOPLED = sorted(
    place for place, one in PLACES.items() if any(kind_of(NOUNS[r.noun]) for r in one.scenery)
)


@pytest.mark.parametrize("place", PEOPLED)
def test_people_and_traffic_of_the_scenery_have_names_and_ids_after_those_of_the_objects(place):
    for seed in range(2):
        scene = stage(SceneObject("dog"), place=place, seed=seed)
        assert set(np.unique(scene.primitives(0.0).instance)) - {0} == set(scene.class_names)
        assert list(scene.class_names) == list(range(1, 1 + len(scene.class_names)))
        assert scene.class_names[1] == "dog"
        assert all(kind_of(NOUNS[name]) for name in list(scene.class_names.values())[1:])


@pytest.mark.parametrize("noun", ["van", "child"])
def test_scenery_shows_none_of_the_kind_that_a_scene_names(noun):
    kind = kind_of(NOUNS[noun])
    scenes = [stage(SceneObject(noun), place="city", seed=seed) for seed in range(3)]
    others = [kind_of(NOUNS[one]) for each in scenes for one in [*each.class_names.values()][1:]]
    assert others
    assert kind not in others


def test_what_stands_at_a_kerb_is_off_the_road_and_out_of_the_way():
    scene = stage(thing("dog", ("walk", "right")), place="city")
    base, shapes = scene.animated_environment.base, scene.primitives(0.0)
    road = RoadLine(base.road_angle, tuple(base.road_offset))
    cars = [n for n, name in scene.class_names.items() if name == "car"]
    assert cars
    for car in cars:
        middles = shapes.to_world[shapes.instance == car][:, :2, 3]
        assert np.abs(road.across(middles)).min() > PLACES["city"].road_m
        assert all(np.hypot(*(middles - scene.actors[0].middle(t)[:2]).T).min() > 1.0
                   for t in TIMES_S)  # fmt: skip


DRIVE = (Motion("drive", speed_m_s=6.0),)
ROADS = [name for name, place in PLACES.items() if place.has_road][:4]
EGO = (CameraMove("dolly", "in", speed_m_s=8.0),)


def staged(*objects, camera=None, **place):
    fields = {"is_empty": True, **place}
    scene = Scene(objects=objects, camera=camera or Camera(), place=Place(**fields))
    return compose_scene(
        complete(to_description(scene), NOUNS), seed=0, size=SIZE, duration_s=2.0
    )  # fmt: skip


def crossing_of(scene):
    return [tuple(one) for one in scene.environment(0.0).road_crossings]


@for_every([(name, noun, turn) for name in ROADS for noun in ("car", "bus", "motorcycle")
            for turn in ((), (Motion("turn", "left", start_s=1.0),))])  # fmt: skip
def test_roads_cross_where_the_scene_says_also_where_its_first_vehicle_turns(row):
    name, noun, turn = row
    one = SceneObject(noun, position_m=(-1.7, 36.0), heading_deg=270.0, motions=DRIVE + turn)
    scene = staged(one, name=name, crossing_m=(0.0, 20.0))
    ((x, y, angle),) = crossing_of(scene)
    assert (x, y) == pytest.approx((0.0, 20.0), abs=1e-6)
    assert abs(math.sin(angle)) < 1e-6
    assert "the roads cross at (0, 20) m" in scene.notes


@for_every(itertools.product(ROADS, ((3.0, 5.0), (-2.0, 8.0)), (0.0, 30.0, 90.0)))
def test_a_road_is_where_the_scene_says(row):
    name, point, degrees = row
    car = SceneObject("car", position_m=(7.0, 1.0), heading_deg=degrees, motions=DRIVE)
    scene = staged(car, name=name, road_m=point, road_heading_deg=degrees)
    line, _ = road_of(scene)
    assert line.across(np.array([point]))[0] == pytest.approx(0.0, abs=1e-6)
    assert math.sin(line.angle - math.radians(degrees)) == pytest.approx(0.0, abs=1e-6)
    assert any(one.startswith("the middle of the road goes through (") for one in scene.notes)


@for_every(itertools.product(ROADS, (0.0, 1.7, -3.0), ("car", "van", "bus"), (True, False)))
def test_a_camera_that_is_driven_has_the_right_lane_and_oncoming_traffic_the_other(row):
    name, x, noun, has_other = row
    half = PLACES[name].road_m
    camera = Camera(EGO, position_m=(x, 0.0, 1.5), look_at_m=(x, 20.0, 1.3))
    oncoming = SceneObject(noun, position_m=(x - half, 36.0), heading_deg=270.0, motions=DRIVE)
    aside = SceneObject("van", position_m=(x - 20.0, 18.0), heading_deg=0.0, motions=DRIVE)
    scene = staged(*([oncoming, aside] if has_other else [oncoming]), camera=camera, name=name)
    line, _ = road_of(scene)
    ego, other = (float(line.across(np.array([p]))[0]) for p in ((x, 0.0), (x - half, 36.0)))
    assert ego == pytest.approx(-0.5 * half, abs=1e-6)
    assert other == pytest.approx(0.5 * half, abs=1e-6)


@pytest.mark.parametrize("field", [{"road_m": (0, 0)}, {"road_heading_deg": 5.0}])
def test_a_place_without_a_road_and_travel_refuse_its_position(field):
    box = SceneObject("car")
    travel = Camera((CameraMove("travel", means="drive"),))
    for scene in (Scene(objects=(box,), place=Place("kitchen", **field)),
                  Scene(objects=(box,), camera=travel, place=Place("road", **field))):  # fmt: skip
        with pytest.raises(ConfigError, match=r"^place\.road_\w+ has no effect: "):
            describe_scene(scene, NOUNS)
