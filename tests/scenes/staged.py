"""Scenes staged from objects, for tests of what they show."""

from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np

from texvent.camera import project
from texvent.sensor import SensorSize
from texvent_scenes.defaults import complete
from texvent_scenes.description import IndexedRelation, SceneDescription, to_description
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.scene_input import understand
from texvent_scenes.spec.scene import Camera, Effect, Light, Motion, Place, Scene, SceneObject
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.compose import ComposedScene, compose_scene
from texvent_scenes.staging.placement.object_placement import ObjectPlacer
from texvent_scenes.staging.surroundings.road_line import RoadLine

SIZE = SensorSize(173, 130)
DURATION_S = 2.0
LEVELS_M = {"air": 1.5, "water": 0.5, "clear": 0.0}


def thing(noun: str, *motions: tuple[str, ...], **fields: Any) -> SceneObject:
    """An object that does one thing after the other; each is a kind and a direction."""
    return SceneObject(noun, motions=tuple(Motion(*motion) for motion in motions), **fields)


@lru_cache(maxsize=32)
def stage(
    *objects: SceneObject,
    relations: tuple[tuple[Any, ...], ...] = (),
    effects: tuple[Effect, ...] = (),
    camera: Camera | None = None,
    place: str | None = "",
    light: str | None = None,
    seed: int = 0,
    duration_s: float = DURATION_S,
) -> ComposedScene:
    """A scene; a relation is its kind, an object's number and those of its targets.

    Where no place is given there is grass without scenery, which is quick.
    """
    description = SceneDescription(
        objects=objects,
        relations=tuple(IndexedRelation(kind, who, tuple(to)) for kind, who, *to in relations),
        effects=effects,
        camera=camera or Camera(),
        light=Light(light),
        place=Place("grass", is_empty=True) if place == "" else Place(place),
    )
    return compose_scene(description, seed=seed, size=SIZE, duration_s=duration_s)


def place(*objects: SceneObject, duration_s: float = DURATION_S) -> list[Actor]:
    """Bodies of a scene file's objects, without a camera and surroundings."""
    said = complete(to_description(Scene(objects=objects)), NOUNS)
    placer = ObjectPlacer(said, NOUNS, seed=3, duration_s=duration_s, level_m=LEVELS_M)
    return placer.place_all()


@lru_cache(maxsize=32)
def stage_text(text: str, seed: int = 0) -> tuple[SceneDescription, ComposedScene]:
    """A sentence as it is understood, and its scene."""
    said = understand(text, NOUNS)
    return said, compose_scene(said, seed=seed, size=SIZE, duration_s=DURATION_S)


def moved(scene: ComposedScene, actor: Actor, by_m: Any) -> ComposedScene:
    """The scene with one of its bodies elsewhere."""
    track = replace(actor.track, start=tuple(np.add(actor.track.start, by_m)))
    others = (replace(one, track=track) if one is actor else one for one in scene.actors)
    return replace(scene, actors=tuple(others))


def in_image(scene: ComposedScene, actor: Actor, time_s: float) -> np.ndarray:
    """[8, 2] corners of an actor, shares of the image's width and height from the top left."""
    image = project(scene.camera(time_s), SIZE, actor.corners(time_s))[:, :2]
    return np.asarray(image / [SIZE.width, SIZE.height])


def middle(actor: Actor, time_s: float) -> np.ndarray:
    """The middle of a body, also where its box leans."""
    lift = 0.0 if actor.is_centred else 0.5 * actor.model.height
    return actor.track.at(time_s).to_world() @ np.array([0.0, 0.0, lift, 1.0])


def box(actor: Actor, time_s: float) -> tuple[np.ndarray, np.ndarray]:
    """Least and greatest corner of a body."""
    corners = actor.corners(float(time_s))
    return corners.min(axis=0), corners.max(axis=0)


def road_of(scene: ComposedScene) -> tuple[RoadLine, float]:
    """The road or shore of a scene, and half its width."""
    seen = scene.environment(0.0)
    x, y = map(float, seen.road_offset)
    return RoadLine(seen.road_angle, (x, y)), float(seen.road_half_width)
