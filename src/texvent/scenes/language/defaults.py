"""Fills in what a prompt leaves open, and says so."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from texvent.scenes.description import (
    STANDING,
    CameraMove,
    Motion,
    Paint,
    Relation,
    SceneDescription,
    Thing,
)
from texvent.scenes.language.lexicon import COLOURS, MAX_BODIES
from texvent.scenes.language.whereabouts import choose_place
from texvent.scenes.language.words import pluralise
from texvent.scenes.model import Noun

SLOW_PAN = CameraMove("pan", "right", 0.8)
"""What the camera does where nothing else moves: a still picture has no events."""


def complete_description(
    description: SceneDescription, nouns: Mapping[str, Noun]
) -> SceneDescription:
    """The description with every thing's motion decided and something that moves.

    Things that live in the air or water always move unless the prompt says that they rest. When
    nothing moves, things that can move do what they usually do; when none can, the camera pans.
    """
    if description.understood_nothing:
        description = _show_default(description, nouns)
    description = _add_crew(description, nouns)
    description = _limit_bodies(_stand_back(_seat_riders(description), nouns))
    things = tuple(_decide_motion(thing, nouns[thing.noun]) for thing in description.things)
    description = _let_chased_move(replace(description, things=things), nouns)
    things = description.things
    said = replace(description.surroundings, place=choose_place(description, nouns))
    description = _put_to_work(replace(description, surroundings=said))
    if description.shot.is_moving or any(_moves(thing) for thing in things):
        return _settle_rest(description)
    return _settle_rest(_set_in_motion(description, nouns))


_CREWS: dict[str, tuple[Thing, ...]] = {
    "construction site": (
        Thing("excavator", motion=Motion("work")),
        Thing("crane", motion=Motion("work"), side="far"),
        Thing("worker", 2, motion=Motion("walk")),
        Thing("traffic cone", 4),
    ),
}
"""Places that are known by what is done there."""


WORKING = frozenset(
    {"windmill", "wind turbine", "flag", "traffic light", "clock", "fan", "pendulum", "crane"}
)
"""Nouns that stay in place and move by themselves."""


def _add_crew(description: SceneDescription, nouns: Mapping[str, Noun]) -> SceneDescription:
    """Things that make a place what it is, where the prompt names none."""
    crew = _CREWS.get(description.surroundings.place or "", ())
    shown = tuple(
        thing for thing in crew if thing.noun in nouns and thing.noun not in description.absent
    )
    if description.things or not shown:
        return description
    names = ", ".join(pluralise(t.noun) if t.count > 1 else t.noun for t in shown)
    note = f"the {description.surroundings.place} is shown with: {names}"
    return replace(description, things=shown, notes=(*description.notes, note))


def _put_to_work(description: SceneDescription) -> SceneDescription:
    """At a place that is known by what is done there, it is done, unless the prompt says what is.

    A crane that turns slowly in the distance would else count as all the motion there is.
    """
    crew = {thing.noun: thing for thing in _CREWS.get(description.surroundings.place or "", ())}
    things = tuple(
        replace(thing, motion=crew[thing.noun].motion)
        if thing.motion is None and thing.noun in crew
        else thing
        for thing in description.things
    )
    return replace(description, things=things)


HAS_RIDER = frozenset({"bicycle", "motorcycle"})
"""Nouns whose models come with the person who rides them."""


def _seat_riders(description: SceneDescription) -> SceneDescription:
    """Leave out the person on a bicycle, which has its rider already."""
    riders = {
        relation.subject
        for relation in description.relations
        if relation.kind == "on" and description.things[relation.targets[0]].noun in HAS_RIDER
    }
    if not riders:
        return description
    kept = [index for index in range(len(description.things)) if index not in riders]
    new = {old: position for position, old in enumerate(kept)}
    relations = tuple(
        Relation(r.kind, new[r.subject], tuple(new[t] for t in r.targets))
        for r in description.relations
        if riders.isdisjoint({r.subject, *r.targets})
    )
    target = description.shot.target
    shot = replace(description.shot, target=new.get(target) if target is not None else None)
    things = tuple(description.things[index] for index in kept)
    return replace(description, things=things, relations=relations, shot=shot)


TOWERING = frozenset(
    {"crane", "building", "mountain", "windmill", "wind turbine", "ship", "bridge", "pyramid"}
)
"""Nouns that stand far behind smaller things, unless the prompt relates them."""
_MOST_COMPANIONS = 6


def _stand_back(description: SceneDescription, nouns: Mapping[str, Noun]) -> SceneDescription:
    """Move towering things to the background, and let living surroundings keep company.

    Animals that surround something move along with it, because scenery stands still.
    """
    things = list(description.things)
    relations = []
    for relation in description.relations:
        target = relation.targets[0]
        if relation.kind in ("surround", "among") and nouns[things[target].noun].habitat != "fixed":
            things[target] = replace(
                things[target], count=min(things[target].count, _MOST_COMPANIONS)
            )
            relation = replace(relation, kind="with")
        relations.append(relation)
    related = {i for relation in relations for i in (relation.subject, *relation.targets)}
    is_mixed = any(thing.noun not in TOWERING for thing in things)
    for index, thing in enumerate(things):
        is_free = index not in related and index != description.shot.target
        if is_mixed and is_free and thing.noun in TOWERING and thing.side is None:
            things[index] = replace(thing, side="far")
    return replace(description, things=tuple(things), relations=tuple(relations))


def _limit_bodies(description: SceneDescription) -> SceneDescription:
    """At most `MAX_BODIES` bodies in all; at least one of each thing."""
    room = MAX_BODIES - len(description.things)
    things = []
    for thing in description.things:
        shown = 1 + min(thing.count - 1, room)
        room -= shown - 1
        things.append(replace(thing, count=shown))
    if tuple(things) == description.things:
        return description
    note = f"no more than {MAX_BODIES} bodies are shown"
    return replace(description, things=tuple(things), notes=(*description.notes, note))


def _let_chased_move(description: SceneDescription, nouns: Mapping[str, Noun]) -> SceneDescription:
    """What is followed goes ahead, if it can move and the prompt does not say that it rests."""
    things = list(description.things)
    for relation in description.relations:
        target = relation.targets[0]
        noun = nouns[things[target].noun]
        if relation.kind == "follow" and things[target].motion is None and noun.motion != "stand":
            things[target] = replace(things[target], motion=Motion(noun.motion))
    return replace(description, things=tuple(things))


def _moves(thing: Thing) -> bool:
    return thing.motion is not None and thing.motion.is_moving and thing.motion.kind != "sit"


def _decide_motion(thing: Thing, noun: Noun) -> Thing:
    motion = thing.motion
    if thing.noun in WORKING and (motion is None or motion.kind in ("stand", "swing", "spin")):
        return replace(thing, motion=Motion("work"))
    if motion is None and noun.habitat in ("air", "water") and noun.motion != "stand":
        return replace(thing, motion=Motion(noun.motion))
    if motion is not None and motion.kind == "move":
        kind = noun.motion if noun.motion != "stand" else "slide"
        return replace(thing, motion=replace(motion, kind=kind))
    return thing


def _set_in_motion(description: SceneDescription, nouns: Mapping[str, Noun]) -> SceneDescription:
    """Let the first thing that can move do so, or else the camera."""
    for index, thing in enumerate(description.things):
        usual = nouns[thing.noun].motion
        if thing.motion is None and usual != "stand":
            moved = replace(thing, motion=Motion(usual))
            things = (*description.things[:index], moved, *description.things[index + 1 :])
            note = f"no motion is said of the {thing.noun}, so it does what it usually does"
            return replace(description, things=things, notes=(*description.notes, note))
    light, weather = description.light, description.surroundings.weather
    if light.flicker_hz is not None or weather in ("rain", "snow"):
        return description
    shot = replace(description.shot, moves=(SLOW_PAN,))
    note = "nothing moves in the prompt, so the camera pans slowly"
    return replace(description, shot=shot, notes=(*description.notes, note))


def _settle_rest(description: SceneDescription) -> SceneDescription:
    things = tuple(
        thing if thing.motion is not None else replace(thing, motion=STANDING)
        for thing in description.things
    )
    return replace(description, things=things)


def _show_default(description: SceneDescription, nouns: Mapping[str, Noun]) -> SceneDescription:
    """A scene for a prompt of which nothing was understood."""
    noun = "ball" if "ball" in nouns else next(iter(nouns))
    ball = Thing(noun, paint=Paint("red", COLOURS["red"]), motion=Motion("bounce"))
    note = f"nothing in the prompt was understood: a bouncing {noun} stands in"
    return replace(description, things=(ball,), notes=(*description.notes, note))
