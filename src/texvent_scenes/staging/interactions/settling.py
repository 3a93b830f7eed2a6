"""Motions that acts imply: who pushes walks, what is ridden goes, who kicks faces a side."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np

from texvent_scenes.description import STANDING, IndexedRelation, SceneDescription
from texvent_scenes.models.activities import (
    ACTIVITIES,
    AIMED,
    HAND_NOUNS,
    ON_TOP,
    PERSON_NOUNS,
)
from texvent_scenes.models.people.outfit import can_be_worn, list_props
from texvent_scenes.models.protocol import Noun
from texvent_scenes.models.tables import nouns_with, trait_value
from texvent_scenes.spec.data import SENT
from texvent_scenes.spec.scene import Direction, Motion, SceneObject
from texvent_scenes.staging.actors import seeded
from texvent_scenes.staging.interactions import machines, striking
from texvent_scenes.staging.interactions.holding import hides_riders
from texvent_scenes.staging.interactions.perform import ACTS
from texvent_scenes.staging.placement.zones import are_driven
from texvent_scenes.staging.tracks.phases import PATH_KINDS, fits_in_hand

_ASIDE_DEG = (-20.0, 200.0)
"""Headings of who points at something: to the right or left, and a little to the camera."""
_SAME_WAY = ("follow", "overtake", "with")
"""Relations of two that go the same way, which one of them may say."""
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
        _mounted(_stated(replace(one, targets=targets), objects), objects, nouns)
        for one in in_hand(description.relations, objects)
        for targets in ([(t,) for t in one.targets] if one.kind == "wear" else [one.targets])
    ]
    relations = _sent_on(relations)
    relations += _implied_acts(objects, relations)
    relations = [_on_top(one, objects, relations) for one in relations]
    for relation in relations:
        if relation.kind in ACTS and relation.targets:
            _settle_act(relation, objects, relations, nouns, seed)
    for each in relations:
        if each.kind == "on" and objects[each.targets[0]].noun in nouns_with("across a road"):
            objects[each.subject] = _directed(objects[each.subject], "across")
        is_led = each.kind == "between" and not are_driven(objects[each.subject].noun)
        if is_led or (
            each.kind == "through" and objects[each.targets[0]].noun in nouns_with("passage")
        ):
            goes = is_led and any(one.kind == "travel" for one in description.camera.moves)
            way: Direction = "left" if goes else "towards"
            objects[each.subject] = _directed(objects[each.subject], way)
    for each in relations:
        who = objects[each.subject]
        is_aimed = bool({one.kind for one in who.motions} & AIMED) and each.kind == "towards"
        if is_aimed and who.heading_deg is None and len(who.motions) == 1:
            side = seeded(seed, "act", each.subject).random() < 0.5
            objects[each.subject] = replace(who, heading_deg=_ASIDE_DEG[side])
        pair = (each.subject, each.targets[0])
        ways = [one.motions[0].direction for one in (objects[n] for n in pair) if one.motions]
        said = [one for one in ways if one is not None] if each.kind in _SAME_WAY else []
        for number in pair if said else ():
            objects[number] = _directed(objects[number], said[0])
    return replace(description, objects=tuple(objects), relations=tuple(relations))


def _sent_on(relations: Sequence[IndexedRelation]) -> list[IndexedRelation]:
    """Relations in which a thing that one sends goes to what it is towards, and to who catches it.

    The sender has them then.
    """
    senders = {one.targets[0]: one.subject for one in relations if one.kind in SENT}
    found: list[IndexedRelation] = []
    for one in relations:
        thing = one.targets[0] if one.kind == "catch" else one.subject
        sender, sent = senders.get(thing, one.subject), one
        if one.kind == "catch" and sender != one.subject:
            sent = IndexedRelation("towards", sender, (one.subject,), is_caught=True)
        elif one.kind == "towards" and sender != one.subject:
            sent = replace(one, subject=sender)
        if sent == one or sent not in found:
            found.append(sent)
    caught = [replace(one, is_caught=False) for one in found if one.is_caught]
    return [one for one in found if one.is_caught or one not in caught]


def _stated(act: IndexedRelation, objects: Sequence[SceneObject]) -> IndexedRelation:
    """An impact with the time and the way that motions of its subject say."""
    impact, motions = striking.IMPACTS.get(act.kind), objects[act.subject].motions
    if impact is None:
        return act
    times = (one.start_s for one in motions if one.kind in (act.kind, impact.activity))
    ways = (one.direction for one in motions if one.direction is not None)
    return replace(act, start_s=next(times, None), direction=next(ways, None))


def _on_top(
    act: IndexedRelation, objects: Sequence[SceneObject], relations: Sequence[IndexedRelation]
) -> IndexedRelation:
    """An act of a person on a thing as that on a bench, where what is in its place stands by."""
    at_bench = ON_TOP.get(act.kind, "")
    if not at_bench or objects[act.subject].noun not in PERSON_NOUNS:
        return act
    nouns = {noun for prop in list_props(at_bench) for noun in prop.nouns}
    is_there = any(objects[n].noun in nouns for one in relations for n in one.targets
                   if one.subject == act.subject and one.kind == "beside")  # fmt: skip
    return replace(act, kind=at_bench) if is_there else act


def _settle_act(
    act: IndexedRelation, objects: list[SceneObject], relations: Sequence[IndexedRelation],
    nouns: Mapping[str, Noun], seed: int,
) -> None:  # fmt: skip
    """Give both bodies of an act the motions that it leaves them."""
    pair = act.subject, act.targets[0]
    direction = _choose_direction(act.kind, objects, pair, seed)
    objects[pair[0]] = who = _swinging(act.kind, pair, objects, relations)
    if machines.grips(who.noun, act.kind):
        is_free = not any(one.subject == pair[1] for one in relations)
        settled = machines.fit_hand(who, objects[pair[1]], nouns, is_free=is_free)
    else:
        settled = _settle(act.kind, who, objects[pair[1]], nouns, direction)
    for index, one in zip(pair, settled, strict=True):
        objects[index] = one


def _directed(said: SceneObject, direction: Direction) -> SceneObject:
    """An actor whose way a relation decides, where no other is said.

    On a crosswalk it crosses the road; out of a tunnel, and between things that stand side by
    side, it comes towards the camera; it comes before one that goes along them.
    """
    first = said.motions[0] if said.motions else None
    if first is None or first.kind not in PATH_KINDS or first.direction is not None:
        return said
    return replace(said, motions=(replace(first, direction=direction), *said.motions[1:]))


def in_hand(
    relations: Sequence[IndexedRelation], objects: Sequence[SceneObject]
) -> Iterator[IndexedRelation]:
    """A person "with" small things wears what can be worn, and holds the first of the others.

    A hand holds what is "with" it.
    """
    free = ("hit", "wear")  # who wears a coat has hands for an umbrella
    holding = {one.subject for one in relations if one.kind in ACTS and one.kind not in free}
    for one in relations:
        thing, who = objects[one.targets[0]].noun, objects[one.subject].noun
        is_in_hand = thing in HAND_NOUNS and who not in PERSON_NOUNS | HAND_NOUNS
        if one.kind == "with" and is_in_hand:  # "a board with a hand"
            yield IndexedRelation("hold", one.targets[0], (one.subject,))
            continue
        small = nouns_with("in hand or on something") | nouns_with("held as a tool")
        is_small = thing in small and thing not in HAND_NOUNS
        if one.kind != "with" or not is_small or objects[one.subject].noun not in PERSON_NOUNS:
            yield one
        elif can_be_worn(thing):
            yield replace(one, kind="wear")
        elif one.subject not in holding:
            holding.add(one.subject)
            yield replace(one, kind="hold")
        else:
            yield one


def _settle(
    kind: str, subject: SceneObject, target: SceneObject, nouns: Mapping[str, Noun], to: Direction
) -> tuple[SceneObject, SceneObject]:
    """Subject and target of an act, with the motions that the act leaves them."""
    motion, still = subject.motion or STANDING, replace(target, motions=())
    if kind == "ride":
        sitting = replace(subject, motions=(Motion("sit"),))
        return sitting, _give_motion(subject, target, nouns)
    if kind == "collide":
        return _at_its_pace(subject), _at_its_pace(target)
    if kind == "knock over":
        return _at_its_pace(subject), still
    if kind in striking.IMPACTS:
        doing = striking.IMPACTS[kind].activity or (motion.kind if kind == "hit" else kind)
        return replace(subject, motions=(Motion(doing, to),)), still
    if kind in ("push", "pull"):
        if motion.kind in ("push", "stand"):
            is_between = None not in (subject.position_m, target.position_m)
            walk = Motion("walk", to if is_between else motion.direction)
            subject = replace(subject, motions=(walk, *subject.motions[1:]))
        return subject, still
    if kind == "act on":
        return subject, target
    if kind in ("hold", "wear"):
        held = [one for one in target.motions if fits_in_hand(one, nouns[target.noun])]
        still = replace(target, motions=() if all(map(_is_rest, held)) else tuple(held))
    if kind == "wear":
        return subject, still
    return subject, _smaller(still, trait_value("carried size", target.noun) or 1.0)


def _is_rest(motion: Motion) -> bool:
    return motion.kind in ("stand", "hang", "sit", "lie")


def _smaller(said: SceneObject, share: float) -> SceneObject:
    return replace(said, size=share * said.size)


def _swinging(
    kind: str, pair: tuple[int, int], objects: Sequence[SceneObject],
    relations: Sequence[IndexedRelation],
) -> SceneObject:  # fmt: skip
    """Subject that hits, with the act of the implement in its hands, or of the usual one."""
    who, target = objects[pair[0]], objects[pair[1]].noun
    if kind != "hit":
        return who
    held = {objects[n].noun for one in relations if one.subject == pair[0] for n in one.targets
            if one.kind in ("hold", "with")}  # fmt: skip
    swung = [name for name, one in ACTIVITIES.items() if one.reach_m]
    used = [name for name in swung if held & {n for p in list_props(name) for n in p.nouns}]
    said = [one.kind for one in who.motions if one.kind in swung]
    usual = trait_value("struck with", target) or "swing bat"
    return replace(who, motions=(Motion([*used, *said, usual][0]),))


def _at_its_pace(said: SceneObject) -> SceneObject:
    """Body that collides, of whose motions speed and a turn are left: the act decides the rest."""
    motion = said.motion or STANDING
    kept = replace(STANDING, pace=motion.pace, speed_m_s=motion.speed_m_s)
    turns = tuple(one for one in said.motions if one.kind == "turn")[:1]
    return replace(said, motions=turns or (() if kept == STANDING else (kept,)))


def _mounted(
    relation: IndexedRelation, objects: Sequence[SceneObject], nouns: Mapping[str, Noun]
) -> IndexedRelation:
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


def _implied_acts(
    objects: Sequence[SceneObject], relations: Sequence[IndexedRelation]
) -> list[IndexedRelation]:
    """Relations that bind named instruments and tools to their players."""
    bound = {target for one in relations if one.kind in ACTS for target in one.targets}
    found: list[IndexedRelation] = []
    for index, person in enumerate(objects):
        motions = person.motions if person.noun in PERSON_NOUNS else ()
        props = [prop for motion in motions for prop in list_props(motion.kind)]
        for prop in props:
            free = [n for n, one in enumerate(objects) if one.noun in prop.nouns and n not in bound]
            if free and not (prop.is_below or prop.is_own):
                found.append(IndexedRelation("hold", index, (free[0],)))
                bound.add(free[0])
    return found


def _give_motion(rider: SceneObject, ridden: SceneObject, nouns: Mapping[str, Noun]) -> SceneObject:
    """Ridden object with the motion that the prompt gives to it or to its rider."""
    if ridden.noun in nouns_with("ridden in place"):
        return replace(
            ridden, motions=(Motion("work" if nouns[ridden.noun].is_working else "tilt"),)
        )
    said = ridden.motion if ridden.motion is not None and ridden.motion.is_moving else rider.motion
    usual = nouns[ridden.noun].motion
    if nouns[ridden.noun].habitat == "fixed" or usual == "roll":
        usual = "slide"
    if said is None:
        return replace(ridden, motions=(Motion(usual),))
    if said.kind in ("sit", "stand"):
        return ridden
    kind = said.kind if said.kind in ("run", "jump", "turn", "fly", "swim") else usual
    later = ridden.motions[1:] or rider.motions[1:]
    return replace(ridden, motions=(replace(said, kind=kind), *later))


def _choose_direction(
    kind: str, objects: Sequence[SceneObject], pair: tuple[int, int], seed: int
) -> Direction:
    """Direction of a single act in the picture; between stated places from one to the other."""
    for motion in (objects[index].motion for index in pair):
        if motion is not None and motion.direction in ("left", "right", "towards", "away"):
            return motion.direction
    here, there = (objects[index].position_m for index in pair)
    if here is not None and there is not None:
        x, y = np.subtract(there, here) * (-1.0 if kind == "pull" else 1.0)
        across: Direction = "right" if x > 0.0 else "left"
        return across if abs(x) >= abs(y) else "away" if y > 0.0 else "towards"
    return "left" if seeded(seed, "act", pair[0]).random() < 0.5 else "right"
