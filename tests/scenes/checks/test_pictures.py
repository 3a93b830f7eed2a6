"""Places, effects and subjects at the edge: what a small picture shows, and what is named."""

from dataclasses import replace

import numpy as np
import pytest
from tests.scenes.every_row import for_every
from tests.scenes.staged import DURATION_S, SIZE, moved, stage_text

from texvent_scenes.checks.surroundings.edges import find_cut_subject, find_merged, list_covering
from texvent_scenes.checks.views.pictures import find_unshown
from texvent_scenes.description import IndexedRelation, SceneDescription
from texvent_scenes.models.effects import EFFECTS
from texvent_scenes.models.places import PLACES, list_telling
from texvent_scenes.raycast.render import render
from texvent_scenes.spec.scene import Effect, Place
from texvent_scenes.staging.actors import assemble
from texvent_scenes.staging.camera.framing import look_at
from texvent_scenes.staging.compose import compose_scene
from texvent_scenes.words import list_plurals

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


@for_every([one for one in ROOMS if one not in TELLING])
def test_a_line_on_a_room_says_what_of_it_is_in_view(room):
    said, scene = stage_text(f"a man stands in a {PLACES[room].names[0]}")
    kept = tuple(one for one in scene.scenery if one.rule.noun not in list_telling(room))
    bare = replace(scene, scenery=kept, still=assemble([one.place() for one in kept]))
    seen = {one.rule.noun for one in kept if any(one.share_of(scene.camera(t)) for t in TIMES_S)}
    for line in (
        one.line for one in find_unshown(bare, said, TIMES_S) if one.kind == "place" and one.line
    ):
        named = line.partition(" only ")[2].partition("walls")[0]
        assert {*filter(None, named.split(", "))} <= {list_plurals(one)[0] for one in seen}
        assert named or not any(
            one.share_of(scene.camera(t)) > 0.01 for one in kept for t in TIMES_S
        )


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


FIVE_S = [float(one) for one in np.linspace(0.0, DURATION_S, 5)]


@pytest.mark.parametrize(
    "text",
    ["a man walks on a street as the camera walks backward in front of him",
     "a dog runs along a beach while the camera moves backward in front of it",
     "the camera follows a cyclist along a road"],
)  # fmt: skip
def test_who_a_moving_camera_is_about_is_in_the_middle_or_named(text):
    said, scene = stage_text(text)
    cameras = [scene.camera(one) for one in FIVE_S]
    assert [*find_cut_subject(scene, said, cameras, FIVE_S, SIZE)] == []
    aside = 0.5 * scene.camera_path.framing.distance_m / scene.camera_path.framing.focal
    beside = [replace(one, position=one.position + aside * one.rotation[0]) for one in cameras]
    assert [*find_cut_subject(scene, said, beside, FIVE_S, SIZE)] == [0]


@pytest.mark.parametrize("noun", ["sheep", "cups", "cars"])
def test_copies_of_which_one_stands_before_the_other_are_counted_as_they_are_seen(noun):
    said, scene = stage_text(f"two {noun} stand")
    cameras = [scene.camera(one) for one in FIVE_S]
    assert [*find_merged(scene, said, cameras, FIVE_S, SIZE)] == []
    first, second = (one.track.start for one in scene.actors)
    away = 0.01 * cameras[0].rotation[2]
    merged = moved(scene, scene.actors[1], np.subtract(first, second) + away)
    assert [*find_merged(merged, said, cameras, FIVE_S, SIZE)] == [(0, 1)]


@pytest.mark.parametrize("noun", ["sheep", "cups", "cars"])
@pytest.mark.parametrize(("often", "told"), [(1, []), (2, []), (3, [(0, 1)]), (5, [(0, 1)])])
def test_copies_are_one_where_they_are_for_most_of_the_clip(noun, often, told):
    said, scene = stage_text(f"two {noun} stand")
    usual, first = scene.camera(0.0), scene.actors[0].middle(0.0)
    beside = 0.6 * scene.actors[0].size_m * usual.rotation[0]
    scene = moved(scene, scene.actors[1], first + beside - scene.actors[1].middle(0.0))
    along = look_at(first - 50.0 * beside, first, 20.0 * usual.focal)
    cameras = [along] * often + [usual] * (5 - often)
    assert [*find_merged(scene, said, cameras, FIVE_S, SIZE)] == told


@pytest.mark.parametrize(("points", "is_told"), [(60, False), (300, True)])
def test_what_stands_before_the_subject_and_takes_much_of_the_image_is_told(points, is_told):
    said, scene = stage_text("a cat and a wardrobe")
    camera = scene.camera(0.0)
    ahead = camera.position + 0.4 * scene.camera_path.framing.distance_m * camera.rotation[2]
    near = moved(scene, scene.actors[1], ahead - scene.actors[1].middle(0.0))
    seen = {1: [points] * 5, 2: [points] * 5}
    told = [*list_covering(near, said, seen, 1000, FIVE_S)]
    assert told == (["the wardrobe covers 30 % of the picture"] if is_told else [])
    for ends in ((0, (1,)), (1, (0,))):  # whichever of both a relation is said of
        tied = replace(said, relations=(IndexedRelation("behind", *ends),))
        assert [*list_covering(near, tied, seen, 1000, FIVE_S)] == []


@pytest.mark.parametrize(
    ("much", "usual"),
    [("heavy snow falls on a street", "snow falls on a street"),
     ("a horse runs in a dense fog", "a horse runs in a fog"),
     ("cars drive on a road in pouring rain", "cars drive on a road in the rain")],
)  # fmt: skip
def test_heavy_weather_is_more_than_the_usual_one_in_the_picture(much, usual):
    (said, scene), (_, other) = stage_text(much), stage_text(usual)
    assert said.place.weather_amount >= 2.0
    assert not {"weather", "weather_amount"} & {*lost(said, scene)}
    flying, sight = (
        [read(one) for one in (scene, other)]
        for read in (lambda one: sum(len(each.lives.draws) for each in one.particles.effects),
                     lambda one: one.animated_environment.base.fog_distance)
    )  # fmt: skip
    assert flying[0] >= 2.5 * flying[1]
    assert sight[0] <= 0.6 * sight[1]


@pytest.mark.parametrize(
    ("text", "is_mirrored"),
    [("a wet road at night with car headlights approaching", True),
     ("driving on a wet highway at night past street lamps", True),
     ("a rainy street at night with neon signs", None),
     ("a cat on a wet pavement at night", False)],
)  # fmt: skip
def test_a_ground_at_night_is_wet_by_the_lamps_that_it_mirrors(text, is_mirrored):
    said, scene = stage_text(text)
    assert is_mirrored is None or ("is_wet" in lost(said, scene)) is not is_mirrored
    base = scene.animated_environment.base
    dry = replace(scene.animated_environment, base=replace(base, wetness=0.0))
    wet, rest = (render(one, TIMES_S[0], SIZE, samples=1, shadows=False).astype(float)
                 for one in (scene, replace(scene, animated_environment=dry)))  # fmt: skip
    gains = (wet - rest).max(axis=-1) >= 20.0
    assert is_mirrored is False or gains.mean() >= 0.002


@pytest.mark.parametrize("noun", ["egg", "globe", "fan", "windmill"])
@pytest.mark.parametrize(
    "around", ["", " in the snow", " on a busy street as the camera pans left"]
)
def test_whether_rotation_shows_depends_on_nothing_before_or_around_the_body(noun, around):
    said, scene = stage_text(f"a {noun} spins{around}")
    camera, (_, hiding) = scene.camera(0.0), stage_text("a cat and a wardrobe")
    ahead = camera.position + 0.4 * scene.camera_path.framing.distance_m * camera.rotation[2]
    near = moved(hiding, hiding.actors[1], ahead - hiding.actors[1].middle(0.0)).actors[1]
    hidden = replace(scene, still=assemble([near.place(0.0)]))
    told = ["turning" in one.line for one in find_unshown(scene, said, TIMES_S)]
    assert any(told) == (noun == "egg")
    assert any("turning" in one.line for one in find_unshown(hidden, said, TIMES_S)) == any(told)
