"""Places and effects that a small picture shows, and those that the report names as not shown."""

from dataclasses import replace

import pytest
from tests.scenes.every_row import for_every
from tests.scenes.staged import DURATION_S, SIZE, stage_text

from texvent_scenes.checks.pictures import find_unshown
from texvent_scenes.description import SceneDescription
from texvent_scenes.models.effects import EFFECTS
from texvent_scenes.models.places import PLACES
from texvent_scenes.spec.scene import Effect, Place
from texvent_scenes.staging.actors import assemble
from texvent_scenes.staging.compose import compose_scene

TIMES_S = [0.2 * DURATION_S, 0.8 * DURATION_S]
ROOMS = [name for name, one in PLACES.items() if one.is_room and one.scenery]
TELLING = ("indoor", "corridor", "cave", "throne room")
"""Rooms that bare walls tell."""
SMALL = ("bowling alley",)
"""Rooms told by their smallest things alone: pins."""


def lost(said, scene):
    return [one.kind for one in find_unshown(scene, said, TIMES_S)]


@for_every(ROOMS)
def test_a_room_is_shown_with_its_furniture_and_not_by_bare_walls(room):
    said, scene = stage_text(f"a man stands in a {PLACES[room].names[0]}")
    assert said.place.name == room
    assert ("place" in lost(said, scene)) == (room in SMALL)
    if room not in TELLING:
        assert "place" in lost(said, replace(scene, still=assemble([]), scenery=()))


BARE = ("bedroom", "factory", *SMALL)
"""Rooms whose furniture is too large for a picture of a cat: the report says so."""


@for_every([one for one in ROOMS if one not in BARE])
def test_a_camera_near_a_small_thing_sees_what_stands_at_the_wall_of_a_room_that_is_said(room):
    said, scene = stage_text(f"close-up of a cat in a {PLACES[room].names[0]}")
    assert "place" not in lost(said, scene)


@for_every([name for name, one in EFFECTS.items() if one.nouns])
def test_an_effect_by_itself_is_seen(kind):
    said = SceneDescription(effects=(Effect(kind),), place=Place("grass", is_empty=True))
    scene = compose_scene(said, seed=0, size=SIZE, duration_s=DURATION_S)
    assert "effect" not in lost(said, scene)


@pytest.mark.parametrize(
    "text",
    ["steam rises from a pot on a table", "smoke rises from a chimney", "a kettle steams",
     "a truck drives along a dirt road and kicks up dust", "a man walks in the rain"],
)  # fmt: skip
def test_soft_things_are_in_view_and_seen_and_faint_ones_are_named(text):
    said, scene = stage_text(text)
    assert not {"effect", "weather"} & {*lost(said, scene)}
    faint = tuple(
        replace(one, style=replace(one.style, thickness=(0.02, 0.0)))
        for one in scene.particles.effects
    )
    scene = replace(scene, particles=replace(scene.particles, effects=faint))
    assert {"effect", "weather"} & {*lost(said, scene)}
