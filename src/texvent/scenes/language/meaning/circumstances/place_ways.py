"""Ways to and from places and things: "runs into the sea"; "out of the ring" is not shown."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from texvent.scenes.description import ObjectMotion
from texvent.scenes.language.meaning.capabilities import is_living, is_person
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.language.meaning.referents.referent import Referent
from texvent.scenes.language.meaning.scope import Scope
from texvent.scenes.language.vocabulary.motion import (
    NO_WAYS,
    ROAD_WORDS,
    SHORE_WAYS,
    SHORES,
    SLOPES,
)
from texvent.scenes.language.words.word import Word, mark_used

_CLIMBED = ("trail", "path", "footpath", "track", "drive", "driveway")
"""What goes "up" rises, though one walks "down" a level one; one drives up a level street."""
_SLOPING = frozenset({"mountain", "mountains", "mountainous", "hill", "hills", "hilly", "steep",
                      "hillside", "mountainside", "sloping", "sloped", "alpine"})  # fmt: skip
"""Words that say that a road or a path goes up or down."""
_OPEN = frozenset({"sky", "space", "underwater"})
"""Places into which one rises or dives."""
_ON_LAND = frozenset({"walk", "run", "move", "jump", "crawl", "roll", "slide", "drive"})


_WITHIN = ("in", "through")
_BATHED_IN = SHORES - {"harbour"}
"""Places in whose water one stands or walks."""
_WADING = _ON_LAND | {"stand", "sit"}
BESIDE = ("near", "next to", "beside", "in front of", "behind")
"""Prepositions of what is outside of a place."""
_EDGED = SHORES | SLOPES | {
    "road", "dirt road", "city", "river", "mountain", "motorway", "railway", "race track", "runway",
    "cliffs", "falls", "forest", "driveway",
}  # fmt: skip
"""Places that one sees from beside them."""
_OPENINGS = frozenset({"window", "door", "gate", "tunnel", "arch", "box", "basket", "bucket"})
"""Out of what one comes."""


def is_outside(word: Word, one: Referent) -> bool:
    """Whether a preposition puts things beside a place that is shown all around them.

    As in "stands near the baseball field".
    """
    return one.kind == "place" and word.text in BESIDE and str(one.value) not in _EDGED


def is_somewhere(one: Referent) -> bool:
    """A background is behind whatever is there."""
    return one.kind == "place" and one.value != "plain"


def lifts_off(draft: Draft, movers: Sequence[int], target: int) -> bool:
    """As in "lifts off from a table": they are on the table first."""
    is_first = all(len(draft.objects[index].motions) == 1 for index in movers)
    noun = draft.noun(target)
    return is_first and _rise(draft, movers) and not (is_person(noun) or noun.name in _OPENINGS)


def _rise(draft: Draft, movers: Sequence[int]) -> bool:
    """As in "takes off from the beach": they begin on the ground, which is there."""
    motions = [draft.objects[index].motions for index in movers]
    return bool(motions) and all(one and one[-1].kind == "rise" for one in motions)


_OUT_OF = ("from", "out of")


def _leap(draft: Draft, movers: Sequence[int]) -> bool:
    """As in "a fish jumps out of the water": what lives there does so by itself."""
    return bool(movers) and all(
        draft.noun(index).habitat == "water"
        and any(one.kind == "jump" for one in draft.objects[index].motions)
        for index in movers
    )


def _wade(draft: Draft, members: Sequence[int]) -> None:
    """As in "stands in a lake": in the water, not on its shore."""
    for index in members:
        motions, noun = draft.objects[index].motions, draft.noun(index)
        is_on_foot = noun.habitat == "ground" and noun.motion in ("walk", "run")
        if not is_on_foot and not (noun.habitat == "air" and is_living(noun)):
            continue
        if not motions:
            motions.append(ObjectMotion("stand", shore="in"))
        elif motions[-1].kind in _WADING and motions[-1].shore is None:
            motions[-1] = replace(motions[-1], shore="in")


_ON_WATER = ("in", "on", "down", "along", "across", "through")
_AFLOAT, _FLOATING_PACE = ("hover", "drift", "move", "slide", "fly"), 0.6


def _set_afloat(draft: Draft, word: Word, place: str, scope: Scope) -> None:
    """As in "a bottle floats down a river": things drift on the water, not in the air above it."""
    is_on_water = word.text in _ON_WATER and place in (*_BATHED_IN, "sea")
    floats = is_on_water and scope.verb in ("float", "drift", "bob")
    for index in scope.movers if floats else ():
        motions, noun = draft.objects[index].motions, draft.noun(index)
        is_thing = noun.habitat == "fixed" or noun.motion == "roll"
        if not is_thing or not motions or motions[-1].kind not in _AFLOAT:
            continue
        way = motions[-1].direction
        motions[-1] = ObjectMotion("slide", way, motions[-1].pace * _FLOATING_PACE, shore="in")


def go_to(draft: Draft, word: Word, one: Referent, scope: Scope) -> bool:
    """Let those who move go to the water of a place, or come from it.

    Args:
        draft: what they do is changed.
        word: the preposition.
        one: the place.
        scope: what the clause is about.

    Returns:
        False where the preposition says a way that is not shown.
    """
    place = str(one.value)
    _set_afloat(draft, word, place, scope)
    if word.text in ("up", "down"):
        is_sloping = place in SLOPES or any(each.text in _SLOPING for each in one.group.words)
        is_sloping |= word.text == "up" and one.group.head is not None and (
            one.group.head.lemma in _CLIMBED
        )  # fmt: skip
        return not is_sloping or not scope.movers
    if word.text in _WITHIN and place in _BATHED_IN:
        _wade(draft, scope.movers or scope.subjects)
    if word.text not in NO_WAYS or place in _OPEN or not (scope.movers or scope.subjects):
        return True
    if word.text in ("from", "off") and _rise(draft, scope.movers):
        return True
    if word.text in _OUT_OF and place in SHORES and _leap(draft, scope.movers):
        return True
    if scope.acted_on:
        return False  # "pulls a fish out of the water": not who pulls comes out
    way = SHORE_WAYS.get(word.text)
    if way is None or place not in SHORES:
        return False
    is_led = False
    for index in scope.movers:
        motions = draft.objects[index].motions
        kind = motions[-1].kind if motions else ""
        is_bound = draft.noun(index).habitat == "ground" or kind == "crawl"
        if is_bound and kind in _ON_LAND:
            motions[-1] = replace(motions[-1], shore=way[0], direction=way[1])
            is_led = True
    return is_led


def put_on_road(draft: Draft, word: Word, one: Referent, scope: Scope) -> None:
    """As in "a deer stands in the lane", "sheep walk down a road": on it, not beside it."""
    head = one.group.head
    is_along = word.text in ("down", "along", "up")
    if not (is_along or word.text in ("in", "on")) or head is None or head.lemma not in ROAD_WORDS:
        return
    for index in scope.subjects:
        item, noun = draft.objects[index], draft.noun(index)
        may_be = not (is_along and is_person(noun)) and noun.motion != "drive"
        if item.side is None and may_be:
            item.side = "lane"


_BY_CAMERA = {"towards": "towards", "toward": "towards", "to": "towards", "past": "across",
              "from": "away", "at": "towards"}  # fmt: skip


def go_by_camera(draft: Draft, word: Word, one: Referent, scope: Scope) -> None:
    """As in "walks towards the camera"; "in front of the camera" is wherever it looks."""
    if word.text == "in front of" and (scope.movers or scope.subjects):
        mark_used([word, *one.group.words])
        return
    direction = _BY_CAMERA.get(word.text)
    for index in scope.movers if direction is not None else ():
        motions = draft.objects[index].motions
        if motions:
            motions[-1] = replace(motions[-1], direction=direction)
            mark_used([word, *one.group.words])
