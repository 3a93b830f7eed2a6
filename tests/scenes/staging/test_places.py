"""Places: every one can be drawn, and what stands there keeps to its side of walls and water."""

from __future__ import annotations

import numpy as np
import pytest

from texvent.scenes.description import ObjectMotion, SceneDescription, SceneObject, Surroundings
from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.models.places import PLACES, is_room, place_names
from texvent.scenes.raycast.render import render
from texvent.scenes.scene import Ground
from texvent.scenes.staging.compose import ComposedScene, compose_scene
from texvent.scenes.staging.preparation import choose_levels
from texvent.scenes.staging.surroundings.scenery import under_snow
from texvent.sensor import SensorSize

SIZE = SensorSize(48, 36)


def scene_at(place: str, noun: str = "dog") -> ComposedScene:
    description = SceneDescription("x", (SceneObject(noun),), surroundings=Surroundings(place))
    return compose_scene(description, seed=1, size=SIZE, duration_s=1.0)


@pytest.mark.parametrize("place", PLACES)
def test_every_place_can_be_drawn(place):
    image = render(scene_at(place), 0.5, SIZE)
    assert np.isfinite(image).all()
    assert image.std() > 1.0


def test_a_name_belongs_to_one_place():
    names = [name for some in place_names().values() for name in some]
    assert len(names) == len(set(names))
    assert all(place_names().values())


def test_all_scenery_has_a_model():
    assert {one.noun for place in PLACES.values() for one in place.scenery} <= set(NOUNS)


@pytest.mark.parametrize("place", [one for one in PLACES if is_room(one) and one != "corridor"])
def test_furniture_stands_in_the_room(place):
    scene = scene_at(place)
    room = scene.environment(0.0).room_half_size
    assert (np.abs(scene.still.to_world[:, :2, 3]) <= room + 0.1).all()


def test_a_shore_keeps_scenery_dry_and_boats_afloat():
    for noun, is_wet in (("dog", False), ("boat", True)):
        scene = scene_at("lake", noun)
        environment = scene.environment(0.0)
        assert environment.ground is Ground.LAKE
        angle, origin = environment.road_angle, environment.road_offset
        normal = np.array([-np.sin(angle), np.cos(angle)])
        assert ((scene.still.to_world[:, :2, 3] - origin) @ normal < 1.0).all()
        assert bool((scene.actors[0].middle(0.0)[:2] - origin) @ normal > 0.0) == is_wet


def test_nothing_blooms_where_snow_lies():
    for place in ("park", "grass"):
        nouns = {rule.noun for rule in under_snow(PLACES[place].scenery)}
        assert nouns
        assert not {"flower", "tree", "bush"} & nouns


@pytest.mark.parametrize(
    ("place", "kind", "is_lifted"),
    [("underwater", "swim", True), ("underwater", "stand", False), ("sea", "swim", False)],
)
def test_who_swims_under_water_is_above_the_sea_bed(place, kind, *, is_lifted):
    description = SceneDescription("", (SceneObject("man", motion=ObjectMotion(kind)),))
    levels = choose_levels(PLACES[place], description, NOUNS)
    assert (levels.get("man", 0.0) > 0.0) is is_lifted
