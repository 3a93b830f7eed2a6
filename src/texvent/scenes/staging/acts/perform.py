"""Binds placed actors together by the acts of a scene."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from texvent.scenes.description import RIDES, Relation, SceneDescription
from texvent.scenes.models.people.outfit import CLOTHES
from texvent.scenes.models.traits import nouns_with, trait_value
from texvent.scenes.staging.actors import Actor, Tether
from texvent.scenes.staging.acts import pushing, striking
from texvent.scenes.staging.acts.acts import (
    ACTS,
    Cast,
    foot_of,
    scaled,
    shifted,
    size_of,
)
from texvent.scenes.staging.acts.attached import HeldAt
from texvent.scenes.staging.acts.colliding import collide
from texvent.scenes.staging.acts.facing import climb_all, face_each_other, look_at
from texvent.scenes.staging.acts.holding import carried, hold, wear
from texvent.scenes.staging.acts.riding import board

_ORDER = ("push", "pull", "kick", "throw", "catch", "hit", "collide", "hold", "carry", "wear")
"""What moves bodies comes before what hangs on them."""


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
        a bicycle.
    """
    cast = Cast(actors)
    acts = [one for one in description.relations if one.kind in ACTS and one.targets]
    bound = {one for act in acts for one in (act.subject, *act.targets)}
    free = [n for n, one in enumerate(actors) if one.object_index not in bound]
    look_at(cast, description.relations, duration_s)
    face_each_other(cast, free)
    climb_all(cast, description.relations)
    ridden = {one.targets[0] for one in acts if one.kind in RIDES}
    towed = [r for r in acts if r.kind in ("push", "pull") and r.targets[0] in ridden]
    for relation in towed:
        _perform(cast, relation, duration_s)
    board(cast, acts)
    for kind in _ORDER:
        for relation in (one for one in acts if one.kind == kind and one not in towed):
            _perform(cast, relation, duration_s)
    for relation in description.relations:
        if relation.kind == "with" and relation.way == "lead":
            _perform(cast, replace(relation, kind="lead"), duration_s)
    _take_off_doubles(cast, actors)
    _take_along(cast, description.relations, actors)
    return [_tied_to_ground(actor) for actor in cast.actors()]


def _perform(cast: Cast, relation: Relation, duration_s: float) -> None:
    """An act of each subject on a target of its own."""
    subjects, targets = cast.copies(relation.subject), cast.copies(relation.targets[0])
    if relation.kind == "collide":
        met = list(dict.fromkeys([*subjects, *targets]))
        for one, two in zip(met[::2], met[1::2], strict=False):
            first, second = collide(cast.get(one), cast.get(two), duration_s)
            cast.put(one, first)
            cast.put(two, second)
        return
    if not subjects and relation.subject in cast.stood_in:
        _stow(cast, relation, cast.stood_in[relation.subject])
    others = cast.copies(relation.targets[1]) if len(relation.targets) > 1 else []
    for turn, target in enumerate(targets):
        at = subjects[turn % len(subjects)] if subjects else target
        if at != target:
            third = others[turn] if turn < len(others) else None
            _bind(cast, relation.kind, (at, target, third), duration_s)


_Act = Callable[[Actor, Actor, Actor | None, float], tuple[Actor | None, ...]]
_ACTS: Mapping[str, _Act] = {
    "push": lambda who, what, _, __: pushing.push(who, what),
    "pull": lambda who, what, _, __: pushing.pull(who, what),
    "lead": lambda who, what, _, __: pushing.lead(who, what),
    "hold": lambda who, what, _, __: hold(who, what),
    "carry": lambda who, what, _, __: hold(who, what),
    "wear": lambda who, what, _, __: wear(who, what),
    "kick": lambda who, what, _, duration_s: striking.kick(who, what, duration_s),
    "catch": lambda who, what, _, duration_s: striking.catch(who, what, duration_s),
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


def _stow(cast: Cast, relation: Relation, at: int) -> None:
    """What the rider has who comes with a vehicle's model: on its head, or where that carries."""
    vehicle, is_worn = cast.get(at), relation.kind == "wear"
    place = "head of its rider" if is_worn else "carries at"
    where = trait_value(place, vehicle.noun.name)
    for number in cast.copies(relation.targets[0]):
        thing = cast.get(number)
        if where is None or thing.noun.name in CLOTHES:
            cast.put(number, None)
            continue
        x, y, z = scaled(where, size_of(vehicle.model))
        path = HeldAt(vehicle, "ground", shifted(x, y, z + foot_of(thing)))
        cast.put(number, carried(thing, path, vehicle))


def _take_off_doubles(cast: Cast, actors: Sequence[Actor]) -> None:
    """A piano, a desk or a board that comes with an activity is not shown twice."""
    for person in cast.actors():
        nouns = {noun for prop in person.props if prop.anchor == "ground" or prop.is_own
                 for noun in prop.nouns}  # fmt: skip
        for number, thing in enumerate(actors):
            if thing.noun.name in nouns and thing.object_index != person.object_index:
                cast.put(number, None)
                nouns.discard(thing.noun.name)


def _take_along(cast: Cast, relations: Sequence[Relation], before: Sequence[Actor]) -> None:
    """What is in or on something that an act has moved goes with it."""
    for relation in relations:
        holders = cast.copies(relation.targets[0])
        if relation.kind not in ("in", "on") or not holders:
            continue
        for turn, at in enumerate(cast.copies(relation.subject)):
            number = holders[turn % len(holders)]
            holder, own = cast.get(number), cast.get(at)
            was = before[number].trajectory
            if holder.trajectory is was or own.trajectory is not before[at].trajectory:
                continue
            state, below = own.trajectory.at(0.0), was.at(0.0).to_world()
            turned = below[:, :3].T
            offset = turned @ (state.to_world() - np.column_stack([np.zeros((3, 3)), below[:, 3]]))
            path = HeldAt(holder, "ground", offset, activity=state.activity)
            cast.put(at, carried(own, path, holder))


def _tied_to_ground(actor: Actor) -> Actor:
    """A kite that no person holds is flown from out of the picture."""
    if actor.noun.name not in nouns_with("flies on a string") or actor.tether is not None:
        return actor
    x, y, z = actor.trajectory.at(0.0).position
    flier = (x + 0.8 * z, y - 1.2 * z, 0.0)
    return replace(actor, tether=Tether(flier, "", (0.0, 0.0, 0.0), 0.008))
