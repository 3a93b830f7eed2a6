"""Phrases of places that say where something goes or stands, and so must be seen to be there."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import replace

from texvent.scenes.description import ObjectMotion
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.language.meaning.referents.referent import Referent
from texvent.scenes.language.meaning.scope import Scope
from texvent.scenes.language.vocabulary.motion import ROAD_WORDS
from texvent.scenes.language.words.word import Word, link

_ABOVE = ("over", "above")
_TOWNS = frozenset({"city", "rooftop", "harbour", "forest", "village"})
_OF_STREETS = frozenset({"street", "sidewalk", "pavement", "intersection", "crossing", "junction"})
"""Words for a city at whose level one goes: a drone "over the street" is above no roofs."""
_ROADS = ("road", "dirt road", "city")
_LINED = ("lined with", "lined by")
FOLLOWED = ("followed by", "followed closely by", "closely followed by")
"""Said of what goes first."""
_IN_CLOUDS = ("in", "inside", "within", "behind")
_ASIDE = frozenset({"behind", "in front of", "beyond", "between", "below", "beneath", "under",
                    "underneath"})  # fmt: skip
"""Prepositions that put something beside a place; who is in the place is not there."""
_WIDE = frozenset({"lake", "sea", "harbour", "mountain"})
"""Places that nobody is seen to go round."""
_ATOP = frozenset({"on", "atop", "on top of", "upon"})
_TOPS = frozenset({"ridge", "cliff", "summit", "peak", "hilltop", "mountaintop", "mountain"})
"""Mountains stand around; nobody is on them."""
_RAILS = frozenset({"track", "rail", "railroad track", "train track", "railway track"})
_ON_RAILS = frozenset({"train", "steam locomotive", "tram", "subway train", "locomotive"})
_IN_THE_BACK = frozenset({"mountain"})
"""What the scene is in front of anyway."""
_BESIDE = frozenset({"beside", "next to", "near", "by", "alongside"})
_ALL_ROUND = frozenset({"plain", "underwater", "sky", "space"})
"""Places that are behind and below everything."""


def name_course(draft: Draft, word: Word, one: Referent, scope: Scope) -> None:
    """Note at a preposition before a place what it claims; the word changes.

    Args:
        draft: the objects.
        word: the preposition, after it is read.
        one: what follows it.
        scope: what the clause is about.
    """
    head = one.group.head.lemma if one.group.head is not None else ""
    if one.kind == "clouds" and word.text in _IN_CLOUDS:
        word.is_used, word.is_lost = False, True
    elif one.kind != "place":
        return
    elif _is_elsewhere(word.text, str(one.value), head, scope):
        word.is_used, word.is_lost = False, True
    elif word.text in _ATOP and one.value == "railway" and head in _RAILS:
        # The track lies behind whoever is no train.
        word.is_lost = any(draft.noun(index).name not in _ON_RAILS for index in scope.subjects)
        word.is_used = not word.is_lost
    elif word.text in _BESIDE and one.value in _ROADS and head in ROAD_WORDS and scope.subjects:
        word.course = "beside road"
        link([word], scope.subjects)
    elif word.text in _ABOVE and one.value in _TOWNS and head not in _OF_STREETS:
        # Fireworks over a city are in its sky.
        is_effect = scope.has_verb and not scope.subjects
        word.course = "" if is_effect else "over roofs"
    elif word.text == "across" and one.value in _ROADS and scope.movers:
        word.course = "across road"
        link([word], scope.movers)


def _is_elsewhere(preposition: str, place: str, head: str, scope: Scope) -> bool:
    """As in "behind a hill", "runs around a lake", "a goat on a ridge": not amid what is there."""
    if preposition in _ASIDE:
        is_before = preposition == "in front of" or not scope.subjects
        return place not in _ALL_ROUND and not (is_before and head in _IN_THE_BACK)
    if preposition == "around":
        return place in _WIDE and bool(scope.movers)
    return preposition in _ATOP and place == "mountain" and head in _TOPS and bool(scope.subjects)


def place_among(draft: Draft, word: Word, things: Sequence[int]) -> None:
    """As in "a street lined with trees": they stand in rows; the preposition changes.

    As in "lightning inside the clouds": what has no place of its own is not seen there.
    """
    if word.text in _LINED:
        word.course = "in rows"
        link([word], things)
    are_clouds = all(draft.noun(index).name == "cloud" for index in things)
    if word.text in _IN_CLOUDS and are_clouds and not word.relations:
        word.is_used, word.is_lost = False, True


def part_ways(draft: Draft, scope: Scope) -> bool:
    """As in "two cars drive in opposite directions": half of them each way; whether it is so."""
    movers = list(scope.movers)
    if len(movers) == 1:
        movers = draft.split(movers[0])
    moving = [one for one in movers if draft.objects[one].motions[-1:] and
              draft.objects[one].motions[-1].is_moving]  # fmt: skip
    for index, way in zip(moving, itertools.cycle(("right", "left")), strict=False):
        motions = draft.objects[index].motions
        motions[-1] = replace(motions[-1], direction=way)
    return len(moving) > 1


def be_followed(draft: Draft, followers: Sequence[int], scope: Scope) -> bool:
    """As in "a duck followed by three ducklings": these go behind it; whether it is read so.

    Who is followed goes, as usual where no verb says how.
    """
    leaders = list(scope.movers or scope.subjects)
    for index in leaders:
        motions, usual = draft.objects[index].motions, draft.noun(index).motion
        if not motions and not scope.has_verb and usual != "stand":
            motions.append(ObjectMotion(usual))
        if not motions or not motions[-1].is_moving:
            return False
    for index in followers:
        motions, usual = draft.objects[index].motions, draft.noun(index).motion
        if usual == "stand":
            return False
        if not motions:
            motions.append(ObjectMotion(usual, draft.objects[leaders[0]].motions[-1].direction))
    return bool(leaders) and draft.relate("follow", list(followers), leaders[:1])


def goes_so(usual: str, direction: str) -> bool:
    """Whether a bare way is a motion: "a car left"; "one hand up" and "umbrella up" go nowhere."""
    return usual in _RISING if direction in ("up", "down") else usual != "stand"


_RISING = frozenset({"fly", "hover", "float", "rise", "fall", "sink"})
