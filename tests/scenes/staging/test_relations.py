"""Relations between objects: where things are, and where they go."""

from __future__ import annotations

import itertools
from dataclasses import replace

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


@pytest.mark.parametrize(
    ("noun", "target", "least", "most"),
    [("cat", "table", 0.9, 1.0), ("man", "tree", 0.9, 1.0), ("elephant", "chair", 0.0, 0.0)],
)
def test_what_fits_is_under_its_target_and_what_does_not_is_beside_it(noun, target, least, most):
    scene = stage(thing(noun, ("stand",)), thing(target), relations=(Relation("under", 0, (1,)),))
    assert least <= overlap(*scene.actors, 1.0) <= most + 1e-9
    assert np.hypot(*(scene.actors[0].middle(0.0) - scene.actors[1].middle(0.0))[:2]) > 0.1


@pytest.mark.parametrize("relation", ["overtake", "past"])
def test_a_car_overtakes_a_truck_without_touching_it(relation):
    scene = stage(thing("car", ("drive", "right")), thing("truck", ("drive",)),
                  relations=(Relation(relation, 0, (1,)),), place="road")  # fmt: skip
    car, truck = scene.actors
    ahead = [float(car.middle(t)[0] - truck.middle(t)[0]) for t in (0.0, 2.0)]
    assert ahead[0] < 0.0 < ahead[1]
    assert max(overlap(car, truck, t) for t in np.linspace(0.0, 2.0, 9)) == 0.0


def test_chairs_stand_around_a_table_and_face_it():
    scene = stage(thing("chair", ("stand",), count=4), thing("table"),
                  relations=(Relation("around", 0, (1,)),), place="indoor")  # fmt: skip
    table = scene.actors[-1].middle(0.0)
    for chair in scene.actors[:-1]:
        inwards = (table - chair.middle(0.0))[:2]
        nose = chair.trajectory.at(0.0).to_world()[:2, 0]
        assert float(nose @ inwards) / np.linalg.norm(inwards) > 0.9
        assert overlap(chair, scene.actors[-1], 0.0) < 0.3


def test_a_child_appears_from_behind_a_car():
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


def test_what_is_followed_moves_and_what_cannot_move_is_reported():
    scene = stage(thing("dog", ("stand",)), moves=(CameraMove("follow", "behind"),))
    dog = scene.actors[0]
    assert np.linalg.norm(dog.middle(2.0) - dog.middle(0.0)) > 1.0
    house = stage(thing("house"), moves=(CameraMove("follow", "behind"),))
    assert house.not_shown == ("following the house, which does not move",)
    step = house.camera(2.0).position - house.camera(0.0).position
    assert np.linalg.norm(step) > 1.0


def test_what_begins_after_the_clip_is_reported():
    jumps = ObjectMotion("jump", start_s=5.0)
    walks = SceneObject("man", motion=ObjectMotion("walk"), then=(jumps,))
    assert stage(walks).not_shown == ("the man's jump after 5 s (the clip ends at 2 s)",)
    assert stage(walks, duration_s=8.0).not_shown == ()


def test_a_car_comes_out_of_what_it_goes_through():
    scene = stage(thing("car", ("drive", "towards")), thing("tunnel"),
                  relations=(Relation("through", 0, (1,)),), place="road")  # fmt: skip
    car, gate = scene.actors
    ahead = [float((car.middle(t) - gate.middle(t))[1]) for t in (0.0, 2.0)]
    assert ahead[1] < -0.5 * gate.model.length < 0.0


@pytest.mark.parametrize("count", [1, 2, 4])
def test_people_at_a_table_sit_on_chairs_around_it_and_face_it(count):
    scene = stage(thing("person", count=count), thing("table"),
                  relations=(Relation("at", 0, (1,)),), place="indoor")  # fmt: skip
    *people, table = scene.actors
    assert len({tuple(np.round(one.middle(0.0)[:2], 2)) for one in people}) == count
    for one in people:
        state = one.trajectory.at(0.0)
        inwards = (table.middle(0.0) - one.middle(0.0))[:2]
        assert state.activity == "sit"
        assert state.to_world()[:2, 0] @ inwards > 0.4 * np.linalg.norm(inwards)
        assert any(prop.anchor == "ground" for prop in one.props)
        assert overlap(one, table, 0.0) < 0.5


def test_who_is_on_a_seat_sits_unless_they_stand():
    for motions, doing in (((), "sit"), ((("stand",),), "stand")):
        scene = stage(thing("man", *motions), thing("chair"), relations=(Relation("on", 0, (1,)),))
        man, chair = scene.actors
        assert man.trajectory.at(0.0).activity == doing
        assert overlap(man, chair, 0.0) > 0.4


def test_things_in_a_row_on_a_table_stand_on_its_top():
    scene = stage(thing("book", count=3), thing("cup"), thing("table"), place="indoor",
                  relations=(Relation("on", 0, (2,)), Relation("on", 1, (2,))))  # fmt: skip
    *things, table = scene.actors
    places = [one.middle(0.0) for one in things]
    for one in things:
        assert one.corners(0.0)[:, 2].min() == pytest.approx(table.model.height, abs=0.03)
        assert overlap(one, table, 0.0) == pytest.approx(1.0)
    assert len({round(float(place[0]), 2) for place in places}) == 4


def test_who_is_on_what_moves_goes_along():
    cat, bus = stage(thing("cat", ("sit",)), thing("bus", ("drive", "left")), place="road",
                     relations=(Relation("on", 0, (1,)),)).actors  # fmt: skip
    for time_s in (0.0, 2.0):
        away = cat.middle(time_s) - bus.middle(time_s)
        np.testing.assert_allclose(away, cat.middle(1.0) - bus.middle(1.0), atol=1e-6)


def test_a_row_is_straight_and_a_ring_is_round():
    row = replace(thing("chair", count=5), side="row")
    places = np.array([one.middle(0.0)[:2] for one in stage(row).actors])
    assert np.ptp(places[:, 1]) == pytest.approx(0.0)
    assert np.diff(places[:, 0]).min() > 0.3
    ring = replace(thing("chair", count=6), side="ring")
    places = np.array([one.middle(0.0)[:2] for one in stage(ring).actors])
    radii = np.linalg.norm(places - places.mean(axis=0), axis=1)
    assert radii == pytest.approx(radii[0])


def test_objects_without_relations_do_not_touch():
    scene = stage(*(thing(noun, ("stand",)) for noun in ("car", "dog", "house", "tree", "bench")))
    for one, other in itertools.combinations(scene.actors, 2):
        assert overlap(one, other, 0.0) == 0.0
