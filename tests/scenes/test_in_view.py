"""The check of rays: what is out of view, and what is a few pixels large."""

from __future__ import annotations

import time
from dataclasses import replace

import numpy as np
import pytest

from texvent.scenes.description import Relation, SceneDescription, SceneObject, Shot, Surroundings
from texvent.scenes.in_view import LEAST_PIXELS, Unseen, count_pixels, find_unseen
from texvent.scenes.raycast.ground_truth import ground_truth
from texvent.scenes.scene import Camera
from texvent.scenes.staging.compose import ComposedScene, compose_scene
from texvent.sensor import SensorSize

SIZE = SensorSize(173, 130)
DURATION_S = 1.0


class OtherCamera:
    """A staged scene that is seen from elsewhere."""

    def __init__(self, scene: ComposedScene, camera: Camera) -> None:
        self._scene, self._camera = scene, camera

    def camera(self, time_s: float) -> Camera:
        return self._camera

    def __getattr__(self, name: str) -> object:
        return getattr(self._scene, name)


def described(*objects: SceneObject, relations: tuple[Relation, ...] = ()) -> SceneDescription:
    return SceneDescription("", objects, relations, surroundings=Surroundings("plain"))


def staged(description: SceneDescription) -> ComposedScene:
    return compose_scene(description, seed=0, size=SIZE, duration_s=DURATION_S)


def unseen_from(description: SceneDescription, camera: Camera | None = None) -> Unseen:
    scene = staged(description)
    seen = scene if camera is None else OtherCamera(scene, camera)
    return find_unseen(seen, description, scene.object_of, SIZE, DURATION_S)  # type: ignore[arg-type]


def looking(axis: int, sign: float, position: tuple[float, float, float]) -> Camera:
    """A level camera that looks along a ground axis."""
    forward = np.zeros(3)
    forward[axis] = sign
    down = np.array([0.0, 0.0, -1.0])
    return Camera(np.array(position), np.array([np.cross(down, forward), down, forward]), 1.1)


def test_what_the_camera_frames_is_in_view() -> None:
    description = described(SceneObject("car"), SceneObject("tree", 2), SceneObject("dog"))
    assert unseen_from(description) == Unseen((), ())


def test_what_is_behind_the_camera_is_out_of_view() -> None:
    description = described(SceneObject("car"))
    assert unseen_from(description, looking(1, -1.0, (0.0, -30.0, 1.5))).out_of_view == ("car",)


def test_copies_out_of_view_are_counted() -> None:
    description = described(SceneObject("car", 3))
    scene = staged(description)
    # From right before one of the cars the others are beside the picture.
    x, y, _ = scene.actors[0].middle(0.0)
    found = unseen_from(description, looking(1, 1.0, (float(x), float(y) - 3.0, 1.0)))
    assert found.out_of_view in (("car (1 of 3)",), ("car (2 of 3)",))


@pytest.mark.parametrize(("distance_m", "is_small"), [(20.0, False), (1500.0, True)])
def test_what_is_far_away_is_too_small(distance_m: float, is_small: bool) -> None:
    found = unseen_from(described(SceneObject("car")), looking(1, 1.0, (0.0, -distance_m, 1.0)))
    assert bool(found.too_small or found.out_of_view) == is_small
    assert all(one.startswith("car (") and "pixel" in one for one in found.too_small)


def test_pixels_of_small_things_are_counted_one_by_one() -> None:
    description = described(SceneObject("ball", colour=None), SceneObject("house"))
    scene = staged(description)
    scene = replace(scene, camera_path=replace(scene.camera_path, moves=(), tie=None))
    found = count_pixels(scene, list(scene.object_of), SIZE, DURATION_S)
    truth = ground_truth(scene, 0.0, 0.05, SIZE).instance
    for instance, count in found.items():
        exact = int(np.sum(truth == instance))
        assert count >= LEAST_PIXELS
        assert count == pytest.approx(exact, rel=0.5, abs=20)


def test_the_check_takes_less_than_a_tenth_of_a_second() -> None:
    size = SensorSize(346, 260)
    objects = (SceneObject("car", 3), SceneObject("tree", 5), SceneObject("bird", 8))
    description = SceneDescription(
        "", objects, shot=Shot(framing="wide"), surroundings=Surroundings("city")
    )
    scene = compose_scene(description, seed=0, size=size, duration_s=2.0)
    find_unseen(scene, description, scene.object_of, size, 2.0)  # compiles
    start = time.process_time()
    find_unseen(scene, description, scene.object_of, size, 2.0)
    assert time.process_time() - start < 0.3  # about 0.05 s; the machine may be busy
