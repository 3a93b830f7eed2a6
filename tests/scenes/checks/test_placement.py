"""Bodies stand on something, in no other body, and where their kind may, or the report says so."""

import numpy as np
import pytest
from tests.scenes.staged import DURATION_S, moved, road_of, stage, stage_text, thing

from texvent_scenes.checks.surroundings.placement import find_misplaced
from texvent_scenes.description import SceneDescription
from texvent_scenes.models import shapes
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.spec.scene import Place

TIMES_S = np.linspace(0.0, DURATION_S, 7)


def faults(said, scene):
    found = find_misplaced(said, scene.place, scene.environment(0.0), scene.actors, TIMES_S)
    return [one.line for one in found if one.line]


def across(scene, noun):
    """[n] metres from the line of the road or shore to the corners of a body over the clip."""
    body = next(one for one in scene.actors if one.noun.name == noun)
    return road_of(scene)[0].across(np.vstack([body.corners(t)[:, :2] for t in TIMES_S]))


@pytest.mark.parametrize(
    ("text", "noun"),
    [("a robot arm above a conveyor belt", "robot arm"), ("a metronome above a piano", "metronome"),
     ("a horse above a house", "horse")],
)  # fmt: skip
def test_what_neither_flies_nor_stands_on_something_is_named(text, noun):
    said, scene = stage_text(text)
    if not any(one.kind == "above" for one in said.relations):  # refused by the reader
        assert "above" in {one.word for one in said.claims}
        return
    assert faults(said, scene) == [f"the {noun} above the ground with nothing below it"]


@pytest.mark.parametrize(
    "text",
    ["a drone hovers above a car", "a cat walks across a table", "a man rides a horse",
     "a cyclist rides past a parked van", "a bus passes a row of parked cars",
     "a boy jumps", "a kite flies over a beach", "a ball falls onto a table",
     "two boxes on a shelf", "a woman sits on a bench next to a tree", "a bird lands on a fence",
     "a train in a tunnel", "a man carries a box past a dog", "a boat on a lake",
     "a person does a handstand", "a car drives on a road", "a book on a desk in an office",
     "a balloon rises", "three dogs run"],
)  # fmt: skip
def test_what_stands_flies_or_is_held_has_no_fault(text):
    assert faults(*stage_text(text)) == []


@pytest.mark.parametrize(
    ("shift", "line"),
    [((0.0, 0.0, -0.5), "the dog partly under the ground"),
     ((0.0, 0.0, 1.0), "the dog above the ground with nothing below it"),
     ((0.0, 0.0, 0.0), None)],
)  # fmt: skip
def test_a_body_that_is_lifted_hangs_and_one_that_is_lowered_sinks(shift, line):
    dog = thing("dog", ("stand",))
    scene = stage(dog)
    said = SceneDescription(objects=(dog,), place=Place("grass", is_empty=True))
    assert faults(said, moved(scene, scene.actors[0], shift)) == ([line] if line else [])


@pytest.mark.parametrize("apart_m", [0.0, 3.0])
def test_bodies_in_the_same_place_go_through_each_other(apart_m):
    objects = thing("man", ("stand",)), thing("barrel", ("stand",))
    scene = stage(*objects)
    man, barrel = scene.actors
    away = np.add(np.subtract(man.track.start, barrel.track.start), (apart_m, 0.0, 0.0))
    said = SceneDescription(objects=objects, place=Place("grass", is_empty=True))
    lines = ["the man and the barrel apart: one goes through the other"]
    assert faults(said, moved(scene, barrel, away)) == ([] if apart_m else lines)


@pytest.mark.parametrize("noun", ["drone", "bird", "airplane", "balloon", "butterfly", "kite"])
@pytest.mark.parametrize("way", ["up", "down"])
def test_nothing_flies_below_the_ground(noun, way):
    (one,) = stage(thing(noun, ("fly", way))).actors
    assert min(one.lowest_m(t) for t in np.linspace(0.0, DURATION_S, 9)) > -0.61


@pytest.mark.parametrize(
    ("text", "vehicle", "other"),
    [("a bench next to a parked car on a street", "car", "bench"),
     ("a man stands in front of a van on a road", "van", "man"),
     ("a dog sits behind a parked truck", "truck", "dog")],
)  # fmt: skip
def test_a_vehicle_at_rest_stands_at_the_edge_of_its_road_and_others_beside_it(
    text, vehicle, other
):
    said, scene = stage_text(text)
    half_m = road_of(scene)[1]
    assert half_m - 0.5 < np.abs(across(scene, vehicle)).max() < half_m + 0.05
    assert np.abs(across(scene, other)).min() >= half_m - 0.05
    assert faults(said, scene) == []


@pytest.mark.parametrize(
    ("text", "noun"),
    [("a man crosses the street towards a bus stop", "bus stop"),
     ("a woman crosses a road next to a bench", "bench"),
     ("a dog crosses the road near a mailbox", "mailbox")],
)  # fmt: skip
def test_who_crosses_does_so_over_the_road_and_what_stands_by_is_beside_it(text, noun):
    said, scene = stage_text(text)
    assert np.abs(across(scene, noun)).min() >= road_of(scene)[1] - 0.05
    assert faults(said, scene) == []


@pytest.mark.parametrize(
    ("text", "dry", "wet"),
    [("a man stands by a lake with ducks", "man", "duck"),
     ("a girl and three swans at a pond", "girl", "swan"),
     ("a man sits on a bench by a lake while a duck swims", "bench", "duck"),
     ("a dog walks along a river, a boat passes", "dog", "boat")],
)  # fmt: skip
def test_those_on_foot_stand_ashore_of_what_floats(text, dry, wet):
    said, scene = stage_text(text)
    half_m = road_of(scene)[1] if said.place.name in ("river", "pond") else 0.0
    own = across(scene, dry)
    assert max(own) < -half_m + 0.05 or (said.place.name == "pond" and min(own) > half_m - 0.05)
    assert np.median(across(scene, wet)) > -half_m
    assert faults(said, scene) == []
    if half_m == 0.0:  # the shore is halfway between the nearest of both
        line = road_of(scene)[0]
        places = [
            [float(line.across(one.middle(0.0)[None, :2])[0]) for one in scene.actors
             if one.noun.name == noun] for noun in (dry, wet)
        ]  # fmt: skip
        assert max(places[0]) + min(places[1]) == pytest.approx(0.0, abs=0.05)


@pytest.mark.parametrize(
    ("text", "noun", "top"),
    [("a cat walks across a table", "cat", "table"),
     ("a toy car rolls across a desk", "toy car", "desk"),
     ("a ball rolls on a table", "ball", "table")],
)  # fmt: skip
def test_what_goes_along_a_table_stays_on_it(text, noun, top):
    _, scene = stage_text(text)
    bodies = {one.noun.name: one for one in scene.actors}
    table = bodies[top].corners(0.0)
    middles = np.array([bodies[noun].middle(t)[:2] for t in TIMES_S])
    assert (middles > table[:, :2].min(axis=0)).all()
    assert (middles < table[:, :2].max(axis=0)).all()
    assert np.ptp(middles, axis=0).max() > 0.3


@pytest.mark.parametrize(
    ("text", "is_laid"),
    [("a domino falls over", True), ("a chair falls over", True),
     ("a bottle lies on a table", True),
     ("a dog lies on a rug", True), ("a man lies on a bench", True), ("a ball lies on grass", True),
     ("a child falls over", True), ("a bicycle lies on the grass", False),
     ("a car lies on the road", False), ("a motorcycle falls over", True)],
)  # fmt: skip
def test_what_lies_or_falls_over_is_on_its_side_in_the_end_or_it_is_said(text, is_laid):
    said, scene = stage_text(text)
    found = find_misplaced(said, scene.place, scene.environment(0.0), scene.actors, TIMES_S)
    assert is_laid == (not any(one.kind == "motion" for one in found))


@pytest.mark.parametrize("noun", sorted(nouns_with("hangs from a ceiling")))
def test_what_hangs_from_a_ceiling_is_above_heads_and_on_a_cord_up_to_it(noun):
    scene = stage(thing(noun, ("stand",)), place="indoor")
    (one,) = (each for each in scene.actors if each.noun.name == noun)
    assert one.lowest_m(0.0) > 1.85
    ceiling_m = scene.animated_environment.base.ceiling_m
    cords = [shapes.moved(hung.parts, hung.to_world) for hung, _ in scene.threads]
    assert max(float(shapes.bounds(each)[1][2]) for each in cords) == pytest.approx(
        ceiling_m, abs=0.01
    )
