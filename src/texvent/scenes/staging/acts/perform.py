"""Binds placed actors together by the acts of a scene, and turns those who look at something."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from texvent.scenes.description import Relation, SceneDescription
from texvent.scenes.models.people.activities import PAIR_GAPS
from texvent.scenes.staging.actors import Actor, size_of
from texvent.scenes.staging.acts import holding, striking
from texvent.scenes.staging.acts.acts import ACTS, Cast, is_person
from texvent.scenes.staging.trajectories.trajectory import Stationary, ahead

_ORDER = ("push", "kick", "throw", "catch", "hit", "collide", "hold", "carry", "wear")
"""What moves bodies comes before what hangs on them."""
_TIED = frozenset({"at", "on", "in", "ride", "push"})
"""Relations that give their subject its heading."""


def perform_acts(
    description: SceneDescription, actors: list[Actor], duration_s: float
) -> list[Actor]:
    """The actors with every act's bodies bound together.

    Args:
        description: the prompt, its motions settled.
        actors: all actors, each where it was placed.
        duration_s: length of the clip, s.

    Returns:
        The actors in the same order, without those whose part a model plays itself: the rider of
        a bicycle, and what that rider has.
    """
    cast = Cast(actors)
    acts = [one for one in description.relations if one.kind in ACTS and one.targets]
    bound = {one for act in acts for one in (act.subject, *act.targets)}
    _look_at(cast, description.relations, duration_s)
    _face_each_other(cast, [n for n, one in enumerate(actors) if one.object_index not in bound])
    ridden = {one.targets[0] for one in acts if one.kind == "ride"}
    pushed = [r for r in acts if r.kind == "push" and r.targets[0] in ridden]
    for relation in pushed:
        _perform(cast, relation, duration_s)
    holding.board(cast, acts)
    for kind in _ORDER:
        for relation in (one for one in acts if one.kind == kind and one not in pushed):
            _perform(cast, relation, duration_s)
    _take_off_doubles(cast, actors)
    return cast.actors()


def _perform(cast: Cast, relation: Relation, duration_s: float) -> None:
    """An act of each subject on a target of its own."""
    subjects, targets = cast.copies(relation.subject), cast.copies(relation.targets[0])
    if relation.kind == "collide":
        met = list(dict.fromkeys([*subjects, *targets]))
        for pair in zip(met[::2], met[1::2], strict=False):
            _bind(cast, relation.kind, (*pair, None), duration_s)
        return
    others = cast.copies(relation.targets[1]) if len(relation.targets) > 1 else []
    for turn, target in enumerate(targets):
        if not subjects:
            cast.put(target, None)
        elif subjects[turn % len(subjects)] != target:
            third = others[turn] if turn < len(others) else None
            _bind(cast, relation.kind, (subjects[turn % len(subjects)], target, third), duration_s)


_Act = Callable[[Actor, Actor, Actor | None, float], tuple[Actor | None, ...]]
_ACTS: Mapping[str, _Act] = {
    "push": lambda who, what, _, __: holding.push(who, what),
    "hold": lambda who, what, _, __: holding.hold(who, what),
    "carry": lambda who, what, _, __: holding.hold(who, what),
    "wear": lambda who, what, _, __: holding.wear(who, what),
    "kick": lambda who, what, _, duration_s: striking.kick(who, what, duration_s),
    "catch": lambda who, what, _, duration_s: striking.catch(who, what, duration_s),
    "collide": lambda who, what, _, duration_s: striking.collide(who, what, duration_s),
    "throw": striking.throw,
    "hit": striking.hit,
}
"""Act → the bodies as it leaves them: who acts, on what, and who catches or with what."""


def _bind(cast: Cast, kind: str, who: tuple[int, int, int | None], duration_s: float) -> None:
    third = None if who[2] is None else cast.get(who[2])
    bodies = _ACTS[kind](cast.get(who[0]), cast.get(who[1]), third, duration_s)
    for number, body in zip(who, bodies, strict=False):
        if number is not None:
            cast.put(number, body)


def _take_off_doubles(cast: Cast, actors: Sequence[Actor]) -> None:
    """A piano, a desk or a board that comes with an activity is not shown twice."""
    for person in cast.actors():
        nouns = {noun for prop in person.props if prop.anchor == "ground" or prop.is_own
                 for noun in prop.nouns}  # fmt: skip
        for number, thing in enumerate(actors):
            if thing.noun.name in nouns and thing.object_index != person.object_index:
                cast.put(number, None)
                nouns.discard(thing.noun.name)


def _face_each_other(cast: Cast, numbers: Sequence[int]) -> None:
    """What two people do together they do before each other.

    Args:
        cast: the actors; those of pairs are replaced.
        numbers: positions of the actors that no other act moves.
    """
    waiting: dict[str, int] = {}
    for number in numbers:
        actor = cast.get(number)
        path = actor.trajectory
        if not isinstance(path, Stationary) or not is_person(actor):
            continue
        apart_m = PAIR_GAPS.get(path.activity)
        if apart_m is None:
            continue
        first = waiting.pop(path.activity, None)
        if first is None:
            waiting[path.activity] = number
        else:
            _face(cast, (first, number), apart_m)


def _face(cast: Cast, pair: tuple[int, int], apart_m: float) -> None:
    """Left and right of the middle between them, as they are placed; fronts to each other."""
    places = np.array([cast.get(number).trajectory.at(0.0).position for number in pair])
    x, y, z = (float(value) for value in places.mean(axis=0))
    half = 0.25 * apart_m * sum(size_of(cast.get(number).model) for number in pair)
    is_ordered = places[0][0] <= places[1][0]
    for number, is_left in zip(pair, (is_ordered, not is_ordered), strict=True):
        actor, yaw = cast.get(number), 0.0 if is_left else math.pi
        if isinstance(actor.trajectory, Stationary):
            path = replace(actor.trajectory, home=ahead((x, y, z), yaw, -half, z), yaw=yaw)
            cast.put(number, replace(actor, trajectory=path, lead_m=0.0, is_mover=True))


def _look_at(cast: Cast, relations: Sequence[Relation], duration_s: float) -> None:
    """Who stays in its place turns to what it looks at, where that is at mid clip."""
    tied = {one.subject for one in relations if one.kind in _TIED}
    for relation in relations:
        goals = [number for target in relation.targets for number in cast.copies(target)]
        if relation.kind != "look at" or relation.subject in tied or not goals:
            continue
        if relation.targets == (relation.subject,):
            goals = goals[1:] + goals[:1]
        for turn, number in enumerate(cast.copies(relation.subject)):
            actor, goal = cast.get(number), cast.get(goals[turn % len(goals)])
            if isinstance(actor.trajectory, Stationary):
                x, y, _ = goal.middle(0.5 * duration_s) - actor.trajectory.at(0.0).position
                path = replace(actor.trajectory, yaw=math.atan2(y, x))
                cast.put(number, replace(actor, trajectory=path))
