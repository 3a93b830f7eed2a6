"""The camera: how near it goes, its moves, and the route that it travels."""

import itertools
import math
import re
from typing import get_args

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples
from tests.scenes.every_row import for_every
from tests.scenes.staged import DURATION_S, SIZE, stage, thing

from texvent.camera import project
from texvent_scenes.rendered_scene import CEILING
from texvent_scenes.spec.scene import Camera, CameraMove, Motion, MoveKind, SceneObject, View
from texvent_scenes.staging.camera.camera_track import CameraTrack
from texvent_scenes.staging.camera.framing import come_near, fit, image_of, measure_prominence

ASPECT = 0.75
SIGNS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
TIMES = np.linspace(0.0, DURATION_S, 9)
KINDS = ("pan", "tilt", "roll", "zoom", "dolly", "truck", "pedestal", "orbit", "handheld", "follow")
DIRECTIONS = ("left", "right", "up", "down", "in", "out", "clockwise")
PLACES = ("road", "city", "dirt road", "forest", "grass", "desert", "snow", "sea", "underwater",
          "mountain", "sky", "indoor")  # fmt: skip
moves = st.lists(
    st.builds(
        CameraMove, st.sampled_from(KINDS), st.sampled_from(DIRECTIONS),
        st.sampled_from([0.5, 1.0, 2.0]), st.integers(0, 2),
    ),
    min_size=1, max_size=3,
)  # fmt: skip


def flat_box(width, height, x=0.0):
    """A box without depth, upright, seen from the south."""
    return 0.5 * SIGNS * [width, 0.0, height] + [x, 0.0, 0.0]


def prominence_of(*boxes):
    return lambda one: measure_prominence(camera_at(one), np.array(boxes), ASPECT)


def camera_at(framing):
    return CameraTrack(framing, (), 2.0, has_floor=False).at(0.0)


@pytest.mark.parametrize("goal", [0.2, 0.5, 0.9, 5.0])
def test_the_camera_stops_where_the_subject_reaches_the_goal(goal):
    subject = flat_box(0.5, 0.5, 2.0)
    everything = np.vstack([subject, flat_box(9.0, 4.0)])
    wide, near = (
        fit(points, azimuth=0.0, elevation=0.1, aspect=ASPECT, fill=0.84)
        for points in (everything, subject)
    )
    prominence = prominence_of(subject)
    found = come_near([wide, near], prominence, [goal])
    least, most = prominence(wide), prominence(near)
    assert min(max(goal, least), most) == pytest.approx(prominence(found), rel=0.1)
    image = project(camera_at(found), SIZE, subject)[:, :2]
    assert np.all(image >= 0.0)
    assert np.all(image <= [SIZE.width, SIZE.height])


@given(
    size=st.tuples(*3 * [st.floats(0.1, 9.0)]),
    azimuth=st.floats(-3.0, 3.0),
    elevation=st.floats(0.0, 0.5),
    fill=st.floats(0.3, 0.9),
    lift=st.floats(0.0, 1.0),
)
def test_all_of_a_subject_is_within_the_share_however_far_the_camera_looks_up(
    size, azimuth, elevation, fill, lift
):
    subject = 0.5 * SIGNS * size
    shot = {"azimuth": azimuth, "elevation": elevation, "aspect": ASPECT, "fill": fill}
    level, raised = (fit(subject, lift=each, **shot) for each in (0.0, lift))
    right, down, _ = np.abs(image_of(camera_at(raised), subject)).T
    assert right.max() <= 0.5 * fill + 1e-6
    assert down.max() <= 0.5 * fill * ASPECT + 1e-6
    assert raised.distance_m == pytest.approx(level.distance_m)
    height_m = (raised.target - level.target)[2]
    is_free = down.max() < 0.5 * fill * ASPECT - 1e-3  # room is left, so all of the lift is taken
    whole_m = lift * ASPECT * 0.5 / raised.focal * raised.distance_m * math.cos(elevation)
    assert height_m == pytest.approx(whole_m) if is_free else 0.0 <= height_m <= whole_m + 1e-9


SHOT = {"azimuth": 0.0, "elevation": 0.0, "aspect": ASPECT}


@examples(30)
@given(st.lists(st.floats(-9.0, 9.0), min_size=2, max_size=6), st.floats(0.2, 2.0))
def test_a_group_is_as_prominent_as_its_copies_and_all_of_it_together(places, side):
    boxes = np.array([flat_box(side, side, x) for x in places])
    camera = camera_at(fit(np.vstack(boxes), **SHOT, fill=0.8))
    image = image_of(camera, boxes)[..., :2] / [1.0, ASPECT]
    own, whole = side / ASPECT**0.5 * camera.focal, np.ptp(image.reshape(-1, 2), axis=0).max()
    own /= image_of(camera, boxes[0])[0, 2]
    expected = max(own / 0.3, min(own / 0.13, whole / 0.65))
    assert measure_prominence(camera, boxes, ASPECT) == pytest.approx(expected)


@given(st.tuples(*3 * [st.floats(0.1, 20.0)]), st.floats(-9.0, 9.0))
def test_a_room_has_walls_and_a_ceiling_beyond_all_that_is_in_it(most, away):
    shot = CameraTrack(fit(np.add(SIGNS, (away, 0.0, 0.0)), **SHOT, fill=0.5), (), 2.0)
    x, y, z = shot.at(0.0).position
    for corner in most * SIGNS:
        room_m = shot.in_room(corner[None], TIMES).room_m
        assert np.abs([*corner[:2], x, y]).max() < room_m
        assert max(corner[2], z) < CEILING * room_m


def extent_of(scene):
    """Focal length over depth of the subject's middle, which its size in the image goes with."""
    camera = scene.camera(0.5 * DURATION_S)
    middle = scene.actors[0].middle(0.5 * DURATION_S)
    return camera.focal / image_of(camera, middle)[2]


SHOTS = [
    *({"view": view, "framing": framing} for view in (None, *get_args(View)) for framing in
      (None, "close", "medium", "full", "wide")),
    {"position_m": (3.0, -9.0, 2.0), "look_at_m": (0.0, 0.0, 0.5)},
]  # fmt: skip


@for_every(SHOTS)
def test_with_any_angle_of_view_a_subject_keeps_its_size_or_a_camera_its_place(shot):
    usual = stage(thing("car"), camera=Camera(**shot))
    for degrees in (8.0, 30.0, 70.0, 110.0):
        scene = stage(thing("car"), camera=Camera(**shot, field_of_view_deg=degrees))
        camera, before = (one.camera(0.5 * DURATION_S) for one in (scene, usual))
        assert math.degrees(2.0 * math.atan(0.5 / camera.focal)) == pytest.approx(degrees)
        if "position_m" in shot:
            np.testing.assert_allclose(camera.position, before.position)
        else:
            assert extent_of(scene) == pytest.approx(extent_of(usual), rel=0.1), (shot, degrees)


@pytest.mark.parametrize("noun", ["car", "dog", "train", "person"])
def test_who_comes_or_goes_away_is_seen_aslant_from_either_side(noun):
    for way, shot in itertools.product(("towards", "away"), ((), (CameraMove("follow"),))):
        sides = set()
        for seed in range(4):
            scene = stage(thing(noun, ("move", way)), camera=Camera(shot), seed=seed)
            heading = np.subtract(*(scene.actors[0].middle(t)[:2] for t in (DURATION_S, 0.0)))
            axis = scene.camera(0.0).rotation[2, :2]
            turn = math.atan2(axis[0] * heading[1] - axis[1] * heading[0], axis @ heading)
            assert 0.3 < abs(math.sin(turn)) < 0.95
            sides.add(math.copysign(1.0, math.tan(turn)))
        assert sides == {-1.0, 1.0}


def film(*shot, noun="dog", motion=("stand",)):
    return stage(SceneObject(noun, motions=(Motion(*motion),)), camera=Camera(shot))


@examples(30)
@given(moves, st.sampled_from(["stand", "walk"]))
def test_every_combination_is_smooth_and_keeps_its_subject(shot, kind):
    scene = film(*shot, motion=(kind,))
    inside = []
    for time in np.linspace(0.0, DURATION_S, 13):
        before, after = scene.camera(float(time)), scene.camera(float(time) + 1e-3)
        distance = float(np.linalg.norm(before.position - scene.actors[0].middle(float(time))))
        assert np.abs(before.position - after.position).max() < 0.005 * distance
        assert np.abs(before.rotation - after.rotation).max() < 0.02
        assert abs(math.log(after.focal / before.focal)) < 0.02
        assert before.position[2] >= 0.25
        x, y, depth = image_of(before, scene.actors[0].middle(float(time)))
        inside.append(abs(x) < 0.5 and abs(y) < 0.5 * SIZE.height / SIZE.width and depth > 0.0)
    assert np.mean(inside) > 0.85


@pytest.mark.parametrize("motion", [("run", None), ("walk", "away"), ("orbit", None)])
def test_a_followed_subject_keeps_its_place_and_size(motion):
    scene = film(CameraMove("follow"), motion=motion)
    cameras = [scene.camera(float(time)) for time in TIMES]
    middles = [scene.actors[0].middle(float(time)) for time in TIMES]
    depths = [
        float(one.rotation[2] @ (middle - one.position))
        for one, middle in zip(cameras, middles, strict=True)
    ]
    assert max(depths) / min(depths) < 1.1
    way = np.diff([camera.position[:2] for camera in cameras], axis=0)
    assert np.hypot(*way.T).sum() > 1.0


def test_phases_follow_each_other():
    scene = film(CameraMove("pan", "right"), CameraMove("tilt", "up", phase=1), noun="house")
    axes = [scene.camera(t).rotation[2] for t in (0.0, 1.0, 2.0)]
    bearings = [math.atan2(axis[0], axis[1]) for axis in axes]
    assert bearings[0] + 0.05 < bearings[1] == pytest.approx(bearings[2])
    assert axes[0][2] == pytest.approx(axes[1][2])
    assert axes[2][2] > axes[1][2] + 0.05


@pytest.mark.parametrize("kind", [one for one in get_args(MoveKind) if one != "static"])
def test_the_camera_moves_between_the_start_and_the_end_of_its_move_only(kind):
    """A camera that travels brakes a little longer."""
    scene = film(CameraMove(kind, "right", start_s=0.6, duration_s=0.7), motion=("walk",))
    first, start, end, last = (scene.camera(time) for time in (0.0, 0.6, 1.7, 2.0))
    for one, other, is_same in ((first, start, True), (start, end, False), (end, last, True)):
        values = [np.concatenate([c.position, c.rotation.ravel(), [c.focal]]) for c in (one, other)]
        assert np.allclose(*values, atol=1e-6) == is_same


def test_a_camera_rests_between_the_times_in_which_it_follows():
    moves = (CameraMove("follow", duration_s=0.4), CameraMove("follow", start_s=1.2))
    scene = film(*moves, motion=("walk",))
    times = (0.0, 0.4, 1.2, 2.0)
    places = np.array([scene.camera(time).position for time in times])
    ways = np.diff([scene.actors[0].track.at(time).position for time in times], axis=0)
    ways[1] = 0.0
    np.testing.assert_allclose(np.diff(places, axis=0), ways, atol=1e-9)
    assert not scene.camera_path.tie.displacement(0.0).any()


def test_each_stretch_of_a_journey_has_the_speed_of_its_own_move():
    moves = (CameraMove("travel", speed_m_s=5.0), CameraMove("travel", phase=1, speed_m_s=1.0))
    scene = stage(camera=Camera(moves), place="road")
    places = [scene.camera(time).position for time in (0.0, 0.5, 1.5, 2.0)]
    gone = [np.linalg.norm(places[n + 1] - places[n]) for n in (0, 2)]
    assert gone == pytest.approx([2.5, 0.5])


def test_a_move_after_the_end_of_the_clip_is_reported_and_moves_nothing():
    late = film(CameraMove("pan", start_s=2.0))
    assert late.not_shown == ("the camera's pan after 2 s (the clip ends at 2 s)",)
    np.testing.assert_array_equal(late.camera(0.0).rotation, late.camera(2.0).rotation)


def travel(place, direction, *objects):
    return stage(*objects, camera=Camera((CameraMove("travel", direction),)), place=place)


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("direction", ["forward", "backward"])
def test_the_camera_moves_on_above_the_ground_and_through_nothing(place, direction):
    scene = travel(place, direction)
    cameras = [scene.camera(float(time)) for time in np.linspace(0.0, DURATION_S, 21)]
    positions = np.array([camera.position for camera in cameras])
    steps = np.diff(positions, axis=0)
    assert np.hypot(*steps[:, :2].T).sum() > 1.5
    assert positions[:, 2].min() > 0.25
    sign = -1.0 if direction == "backward" else 1.0
    for step, camera in zip(steps, cameras, strict=False):
        assert sign * float(step @ camera.rotation[2]) > 0.0
    boxes = scene.still.to_world
    middles, reach = boxes[:, :, 3], np.linalg.norm(boxes[:, :, :3], axis=(1, 2)) / math.sqrt(3.0)
    for position in positions:
        assert np.all(np.linalg.norm(middles - position, axis=1) > 0.3 * reach)


@pytest.mark.parametrize("place", PLACES)
def test_a_camera_that_travels_with_a_view_from_the_top_looks_down_in_rooms_too(place):
    scene = stage(camera=Camera((CameraMove("travel", "forward"),), view="top"), place=place)
    assert all(scene.camera(time).rotation[2, 2] < -0.9 for time in TIMES)


def test_a_vehicle_ahead_keeps_its_distance_and_oncoming_ones_pass():
    scene = travel(
        "road", "forward", thing("truck", ("drive",)), thing("car", ("drive", "towards"))
    )
    depths = []
    for time in (0.0, 1.0, 2.0):
        camera = scene.camera(time)
        middles = np.array([actor.middle(time) for actor in scene.actors])
        depths.append(((middles - camera.position) @ camera.rotation.T)[:, 2])
    gaps = np.array(depths)
    np.testing.assert_allclose(gaps[:, 0], gaps[0, 0], atol=0.05)
    assert gaps[0, 1] - gaps[2, 1] > 20.0


STILL, TILT = (CameraMove("static"),), (CameraMove("tilt", "up", pace=0.01),)
BIRD = ("bird", Motion("fly", "right"))
PASSAGES = [
    ("bullet", Motion("fly", "left", speed_m_s=200), (), ()),
    ("arrow", Motion("rise", speed_m_s=100), (), ()),
    ("car", Motion("drive", "left", speed_m_s=90), TILT, ()),
    (*BIRD, STILL, ()), (*BIRD, (), (thing("tree", ("stand",)),)),
    (*BIRD, (), (thing("bird", ("fly", "left")),)),
]  # fmt: skip
"""Who is too fast for the camera, or goes where it may not go along: by a landmark, both ways."""


@pytest.mark.parametrize(("noun", "motion", "shot", "others"), PASSAGES)
def test_who_crosses_the_view_is_in_it_for_as_long_as_is_said(noun, motion, shot, others):
    passed = (("past", 0, 1),) if [one.noun for one in others] == ["tree"] else ()
    mover = SceneObject(noun, motions=(motion,))
    staged = stage(mover, *others, relations=passed, camera=Camera(shot))
    np.testing.assert_array_equal(staged.camera(0.0).position, staged.camera(2.0).position)
    (note,) = staged.camera_path.notes
    lasts_s, from_s = map(float, re.findall(r"[\d.]+(?= s\b)", note))
    times = 1.0 + np.linspace(-2.0, 2.0, 2001) * min(lasts_s, 0.5)
    actor, corners = staged.actors[0], []
    for time in times:  # ends of a ball around the body, which is said to cross
        ends = 0.5 * actor.size_m * np.vstack([staged.camera(time).rotation[:2]] * 2)
        ends[2:] *= -1.0
        corners.append(project(staged.camera(time), SIZE, actor.middle(time) + ends))
    low, high = (np.array([end(one, axis=0) for one in corners]) for end in (np.min, np.max))
    is_seen = ((high[:, :2] > 0) & (low[:, :2] < [SIZE.width, SIZE.height])).all(axis=1)
    seen_s = times[is_seen & (low[:, 2] > 0)]
    assert np.ptp(seen_s) == pytest.approx(lasts_s, rel=0.06)
    assert seen_s[0] == pytest.approx(from_s, abs=0.02)


def test_what_is_passed_can_be_told_all_the_way_or_in_a_passage_and_hides_nobody():
    for noun, kind, passed in (
        ("train", "drive", "station building"), ("tram", "drive", "house"), ("dog", "run", "bench"),
        ("train", "drive", "tree"), ("car", "drive", "tree"), ("person", "walk", "dog"),
    ):  # fmt: skip
        staged = stage(
            SceneObject(noun, motions=(Motion(kind, "left"),)), SceneObject(passed),
            relations=(("past", 0, 1),),
        )  # fmt: skip
        who, what = staged.actors
        middle_s = 0.5 * DURATION_S
        camera = staged.camera(middle_s)
        boxes = [one.corners(middle_s) for one in (who, what)]
        told = measure_prominence(camera, boxes[1][None], SIZE.height / SIZE.width)
        assert told > (0.7 if staged.camera_path.passage_s is None else 0.5), (noun, passed)
        depths = [image_of(camera, one)[:, 2].mean() for one in boxes]
        assert depths[0] < depths[1] or what.model.height < who.model.height
