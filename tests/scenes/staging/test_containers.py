"""What is in something fits, lies between its sides and below its rim, or is not shown."""

import itertools

import numpy as np
import pytest
from tests.scenes.every_row import for_every
from tests.scenes.staged import DURATION_S, SIZE, moved, stage, stage_text, thing

from texvent_scenes.checks.clip.body_boxes import body_of
from texvent_scenes.checks.clip.relations import find_violations
from texvent_scenes.checks.in_view import find_unseen
from texvent_scenes.models.anchors import find_rim, has_rim
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.tables import nouns_with, trait_value, trait_values
from texvent_scenes.staging.placement.rims import fits

TIMES_S = np.linspace(0.0, DURATION_S, 7)


def lost_relations(said, scene):
    cameras = [scene.camera(time) for time in TIMES_S]
    copies = [
        [body_of(one, cameras, TIMES_S) for one in scene.actors if one.object_index == n]
        for n in range(len(said.objects))
    ]
    return [one.value for one in find_violations(said, copies) if one.kind == "relation"]


@pytest.mark.parametrize(
    "text",
    ["three apples in a bowl", "a cat in a basket", "five eggs in a bowl", "a teddy bear in a box",
     "a spoon in a cup", "a ball rolls in a box", "a fish swims in an aquarium",
     "a hamster runs in a cage", "a parrot sits in a cage", "a diver swims in an aquarium",
     "a woman and two fish swim in a fish tank", "a man sits in a cage", "a shark in a tank"],
)  # fmt: skip
def test_what_is_in_a_container_is_between_its_sides_and_below_its_rim_all_along(text):
    said, scene = stage_text(text)
    assert lost_relations(said, scene) == []
    *things, kept = scene.actors
    for one in things:
        for time in TIMES_S:
            low, high = (f(one.corners(time), axis=0) for f in (np.min, np.max))
            least, most = (f(kept.corners(time), axis=0) for f in (np.min, np.max))
            assert (0.5 * (low + high)[:2] > least[:2]).all()
            assert (high - low)[:2].max() <= 1.1 * (most - least)[:2].max()
            assert least[2] - 0.15 * (high - low)[2] <= low[2] < most[2]


@pytest.mark.parametrize("text", ["two apples in a bowl", "a cat in a box", "a dog in a cage"])
def test_a_thing_that_is_lifted_out_of_its_container_is_not_in_it(text):
    said, scene = stage_text(text)
    *things, kept = scene.actors
    for one in things:
        scene = moved(scene, one, (0.0, 0.0, 1.01 * kept.corners(0.0)[:, 2].max()))
    assert lost_relations(said, scene) == ["in"]


@pytest.mark.parametrize("text", ["a man in a cage", "a parrot in a cage", "a cat in an aquarium"])
def test_what_stands_out_of_a_cage_or_an_aquarium_is_not_in_it(text):
    said, scene = stage_text(text)
    one, kept = scene.actors
    raised = moved(scene, one, (0.0, 0.0, 0.9 * kept.corners(0.0)[:, 2].max()))
    assert lost_relations(said, scene) == []
    assert lost_relations(said, raised) == ["in"]


@pytest.mark.parametrize(
    ("text", "inner", "outer"),
    [("a goldfish swims in a bowl on a table", "fish bowl", "table"),
     ("a kitten sleeps in a basket on a sofa", "basket", "sofa"),
     ("a mouse runs in a box on a bench", "box", "bench")],
)  # fmt: skip
def test_what_one_is_in_is_on_what_is_said_next(text, inner, outer):
    said, scene = stage_text(text)
    who, kept, below = scene.actors
    assert [kept.noun.name, below.noun.name] == [inner, outer]
    assert lost_relations(said, scene) == []
    assert kept.corners(0.0)[:, 2].min() > 0.3 * below.corners(0.0)[:, 2].max()
    assert who.corners(0.0)[:, 2].min() > kept.corners(0.0)[:, 2].min()


@pytest.mark.parametrize(
    "text", ["an apple in a suitcase", "a cat in a barrel", "a fish in a bucket"]
)
def test_what_cannot_be_seen_in_its_container_is_not_shown(text):
    said, scene = stage_text(text)
    seen = find_unseen(scene, said, SIZE, DURATION_S)
    assert ("relation", "in") in {(one.kind, one.value) for one in seen.violations}


@pytest.mark.parametrize("text", ["a cat in a basket", "a fish in a bowl", "an apple in a glass"])
def test_a_size_that_makes_something_fit_is_told(text):
    assert any("of its usual size" in note for note in stage_text(text)[1].notes)


def test_containers_are_nouns_and_what_is_lidded_or_clear_is_one():
    known = trait_values("container").keys()
    assert known <= NOUNS.keys()
    assert nouns_with("lidded") | nouns_with("see-through") <= known
    assert set(trait_values("drawn open").values()) <= NOUNS.keys()


@for_every(
    [*itertools.product(sorted(filter(has_rim, NOUNS)), (("coin", "fall"), ("ball", "sink")))]
)
def test_what_comes_down_through_a_rim_stays_in_it_and_in_sight(row):
    """Most of what lies in a container is over its rim; else it goes on down below it."""
    into, (noun, kind) = row
    scene = stage(thing(noun, (kind,)), thing(into, ("stand",)), relations=(("into", 0, 1),))
    body, other = scene.actors[:2]
    rim = find_rim(into, other.model)
    if not fits(body.model, rim):
        return
    middle = other.track.at(0.0).to_world() @ [rim.x, 0.0, rim.height, 1.0]
    places = np.array([body.middle(time_s) for time_s in np.linspace(0.0, 2.0, 41)]) - middle
    assert np.hypot(*places[:, :2].T).max() < 1e-6 + rim.radius
    assert places[0, 2] > 0.5 * body.model.height + 0.19
    tall = (places[-1, 2] + 0.5 * body.model.height) / body.model.height
    is_container = trait_value("container", into) is not None
    assert tall == pytest.approx(0.6, abs=0.01) if is_container else tall <= 0.0


@pytest.mark.parametrize("place", ["", "kitchen", "living room"])
@pytest.mark.parametrize(("small", "into"), [("apple", "bowl"), ("egg", "basket"), ("cat", "box")])
def test_one_sees_into_a_container_from_above_wherever_it_is(small, into, place):
    pair = thing(small, ("stand",)), thing(into, ("stand",))
    scene = stage(*pair, relations=(("in", 0, 1),), place=place)
    assert scene.camera(0.0).rotation[2][2] < -0.5
