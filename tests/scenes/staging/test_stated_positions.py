"""Stated positions and distances hold together at time 0, whoever is placed first."""

import itertools

import numpy as np
import pytest
from tests.scenes.every_row import for_every
from tests.scenes.staging.test_distances_on_supports import WAYS, place_by_id, try_to_place

from texvent.errors import ConfigError
from texvent_scenes.spec.scene import Motion, Relation, SceneObject

BELT = (Motion("work", "left", speed_m_s=0.2, start_s=0.4), Motion("stand", start_s=1.6))
SPIN = (Motion("spin", "clockwise", rate_hz=0.25),)
LATE = (Motion("stand"), Motion("spin", "clockwise", rate_hz=0.25, start_s=0.5))
CART = (Motion("stand"), Motion("drive", "right", speed_m_s=1.0, start_s=0.5))
SUPPORTS = [
    ("table", (), "mug", "bottle"), ("workbench", (), "led", "cup"),
    ("desk", (), "laptop", "mug"), ("shelf", (), "book", "vase"),
    ("conveyor belt", BELT, "box", "bottle"), ("conveyor belt", (), "box", "box"),
    ("turntable", SPIN, "cup", "cup"), ("turntable", LATE, "mug", "cup"),
    ("mobile robot", CART, "bottle", "bottle"),
]  # fmt: skip
MIDDLE = np.array([1.0, 2.0])


def start(actor):
    return np.array(actor.track.at(0.0).position[:2])


def put(support, motions, things, relation, distance_m, order):
    """A support at a place, a thing at a position on it, another one at a distance from that."""
    on = Relation("on", ("below",))
    objects = (
        SceneObject(support, id="below", motions=motions, position_m=tuple(MIDDLE)),
        SceneObject(things[0], id="one", size=0.4, relations=(on,), position_m=(1.02, 2.0)),
        SceneObject(things[1], id="other", size=0.4,
                    relations=(on, Relation(relation, ("one",), distance_m))),
    )  # fmt: skip
    return [objects[n] for n in order]


@for_every(itertools.product(SUPPORTS, WAYS, (0.09, 0.3), itertools.permutations(range(3))))
def test_positions_and_distances_on_a_support_agree_at_time_0_and_go_with_it(row):
    (support, motions, *things), relation, distance_m, order = row
    placed, refusal = try_to_place(*put(support, motions, things, relation, distance_m, order))
    if refusal:
        assert "cannot be kept" in refusal or "is beside the" in refusal
        is_long = relation in ("front", "behind") or support in ("turntable", "mobile robot")
        assert is_long if distance_m > 0.1 else "go through each other" in refusal
        return
    np.testing.assert_allclose(start(placed["one"]), (1.02, 2.0), atol=1e-6)
    apart = start(placed["other"]) - start(placed["one"])
    np.testing.assert_allclose(apart, distance_m * np.array(WAYS[relation]), atol=1e-6)
    ways = []
    for name in ("one", "other"):  # they stay where they are on it, or go as the belt does
        frames = [placed["below"].track.at(t).to_world() for t in (0.0, 2.0)]
        place = np.append(placed[name].track.at(0.0).position, 1.0)
        own = np.linalg.solve(np.vstack([frames[0], [0, 0, 0, 1]]), place)
        ways.append(np.array(placed[name].track.at(2.0).position[:2]) - (frames[1] @ own)[:2])
    np.testing.assert_allclose(*ways, atol=1e-6)
    if support != "conveyor belt" or motions:
        np.testing.assert_allclose(ways[0], (-0.24 if motions == BELT else 0.0, 0.0), atol=1e-3)


@for_every(itertools.product(SUPPORTS, itertools.permutations(range(3)), (True, False)))
def test_a_position_beside_what_a_thing_is_on_is_refused(row):
    (support, motions, *things), order, is_far = row
    on = Relation("on", ("below",))
    x = 4.0 if is_far else 1.0
    objects = (SceneObject(support, id="below", motions=motions, position_m=tuple(MIDDLE)),
               SceneObject(things[0], id="one", relations=(on,), position_m=(x, 2.0)),
               SceneObject(things[1], id="other", size=0.4, position_m=(9.0, 9.0)))  # fmt: skip
    objects = [objects[n] for n in order]
    if is_far:
        with pytest.raises(ConfigError, match=r"^objects\[\d\]\.position_m is \[4, 2\], which is "):
            place_by_id(*objects)
    else:
        np.testing.assert_allclose(start(place_by_id(*objects)["one"]), (x, 2.0), atol=1e-6)


@for_every(itertools.product(SUPPORTS, itertools.permutations(range(2)), (2, 3)))
def test_a_support_of_no_place_is_below_the_positions_of_what_is_on_it(row):
    (support, motions, *things), order, count = row
    places = [(3.0, 1.0), (3.05, 1.0)][: count - 1]
    on = Relation("on", ("below",))
    borne = [SceneObject(thing, id=str(n), size=0.4, relations=(on,), position_m=places[n])
             for n, thing in enumerate(things[: count - 1])]  # fmt: skip
    objects = [SceneObject(support, id="below", motions=motions), *borne]
    placed = place_by_id(*(objects if order == (0, 1) else objects[::-1]))
    for n, said in enumerate(places):
        np.testing.assert_allclose(start(placed[str(n)]), said, atol=1e-6)


GOERS = [("car", "drive", 5.0), ("man", "walk", 1.2), ("dog", "run", 3.0), ("drone", "fly", 2.0),
         ("ball", "roll", 1.0), ("street lamp", "stand", None)]  # fmt: skip


@for_every(itertools.product(GOERS, GOERS, WAYS, ((0, 1), (1, 0)), (True, False)))
def test_distances_of_who_goes_hold_at_time_0(row):
    (one, kind, speed), (other, its_kind, its_speed), relation, order, is_stated = row

    def motions(kind, speed):
        return (Motion(kind, "right" if speed else None, speed_m_s=speed),)

    first = SceneObject(one, id="one", motions=motions(kind, speed),
                        position_m=(2.0, 5.0) if is_stated else None)  # fmt: skip
    second = SceneObject(other, id="other", motions=motions(its_kind, its_speed),
                         relations=(Relation(relation, ("one",), 6.0),))  # fmt: skip
    placed = place_by_id(*((first, second)[n] for n in order))
    apart = start(placed["other"]) - start(placed["one"])
    np.testing.assert_allclose(apart, 6.0 * np.array(WAYS[relation]), atol=1e-6)
    if is_stated:
        np.testing.assert_allclose(start(placed["one"]), (2.0, 5.0), atol=1e-6)


@for_every(itertools.product(("mug", "box", "man", "car"), ("table", None), (0.3, 0.5), WAYS))
def test_two_positions_that_contradict_a_distance_are_refused(row):
    noun, support, distance_m, relation = row
    on = (Relation("on", ("table",)),) if support else ()
    apart = 0.5 * np.array(WAYS[relation])
    objects = (SceneObject("table", position_m=(0.0, 0.0), heading_deg=0.0),
               SceneObject(noun, id="one", size=0.5, position_m=(0.0, 0.0), relations=on),
               SceneObject(noun, id="other", size=0.5, position_m=tuple(apart),
                           relations=(*on, Relation(relation, ("one",), distance_m))))  # fmt: skip
    objects = objects if support else objects[1:]
    _, refusal = try_to_place(*objects)
    if distance_m == 0.5:
        assert "which is beside" in refusal or not refusal
        return
    assert "position_m" in refusal


@for_every(itertools.product(("table", "workbench", "desk"), ("mug", "book", "vase"), (-0.2, 0.3)))
def test_others_make_way_for_what_has_a_position(row):
    support, noun, x = row
    on = (Relation("on", ("below",)),)
    placed = place_by_id(SceneObject(support, id="below", position_m=(0.0, 0.0)),
                   SceneObject(noun, id="one", size=0.6, position_m=(x, 0.0), relations=on),
                   SceneObject(noun, id="other", size=0.6, relations=on))  # fmt: skip
    apart = np.linalg.norm(start(placed["one"]) - start(placed["other"]))
    assert apart > min(placed["one"].model.length, placed["one"].model.width)
