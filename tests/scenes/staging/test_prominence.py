"""The camera goes as near as its subject asks for, and no nearer."""

from __future__ import annotations

import numpy as np
import pytest
from tests.scenes.sentences import parse_prompt

from texvent.scenes.projection import project
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.camera.camera_path import CameraPath
from texvent.scenes.staging.camera.framing import Framing, fit
from texvent.scenes.staging.camera.prominence import (
    LARGE,
    LARGE_COPY,
    Prominence,
    come_near,
    has_clear_view,
)
from texvent.scenes.staging.compose import ComposedScene, compose_scene
from texvent.sensor import SensorSize

SIZE = SensorSize(173, 130)
ASPECT = 0.75
SIGNS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])


def path_of(framing: Framing) -> CameraPath:
    return CameraPath(framing, (), 2.0, has_floor=False)


def flat_box(width: float, height: float, x: float = 0.0) -> Float64Array:
    """A box without depth, upright, seen from the south."""
    return np.asarray(0.5 * SIGNS * [width, 0.0, height] + [x, 0.0, 0.0])


def prominence_of(*boxes: Float64Array) -> Prominence:
    return Prominence(np.array([0.0, 1.0]), np.array([boxes, boxes]), ASPECT)


def seen_from(distance_m: float) -> CameraPath:
    return path_of(Framing(np.zeros(3), 0.0, 0.0, distance_m, 1.0))


def test_prominence_of_one_is_the_mean_of_its_shares_of_width_and_height() -> None:
    # 0.4 m at 2 m fills 0.2 of the width; 0.6 m fills 0.3 widths, 0.4 of the height.
    found = prominence_of(flat_box(0.4, 0.6))(seen_from(2.0))
    assert found == pytest.approx(np.sqrt(0.2 * 0.4) / LARGE)


def test_a_group_counts_together_unless_each_is_tiny() -> None:
    pair = prominence_of(flat_box(0.3, 0.3, -0.6), flat_box(0.3, 0.3, 0.6))
    assert pair(seen_from(2.0)) == pytest.approx(0.75 / 0.65)
    copy = np.sqrt(0.02 * 0.02 / ASPECT)
    specks = prominence_of(flat_box(0.04, 0.04, -0.6), flat_box(0.04, 0.04, 0.6))
    assert specks(seen_from(2.0)) == pytest.approx(copy / LARGE_COPY)


@pytest.mark.parametrize("goal", [0.2, 0.5, 0.9, 5.0])
def test_the_camera_stops_where_the_subject_reaches_the_goal(goal: float) -> None:
    subject = flat_box(0.5, 0.5, 2.0)
    everything = np.vstack([subject, flat_box(9.0, 4.0)])

    def framed(points: Float64Array) -> Framing:
        return fit(points, azimuth=0.0, elevation=0.1, aspect=ASPECT, fill=0.84)

    prominence = prominence_of(subject)
    wide, near = framed(everything), framed(subject)
    path = come_near([wide, near], path_of, prominence, [goal])
    least, most = prominence(path_of(wide)), prominence(path_of(near))
    if goal < least:
        assert path.framing is wide
    elif goal < most:
        assert goal <= prominence(path) < 1.1 * goal
    else:
        assert prominence(path) == pytest.approx(most)
    camera = path.at(0.0)
    image = project(camera, SIZE, subject)[:, :2]
    assert np.all(image >= 0.0)
    assert np.all(image <= [SIZE.width, SIZE.height])


class BoxActor:
    """As much of an actor as the view needs."""

    def __init__(self, box: Float64Array) -> None:
        self.box = box

    def corners(self, time_s: float) -> Float64Array:
        return self.box

    def middle(self, time_s: float) -> Float64Array:
        return np.asarray(self.box.mean(axis=0))


TIMES = np.array([0.0, 1.0])


def covered(path: CameraPath, box: Float64Array) -> float:
    """Share of the image that a box's outline takes."""
    camera = path.at(0.0)
    image = project(camera, SIZE, box)[:, :2] / [SIZE.width, SIZE.height]
    return float(np.prod(np.ptp(np.clip(image, 0.0, 1.0), axis=0)))


def extent(scene: ComposedScene, noun: str) -> float:
    """Largest extent of a thing in the image, shares of its width and height, at mid clip."""
    actor = next(one for one in scene.actors if one.noun.name == noun)
    image = project(scene.camera(1.0), SIZE, actor.corners(1.0))
    return float((np.ptp(image[:, :2], axis=0) / [SIZE.width, SIZE.height]).max())


@pytest.mark.parametrize(
    ("prompt", "noun", "least"),
    [
        ("a toy robot stands on a rug in a bedroom", "toy robot", 0.2),
        ("a hedgehog walks in front of a bench", "hedgehog", 0.2),
        ("a man walks in front of a castle", "man", 0.35),
        ("a boy flies a kite in the park", "child", 0.3),
    ],
)
def test_large_things_do_not_push_the_camera_away(prompt: str, noun: str, least: float) -> None:
    scene = compose_scene(parse_prompt(prompt), seed=0, size=SIZE, duration_s=2.0)
    assert extent(scene, noun) > least


@pytest.mark.parametrize(
    ("prompt", "noun"),
    [("a cowboy is roping a calf", "calf"), ("a man stands beside a car", "car"),
     ("a motorcycle with a person stops", "person")],
)  # fmt: skip
def test_partners_stay_in_the_image(prompt: str, noun: str) -> None:
    scene = compose_scene(parse_prompt(prompt), seed=0, size=SIZE, duration_s=2.0)
    partner = next(one for one in scene.actors if one.noun.name == noun)
    for time in (0.0, 1.0, 2.0):
        image = project(scene.camera(time), SIZE, partner.corners(time))[:, :2]
        image = np.clip(image / [SIZE.width, SIZE.height], 0.0, 1.0)
        assert np.ptp(image, axis=0).min() > 0.06


def test_what_a_subject_acts_on_stays_in_the_image() -> None:
    scene = compose_scene(parse_prompt("a boy kicks a ball"), seed=0, size=SIZE, duration_s=2.0)
    ball = next(one for one in scene.actors if one.noun.name == "ball")
    for time in (0.0, 1.0, 2.0):
        x, y = project(scene.camera(time), SIZE, ball.middle(time)[None])[0, :2]
        assert 0.0 < x < SIZE.width
        assert 0.0 < y < SIZE.height


def test_nothing_looms_between_the_camera_and_the_subject() -> None:
    wide, near = seen_from(8.0), seen_from(3.0)
    # The boxes stand to the south of the subject: 5.5 and 0.5 m from the cameras.
    box = 0.5 * SIGNS * 0.8 + [0.0, -2.5, 0.0]
    assert covered(wide, box) < 0.05
    assert covered(near, box) > 0.5
    for path, expected in ((wide, True), (near, False)):
        others = [BoxActor(box)]
        assert has_clear_view(path, BoxActor(0.1 * SIGNS), others, TIMES, ASPECT) is expected
    # What is lower than the subject's middle hides nothing.
    low = BoxActor(box - [0.0, 0.0, 0.5])
    assert has_clear_view(near, BoxActor(0.1 * SIGNS), [low], TIMES, ASPECT)


def test_the_camera_goes_no_nearer_than_the_view_is_clear() -> None:
    subject, everything = flat_box(0.5, 0.5), flat_box(9.0, 4.0)
    framings = [
        fit(points, azimuth=0.0, elevation=0.1, aspect=ASPECT, fill=0.84)
        for points in (everything, subject)
    ]

    def is_clear(path: CameraPath) -> bool:
        return path.framing.distance_m > 5.0

    path = come_near(framings, path_of, prominence_of(subject), [1.0], is_clear)
    assert 5.0 < path.framing.distance_m < 5.3
