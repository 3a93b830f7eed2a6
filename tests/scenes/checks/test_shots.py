"""The camera's words: framing, viewpoint and moves, as they are staged and as they are checked."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from tests.scenes.staged import DURATION_S, SIZE, stage, thing
from tests.scenes.test_short_prompts import staged

from texvent.camera import project
from texvent.sensor import SensorSize
from texvent_scenes.checks.bodies.limbs import find_tiny
from texvent_scenes.checks.views.shots import find_misframed
from texvent_scenes.description import SceneDescription
from texvent_scenes.spec.scene import Camera, CameraMove
from texvent_scenes.staging.camera.camera_track import CameraTrack
from texvent_scenes.staging.camera.framing import pose

TIMES = [float(one) for one in np.linspace(0.0, DURATION_S, 7)]


def faults(scene, said):
    cameras = [scene.camera(one) for one in TIMES]
    description = SceneDescription(objects=(thing("man"),), camera=said)
    return [one.value for one in find_misframed(scene, description, cameras, TIMES, SIZE)]


@pytest.mark.parametrize("noun", ["man", "truck", "tree"])
@pytest.mark.parametrize(
    ("view", "others"),
    [("low", {"aerial", "top"}), ("aerial", {"low", "top"}), ("top", {"low"}),
     (None, {"low", "aerial", "top"})],
)  # fmt: skip
def test_a_view_holds_where_it_is_staged_and_another_one_does_not(noun, view, others):
    scene = stage(thing(noun), camera=Camera(view=view))
    wrong = {each for each in ("low", "aerial", "top") if faults(scene, Camera(view=each))}
    assert wrong == others


@pytest.mark.parametrize("heading_deg", [0.0, 90.0, -140.0])
@pytest.mark.parametrize("view", ["side", "front", "back"])
@pytest.mark.parametrize("motion", [("stand",), ("walk",)])
def test_a_view_of_a_side_holds_whichever_way_the_subject_heads(view, heading_deg, motion):
    man = replace(thing("man", motion), heading_deg=heading_deg)
    scene = stage(man, camera=Camera(view=view))
    wrong = {one for one in ("side", "front", "back") if faults(scene, Camera(view=one))}
    assert wrong == {"side", "front", "back"} - {view}


@pytest.mark.parametrize(
    ("text", "is_behind"),
    [("the camera trails behind a jogger", True), ("a fox runs, the camera follows behind", True),
     ("the camera flies behind an eagle", True), ("the camera stays with a skier", False),
     ("the camera keeps pace with a horse galloping through a meadow", False),
     ("a runner jogs in a park while the camera keeps up with her", False)],
)  # fmt: skip
def test_a_camera_that_keeps_with_somebody_goes_as_far_and_behind_if_so_said(text, is_behind):
    scene, said, _ = staged(text)
    body, (first, last) = scene.actors[0], (TIMES[0], TIMES[-1])
    way = body.middle(last) - body.middle(first)
    gone = scene.camera(last).position - scene.camera(first).position
    assert np.linalg.norm((gone - way)[:2]) < 0.2 * np.linalg.norm(way)
    to_body = body.middle(first) - scene.camera(first).position
    ahead = (to_body @ way) / (np.linalg.norm(to_body) * np.linalg.norm(way))
    assert (ahead > 0.7) == is_behind
    assert said.is_faithful


@pytest.mark.parametrize("kind", ["follow", "orbit", "pan", "dolly"])
def test_a_move_holds_if_the_camera_moves(kind):
    said = Camera(moves=(CameraMove(kind),))
    still = stage(thing("man", ("stand",)), camera=Camera(moves=(CameraMove("static"),)))
    assert faults(still, said) == [kind]
    assert faults(stage(thing("man", ("walk", "right")), camera=said), said) == []


@pytest.mark.parametrize(
    ("text", "number"),
    [("the camera follows a ball that a dog chases", 1), ("a cat chases a mouse", 1),
     ("a spoon lies on a table", 0), ("small racing drone flies", 0)],
)  # fmt: skip
def test_what_is_small_beside_what_the_camera_is_about_is_large_enough_to_be_told(text, number):
    """Its box, at mid clip, is in the image, and takes more than .3 % of it."""
    scene, middle_s = staged(text)[0], 1.0
    points = project(scene.camera(middle_s), SIZE, scene.actors[number].corners(middle_s))
    assert ((points > 0.0) & (points < [SIZE.width, SIZE.height, np.inf])).all()
    assert np.prod(np.ptp(points[:, :2], axis=0)) > 0.003 * SIZE.width * SIZE.height


@pytest.mark.parametrize(("aim_m", "is_told"), [(1.2, True), (0.3, False)])
def test_a_look_is_told_only_with_the_head_in_the_image(aim_m, is_told):
    scene = stage(thing("man", ("look",)))
    near = CameraTrack(pose((0.0, -2.0, aim_m), (0.0, 0.0, aim_m)), (), DURATION_S)
    cameras = [near.at(one) for one in TIMES]
    description = SceneDescription(objects=(thing("man", ("look",)),))
    lost = [*find_tiny(description, scene.actors, cameras, TIMES, SIZE)]
    assert (lost == []) == is_told


@pytest.mark.parametrize(
    ("text", "way"),
    [("close-up of a dog running towards the camera", 1.0),
     ("close-up of a woman walking away", -1.0),
     ("close-up of a car driving towards the camera", 1.0)],
)  # fmt: skip
def test_a_close_camera_goes_along_and_sees_the_front_or_the_back(text, way):
    scene, said, _ = staged(text)
    body = scene.actors[0]
    for time_s in TIMES:
        camera, yaw = scene.camera(time_s), body.track.at(time_s).yaw
        to_camera = (camera.position - body.middle(time_s))[:2]
        facing = np.array([np.cos(yaw), np.sin(yaw)]) @ to_camera / np.linalg.norm(to_camera)
        assert way * facing > 0.7
        assert np.ptp(project(camera, SIZE, body.corners(time_s))[:, 1]) > 0.3 * SIZE.height
    assert said.is_faithful


@pytest.mark.parametrize(
    ("act", "has_head"),
    [("typing on a laptop", False), ("kneading dough", False), ("writing on paper", False),
     ("shaving", True), ("drinking from a cup", True), ("playing the guitar", True),
     ("walking", True)],
)  # fmt: skip
def test_a_close_up_of_hands_at_work_holds_these_and_another_one_the_head(act, has_head):
    scene, said, _ = staged(f"close-up of a woman {act}")
    body = next(one for one in scene.actors if one.noun.name == "woman")
    for time_s in TIMES:
        names = ("head",) if has_head else ("right hand", "left hand", "head")
        places = np.array([body.anchor(one, time_s)[:, 3] for one in names])
        x, y, _ = project(scene.camera(time_s), SIZE, places).T
        inside = (x > 0) & (x < SIZE.width) & (y > 0) & (y < SIZE.height)
        assert [*inside] == ([True] if has_head else [True, True, False])
    assert said.is_faithful


@pytest.mark.parametrize("place", ["forest", "city", "park"])
@pytest.mark.parametrize("view", ["aerial", "top"])
def test_scenery_stands_where_a_camera_from_the_air_looks(place, view):
    scene = stage(thing("car", ("drive", "right")), camera=Camera(view=view), place=place)
    spots = scene.still.to_world[:, :, 3]
    inside = np.zeros(len(spots), dtype=bool)
    for camera in map(scene.camera, TIMES):
        x, y, depth = project(camera, SIZE, spots).T
        inside |= (abs(x - 0.5 * SIZE.width) < 0.7 * SIZE.width) & (y > 0.0) & (depth > 0.0)
    assert len(spots) >= 30
    assert inside.mean() > 0.35


@pytest.mark.parametrize("noun", ["man", "ballerina", "child"])
def test_a_framing_holds_where_it_is_staged_and_another_one_does_not(noun):
    names = ("close", "medium", "full", "wide")
    for name in names:
        scene = stage(thing(noun, ("stand",)), camera=Camera(framing=name))
        wrong = {each for each in names if faults(scene, Camera(framing=each))}
        assert name not in wrong
        assert wrong >= {"close": {"full", "wide"}, "medium": {"full", "wide"},
                         "full": {"wide"}, "wide": {"close", "medium"}}[name]  # fmt: skip


@pytest.mark.parametrize(
    ("text", "is_told"),
    [("close-up of a woman kneading dough", True), ("an old man walks", False),
     ("close-up of a girl laughing", False)],
)  # fmt: skip
def test_a_person_whose_head_is_out_of_the_picture_is_noted(text, is_told):
    assert any("head of the" in one for one in staged(text)[1].notes) == is_told


def test_what_is_followed_is_in_the_image_up_to_each_of_its_sides():
    """Cameras are turned so that its middle comes to just inside or just outside of a side."""
    said = Camera(moves=(CameraMove("follow"),))
    scene = stage(thing("man", ("walk", "right")), camera=said)
    description = SceneDescription(objects=(thing("man"),), camera=said)
    sizes = SensorSize(160, 90), SensorSize(90, 160), SensorSize(64, 64)
    for size, axis, (share, is_inside) in product(
        sizes, (0, 1), ((0.9, True), (1.1, False), (-0.9, True), (-1.1, False))
    ):
        cameras = []
        for time_s in TIMES:
            forward = scene.actors[0].middle(time_s) - scene.camera(time_s).position
            forward /= np.linalg.norm(forward)
            right = np.cross(forward, (0.0, 0.0, 1.0))
            right /= np.linalg.norm(right)
            level = np.stack([right, np.cross(forward, right), forward])
            half = 0.5 * size[axis] / size.width
            angle = np.arctan(share * half / scene.camera(time_s).focal)
            turned = level.copy()
            turned[axis] = np.cos(angle) * level[axis] + np.sin(angle) * forward
            turned[2] = np.cos(angle) * forward - np.sin(angle) * level[axis]
            cameras.append(replace(scene.camera(time_s), rotation=turned))
        found = find_misframed(scene, description, cameras, TIMES, size)
        assert ("follow" not in [one.value for one in found]) == is_inside
