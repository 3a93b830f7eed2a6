"""Motions that acts imply: who pushes walks, what is ridden moves and its rider sits."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from texvent.scenes.description import (
    STANDING,
    ObjectMotion,
    Relation,
    SceneDescription,
    SceneObject,
)
from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.models.people.outfit import list_props
from texvent.scenes.models.protocol import Noun
from texvent.scenes.models.tables import nouns_with, trait_value
from texvent.scenes.spec.scene import Direction
from texvent.scenes.staging.actors import seeded
from texvent.scenes.staging.acts.acts import ACTS, SINGLE, hides_riders

_IDLE = frozenset({"stand", "sit", "sail", "drive"})
"""Motions of people that leave it open whether they ride."""


def settle_motions(
    description: SceneDescription, nouns: Mapping[str, Noun], seed: int
) -> SceneDescription:
    """The description with the motions that its acts imply.

    Who pushes walks; what is ridden moves and its rider sits; who kicks faces left or right.
    """
    objects = list(description.objects)
    relations = [
        _mounted(replace(one, targets=targets), objects, nouns)
        for one in description.relations
        for targets in ([(t,) for t in one.targets] if one.kind == "wear" else [one.targets])
    ]
    relations += _implied_acts(objects, relations)
    relations = _with_thirds(objects, relations)
    for relation in relations:
        if relation.kind in ACTS and relation.targets:
            pair = relation.subject, relation.targets[0]
            way = _choose_way(objects, pair, seed)
            settled = _settle(relation.kind, objects[pair[0]], objects[pair[1]], nouns, way)
            for index, one in zip(pair, settled, strict=True):
                objects[index] = one
    return replace(description, objects=tuple(objects), relations=tuple(relations))


def _settle(
    kind: str, subject: SceneObject, target: SceneObject, nouns: Mapping[str, Noun], way: Direction
) -> tuple[SceneObject, SceneObject]:
    """Who acts and on what, with the motions that the act leaves them."""
    motion, still = subject.motion or STANDING, replace(target, motion=None, then=())
    if kind == "ride":
        sitting = replace(subject, motion=ObjectMotion("sit"), then=())
        return sitting, _give_motion(subject, target, nouns)
    if kind == "collide":
        return replace(subject, motion=None, then=()), still
    if kind in SINGLE:
        return replace(subject, motion=ObjectMotion(kind, way), then=()), still
    if kind == "push":
        if motion.kind in ("push", "stand"):
            subject = replace(subject, motion=ObjectMotion("walk", motion.direction))
        return subject, still
    if kind == "wear":
        return subject, still
    size = trait_value("carried size", target.noun) or 1.0
    return subject, replace(still, scale=size * target.scale)


def _mounted(
    relation: Relation, objects: Sequence[SceneObject], nouns: Mapping[str, Noun]
) -> Relation:
    """A person on a horse or a skateboard rides it; so do idle people in a boat or a vehicle."""
    person, target = objects[relation.subject], objects[relation.targets[0]].noun
    if relation.kind not in ("on", "in") or person.noun not in PERSON_NOUNS:
        return relation
    is_mount = trait_value("ridden", target) is not None and relation.kind == "on"
    is_carrier = trait_value("seats", target) or trait_value("ridden", target)
    is_closed = relation.kind == "in" and hides_riders(nouns[target])
    is_idle = (person.motion or STANDING).kind in _IDLE
    if is_mount or (is_idle and (is_carrier or is_closed)):
        return replace(relation, kind="ride")
    return relation


def _with_thirds(objects: Sequence[SceneObject], relations: Sequence[Relation]) -> list[Relation]:
    """The target of a throw catches it; a holder of a racket hits the ball with it."""
    found = list(relations)
    for act in relations:
        if act.kind not in ("throw", "hit") or len(act.targets) != 1:
            continue
        for other in relations:
            is_tool = other.subject == act.subject and _holds_tool(other, objects)
            is_goal = other.kind == "towards" and other.subject in (act.subject, *act.targets)
            if is_tool if act.kind == "hit" else is_goal:
                found[found.index(act)] = replace(act, targets=act.targets + other.targets[:1])
                if is_tool:
                    found.remove(other)
                break
    return found


def _holds_tool(relation: Relation, objects: Sequence[SceneObject]) -> bool:
    noun = objects[relation.targets[0]].noun
    is_tool = trait_value("struck with", noun) is not None
    return relation.kind == "hold" and is_tool and noun not in nouns_with("played with")


def _implied_acts(objects: Sequence[SceneObject], relations: Sequence[Relation]) -> list[Relation]:
    """Who plays a guitar that the scene names holds that one."""
    bound = {target for one in relations if one.kind in ACTS for target in one.targets}
    found: list[Relation] = []
    for index, person in enumerate(objects):
        motions = [person.motion, *person.then] if person.noun in PERSON_NOUNS else []
        props = [prop for motion in motions if motion for prop in list_props(motion.kind)]
        for prop in props:
            free = [n for n, one in enumerate(objects) if one.noun in prop.nouns and n not in bound]
            if free and prop.anchor != "ground" and not prop.is_own:
                found.append(Relation("hold", index, (free[0],)))
                bound.add(free[0])
    return found


def _give_motion(rider: SceneObject, ridden: SceneObject, nouns: Mapping[str, Noun]) -> SceneObject:
    """What is ridden, with the motion that the prompt gives to it or to its rider."""
    said = ridden.motion if ridden.motion is not None and ridden.motion.is_moving else rider.motion
    usual = nouns[ridden.noun].motion
    if nouns[ridden.noun].habitat == "fixed" or usual == "roll":
        usual = "slide"
    if said is None:
        return replace(ridden, motion=ObjectMotion(usual))
    if said.kind in ("sit", "stand"):
        return ridden
    kind = said.kind if said.kind in ("run", "jump", "turn", "fly", "swim") else usual
    return replace(ridden, motion=replace(said, kind=kind), then=ridden.then or rider.then)


def _choose_way(objects: Sequence[SceneObject], pair: tuple[int, int], seed: int) -> Direction:
    """Where a single act goes in the picture."""
    for motion in (objects[index].motion for index in pair):
        if motion is not None and motion.direction in ("left", "right", "towards", "away"):
            return motion.direction
    return "left" if seeded(seed, "act", pair[0]).random() < 0.5 else "right"
