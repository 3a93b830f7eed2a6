"""What staging settles before anything is placed: a followed subject moves; levels of flight."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

from texvent.errors import InputError
from texvent.scenes.description import ObjectMotion, SceneDescription
from texvent.scenes.models.nouns import AFLOAT
from texvent.scenes.models.places import Place
from texvent.scenes.models.protocol import Noun
from texvent.scenes.models.traits import nouns_with
from texvent.scenes.scene import Ground
from texvent.scenes.staging.trajectories.phases import left_out

_PLACES_TO_GO = frozenset(
    {"drive", "walk", "run", "fly", "swim", "sail", "paddle", "roll", "float"}
)
_OFF_THE_BED = 0.5
"""How high people swim above the bed of the sea, as a multiple of their height."""
_SUNK = -0.18
"""Height of the origin of what swims at the surface, in its sizes."""


def prepare(
    description: SceneDescription, nouns: Mapping[str, Noun], duration_s: float
) -> tuple[SceneDescription, list[str]]:
    """The description as it is staged, and what of it cannot be shown.

    A camera that follows something which stays in its place would show nothing: the subject does
    what it usually does, and what cannot move is passed by the camera instead.

    Raises:
        InputError: the duration is not a positive number.
    """
    if not (math.isfinite(duration_s) and duration_s > 0.0):
        raise InputError(f"duration is {duration_s} s; it must be a positive number of seconds")
    missing = [
        f"the {one.noun}'s {motion.kind} after {motion.start_s:g} s "
        f"(the clip ends at {duration_s:g} s)"
        for one in description.objects
        for motion in left_out([*filter(None, [one.motion]), *one.then], duration_s)
    ]
    description = _face_passages(description)
    index = _find_followed(description)
    if index is None:
        return description, missing
    objects = list(description.objects)
    noun, shot = nouns[objects[index].noun], description.shot
    if noun.motion in _PLACES_TO_GO:
        objects[index] = replace(objects[index], motion=ObjectMotion(noun.motion))
        shot = replace(shot, target=index)
        return replace(description, objects=tuple(objects), shot=shot), missing
    moves = tuple(
        replace(move, kind="truck", direction="right") if move.kind == "follow" else move
        for move in shot.moves
    )
    missing.append(f"following the {noun.name}, which does not move")
    return replace(description, shot=replace(shot, moves=moves)), missing


def _find_followed(description: SceneDescription) -> int | None:
    """Index of what the camera follows, if that rests; None if there is no such thing."""
    objects, index = description.objects, description.shot.target
    if not objects or not any(move.kind == "follow" for move in description.shot.moves):
        return None
    if index is None:
        moving = [n for n, one in enumerate(objects) if one.motion and one.motion.is_moving]
        index = moving[0] if moving else 0
    motion = objects[index].motion
    rests = motion is None or motion.kind in ("stand", "hang")
    return index if rests and not objects[index].then else None


def _face_passages(description: SceneDescription) -> SceneDescription:
    """Let what goes through a tunnel come towards the camera, where the prompt leaves it open."""
    objects = list(description.objects)
    for relation in description.relations:
        motion = objects[relation.subject].motion
        gates = [t for t in relation.targets if objects[t].noun in nouns_with("passage")]
        if relation.kind != "through" or not gates or motion is None:
            continue
        if motion.direction is None and motion.is_moving:
            turned = replace(motion, direction="towards")
            objects[relation.subject] = replace(objects[relation.subject], motion=turned)
    return replace(description, objects=tuple(objects))


def choose_levels(
    place: Place, description: SceneDescription, nouns: Mapping[str, Noun]
) -> dict[str, float]:
    """Height of origins above the ground: habitat or noun → multiple of an object's size.

    "clear" is in metres, on top of that, for what flies.
    """
    if place.ground is Ground.NONE:
        everything = {nouns[scene_object.noun].name: 0.0 for scene_object in description.objects}
        return {"air": 2.0, "water": 0.0, **everything}
    levels = {"air": 1.5, "water": 0.5, "clear": place.flight_m}
    if place.ground is Ground.UNDERWATER:
        swimming = [one for one in description.objects if one.motion and one.motion.kind == "swim"]
        divers = [one.noun for one in swimming if nouns[one.noun].habitat == "ground"]
        return {**levels, "water": 0.9, **dict.fromkeys(divers, _OFF_THE_BED)}
    if place.ground is Ground.SEA or place.has_shore:
        swimmers = {noun.name: _SUNK for noun in nouns.values() if noun.habitat == "water"}
        return {**levels, "water": 0.0, **swimmers, **dict.fromkeys(AFLOAT, 0.0)}
    return {**levels, **dict.fromkeys(AFLOAT, 0.25)}
