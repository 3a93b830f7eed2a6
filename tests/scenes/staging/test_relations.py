"""Relations between objects, and the report of those that the scene does not show."""

from __future__ import annotations

import numpy as np
import pytest

from texvent.scenes.description import (
    CameraMove,
    ObjectMotion,
    Relation,
    SceneDescription,
    SceneObject,
    Shot,
    Surroundings,
)
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.compose import ComposedScene, compose_scene
from texvent.sensor import SensorSize

SIZE = SensorSize(173, 130)


def thing(noun: str, *motions: tuple[str, ...], count: int = 1) -> SceneObject:
    said = [ObjectMotion(*motion) for motion in motions]
    return SceneObject(noun, count, motion=said[0] if said else None, then=tuple(said[1:]))


def stage(
    *objects: SceneObject,
    relations: tuple[Relation, ...] = (),
    place: str = "grass",
    moves: tuple[CameraMove, ...] = (),
    duration_s: float = 2.0,
) -> ComposedScene:
    description = SceneDescription(
        "", objects, relations, shot=Shot(moves), surroundings=Surroundings(place)
    )
    return compose_scene(description, seed=0, size=SIZE, duration_s=duration_s)


def overlap(first: Actor, second: Actor, time_s: float) -> float:
    """Share of the first one's box that lies in the second one's, over the ground."""
    boxes = [actor.corners(time_s)[:, :2] for actor in (first, second)]
    low = np.maximum(boxes[0].min(axis=0), boxes[1].min(axis=0))
    high = np.minimum(boxes[0].max(axis=0), boxes[1].max(axis=0))
    return float(np.prod(np.maximum(high - low, 0.0)) / np.prod(np.ptp(boxes[0], axis=0)))


def test_a_cat_sits_under_the_table() -> None:
    scene = stage(thing("cat", ("sit",)), thing("table"), relations=(Relation("under", 0, (1,)),),
                  place="indoor")  # fmt: skip
    assert overlap(*scene.actors, 1.0) > 0.9
    assert scene.not_shown == ()


def test_what_does_not_fit_under_something_is_reported() -> None:
    scene = stage(thing("elephant", ("stand",)), thing("chair"),
                  relations=(Relation("under", 0, (1,)),))  # fmt: skip
    assert scene.not_shown == ("under the chair",)
    assert overlap(*scene.actors, 1.0) == 0.0


def test_from_one_to_the_other() -> None:
    relations = (Relation("from", 0, (1,)), Relation("towards", 0, (2,)))
    scene = stage(thing("man", ("walk", "right")), thing("house"), thing("tree"),
                  relations=relations)  # fmt: skip
    man, house, tree = scene.actors
    apart = [[float(np.linalg.norm(man.middle(t) - other.middle(t))) for other in (house, tree)]
             for t in (0.0, 2.0)]  # fmt: skip
    assert apart[1][0] > apart[0][0]
    assert apart[1][1] < apart[0][1]
    assert scene.not_shown == ()


@pytest.mark.parametrize("relation", ["overtake", "past"])
def test_a_car_overtakes_a_truck_without_touching_it(relation: str) -> None:
    scene = stage(thing("car", ("drive", "right")), thing("truck", ("drive",)),
                  relations=(Relation(relation, 0, (1,)),), place="road")  # fmt: skip
    car, truck = scene.actors
    ahead = [float(car.middle(t)[0] - truck.middle(t)[0]) for t in (0.0, 2.0)]
    assert ahead[0] < 0.0 < ahead[1]
    assert max(overlap(car, truck, t) for t in np.linspace(0.0, 2.0, 9)) == 0.0
    assert scene.not_shown == ()


def test_a_follower_takes_the_same_line_round_the_corner() -> None:
    scene = stage(thing("car", ("drive",), ("turn", "left")), thing("bus", ("drive",)),
                  relations=(Relation("follow", 1, (0,)),), place="city")  # fmt: skip
    car, bus = scene.actors
    line = np.array([car.trajectory.at(float(t)).position for t in np.linspace(-3.0, 2.0, 4000)])
    spot = np.array(bus.trajectory.at(2.0).position)
    assert float(np.min(np.linalg.norm(line - spot, axis=1))) < 0.02
    assert max(overlap(bus, car, t) for t in np.linspace(0.0, 2.0, 9)) < 0.05


def test_chairs_stand_around_a_table_and_face_it() -> None:
    scene = stage(thing("chair", ("stand",), count=4), thing("table"),
                  relations=(Relation("around", 0, (1,)),), place="indoor")  # fmt: skip
    table = scene.actors[-1].middle(0.0)
    for chair in scene.actors[:-1]:
        inwards = (table - chair.middle(0.0))[:2]
        nose = chair.trajectory.at(0.0).to_world()[:2, 0]
        assert float(nose @ inwards) / np.linalg.norm(inwards) > 0.9
        assert overlap(chair, scene.actors[-1], 0.0) < 0.3


def test_a_child_appears_from_behind_a_car() -> None:
    scene = stage(thing("child", ("appear", "left")), thing("car"),
                  relations=(Relation("behind", 0, (1,)),), place="city")  # fmt: skip
    child, car = scene.actors

    def is_hidden(time_s: float) -> bool:
        camera = scene.camera(time_s)
        views = []
        for actor in (child, car):
            seen = (actor.corners(time_s) - camera.position) @ camera.rotation.T
            image = seen[:, 0] / seen[:, 2]
            views.append((image.min(), image.max(), seen[:, 2].mean()))
        (low, high, far), (near_low, near_high, near) = views
        return bool(near < far and low > near_low and high < near_high)

    assert is_hidden(0.0)
    assert not is_hidden(2.0)


def test_what_enters_begins_outside_and_what_leaves_ends_outside() -> None:
    for kind, outside, inside in (("enter", 0.0, 2.0), ("leave", 2.0, 0.0)):
        scene = stage(thing("dog", (kind, "right")))
        shown = []
        for time in (outside, inside):
            camera = scene.camera(time)
            seen = (scene.actors[0].corners(time) - camera.position) @ camera.rotation.T
            image = camera.focal * seen[:, 0] / seen[:, 2]
            shown.append(image.min() < 0.5 and image.max() > -0.5)
        assert shown == [False, True]


def test_a_waiting_plane_stands_on_the_ground() -> None:
    scene = stage(thing("airplane", ("stand",)), place="road")
    plane = scene.actors[0].instance
    shapes = scene.primitives(0.0)
    mine = shapes.to_world[shapes.instance == plane]
    lowest = float(np.min(mine[:, 2, 3] - np.linalg.norm(mine[:, 2, :3], axis=1)))
    assert lowest == pytest.approx(0.0, abs=0.3)


def test_what_is_followed_moves_and_what_cannot_move_is_reported() -> None:
    scene = stage(thing("dog", ("stand",)), moves=(CameraMove("follow", "behind"),))
    dog = scene.actors[0]
    assert np.linalg.norm(dog.middle(2.0) - dog.middle(0.0)) > 1.0
    house = stage(thing("house"), moves=(CameraMove("follow", "behind"),))
    assert house.not_shown == ("following the house, which does not move",)
    step = house.camera(2.0).position - house.camera(0.0).position
    assert np.linalg.norm(step) > 1.0


def test_what_begins_after_the_clip_is_reported() -> None:
    walks = SceneObject("man", motion=ObjectMotion("walk"),
                        then=(ObjectMotion("jump", start_s=5.0),))  # fmt: skip
    assert stage(walks).not_shown == ("the man's jump after 5 s (the clip ends at 2 s)",)
    assert stage(walks, duration_s=8.0).not_shown == ()


@pytest.mark.parametrize("noun", ["tunnel", "arch"])
def test_a_car_comes_out_of_what_it_goes_through(noun: str) -> None:
    scene = stage(thing("car", ("drive",)), thing(noun), relations=(Relation("through", 0, (1,)),),
                  place="road")  # fmt: skip
    assert scene.not_shown == ()
    car, gate = scene.actors
    ahead = [float((car.middle(t) - gate.middle(t))[1]) for t in (0.0, 2.0)]
    assert ahead[1] < -0.5 * gate.model.length < 0.0


def test_what_one_cannot_go_through_is_reported() -> None:
    scene = stage(thing("car", ("drive", "right")), thing("rock"),
                  relations=(Relation("through", 0, (1,)),), place="road")  # fmt: skip
    assert scene.not_shown == ("through the rock",)
