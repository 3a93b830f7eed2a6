"""Small things that the prompt puts nowhere: on a table before the people, not on the floor."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from texvent.scenes.description import Relation, SceneDescription, SceneObject
from texvent.scenes.models.nouns import FAMILIES
from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.models.protocol import Noun
from texvent.scenes.staging.placement.fitting import extent

_FAMILIES = (
    "objects kitchen food", "objects kitchen tableware", "objects home electronics",
    "objects home personal", "objects home small things", "objects household",
    "objects work tools", "objects play toys", "objects home screens", "objects kitchen appliances",
)  # fmt: skip
_SMALL = frozenset(noun.name for name in _FAMILIES for noun in FAMILIES[name])
_LARGEST_M = 0.45
_NOT_ON_TABLES = frozenset({"campfire", "torch", "soap bubble", "paper plane", "water balloon",
                            "feather", "toy train", "poster", "sign", "rope", "chain"})  # fmt: skip
TABLES = ("table", "desk", "chest of drawers")
"""What small things are put on, the first that is there."""
_MOST = 6
"""Kinds of things, and copies in all, that find room on a table."""
_LOOSE = frozenset({"beside", "with", "past", "towards", "from", "away from"})
"""Relations of a small thing that leave open where it is."""


def set_on_table(description: SceneDescription, nouns: Mapping[str, Noun]) -> SceneDescription:
    """The description with small things on a table, in scenes with people.

    A table that the prompt names takes them, else one is added at the end of the objects, before
    the first of the people. Things that move, that a relation places or that an act uses stay as
    they are.
    """
    objects = description.objects
    people = [n for n, one in enumerate(objects) if one.noun in PERSON_NOUNS]
    bound = {
        index
        for one in description.relations
        if one.kind not in _LOOSE
        for index in (one.subject, *one.targets)
    }
    bound |= {one.source for one in description.effects if one.source is not None}
    loose = [n for n, one in enumerate(objects) if n not in bound and _is_small(one, nouns)]
    if not people or not loose or _has_way(objects[people[0]]):
        return description
    if (
        any(move.kind == "travel" for move in description.shot.moves)
        or "table" in description.absent
    ):
        return description
    chosen: list[int] = []
    for index in loose:
        if sum(objects[n].count for n in (*chosen, index)) <= _MOST:
            chosen.append(index)
    table = _find_table(objects)
    added: tuple[Relation, ...] = ()
    if table is None:
        table, objects = len(objects), (*objects, SceneObject("table"))
        added = (Relation("front", table, (people[0],)),)
    kept = [one for one in description.relations if not {one.subject, *one.targets} & set(chosen)]
    on = [Relation("on", index, (table,)) for index in chosen]
    return replace(description, objects=objects, relations=(*kept, *added, *on))


def _is_small(one: SceneObject, nouns: Mapping[str, Noun]) -> bool:
    is_named = one.noun in _SMALL and one.noun not in _NOT_ON_TABLES and one.side is None
    is_still = one.motion is None or one.motion.kind in ("stand", "lie", "sit")
    is_free = is_named and is_still and not one.then and one.count <= _MOST
    return is_free and extent(one, nouns) <= _LARGEST_M


def _has_way(one: SceneObject) -> bool:
    """Whether it moves on: a table would be left behind."""
    return any(motion is not None and motion.is_moving for motion in (one.motion, *one.then))


def _find_table(objects: Sequence[SceneObject]) -> int | None:
    for noun in TABLES:
        for index, one in enumerate(objects):
            if one.noun == noun and one.count == 1:
                return index
    return None
