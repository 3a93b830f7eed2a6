"""Stated distances between things on a table, a bench, a belt or a shelf hold, or are refused."""

import itertools

import numpy as np
import pytest
from tests.scenes.every_row import for_every
from tests.scenes.staged import place

from texvent.errors import ConfigError
from texvent_scenes.spec.data import SPACED
from texvent_scenes.spec.scene import Motion, Relation, SceneObject

WAYS = {"left of": (-1, 0), "right of": (1, 0), "beside": (1, 0), "front": (0, -1),
        "behind": (0, 1)}  # fmt: skip
SUPPORTS = [("table", "mug", "bottle"), ("workbench", "led", "cup"), ("bench", "man", "woman"),
            ("conveyor belt", "box", "box"), ("shelf", "book", "vase"), ("desk", "laptop", "lamp"),
            ("sofa", "cat", "pillow")]  # fmt: skip


def place_by_id(*objects):
    names = [one.id or one.noun for one in objects]
    return {names[one.object_index]: one for one in place(*objects)}


def put(support, first, second, relation, distance_m, *, is_turned=False, order=(0, 1, 2)):
    """A support with two things on it, at a distance, in any order of the three."""
    on = Relation("on", (support,))
    related = Relation(relation, ("one",), distance_m)
    relations = (related, on) if is_turned else (on, related)
    objects = (SceneObject(support), SceneObject(first, id="one", relations=(on,)),
               SceneObject(second, id="other", relations=relations))  # fmt: skip
    return [objects[n] for n in order]


def try_to_place(*objects):
    """The actors, or the text of the refusal."""
    try:
        return place_by_id(*objects), ""
    except ConfigError as error:
        return {}, str(error)


ORDERS = [*itertools.permutations(range(3))]


@for_every(itertools.product(SUPPORTS, SPACED, (0.55, 0.75), ORDERS, (False, True)))
def test_things_on_a_support_are_as_far_apart_as_said_or_refused(row):
    (support, *things), relation, distance_m, order, is_turned = row
    objects = put(support, *things, relation, distance_m, is_turned=is_turned, order=order)
    placed, refusal = try_to_place(*objects)
    if refusal:
        is_long = support == "shelf" and distance_m > 0.6
        assert relation in ("front", "behind") or is_long
        assert f"distance_m is {distance_m:g}, which cannot be kept" in refusal
        return
    for time_s in (0.0, 1.0, 2.0):
        first, second = (placed[one].track.at(time_s).position for one in ("one", "other"))
        off = np.subtract(second, first)[:2]
        way = WAYS[relation]
        sidewards = abs(float(np.hypot(*off)) - distance_m)
        assert sidewards < (0.02 if "man" in things else 1e-6)
        assert off @ way > 0.5 * distance_m


@for_every(itertools.product(("mug", "box", "cat"), (0.4, 0.6, 0.9), (1, -1)))
def test_chains_of_distances_hold_on_a_table_and_the_whole_stays_on_it(row):
    noun, whole_m, step = row
    on = Relation("on", ("table",))
    kind = "right of" if step > 0 else "left of"
    things = [SceneObject(noun, id="0", size=0.5, relations=(on,))] + [
        SceneObject(noun, id=str(n), size=0.5,
                    relations=(on, Relation(kind, (str(n - 1),), whole_m / 3)))
        for n in range(1, 4)
    ]  # fmt: skip
    placed, refusal = try_to_place(SceneObject("table", size=1.4), *things)
    if refusal:
        assert "go through each other" in refusal or "are needed" in refusal
        return
    places = np.array([placed[str(n)].track.at(0.0).position for n in range(4)])
    np.testing.assert_allclose(np.hypot(*np.diff(places[:, :2], axis=0).T), whole_m / 3, atol=1e-6)
    middle = np.array(placed["table"].track.at(0.0).position)
    assert np.hypot(*(places[:, :2] - middle[:2]).T).max() < 0.5 * placed["table"].model.width + 0.1


@for_every(itertools.product(("mug", "laptop", "vase"), ("left of", "right of"), ORDERS))
def test_who_stands_beside_what_is_on_a_table_is_as_far_from_it_as_said(row):
    noun, relation, order = row
    objects = [
        SceneObject("table"),
        SceneObject(noun, id="one", relations=(Relation("on", ("table",)),)),
        SceneObject("man", id="other", motions=(Motion("stand"),),
                    relations=(Relation(relation, ("one",), 1.8),)),
    ]  # fmt: skip
    placed = place_by_id(*(objects[n] for n in order))
    first, second = (placed[one].track.at(1.0).position for one in ("one", "other"))
    off = np.subtract(second, first)[:2]
    np.testing.assert_allclose(off, 1.8 * np.array(WAYS[relation]), atol=1e-6)


@for_every(itertools.product(SUPPORTS, ("left of", "right of"), ORDERS))
def test_a_distance_for_which_there_is_no_room_is_refused(row):
    (support, *things), relation, order = row
    with pytest.raises(ConfigError, match=r"^objects\[\d\]\.relations\[1\]\.distance_m is 5, "):
        place(*put(support, *things, relation, 5.0, order=order))


COPIED = ("bottle", "mug", "book", "plate", "candle")


@for_every(itertools.product(COPIED, (1, 2, 3), (0.25, 0.4, 0.6), SPACED, (False, True)))
def test_nothing_is_put_into_a_row_of_copies(row):
    noun, count, distance_m, kind, is_row_last = row
    on = Relation("on", ("table",))
    first = SceneObject("mug", id="one", relations=(on,))
    second = SceneObject(noun, relations=(on, Relation(kind, ("one",), distance_m)), count=count)
    if not is_row_last:
        first = SceneObject(noun, id="one", relations=(on,), count=count)
        second = SceneObject("mug", relations=(on, Relation(kind, ("one",), distance_m)))
    try:
        actors = [one for one in place(SceneObject("table"), first, second) if one.object_index]
    except ConfigError:
        return
    assert len(actors) == count + 1
    for one, other in itertools.combinations(actors, 2):
        apart = np.subtract(one.track.at(0.0).position, other.track.at(0.0).position)
        radii = [0.5 * min(each.model.length, each.model.width) for each in (one, other)]
        assert float(np.hypot(*apart[:2])) > sum(radii) - 1e-6


@for_every(itertools.product(SUPPORTS, (1, 2, 4), (30.0, 90.0, 205.0)))
def test_what_is_on_a_support_turns_with_it(row):
    (support, noun, _), count, heading_deg = row
    on = Relation("on", (support,))
    found = []
    for turn in (0.0, heading_deg):
        below, *things = place(SceneObject(support, position_m=(0.0, 0.0), heading_deg=turn),
                               SceneObject(noun, count=count, relations=(on,)))  # fmt: skip
        to_world = below.track.at(0.0).to_world()
        places = np.array([one.track.at(0.0).position for one in things])
        found.append((places - to_world[:, 3]) @ to_world[:, :3])
    np.testing.assert_allclose(*found, atol=1e-6)
