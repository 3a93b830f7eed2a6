"""The check of rays: what is out of view, and what is a few pixels large."""

from dataclasses import replace

import numpy as np
import pytest
from tests.scenes.staged import DURATION_S, SIZE, stage

from texvent.scenes.description import SceneDescription, SceneObject
from texvent.scenes.in_view import LEAST_PIXELS, Unseen, count_pixels, find_unseen
from texvent.scenes.raycast.ground_truth import ground_truth
from texvent.scenes.staging.camera.camera_path import CameraPath
from texvent.scenes.staging.camera.framing import pose

CAR = SceneObject("car")


def unseen_from(*objects, relations=(), position=None, target=(0.0, 0.0, 1.0)):
    """What is unseen from the framing's place, or from another one."""
    scene = stage(*objects, relations=relations, place="plain")
    if position is not None:
        scene = replace(scene, camera_path=CameraPath(pose(position, target), (), DURATION_S))
    return find_unseen(scene, SceneDescription("", objects), scene.object_of, SIZE, DURATION_S)


def test_what_the_camera_frames_is_in_view_and_what_is_worn_is_part_of_who_wears_it():
    assert unseen_from(CAR, SceneObject("tree", 2), SceneObject("dog")) == Unseen((), ())
    worn = unseen_from(SceneObject("man"), SceneObject("hat"), relations=(("wear", 0, 1),))
    assert worn.out_of_view == ()


def test_what_is_behind_the_camera_is_out_of_view_and_copies_are_counted():
    behind = unseen_from(CAR, position=(0.0, -30.0, 1.5), target=(0.0, -60.0, 1.5))
    assert behind.out_of_view == ("car",)
    beside = unseen_from(SceneObject("car", 3), position=(0.0, -3.5, 1.0))
    assert beside.out_of_view in (("car (1 of 3)",), ("car (2 of 3)",))


def test_pixels_of_small_things_are_counted_one_by_one():
    scene = stage(SceneObject("ball"), SceneObject("house"), place="plain")
    scene = replace(scene, camera_path=replace(scene.camera_path, moves=(), tie=None))
    truth = ground_truth(scene, 0.0, 0.05, SIZE).instance
    for instance, count in count_pixels(scene, list(scene.object_of), SIZE, DURATION_S).items():
        assert count >= LEAST_PIXELS
        assert count == pytest.approx(int(np.sum(truth == instance)), rel=0.5, abs=20)
