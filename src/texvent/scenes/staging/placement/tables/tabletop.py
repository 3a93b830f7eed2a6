"""Small things that the prompt puts nowhere: in a hand or on a table, not on the floor."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from texvent.scenes.description import Relation, SceneDescription, SceneObject
from texvent.scenes.models.nouns import FAMILIES
from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.models.people.props import PROPS
from texvent.scenes.models.places import is_room
from texvent.scenes.models.protocol import Noun
from texvent.scenes.staging.acts.holding import WORN
from texvent.scenes.staging.placement.fitting import extent
from texvent.scenes.staging.trajectories.phases import PATH_KINDS

_FAMILIES = (
    "objects kitchen food", "objects kitchen dishes", "objects kitchen tableware",
    "objects home electronics",
    "objects home personal", "objects home small things", "objects household",
    "objects work tools", "objects play toys", "objects home screens",
    "objects kitchen appliances", "objects sport gear", "objects home lights",
)  # fmt: skip
_SMALL = frozenset(noun.name for name in _FAMILIES for noun in FAMILIES[name])
_LARGEST_M = 0.45
_AT_DESK = frozenset({"monitor", "laptop", "keyboard", "computer mouse", "printer"})
"""Computers and what belongs to them; several stand on a desk."""
_SCREEN_M = 0.8
_APPLIANCES = frozenset({"microwave", "toaster", "coffee machine", "blender", "tv", "typewriter"})
"""What strangers miss a table under, where it stands on the floor of a room."""
_APPLIANCE_M = 1.3
_ON_DESKS = _AT_DESK | _APPLIANCES
_NOT_ON_TABLES = frozenset({
    "campfire", "torch", "soap bubble", "paper plane", "water balloon", "feather", "toy train",
    "rubber duck", "paper boat", "dart", "ice skate", "roller skate", "poster", "sign", "rope",
    "chain", *WORN,
})  # fmt: skip
_SPORT = frozenset({"gym", "sports hall", "stadium", "ice rink", "swimming pool", "court"})
"""Places in which no table is added."""
TABLES = ("table", "desk", "chest of drawers")
"""What small things are put on, the first that is there; of several, one each."""
_MOST = 6
"""Kinds of things, and copies in all, that find room on a table."""
_LOOSE = frozenset({"beside", "with", "past", "towards", "from", "away from"})
"""Relations of a small thing that leave open where it is."""


def set_on_table(description: SceneDescription, nouns: Mapping[str, Noun]) -> SceneDescription:
    """The description with small things in a hand or on a table.

    Without people they go on the table only where the prompt names one.

    A single thing goes into the hand of who is named before it, and who has nothing in hand. Others
    go on a table: the first that the prompt names, else one that is added at the end of the
    objects, before the first of the people, but only inside: outdoors they lie on the ground. What
    is on or in another small thing stays there. Things that move, that a relation places or that
    an act uses stay as they are.
    """
    objects = description.objects
    people = [n for n, one in enumerate(objects) if one.noun in PERSON_NOUNS]
    loose = _list_loose(description, nouns)
    if any(move.kind == "travel" for move in description.shot.moves):
        return description
    if not people:
        return _lay(description, loose, nouns)
    loaded = {i for one in description.relations for i in (one.subject, *one.targets)}
    held: list[Relation] = []
    for index in loose:
        person = max((n for n in people if n < index), default=None)
        taken = loaded | {one.subject for one in held}
        if person is None or person in taken or index in taken:
            continue
        if objects[index].count == objects[person].count == 1 and _has_free_hands(objects[person]):
            held.append(Relation("hold", person, (index,)))
    description = replace(description, relations=(*description.relations, *held))
    in_hand = {one.targets[0] for one in held}
    rest = [index for index in loose if index not in in_hand]
    if not rest or _has_way(objects[people[0]]) or "table" in description.absent:
        return description
    place = description.surroundings.place or "grass"
    is_inside = is_room(place) and place not in _SPORT
    if _find_table(objects) is None and not is_inside:
        return description
    return _add_table(description, rest, people[0], nouns)


def _lay(
    description: SceneDescription, loose: Sequence[int], nouns: Mapping[str, Noun]
) -> SceneDescription:
    """The description with small things on the table that it names, as in a still life."""
    table = _find_table(description.objects)
    if table is None and loose and _needs_desk(description, loose):
        return _add_table(description, loose, None, nouns)
    is_led_away = table is None or any(
        one.kind not in _LOOSE and table in (one.subject, *one.targets) and one.kind != "on"
        for one in description.relations
    )
    return description if is_led_away or not loose else _add_table(description, loose, 0, nouns)


def _needs_desk(description: SceneDescription, loose: Sequence[int]) -> bool:
    """Whether an appliance or several computers would stand on the floor of a room."""
    objects = description.objects
    some = [objects[index] for index in loose if objects[index].noun in _ON_DESKS]
    needs = sum(one.count for one in some) > 1 or any(one.noun in _APPLIANCES for one in some)
    place = description.surroundings.place or "grass"
    is_free = not {"table", "desk"} & set(description.absent)
    return needs and is_room(place) and is_free


def _add_table(
    description: SceneDescription,
    loose: Sequence[int],
    person: int | None,
    nouns: Mapping[str, Noun],
) -> SceneDescription:
    """`person` is whom an added table stands before; None = a desk for what stands there alone."""
    objects = description.objects
    chosen: list[int] = []
    for index in loose:
        if sum(objects[n].count for n in (*chosen, index)) <= _MOST:
            chosen.append(index)
    table = _find_table(objects)
    added: tuple[Relation, ...] = ()
    if table is None:
        is_desk = person is None and any(objects[index].noun in _AT_DESK for index in chosen)
        kind = "desk" if is_desk else "table"
        table, objects = len(objects), (*objects, SceneObject(kind))
        added = (Relation("front", table, (person,)),) if person is not None else ()
    kept = [
        one
        for one in description.relations
        if one.kind not in _LOOSE or not {one.subject, *one.targets} & set(chosen)
    ]
    on = [Relation("on", index, (table,)) for index in chosen]
    notes = description.notes
    if table == len(description.objects):
        names = ", ".join(dict.fromkeys(objects[index].noun for index in chosen))
        notes = (*notes, f"a {objects[table].noun} is added, on which is: {names}")
    description = replace(description, relations=(*kept, *added, *on), notes=notes)
    if any(objects[index].noun in _ON_DESKS for index in chosen):
        objects = _widen(objects, table, description.relations, nouns)
    return replace(description, objects=objects)


def _widen(
    objects: Sequence[SceneObject],
    table: int,
    relations: Sequence[Relation],
    nouns: Mapping[str, Noun],
) -> tuple[SceneObject, ...]:
    """The objects with a desk that has room for all that stands on it in a row."""
    wide = sum(
        objects[one.subject].count * _width(objects[one.subject], nouns)
        for one in relations if one.kind == "on" and one.targets == (table,)
    )  # fmt: skip
    factor = min(max(_ROOM_BESIDE * wide / _width(objects[table], nouns), 1.0), _WIDEST_DESK)
    larger = replace(objects[table], scale=factor * objects[table].scale)
    return (*objects[:table], larger, *objects[table + 1 :])


_ROOM_BESIDE, _WIDEST_DESK = 1.25, 1.7


def _width(one: SceneObject, nouns: Mapping[str, Noun]) -> float:
    return nouns[one.noun].build(colour=None, scale=one.scale, seed=0).width


def _list_loose(description: SceneDescription, nouns: Mapping[str, Noun]) -> list[int]:
    """Small things that no relation and no act places, but for others that are on or in them.

    A book that one reads is in the reader's hands.
    """
    objects = description.objects
    is_alone = not any(one.noun in PERSON_NOUNS for one in objects)
    small = {n for n, one in enumerate(objects) if _is_small(one, nouns, is_alone=is_alone)}
    in_use = {
        noun for one in objects if one.noun in PERSON_NOUNS
        for motion in (one.motion, *one.then) if motion is not None
        for prop in PROPS.get(motion.kind, ()) for noun in prop.nouns
    }  # fmt: skip
    small = {n for n in small if objects[n].noun not in in_use}
    bound = {one.source for one in description.effects if one.source is not None}
    for one in description.relations:
        if one.kind in _LOOSE and not one.way:
            continue
        ends = {one.subject, *one.targets}
        is_stack = one.kind in ("on", "in") and ends <= small
        bound |= {one.subject} if is_stack else ends
    return sorted(small - bound)


def _has_free_hands(one: SceneObject) -> bool:
    kinds = {motion.kind for motion in (one.motion, *one.then) if motion is not None}
    return kinds <= {"stand", "walk", "sit", "talk", "run"}


def _is_small(one: SceneObject, nouns: Mapping[str, Noun], *, is_alone: bool) -> bool:
    """Whether it belongs on a table; a screen does where it hides nobody who sits at it."""
    is_named = one.noun in _SMALL and one.noun not in _NOT_ON_TABLES and one.side is None
    is_still = one.motion is None or one.motion.kind in ("stand", "lie", "sit")
    is_free = is_named and is_still and not one.then and one.count <= _MOST
    most = _LARGEST_M
    if is_alone and one.noun in _ON_DESKS:
        most = _APPLIANCE_M if one.noun in _APPLIANCES else _SCREEN_M
    return is_free and extent(one, nouns) <= most


def _has_way(one: SceneObject) -> bool:
    """Whether it moves on: a table would be left behind."""
    return any(
        motion is not None and motion.kind in PATH_KINDS for motion in (one.motion, *one.then)
    )


def is_added(description: SceneDescription, index: int) -> bool:
    """Whether it is a table that the prompt does not name, under things that it names."""
    return description.objects[index].noun in TABLES


def _find_table(objects: Sequence[SceneObject]) -> int | None:
    for noun in TABLES:
        for index, one in enumerate(objects):
            if one.noun == noun and one.count == 1:
                return index
    return None
