"""The camera goes as near as its subject asks for, and no nearer."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from texvent.scenes.description import (
    ObjectMotion,
    Relation,
    SceneDescription,
    SceneObject,
    Shot,
    Surroundings,
)
from texvent.scenes.projection import project
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.camera.camera_path import CameraPath
from texvent.scenes.staging.camera.framing import Framing, come_near, fit, measure_prominence
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


def prominence_of(*boxes: Float64Array) -> Callable[[Framing], float]:
    return lambda one: measure_prominence(path_of(one).at(0.0), np.array(boxes), ASPECT)


def seen_from(distance_m: float) -> Framing:
    return Framing(np.zeros(3), 0.0, 0.0, distance_m, 1.0)


def test_prominence_is_the_mean_share_of_one_and_the_extent_of_a_group():
    # 0.4 m at 2 m fills 0.2 of the width; 0.6 m fills 0.3 widths, 0.4 of the height.
    found = prominence_of(flat_box(0.4, 0.6))(seen_from(2.0))
    assert found == pytest.approx(np.sqrt(0.2 * 0.4) / 0.3)
    pair = prominence_of(flat_box(0.3, 0.3, -0.6), flat_box(0.3, 0.3, 0.6))
    assert pair(seen_from(2.0)) == pytest.approx(0.75 / 0.65)
    specks = prominence_of(flat_box(0.04, 0.04, -0.6), flat_box(0.04, 0.04, 0.6))
    assert specks(seen_from(2.0)) == pytest.approx(np.sqrt(0.02 * 0.02 / ASPECT) / 0.13)


@pytest.mark.parametrize("goal", [0.2, 0.5, 0.9, 5.0])
def test_the_camera_stops_where_the_subject_reaches_the_goal(goal):
    subject = flat_box(0.5, 0.5, 2.0)
    everything = np.vstack([subject, flat_box(9.0, 4.0)])

    def framed(points: Float64Array) -> Framing:
        return fit(points, azimuth=0.0, elevation=0.1, aspect=ASPECT, fill=0.84)

    prominence = prominence_of(subject)
    wide, near = framed(everything), framed(subject)
    found = come_near([wide, near], prominence, [goal])
    least, most = prominence(wide), prominence(near)
    if goal < least:
        assert found is wide
    elif goal < most:
        assert goal <= prominence(found) < 1.1 * goal
    else:
        assert prominence(found) == pytest.approx(most)
    camera = path_of(found).at(0.0)
    image = project(camera, SIZE, subject)[:, :2]
    assert np.all(image >= 0.0)
    assert np.all(image <= [SIZE.width, SIZE.height])


def shot_of(
    *objects: SceneObject, relations: tuple[Relation, ...] = (), framing: str | None = None
) -> ComposedScene:
    description = SceneDescription(
        "", objects, relations, shot=Shot(framing=framing), surroundings=Surroundings("grass")
    )
    return compose_scene(description, seed=0, size=SIZE, duration_s=2.0)


def place_in_image(scene: ComposedScene, number: int, time_s: float) -> Float64Array:
    """[8, 2] corners of an actor, shares of the image's width and height from the top left."""
    corners = scene.actors[number].corners(time_s)
    image = project(scene.camera(time_s), SIZE, corners)[:, :2]
    return np.asarray(image / [SIZE.width, SIZE.height])


@pytest.mark.parametrize(
    ("small", "kind", "large", "least"),
    [("hedgehog", "front", "bench", 0.15), ("man", "front", "castle", 0.3),
     ("dog", "beside", "house", 0.15), ("cup", "on", "table", 0.1)],
)  # fmt: skip
def test_large_things_do_not_push_the_camera_away(small, kind, large, least):
    objects = (SceneObject(small), SceneObject(large))
    scene = shot_of(*objects, relations=(Relation(kind, 0, (1,)),))
    assert np.ptp(place_in_image(scene, 0, 1.0), axis=0).max() > least
    partner = np.clip(place_in_image(scene, 1, 1.0), 0.0, 1.0)
    assert np.ptp(partner, axis=0).min() > 0.05


@pytest.mark.parametrize(
    ("activity", "framing", "is_whole"),
    [("wave", None, False), ("clap", None, False), ("squat", None, True), ("walk", None, True),
     ("wave", "wide", True), ("walk", "medium", False), ("stand", "close", False)],
)  # fmt: skip
def test_the_image_ends_at_the_waist_of_who_acts_with_the_arms_alone(activity, framing, is_whole):
    scene = shot_of(SceneObject("man", motion=ObjectMotion(activity)), framing=framing)
    seen = place_in_image(scene, 0, 1.0)
    assert seen[:, 1].min() > -0.05
    assert (seen[:, 1].max() < 1.0) == is_whole


@pytest.mark.parametrize(
    ("kind", "outside_s", "inside_s"), [("enter", 0.0, 1.8), ("leave", 2.0, 0.2)]
)
def test_what_enters_or_leaves_is_out_of_the_picture_before_or_after(kind, outside_s, inside_s):
    for noun in ("car", "man", "dog"):
        scene = shot_of(SceneObject(noun, motion=ObjectMotion(kind, "right")))
        outside, inside = (place_in_image(scene, 0, time) for time in (outside_s, inside_s))
        assert np.any(outside.max(axis=0) < 0.0) or np.any(outside.min(axis=0) > 1.0)
        assert np.all(np.abs(inside.mean(axis=0) - 0.5) < 0.5)
