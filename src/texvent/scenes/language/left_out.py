"""Things that a prompt leaves out: who works at a site, and what drops and sparks come from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from texvent.scenes.description import STANDING, ObjectMotion, SceneDescription, SceneObject
from texvent.scenes.inflection import pluralise
from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.models.protocol import Noun

_CREWS: dict[str, tuple[SceneObject, ...]] = {
    "construction site": (
        SceneObject("excavator", motion=ObjectMotion("work")),
        SceneObject("crane", motion=ObjectMotion("work"), side="far"),
        SceneObject("worker", 2, motion=ObjectMotion("walk")),
        SceneObject("traffic cone", 4),
    ),
}
"""Places with usual objects at work."""


def add_crew(description: SceneDescription, nouns: Mapping[str, Noun]) -> SceneDescription:
    """Add the usual objects of a place where the prompt names none."""
    crew = _CREWS.get(description.surroundings.place or "", ())
    shown = tuple(
        scene_object
        for scene_object in crew
        if scene_object.noun in nouns and scene_object.noun not in description.absent
    )
    if description.objects or not shown:
        return description
    names = ", ".join(pluralise(t.noun) if t.count > 1 else t.noun for t in shown)
    note = f"the {description.surroundings.place} is shown with: {names}"
    return replace(description, objects=shown, notes=(*description.notes, note))


_SOURCES = {"drip": "faucet", "sparks": "angle grinder", "popcorn": "frying pan"}
"""Effect → what it comes from where the prompt names nothing."""


def add_sources(description: SceneDescription) -> SceneDescription:
    """Add what drops and sparks come from, where the prompt names no thing."""
    first = description.effects[0] if description.effects else None
    noun = _SOURCES.get(first.kind) if first is not None and first.source is None else None
    is_told = description.objects or description.surroundings.place or noun in description.absent
    if first is None or noun is None or is_told:
        return description
    note = f"no source of the {first.kind} is said: the {noun} is chosen"
    return replace(
        description,
        objects=(SceneObject(noun),),
        effects=(replace(first, source=0), *description.effects[1:]),
        notes=(*description.notes, note),
    )


def give_usual_work(description: SceneDescription) -> SceneDescription:
    """Give the usual objects of a place their usual motion, unless the prompt states one.

    A crane that turns slowly in the distance would else count as all the motion there is.
    """
    crew = {
        scene_object.noun: scene_object
        for scene_object in _CREWS.get(description.surroundings.place or "", ())
    }
    objects = tuple(
        replace(scene_object, motion=crew[scene_object.noun].motion)
        if scene_object.motion is None and scene_object.noun in crew
        else scene_object
        for scene_object in description.objects
    )
    return replace(description, objects=objects)


def ride_waves(description: SceneDescription) -> SceneDescription:
    """As in "a surfer on a wave": surfs, unless the prompt says what else."""
    if description.surroundings.wave_height <= 1.0:
        return description
    objects = tuple(
        replace(one, motion=ObjectMotion("surf"))
        if one.noun == "surfer" and one.motion is None
        else one
        for one in description.objects
    )
    return replace(description, objects=objects)


_AT_HAND = frozenset({"hold", "wear", "with"})
_BESIDE = frozenset({"beside", "left of", "right of"})


def is_still_life(description: SceneDescription) -> bool:
    """Whether things are named side by side, with nobody, that do nothing: birds sit there too."""
    objects = description.objects
    return (
        len(objects) > 1
        and not any(one.noun in PERSON_NOUNS for one in objects)
        and all(one.kind in _BESIDE for one in description.relations)
        and all(one.motion is None and one.count == 1 for one in objects)
        and not description.shot.is_moving
        and description.surroundings.place not in ("sky", "space")
    )


def stays_together(description: SceneDescription, nouns: Mapping[str, Noun]) -> bool:
    """Whether several things are named of which none should go off and leave the others behind.

    Those without people, and people with things that only stand there.
    """
    objects = description.objects
    people = {index for index, one in enumerate(objects) if one.noun in PERSON_NOUNS}
    others = [one for one in objects if one.noun not in PERSON_NOUNS]
    if not people:
        return len(others) > 1
    stand = all(nouns[one.noun].habitat == "fixed" for one in others)
    are_beside = all(
        one.kind in _BESIDE | _AT_HAND or not people & {one.subject, *one.targets}
        for one in description.relations
    )
    return bool(others) and stand and are_beside


def land(index: int, description: SceneDescription) -> SceneObject:
    """A plane of which only an airport is said is on the ground there, and so is one near others.

    As in "two men next to an airplane".
    """
    one = description.objects[index]
    if one.noun not in _PLANES or one.motion is not None:
        return one
    others = [
        description.objects[other]
        for relation in description.relations
        if relation.kind in _NEAR
        for other in (relation.subject, *relation.targets)
        if index in (relation.subject, *relation.targets) and other != index
    ]
    is_near = any(other.motion is None or other.motion.kind not in _ALOFT for other in others)
    is_landed = is_near or description.surroundings.place == "runway"
    return replace(one, motion=STANDING) if is_landed else one


_NEAR = frozenset({"beside", "front", "behind", "left of", "right of", "between"})
_ALOFT = ("fly", "hover", "rise")
_PLANES = frozenset({"airplane", "jet plane", "biplane", "fighter jet", "helicopter"})
