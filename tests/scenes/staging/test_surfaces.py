"""Places, rooms and materials as the prompt says."""

from __future__ import annotations

import numpy as np
import pytest
from tests.scenes.sentences import parse_prompt
from texvent.scenes.language.vocabulary.objects import MATERIALS as WORDS
from texvent.scenes.language.vocabulary.scene import PLACES as PLACE_WORDS
from texvent.scenes.staging.surroundings.places import PLACES, is_room
from texvent.scenes.staging.surroundings.scenery.tables import SCENERY

from texvent.errors import InputError
from texvent.scenes.description import NamedColour, SceneDescription, SceneObject, Surroundings
from texvent.scenes.models.material_override import in_material
from texvent.scenes.models.materials import MATERIALS
from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.models.protocol import Pose
from texvent.scenes.raycast.render import render
from texvent.scenes.scene import Ground, Texture
from texvent.scenes.staging.compose import ComposedScene, compose_scene
from texvent.sensor import SensorSize

SIZE = SensorSize(48, 36)


def scene_at(place: str, noun: str = "dog", **more: object) -> ComposedScene:
    described = SceneObject(noun, **more)  # type: ignore[arg-type]
    description = SceneDescription(
        "x", objects=(described,), surroundings=Surroundings(place=place)
    )
    return compose_scene(description, seed=1, size=SIZE, duration_s=1.0)


@pytest.mark.parametrize("place", PLACES)
def test_every_place_can_be_drawn(place: str) -> None:
    image = render(scene_at(place), 0.5, SIZE)
    assert np.isfinite(image).all()
    assert image.std() > 1.0


def test_every_table_of_scenery_and_every_word_belongs_to_a_place() -> None:
    assert set(SCENERY) <= set(PLACES)
    assert set(PLACE_WORDS) <= set(PLACES)


def test_all_scenery_has_a_model() -> None:
    named = {rule.noun for rules in SCENERY.values() for rule in rules}
    assert named <= set(NOUNS)


@pytest.mark.parametrize(
    ("prompt", "mark"),
    [
        ("a man walks down a hallway", "corridor walls"),
        ("children run through a funfair", "ferris wheel"),
        ("a waiter walks through an outdoor cafe", "terrace table"),
        ("a woman walks through the departure hall", "check-in desk"),
        ("a car drives through a car wash", "car wash arch"),
        ("a boy stands in the driveway", "drive slab"),
        ("a man sits in the living room", "sofa"),
    ],
)
def test_a_place_holds_what_it_is_known_by(prompt: str, mark: str) -> None:
    scene = compose_scene(parse_prompt(prompt), seed=0, size=SIZE, duration_s=1.0)
    assert mark in scene.still_nouns


@pytest.mark.parametrize("place", [place for place in PLACES if is_room(place)])
def test_furniture_stands_in_the_room(place: str) -> None:
    scene = scene_at(place)
    room = scene.environment(0.0).room_half_size
    # The walls of a corridor meet the wall of the room at its end.
    is_furniture = np.array([not noun.endswith(" walls") for noun in scene.still_nouns])
    reach = np.abs(scene.still.to_world[is_furniture, :2, 3])
    assert (reach <= room + 0.1).all()


def test_a_shore_keeps_scenery_dry_and_boats_afloat() -> None:
    scene = scene_at("lake")
    environment = scene.environment(0.0)
    assert environment.ground is Ground.LAKE
    angle, (x, y) = environment.road_angle, environment.road_offset
    spots = scene.still.to_world[:, :2, 3]
    across = (spots[:, 1] - y) * np.cos(angle) - (spots[:, 0] - x) * np.sin(angle)
    assert (across < 1.0).all()
    boat = scene_at("lake", "boat")
    x, y, _ = boat.actors[0].middle(0.0)
    angle, (x0, y0) = boat.environment(0.0).road_angle, boat.environment(0.0).road_offset
    assert (y - y0) * np.cos(angle) - (x - x0) * np.sin(angle) > 0.0


def test_every_material_of_the_reader_is_known() -> None:
    assert set(WORDS) <= set(MATERIALS)


def test_an_object_is_made_of_what_is_said() -> None:
    usual = NOUNS["car"].build(colour=None, scale=1.0, seed=0)
    pose = Pose(0.0, 0.0, 0.0, "stand")
    parts = in_material(usual, "wood", None).parts(pose)
    assert {part.texture for part in parts if part.emission == 0.0} == {Texture.WOOD}
    painted = in_material(usual, "wood", (0.1, 0.2, 0.6)).parts(pose)
    colours = [part.colour for part in usual.parts(pose)]
    assert [part.colour for part in painted] == colours
    assert in_material(usual, None, None) is usual
    with pytest.raises(InputError, match="unknown material 'cheese'; known: wood"):
        in_material(usual, "cheese", None)


def test_a_material_reaches_the_scene() -> None:
    red = NamedColour("red", (0.5, 0.03, 0.02))
    scene = scene_at("plain", "cube", material="brick", colour=red)
    assert set(scene.primitives(0.0).texture[:1]) == {Texture.BRICK}
