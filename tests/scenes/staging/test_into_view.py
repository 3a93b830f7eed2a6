"""What only stands about and is out of view comes to a free spot of the image."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from tests.scenes.sentences import parse_prompt

from texvent.scenes.description import ObjectMotion, Relation, SceneDescription, SceneObject
from texvent.scenes.projection import project
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.camera.camera_path import CameraPath
from texvent.scenes.staging.compose import compose_scene
from texvent.scenes.staging.placement.into_view import find_shifts
from texvent.scenes.staging.trajectories.trajectory import Stationary
from texvent.sensor import SensorSize

SIZE = SensorSize(173, 130)
DESCRIPTION = SceneDescription(
    "a man waves; a chair, a dog",
    objects=(
        SceneObject("man", motion=ObjectMotion("wave")),
        SceneObject("chair"),
        SceneObject("dog", motion=ObjectMotion("sit")),
    ),
)


def outline(path: CameraPath, actor: Actor) -> tuple[np.ndarray, np.ndarray]:
    """Least and greatest x and y of its box in the image, pixels."""
    image = project(path.at(0.5), SIZE, actor.corners(0.5))[:, :2]
    return image.min(axis=0), image.max(axis=0)


def is_inside(path: CameraPath, actor: Actor) -> bool:
    if np.any(project(path.at(0.5), SIZE, actor.corners(0.5))[:, 2] <= 0.0):
        return False
    low, high = outline(path, actor)
    return bool(np.all(low > -2.0) and np.all(high < np.array([SIZE.width, SIZE.height]) + 2.0))


def staged(spot: tuple[float, float]) -> tuple[list[Actor], CameraPath]:
    """The scene's actors and camera, the chair at a ground point."""
    scene = compose_scene(DESCRIPTION, seed=0, size=SIZE, duration_s=1.0)
    actors = [
        replace(one, trajectory=Stationary((*spot, 0.0))) if one.noun.name == "chair" else one
        for one in scene.actors
    ]
    return actors, scene.camera_path


def brought(actors: list[Actor], path: CameraPath, description: SceneDescription = DESCRIPTION):
    shifts = find_shifts(
        description, actors, path, subject=0, aspect=SIZE.height / SIZE.width, duration_s=1.0
    )
    return [moved(actor, shifts.get(actor.object_index, np.zeros(3))) for actor in actors]


def moved(actor: Actor, shift: np.ndarray) -> Actor:
    if not isinstance(actor.trajectory, Stationary) or not np.any(shift):
        return actor
    home = tuple(float(v) for v in np.array(actor.trajectory.home) + shift)
    return replace(actor, trajectory=replace(actor.trajectory, home=home))


@pytest.mark.parametrize("spot", [(40.0, 0.0), (0.0, -60.0), (-9.0, 9.0)])
def test_a_thing_out_of_view_comes_into_view_and_hides_no_other(spot) -> None:
    actors, path = staged(spot)
    man, chair, dog = brought(actors, path)
    assert (man, dog) == (actors[0], actors[2])
    assert not is_inside(path, actors[1])
    assert is_inside(path, chair)
    low, high = outline(path, chair)
    for other in (man, dog):
        other_low, other_high = outline(path, other)
        common = np.minimum(high, other_high) - np.maximum(low, other_low)
        covered = np.prod(np.maximum(common, 0.0)) / np.prod(other_high - other_low)
        assert covered < 0.31


def test_what_is_in_view_or_has_its_place_from_the_prompt_stays() -> None:
    actors, path = staged((40.0, 0.0))
    there = brought(actors, path)
    assert brought(there, path) == there
    behind = replace(DESCRIPTION, relations=(Relation("behind", 1, (0,)),))
    assert brought(actors, path, behind) == actors
    far = [*DESCRIPTION.objects]
    far[1] = replace(far[1], side="far")
    assert brought(actors, path, replace(DESCRIPTION, objects=tuple(far))) == actors


def test_what_a_relation_ties_together_moves_as_one() -> None:
    actors, path = staged((40.0, 0.0))
    actors[2] = replace(actors[2], trajectory=Stationary((40.0, 1.0, 0.0)))
    on = replace(DESCRIPTION, relations=(Relation("beside", 2, (1,)),))
    shifts = find_shifts(on, actors, path, subject=0, aspect=0.75, duration_s=1.0)
    assert set(shifts) == {1, 2}
    assert np.array_equal(shifts[1], shifts[2])


def test_mountains_stand_far_behind_those_who_ride_near_them() -> None:
    description = parse_prompt("A group of people ride horses near three mountains.")
    scene = compose_scene(description, seed=0, size=SIZE, duration_s=1.0)
    camera = scene.camera(0.5)
    depth = {
        one.noun.name: (one.middle(0.5) - camera.position) @ camera.rotation[2]
        for one in scene.actors
    }
    assert depth["mountain"] > 5.0 * depth["horse"] > 0.0
    horse = next(one for one in scene.actors if one.noun.name == "horse")
    low, high = outline(scene.camera_path, horse)
    assert np.max(high - low) > 0.12 * SIZE.width
