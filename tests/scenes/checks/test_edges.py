"""Subjects at the edge of the picture, copies that merge, and what covers it, are named."""

from dataclasses import replace

import numpy as np
import pytest
from tests.scenes.staged import DURATION_S, SIZE, moved, stage_text

from texvent_scenes.checks.edges import find_cut_subject, find_merged, list_covering

TIMES_S = [float(one) for one in np.linspace(0.0, DURATION_S, 5)]


@pytest.mark.parametrize(
    "text",
    ["a man walks on a street as the camera walks backward in front of him",
     "a dog runs along a beach while the camera moves backward in front of it",
     "the camera follows a cyclist along a road"],
)  # fmt: skip
def test_who_a_moving_camera_is_about_is_in_the_middle_or_named(text):
    said, scene = stage_text(text)
    cameras = [scene.camera(one) for one in TIMES_S]
    assert [*find_cut_subject(scene, said, cameras, TIMES_S, SIZE)] == []
    aside = 0.5 * scene.camera_path.framing.distance_m / scene.camera_path.framing.focal
    beside = [replace(one, position=one.position + aside * one.rotation[0]) for one in cameras]
    assert [*find_cut_subject(scene, said, beside, TIMES_S, SIZE)] == [0]


@pytest.mark.parametrize("noun", ["sheep", "cups", "cars"])
def test_copies_of_which_one_stands_before_the_other_are_counted_as_they_are_seen(noun):
    said, scene = stage_text(f"two {noun} stand")
    cameras = [scene.camera(one) for one in TIMES_S]
    assert [*find_merged(scene, said, cameras, TIMES_S, SIZE)] == []
    first, second = (one.track.start for one in scene.actors)
    away = 0.01 * cameras[0].rotation[2]
    merged = moved(scene, scene.actors[1], np.subtract(first, second) + away)
    assert [*find_merged(merged, said, cameras, TIMES_S, SIZE)] == [(0, 1)]


@pytest.mark.parametrize(("points", "is_told"), [(60, False), (300, True)])
def test_what_stands_before_the_subject_and_takes_much_of_the_image_is_told(points, is_told):
    said, scene = stage_text("a cat and a wardrobe")
    camera = scene.camera(0.0)
    ahead = camera.position + 0.4 * scene.camera_path.framing.distance_m * camera.rotation[2]
    near = moved(scene, scene.actors[1], ahead - scene.actors[1].middle(0.0))
    seen = {1: [points] * 5, 2: [points] * 5}
    told = [*list_covering(near, said, seen, 1000, TIMES_S)]
    assert told == (["the wardrobe covers 30 % of the picture"] if is_told else [])
