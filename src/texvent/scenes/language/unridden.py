"""Bicycles that nobody rides, cars with somebody in them, birds that fly: models of their own."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from texvent.scenes.description import RIDES, STANDING, SceneDescription
from texvent.scenes.language.vocabulary.acts import BOARDS
from texvent.scenes.models.protocol import Noun

HAS_RIDER = frozenset({"bicycle", "motorcycle"})
"""Nouns whose models come with the person who rides them."""
_ABOARD = (*RIDES, "in")
"""Relations of who is to be seen in a car: it has no roof then."""
_IN_AIR = frozenset({"fly", "hover", "rise", "orbit", "sink"})
_RIDERS = frozenset({"cyclist", "bicyclist", "motorcyclist", "biker"})
"""Words for who rides them."""


def _list_ridden(description: SceneDescription) -> set[int]:
    """Objects that have a rider: one who rides them, or "a cyclist"; what collides has one."""
    ridden = {
        target
        for relation in description.relations
        if relation.kind in RIDES
        for target in relation.targets
    }
    return ridden | {one.subject for one in description.relations if one.kind == "collide"}


def leave_unridden(description: SceneDescription) -> SceneDescription:
    """A bicycle of which nothing is said but how it looks stands there: nobody rides it.

    Boards do so wherever they are.
    """
    ridden = _list_ridden(description)
    is_plain = description.surroundings.place is None and not description.shot.is_moving
    resting = BOARDS | (HAS_RIDER if is_plain else frozenset())
    objects = tuple(
        replace(one, motion=STANDING)
        if one.noun in resting and one.motion is None and index not in ridden
        else one
        for index, one in enumerate(description.objects)
    )
    return replace(description, objects=objects)


def park(description: SceneDescription, nouns: Mapping[str, Noun]) -> SceneDescription:
    """Bicycles and motorcycles that only stand there have no rider; an owl that flies has wings.

    A car with somebody in it is an open one.
    """
    ridden = _list_ridden(description)
    objects = list(description.objects)
    for index, one in enumerate(objects):
        is_parked = one.noun in HAS_RIDER and one.motion == STANDING and not one.then
        if is_parked and index not in ridden and f"parked {one.noun}" in nouns:
            objects[index] = replace(one, noun=f"parked {one.noun}")
        kinds = {motion.kind for motion in (one.motion, *one.then) if motion is not None}
        if kinds & _IN_AIR and f"flying {one.noun}" in nouns:
            objects[index] = replace(one, noun=f"flying {one.noun}")
    for relation in description.relations:
        rider = nouns[objects[relation.subject].noun]
        for index in relation.targets if relation.kind in _ABOARD else ():
            if objects[index].noun == "car" and rider.motion == "walk" and "open car" in nouns:
                objects[index] = replace(objects[index], noun="open car")
    return replace(description, objects=tuple(objects))
