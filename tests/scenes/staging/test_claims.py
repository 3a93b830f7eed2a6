"""What a prompt says is checked on the bodies of the scene: it holds, or it is reported."""

from __future__ import annotations

from collections.abc import Sequence
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
from texvent.scenes.language.vocabulary.motion import (
    APART,
    LED,
    PREPOSITION_WAYS,
    RELATIONS,
    WEAK_PREPOSITIONS,
)
from texvent.scenes.language.vocabulary.verbs import VERBS
from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.acts import ACTS
from texvent.scenes.staging.camera.camera_path import CameraPath
from texvent.scenes.staging.camera.framing import Framing
from texvent.scenes.staging.claims.acts import Stage, list_acts_not_shown
from texvent.scenes.staging.claims.bodies import boxes_of, gap, part_boxes
from texvent.scenes.staging.claims.positions import measure
from texvent.scenes.staging.claims.relations import CHECKS, list_not_shown
from texvent.scenes.staging.claims.shots import list_moves_not_shown
from texvent.scenes.staging.claims.ways import WAYS
from texvent.scenes.staging.surroundings.environment import build_environment
from texvent.scenes.staging.surroundings.road import RoadLine
from texvent.scenes.staging.trajectories.trajectory import (
    BodyState,
    Stationary,
    Straight,
    Trajectory,
)

DURATION_S = 2.0
CAMERA = CameraPath(Framing(np.zeros(3), 0.0, 0.2, 10.0, 1.0), (), DURATION_S)
"""South of the origin, looking north: x is to the right in the image."""


def body(index: int, noun: str, trajectory: Trajectory, scale: float = 1.0) -> Actor:
    model = NOUNS[noun].build(colour=None, scale=scale, seed=0)
    is_mover = not isinstance(trajectory, Stationary)
    return Actor(index, NOUNS[noun], model, trajectory, is_mover, index + 1)


def at(x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Stationary:
    return Stationary((x, y, z))


def going(yaw: float, speed: float = 2.0) -> Straight:
    return Straight((0.0, 0.0, 0.0), yaw, speed, 0.5 * DURATION_S)


def unrelated(kind: str, *bodies: Actor) -> list[str]:
    """What is reported of the first body's relation to the others, copies of one object."""
    nouns = [bodies[0].noun.name, bodies[1].noun.name]
    objects = (SceneObject(nouns[0]), SceneObject(nouns[1], len(bodies) - 1))
    description = SceneDescription("", objects, (Relation(kind, 0, (1,)),))
    return [one.text for one in list_not_shown(description, bodies, DURATION_S)]


def unmoved(
    actors: Sequence[Actor],
    *motions: ObjectMotion,
    place: str = "grass",
    road: RoadLine | None = None,
) -> list[str]:
    objects = (SceneObject(actors[0].noun.name, motion=motions[0], then=motions[1:]),)
    others = tuple(SceneObject(actor.noun.name) for actor in actors[1:])
    description = SceneDescription("", objects + others, surroundings=Surroundings(place))
    environment = build_environment(
        description, place=place, road=road or RoadLine(), distance_m=10.0, room_m=9.0
    )
    stage = Stage(description, actors, CAMERA, environment.at(0.0), place, DURATION_S)
    return [one.text for one in list_acts_not_shown(stage)]


TABLE_TOP_M = part_boxes(body(0, "table", at()), 0.0).hull[1][2]


@pytest.mark.parametrize(
    ("place", "reported"),
    [
        ((0.0, 0.0, TABLE_TOP_M), []),
        ((0.0, 0.0, TABLE_TOP_M + 0.4), ["book on the table"]),
        ((0.0, 0.0, 0.0), ["book on the table"]),
        ((3.0, 0.0, TABLE_TOP_M), ["book on the table"]),
    ],
    ids=["rests", "floats", "below", "beside"],
)
def test_what_is_on_something_rests_on_it(place, reported) -> None:
    assert unrelated("on", body(0, "book", at(*place)), body(1, "table", at())) == reported


def test_nobody_is_on_a_telephone() -> None:
    bodies = body(0, "woman", at()), body(1, "cell phone", at())
    assert unrelated("on", *bodies) == ["woman on the cell phone"]


def test_what_is_in_something_fits_into_it() -> None:
    basket = body(1, "basket", at())
    rim = part_boxes(basket, 0.0).hull[1][2]
    assert unrelated("in", body(0, "apple", at(z=0.5 * rim)), basket) == []
    assert unrelated("in", body(0, "apple", at(z=0.5 * rim), 9.0), basket) == [
        "apple in the basket"
    ]
    assert unrelated("in", body(0, "apple", at(z=2.0 * rim)), basket) == ["apple in the basket"]


def test_what_works_carries_what_is_on_it() -> None:
    belt = body(1, "conveyor belt", at())
    top = part_boxes(belt, 0.0).hull[1][2]
    still, moving = at(z=top), Straight((0.0, 0.0, top), 0.0, 0.1, 1.0)
    assert unrelated("on", body(0, "bottle", moving), belt) == []
    assert unrelated("on", body(0, "bottle", still), belt) == ["bottle on the conveyor belt"]


def test_what_is_held_is_at_the_hand() -> None:
    person = body(0, "person", at())
    hand = person.anchor("right hand", 0.0)[:, 3]
    assert unrelated("hold", person, body(1, "cup", at(*hand))) == []
    assert unrelated("hold", person, body(1, "cup", at(2.0))) == ["person holding the cup"]


def test_what_is_kicked_is_met_and_flies_on() -> None:
    person = body(0, "person", at())
    passing = Straight((0.0, 0.3, 0.0), 0.0, 4.0, 1.0)
    assert unrelated("kick", person, body(1, "football", passing)) == []
    assert unrelated("kick", person, body(1, "football", at(0.2))) == [
        "person kicking the football"
    ]
    far = Straight((0.0, 9.0, 0.0), 0.0, 4.0, 1.0)
    assert unrelated("kick", person, body(1, "football", far)) == ["person kicking the football"]


def test_between_copies_there_are_some_to_both_sides() -> None:
    car = body(0, "car", going(0.0))
    north, south = body(1, "car", at(0.0, 4.0)), body(1, "car", at(0.0, -4.0))
    assert unrelated("between", car, north, south) == []
    assert unrelated("between", car, north, body(1, "car", at(6.0, 4.5))) == ["between the cars"]


@pytest.mark.parametrize(
    ("direction", "yaw", "is_shown"),
    [
        ("right", 0.0, True),
        ("left", 0.0, False),
        ("away", 0.5 * np.pi, True),
        ("towards", 0.5 * np.pi, False),
    ],
)
def test_directions_are_those_of_the_image(direction, yaw, is_shown) -> None:
    found = unmoved([body(0, "car", going(yaw))], ObjectMotion("drive", direction))
    words = {"towards": "towards the camera"}.get(direction, direction)
    assert found == ([] if is_shown else [f"car drives {words}"])


def test_who_is_said_to_walk_and_stays_is_reported() -> None:
    assert unmoved([body(0, "dog", at())], ObjectMotion("walk")) == ["dog walks"]


def test_who_stops_comes_to_rest() -> None:
    motions = ObjectMotion("walk"), ObjectMotion("stand")
    assert unmoved([body(0, "dog", going(0.0))], *motions) == ["dog stands still"]


def test_a_turn_changes_the_heading() -> None:
    assert unmoved([body(0, "car", going(0.0))], ObjectMotion("turn", "left")) == ["car turns left"]


def test_what_rises_rises() -> None:
    up = Straight((0.0, 0.0, 1.0), 0.0, 0.5, 1.0, climb=2.0)
    assert unmoved([body(0, "balloon", up)], ObjectMotion("rise")) == []
    assert unmoved([body(0, "balloon", at(z=1.0))], ObjectMotion("rise")) == ["balloon rises"]


def test_who_crosses_a_road_goes_over_its_middle() -> None:
    across = ObjectMotion("walk", "across")
    along_y = going(0.5 * np.pi, 6.0)
    person = body(0, "person", along_y)
    assert unmoved([person], across, place="city", road=RoadLine()) == []
    short = body(0, "person", going(0.5 * np.pi, 1.0))
    found = unmoved([short], across, place="city", road=RoadLine())
    assert found == ["person walks across the road"]


def test_what_drives_is_on_the_ground_or_on_something() -> None:
    high = Straight((0.0, 0.0, 5.0), 0.0, 2.0, 1.0)
    assert unmoved([body(0, "car", high)], ObjectMotion("drive")) == ["car on the ground"]
    bridge = body(1, "box", Straight((0.0, 0.0, 5.0), 0.0, 2.0, 1.0))
    assert unmoved([body(0, "car", high), bridge], ObjectMotion("drive")) == []
    person = body(0, "person", at())
    assert unmoved([person], ObjectMotion("stand"), place="sea") == ["person on the ground"]


@pytest.mark.parametrize("kind", ["pan", "tilt", "zoom", "dolly", "truck", "pedestal", "crane"])
def test_moves_of_the_camera_are_made(kind) -> None:
    directions = {"zoom": "in", "dolly": "out", "tilt": "up", "pedestal": "up", "crane": "down"}
    shot = Shot((CameraMove(kind, directions.get(kind, "left")),))
    path = replace(CAMERA, moves=shot.moves)
    assert list_moves_not_shown(shot, path, DURATION_S) == []
    words = f"camera {kind} {directions.get(kind, 'left')}"
    assert [one.text for one in list_moves_not_shown(shot, CAMERA, DURATION_S)] == [words]
    other = {"in": "out", "out": "in", "up": "down", "down": "up"}
    turned = (CameraMove(kind, other.get(directions.get(kind, ""), "right")),)
    found = list_moves_not_shown(shot, replace(CAMERA, moves=turned), DURATION_S)
    assert [one.text for one in found] == [words]


def test_boxes_of_parts_hold_their_shapes() -> None:
    """A unit box, turned by 45°, is as wide as its diagonal; two boxes 3 m apart have that gap."""
    half = np.sqrt(0.5)
    turned = np.array([[half, -half, 0.0, 5.0], [half, half, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]])
    part = (
        NOUNS["cube"].build(colour=None, scale=1.0, seed=0).parts(body(0, "cube", at()).pose(0.0))
    )
    unit = replace(part[0], to_body=np.eye(3, 4))
    boxes = boxes_of([unit], turned)
    assert boxes.high[0] == pytest.approx([5.0 + 2.0 * half, 2.0 * half, 1.0])
    shifted = boxes_of(
        [unit], turned + np.array([[0.0, 0.0, 0.0, 3.0 + 4.0 * half]] + [[0.0] * 4] * 2)
    )
    assert gap(boxes, shifted) == pytest.approx(3.0)


def test_every_relation_that_the_reader_makes_is_measured() -> None:
    kinds = {*RELATIONS, *WEAK_PREPOSITIONS.values(), *ACTS, "at", "with", "follow", "overtake"}
    kinds |= {one for verb in VERBS for one in (verb.relation, verb.act) if one}
    assert kinds <= CHECKS.keys()
    assert {*PREPOSITION_WAYS.values(), APART, LED} == set(WAYS)


@pytest.mark.parametrize(
    ("way", "first", "last", "is_there"),
    [
        ("into", (-2.0, 0.0, 0.0), (0.0, 0.0, 0.1), True),
        ("into", (0.0, 0.0, 0.1), (0.0, 0.0, 0.1), False),
        ("out of", (0.0, 0.0, 0.1), (-2.0, 0.0, 0.0), True),
        ("out of", (-0.6, 0.0, 0.0), (-2.0, 0.0, 0.0), False),
        ("against", (-0.3, 0.0, 0.0), (-0.3, 0.0, 0.0), True),
        ("against", (-1.5, 0.0, 0.0), (-1.5, 0.0, 0.0), False),
        ("across", (-0.5, 0.0, 0.0), (0.5, 0.0, 0.0), True),
        ("across", (0.0, 0.0, 0.0), (0.1, 0.0, 0.0), False),
    ],
)
def test_ways_are_measured_at_start_and_end(way, first, last, is_there) -> None:
    start, end = np.array(first), np.array(last)

    class Line:
        def at(self, time_s: float) -> BodyState:
            x, y, z = start + (end - start) * time_s / DURATION_S
            return BodyState((float(x), float(y), float(z)), 0.0)

    ball = replace(body(0, "apple", at()), trajectory=Line(), is_mover=True)
    subject, target = (
        measure([one], np.linspace(0.0, DURATION_S, 13)) for one in (ball, body(1, "box", at()))
    )
    assert WAYS[way](subject, [target]) == is_there


def test_that_something_rests_is_missed_only_where_a_word_says_so() -> None:
    assert unmoved([body(0, "dog", going(0.0))], ObjectMotion("stand")) == []
