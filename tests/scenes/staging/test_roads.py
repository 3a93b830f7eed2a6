"""Roads are where a scene says, in one frame of coordinates; who drives on them has a lane."""

import itertools
import math

import numpy as np
import pytest
from tests.scenes.every_row import for_every
from tests.scenes.staged import SIZE, road_of

from texvent.errors import ConfigError
from texvent_scenes.defaults import complete
from texvent_scenes.description import to_description
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.places import PLACES
from texvent_scenes.scene_input import describe_scene
from texvent_scenes.spec.scene import Camera, CameraMove, Motion, Place, Scene, SceneObject
from texvent_scenes.staging.compose import compose_scene

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
