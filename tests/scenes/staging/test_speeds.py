"""Usual speeds: those of the table, whatever the camera must do to show them; and rest."""

import itertools
from typing import get_args

import numpy as np
import pytest
from tests.scenes.every_row import for_every
from tests.scenes.staged import DURATION_S, SIZE, in_image, middle, stage, thing

from texvent.errors import ConfigError
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.tables import nouns_with, trait_values
from texvent_scenes.spec.scene import (
    Camera,
    CameraMove,
    Motion,
    MoveKind,
    RelationKind,
    SceneObject,
)
from texvent_scenes.staging.camera.framing import image_of, measure_prominence
from texvent_scenes.staging.interactions.perform import ACTS
from texvent_scenes.staging.placement.zones import zone_of
from texvent_scenes.staging.tracks.phases import PATH_KINDS, usual_speed

GOING = [one for one in NOUNS.values() if one.motion in PATH_KINDS]
ASPECT = SIZE.height / SIZE.width
TIMES = np.linspace(0.0, DURATION_S, 41)
RIGHT = {"dog": "run", "car": "drive", "bird": "fly", "dart": "fly"}


def goes(noun, *motion, **fields):
    """One body on empty grass, which goes right at its usual speed unless more is said."""
    said = motion or (NOUNS[noun].motion, "right")
    return stage(SceneObject(noun, motions=(Motion(*said),)), **fields)


def speeds_of(actor, times=TIMES):
    """Its speed from instant to instant, by the places of its middle, m/s."""
    steps = np.diff([middle(actor, float(time)) for time in times], axis=0)
    return np.linalg.norm(steps, axis=1) / np.diff(times)


def in_view(scene, times=TIMES):
    """Whether the middle of the first body is in the picture at each instant."""
    seen = [image_of(scene.camera(float(t)), middle(scene.actors[0], float(t))) for t in times]
    x, y, depth = np.array(seen).T
    return (np.abs(x) < 0.5) & (np.abs(y) < 0.5 * ASPECT) & (depth > 0.0)


def test_every_noun_that_goes_has_a_speed_of_the_table():
    assert {one.name for one in GOING} <= trait_values("speeds").keys() <= NOUNS.keys()
    for name, speeds in trait_values("speeds").items():
        assert NOUNS[name].speed_m_s == speeds[NOUNS[name].motion] > 0.0
        assert {kind: usual_speed(NOUNS[name], kind) for kind in speeds} == pytest.approx(speeds)


@pytest.mark.long
@for_every(GOING)
def test_a_body_goes_at_its_usual_speed_and_is_large_enough_where_it_is_seen(noun):
    scene = goes(noun.name)
    (actor,) = scene.actors
    assert np.median(speeds_of(actor, TIMES[::10])) == pytest.approx(noun.speed_m_s, rel=0.2)
    boxes = actor.corners(0.5 * DURATION_S)[None]
    camera = scene.camera(0.5 * DURATION_S)
    assert measure_prominence(camera, boxes, ASPECT) > 0.1
    path = scene.camera_path
    assert np.all(in_view(scene, np.linspace(*path.framed_s, 5)))
    assert (path.passage_s is None and (path.tie is None)) != bool(path.notes)


@for_every(GOING[::5])
def test_what_is_steered_turns_in_its_length_and_others_on_their_heel(noun):
    (actor,) = goes(noun.name, "turn", "left").actors
    track, model = actor.track, actor.model
    states = np.array([[*track.at(t).position[:2], track.at(t).yaw] for t in np.arange(0, 2, 0.01)])
    turned = np.diff(np.unwrap(states[:, 2]))
    ways = np.linalg.norm(np.diff(states[:, :2], axis=0), axis=1)[turned > 1e-4]
    radius, length = (ways / turned[turned > 1e-4]).min(), model.length
    is_steered = noun.motion in ("drive", "sail") or noun.name in nouns_with("takes off")
    on_heel_m = max(0.31 * length, noun.speed_m_s / 1.7)
    assert radius > 0.89 * length if is_steered else radius < on_heel_m


@pytest.mark.long
@for_every([one for one in GOING if one.habitat == "ground" and zone_of(one) != "road"])
def test_of_several_that_go_together_each_is_large_enough(noun):
    scene = stage(SceneObject(noun.name, count=4, motions=(Motion(noun.motion, "right"),)))
    shares = []
    for time in np.linspace(*scene.camera_path.framed_s, 5):
        boxes = np.array([one.corners(float(time)) for one in scene.actors])
        shares.append(measure_prominence(scene.camera(float(time)), boxes, ASPECT))
    assert max(shares) > (0.2 if noun.motion == "roll" else 0.5)  # a ball is told by its outline


@pytest.mark.parametrize("noun", RIGHT)
def test_a_pace_or_a_stated_speed_changes_the_speed_and_not_the_view(noun):
    kind, usual = RIGHT[noun], usual_speed(NOUNS[noun], RIGHT[noun])
    for said, expected in (
        ((kind, "right", 0.5), 0.5 * usual), ((kind, "right", 2.0), 2.0 * usual),
        ((kind, "right", 1.0, None, 30.0), 30.0),
    ):  # fmt: skip
        scene = goes(noun, *said)
        assert np.median(speeds_of(scene.actors[0])) == pytest.approx(expected, rel=0.05)
        assert np.all(in_view(scene, np.linspace(*scene.camera_path.framed_s, 9)))


def test_the_camera_stays_goes_along_or_shows_a_passage_as_the_speed_grows():
    car, dog, dart = (goes(noun, RIGHT[noun], "right") for noun in ("car", "dog", "dart"))
    for scene in (car, dart):
        np.testing.assert_array_equal(scene.camera(0.0).position, scene.camera(2.0).position)
    assert np.all(in_view(car))
    first, last = (dog.camera(time).position[0] for time in (0.0, DURATION_S))
    assert 0.0 < last - first < 2.0 * usual_speed(NOUNS["dog"], "run")
    images = [in_image(dog, dog.actors[0], time).mean(axis=0)[0] for time in (0.0, DURATION_S)]
    assert images[0] < 0.35
    assert images[1] > 0.65
    assert np.all(in_view(dog))
    assert [len(scene.camera_path.notes) for scene in (car, dog, dart)] == [0, 1, 1]


def traffic(*nouns, duration_s=1.0, **fields):
    """Vehicles that drive right and left by turns on an empty plain."""
    things = (thing(noun, ("drive", ("right", "left")[n % 2])) for n, noun in enumerate(nouns))
    return stage(*things, duration_s=duration_s, **fields)


def spans_in_image(scene, times):
    """[vehicles, times, 2] left and right end of each, widths of the picture."""
    boxes = [[image_of(scene.camera(float(time)), one.corners(float(time)))[:, 0] for time in times]
             for one in scene.actors]  # fmt: skip
    return np.stack([np.min(boxes, axis=2), np.max(boxes, axis=2)], axis=2)


@pytest.mark.parametrize("nouns", [("car", "car"), ("van", "car"), ("bus", "car", "taxi")])
def test_traffic_is_as_slow_and_as_long_in_the_picture_as_in_a_street(nouns):
    times = np.linspace(0.0, 0.5, 11)
    scenes = [traffic(*nouns, duration_s=length_s) for length_s in (0.5, 1.0, 2.0)]
    distances = [one.camera_path.framing.distance_m for one in scenes]
    assert distances == pytest.approx([distances[0]] * 3)
    for scene in scenes[:2]:
        spans = spans_in_image(scene, times)
        speeds = np.abs(np.diff(spans.mean(axis=2), axis=1)) / 0.05
        assert 0.2 < speeds.max() < 0.32
        assert np.diff(spans, axis=2).min() > 0.055


@pytest.mark.parametrize(("duration_s", "is_told"), [(2.0, False), (5.0, True)])
def test_that_a_fast_one_leaves_the_street_is_told_only_where_it_does(duration_s, is_told):
    fast = (thing("car", ("drive", way, 1.0, None, 15.0)) for way in ("right", "left"))
    scene = stage(*fast, duration_s=duration_s)
    assert np.all(in_view(scene, np.linspace(0.0, duration_s, 21))) != is_told
    assert bool(scene.camera_path.notes) == is_told


def test_one_vehicle_and_a_camera_that_moves_stay_near():
    assert np.diff(spans_in_image(traffic("car"), [0.5]), axis=2).min() > 0.25
    truck = Camera((CameraMove("truck"),))
    moved = traffic("car", "car", camera=truck).camera_path.framing
    assert moved.distance_m < 0.8 * traffic("car", "car").camera_path.framing.distance_m


def test_a_said_view_of_traffic_keeps_its_angles():
    aerial = traffic("car", "car", camera=Camera(view="aerial")).camera_path.framing
    street = traffic("car", "car").camera_path.framing
    assert aerial.elevation > 0.7 > street.elevation > 0.2
    assert abs(aerial.azimuth) < 0.2 < abs(street.azimuth)


def test_a_close_shot_that_follows_late_shows_what_goes_before():
    follow = Camera((CameraMove("follow", start_s=1.0),), framing="close")
    scene = goes("man", "walk", "right", camera=follow)
    assert np.all(in_view(scene))
    assert np.all(
        [np.all(np.abs(in_image(scene, scene.actors[0], t)[:, 0] - 0.5) < 0.55) for t in TIMES]
    )


def test_who_walks_and_then_runs_gets_faster():
    scene = stage(thing("dog", ("walk", "right"), ("run", "right")))
    slow, fast = (speeds_of(scene.actors[0], np.array(span)) for span in ((0.2, 0.6), (1.6, 1.9)))
    assert slow == pytest.approx(usual_speed(NOUNS["dog"], "walk"), rel=0.05)
    assert fast == pytest.approx(usual_speed(NOUNS["dog"], "run"), rel=0.05)


WAYS = sorted({*get_args(RelationKind)} - {*ACTS, "off"})  # what is done, or left, is done anyway
PAIRS = ("man", "table"), ("car", "truck"), ("cat", "ladder"), ("man", "ladder")


@for_every(itertools.product(WAYS, PAIRS, ("pace", "speed_m_s")))
def test_a_speed_of_0_is_rest_wherever_it_would_lead(row):
    way, (noun, other), field = row
    subject = SceneObject(noun, motions=(Motion("move", **{field: 0.0}),))
    try:
        scene = stage(subject, thing(other), relations=((way, 0, 1),))
    except ConfigError:
        return
    for actor in (one for one in scene.actors if one.object_index == 0):
        moved_m = np.ptp([middle(actor, t) for t in TIMES[::5]], axis=0).max()
        assert moved_m < 0.01


RATES = {
    "pace": get_args(MoveKind), "speed_m_s": ("travel", "dolly", "truck", "pedestal"),
    "rate_deg_s": ("pan", "tilt", "roll", "orbit", "zoom"),
}  # fmt: skip


@for_every([(kind, field) for field, kinds in RATES.items() for kind in kinds])
def test_a_camera_move_of_speed_0_shows_what_a_static_camera_does(row):
    kind, field = row
    scene = stage(thing("box"), camera=Camera((CameraMove(kind, **{field: 0.0}),)))
    seen = [in_image(scene, scene.actors[0], t) for t in TIMES[::5]]
    moved = np.ptp(seen, axis=0).max()
    assert moved < 1e-6
