"""Words that mean many things at once: traffic, a busy street, drifting leaves."""

from __future__ import annotations

from dataclasses import replace

from texvent.scenes.description import CREEPING_M_S, ObjectMotion
from texvent.scenes.language.grammar.syntax import NounGroup
from texvent.scenes.language.meaning.draft import Draft, PartialObject
from texvent.scenes.language.words.english import Pos
from texvent.scenes.language.words.lexicon import Role
from texvent.scenes.language.words.word import Word, mark_used
from texvent.scenes.models.kinds.people import TRAFFIC

AIRBORNE = frozenset({"blow", "fall", "swirl", "fly", "drift", "float", "flutter", "whirl"})
"""What leaves and feathers do in the air."""
DRIFTING = {"leaf": "leaves", "feather": "feathers", "soap bubble": "bubbles"}
"""Noun → the effect that many of them in the air are."""
_JAMS = frozenset({"traffic jam", "jam"})
"""Words for traffic that stands."""


def find_drifting(group: NounGroup, verb: str) -> str | None:
    """As in "leaves blow in the wind", "soap bubbles": many that drift through the air.

    Args:
        group: what is named.
        verb: verb of its clause.

    Returns:
        The effect; None where they are things.
    """
    meaning = group.head_word.read_as(Role.NOUN)
    if meaning is None or not meaning.is_plural:
        return None
    said = [word for word in group.modifiers if word.lemma in AIRBORNE]
    if meaning.value != "soap bubble" and verb not in AIRBORNE and not said:
        return None
    kind = DRIFTING.get(str(meaning.value))
    mark_used(said if kind is not None else ())
    return kind


def add_traffic(draft: Draft, head: Word) -> list[int]:
    """As in "highway traffic": vehicles that drive both ways; returns the new objects."""
    kind = str((head.read_as(Role.NOUN) or head.meaning).value)
    found = _add_vehicles(draft, kind, head.lemma)
    head.is_used = bool(found)
    return found


def hold_up_traffic(draft: Draft) -> None:
    """As in "a bus waits in traffic", "a traffic jam": all stand in the lanes of a road."""
    traffic = [one for one in draft.objects if one.traffic]
    waiting = [
        draft.objects[one.subject]
        for one in draft.relations
        if one.kind == "in"
        and any(
            draft.objects[target].traffic in _JAMS
            or (
                draft.objects[target].traffic
                and draft.objects[one.subject].motions[-1:] == [ObjectMotion("stand")]
            )
            for target in one.targets
        )
        and draft.noun(one.subject).motion == "drive"
    ]
    for item in traffic:
        if waiting or item.traffic in _JAMS:
            item.motions = [replace(item.motions[-1], speed_m_s=CREEPING_M_S, is_stuck=True)]
    for item in waiting:
        item.motions = [ObjectMotion("drive", "right", speed_m_s=CREEPING_M_S, is_stuck=True)]
    # All vehicles of a road are in its traffic.
    draft.relations[:] = [
        one for one in draft.relations
        if one.kind != "in" or not any(draft.objects[i].traffic for i in one.targets)
    ]  # fmt: skip


def _add_vehicles(draft: Draft, kind: str, said: str = "") -> list[int]:
    found = []
    for noun, count, way in TRAFFIC[kind] if "car" in draft.nouns else ():
        motion = ObjectMotion("drive", way)
        vehicles = PartialObject(noun, count, count > 1, motions=[motion], traffic=said or kind)
        index = draft.add(vehicles)
        if index is not None:
            found.append(index)
    return found


CROWDED = frozenset({"crowded", "busy", "bustling", "packed"})
"""Adjectives of a place that is full of people, or of traffic."""
_PASSERS = 6
_ROADS = frozenset({"road", "motorway"})
_EMPTY = frozenset({"sky", "space", "sea", "underwater", "lake", "river", "mountain", "forest"})


def add_passers(draft: Draft, group: NounGroup) -> None:
    """As in "a crowded square", "a busy road": people who walk there, or traffic."""
    said = next((word for word in group.modifiers if word.text in CROWDED), None)
    place = group.head_word.read_as(Role.PLACE)
    if said is None or said.is_used or place is None or place.value in _EMPTY:
        return
    if place.value in _ROADS and "car" in draft.nouns:
        found, shown = _add_vehicles(draft, "traffic"), "traffic"
    elif "person" in draft.nouns:
        walk = [ObjectMotion("walk")]
        index = draft.add(PartialObject("person", _PASSERS, True, motions=walk))
        found, shown = ([] if index is None else [index]), f"{_PASSERS} people who walk"
    else:
        return
    said.is_used, said.shown_as = bool(found), shown


def name_kind_before(group: NounGroup, noun: str) -> None:
    """As in "a humpback whale", "an oak tree": the word before says which kind.

    Args:
        group: of a thing that is shown; words before its head change.
        noun: what its head is shown as.
    """
    for word in group.modifiers:
        kind = word.read_as(Role.NOUN) if word.pos is Pos.NOUN else None
        if kind is not None and kind.value == noun:
            word.is_used = True
            word.shown_as = noun if kind.is_substitute else None
