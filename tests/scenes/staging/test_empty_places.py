"""Empty places have no furniture, and the prompt of a file changes nothing of its scene."""

import itertools
from dataclasses import replace
from pathlib import Path

import pytest
from tests.scenes.every_row import for_every
from tests.scenes.staged import SIZE

from texvent_scenes import load_scene
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.places import PLACES
from texvent_scenes.scene_input import describe_scene, understand
from texvent_scenes.spec.scene import Light, Motion, Place, Relation, Scene, SceneObject
from texvent_scenes.staging.compose import compose_scene

EXAMPLES = sorted(Path("docs/examples/scenes").glob("*.toml"))
BOX = SceneObject("box", motions=(Motion("stand"),))
ROBOTS = (SceneObject("mobile robot", id="a", motions=(Motion("drive", "right"),)),
          SceneObject("mobile robot", id="b", relations=(Relation("follow", ("a",)),)))  # fmt: skip


def furnish(scene):
    said = describe_scene(scene, NOUNS)
    return compose_scene(said, seed=1, size=SIZE, duration_s=1.0).scenery


@for_every(sorted(PLACES))
def test_nothing_of_the_furniture_of_an_empty_place_is_left(place):
    left = furnish(Scene(objects=(BOX,), place=Place(place, is_empty=True)))
    assert all(one.rule.is_structure for one in left)


def test_most_places_have_furniture_that_empty_ones_lose():
    rooms = ("gym", "kitchen", "warehouse", "laboratory", "street", "park", "forest", "office")
    for place in (one for one in rooms if one in PLACES):
        assert furnish(Scene(objects=(BOX,), place=Place(place)))


@pytest.mark.parametrize("prompt", ["robots", "a dark room at night", "an empty street", "sky"])
def test_the_prompt_of_a_file_changes_nothing_of_its_scene(prompt):
    scenes = [load_scene(one) for one in EXAMPLES]
    scenes += [Scene(objects=ROBOTS, place=Place("warehouse"))]
    scenes += [Scene(objects=(BOX,), place=Place(place), light=Light(kind)) for place, kind in
               itertools.product(("office", "kitchen"), ("night", "lamp"))]  # fmt: skip
    for scene in scenes:
        with_it, without = (describe_scene(replace(scene, prompt=one), NOUNS)
                            for one in (prompt, ""))  # fmt: skip
        assert replace(with_it, prompt="") == without
        staged = [compose_scene(one, seed=0, size=SIZE, duration_s=1.0)
                  for one in (with_it, without)] if scene.objects == (BOX,) else []  # fmt: skip
        assert len({repr(one.environment(0.0)) for one in staged}) < 2


@pytest.mark.parametrize("prompt", [
    "leaves blow across an empty street", "a man waves in an office at night", "an empty room",
    "a woman runs in a dark gym", "a car drives on an empty road at night",
])  # fmt: skip
def test_the_file_of_a_sentence_has_its_scene(prompt):
    said = understand(prompt, NOUNS)
    own = Scene(**{one: getattr(said, one) for one in Scene.__dataclass_fields__})
    again = describe_scene(replace(own, prompt=""), NOUNS)
    assert (again.objects, again.place, again.light) == (said.objects, said.place, said.light)
