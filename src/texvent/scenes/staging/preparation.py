"""What staging must settle before anything is placed: a followed subject moves."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

from texvent.errors import InputError
from texvent.scenes.description import ObjectMotion, SceneDescription
from texvent.scenes.models.protocol import Noun
from texvent.scenes.models.traits import nouns_with
from texvent.scenes.staging.trajectories.schedule import left_out

_PLACES_TO_GO = frozenset(
    {"drive", "walk", "run", "fly", "swim", "sail", "paddle", "roll", "float"}
)


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
    missing: list[str] = []
    for scene_object in description.objects:
        said = [*filter(None, [scene_object.motion]), *scene_object.then]
        for motion in left_out(said, duration_s):
            text = (
                f"the {scene_object.noun}'s {motion.kind} after {motion.start_s:g} s "
                f"(the clip ends at {duration_s:g} s)"
            )
            missing.append(text)
    description = _shade(_face_passages(description))
    follows = any(move.kind == "follow" for move in description.shot.moves)
    if not follows or not description.objects:
        return description, missing
    index = description.shot.target
    if index is None:
        movers = [n for n, one in enumerate(description.objects) if _moves_on(one.motion)]
        index = movers[0] if movers else 0
    subject = description.objects[index]
    if _moves_on(subject.motion) or subject.then:
        return description, missing
    if subject.motion is not None and subject.motion.kind not in ("stand", "move"):
        return description, missing
    usual = nouns[subject.noun].motion
    if usual in _PLACES_TO_GO:
        objects = list(description.objects)
        objects[index] = replace(subject, motion=ObjectMotion(usual))
        shot = replace(description.shot, target=index)
        return replace(description, objects=tuple(objects), shot=shot), missing
    moves = tuple(
        replace(move, kind="truck", direction="right") if move.kind == "follow" else move
        for move in description.shot.moves
    )
    missing.append(f"following the {subject.noun}, which does not move")
    return replace(description, shot=replace(description.shot, moves=moves)), missing


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


def _shade(description: SceneDescription) -> SceneDescription:
    """With parasols for umbrellas that nobody holds: over people, or on a beach."""
    objects = list(description.objects)
    relations = description.relations
    held = {i for one in relations if one.kind in _IN_HANDS for i in one.targets}
    over = {i for one in relations if one.kind == "under" for i in one.targets}
    is_beach = description.surroundings.place in _BEACHES
    for index, one in enumerate(objects):
        if one.noun == "umbrella" and index not in held and (is_beach or index in over):
            objects[index] = replace(one, noun="parasol")
    return replace(description, objects=tuple(objects))


_IN_HANDS = frozenset({"hold", "carry"})
_BEACHES = frozenset({"sand", "beach", "swimming pool"})


def _moves_on(motion: ObjectMotion | None) -> bool:
    return motion is not None and motion.is_moving
