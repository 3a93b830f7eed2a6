"""Forms of English nouns and verbs."""

from __future__ import annotations

import re

_VOWELS = "aeiou"
_IRREGULAR = {
    "person": "people", "child": "children", "leaf": "leaves", "wolf": "wolves", "calf": "calves",
    "shelf": "shelves", "bookshelf": "bookshelves", "knife": "knives", "mouse": "mice",
    "potato": "potatoes", "tomato": "tomatoes", "mosquito": "mosquitoes", "volcano": "volcanoes",
    "hero": "heroes",
    "goose": "geese", "ox": "oxen", "scissors": "scissors", "wife": "wives",
    "midwife": "midwives",
}  # fmt: skip
_UNCHANGED = ("fish", "sheep", "deer", "moose", "bison", "squid", "salmon", "tuna", "trout", "cod")
"""Ends of nouns whose plural is the same word."""

_SINGULAR = ("ss", "us", "is", "as", "lens")
"""Ends of singular nouns in s; others in s are plurals: "stairs", "headphones"."""


def list_plurals(noun: str) -> tuple[str, ...]:
    """Plurals of a noun of one or more words, the usual one first.

    Example:
        >>> list_plurals("traffic cone"), list_plurals("bus"), list_plurals("snow goose")
        (('traffic cones',), ('buses', 'busses'), ('snow geese', 'snow gooses'))
    """
    first, last = noun[: noun.rfind(" ") + 1], noun.split()[-1]
    is_plural = last.endswith("s") and not last.endswith(_SINGULAR)
    usual = noun if is_plural or last.endswith(_UNCHANGED) else None
    usual = f"{first}{_IRREGULAR[last]}" if last in _IRREGULAR else usual
    regular = _list_regular_plurals(noun)
    return regular if usual is None else (usual, *(one for one in regular if one != usual))


def _list_regular_plurals(noun: str) -> tuple[str, ...]:
    if noun.endswith("s"):
        return (f"{noun}es", f"{noun}ses")
    if noun.endswith(("x", "z", "ch", "sh")):
        return (f"{noun}es",)
    if noun.endswith("y") and noun[-2:-1] not in _VOWELS:
        return (f"{noun[:-1]}ies",)
    if noun.endswith("f"):
        return (f"{noun}s", f"{noun[:-1]}ves")
    if noun.endswith("o"):
        return (f"{noun}s", f"{noun}es")
    if noun.endswith("man"):
        return (f"{noun[:-2]}en",)
    return (f"{noun}s",)


def _third_person(verb: str) -> str:
    """As "flies", "crosses"."""
    if verb.endswith(("s", "x", "z", "ch", "sh", "o")):
        return f"{verb}es"
    return f"{verb[:-1]}ies" if _ends_in_y(verb) else f"{verb}s"


def _ends_in_y(verb: str) -> bool:
    return verb.endswith("y") and verb[-2:-1] not in _VOWELS


def list_verb_forms(verb: str, irregular: str = "") -> list[tuple[str, str]]:
    """Forms of a verb, each with its name.

    Args:
        verb: its base form.
        irregular: its form in -ing and those of the past, if they are not regular.

    Example:
        >>> list_verb_forms("carry")
        [('carry', 'base'), ('carries', 's'), ('carrying', 'ing'), ('carried', 'ed')]
        >>> list_verb_forms("stop")[2:]
        [('stopping', 'ing'), ('stopped', 'ed')]
    """
    stem = verb[:-1] if verb.endswith("e") and not verb.endswith("ee") else verb
    if re.fullmatch(r"[^aeiou]+[aeiou][^aeiouwxy]", verb):  # "stop", "stopping"
        stem += verb[-1]
    past = f"{verb[:-1]}ied" if _ends_in_y(verb) else f"{stem}ed"
    present, *pasts = irregular.split() or (f"{stem}ing", past)
    forms = [(verb, "base"), (_third_person(verb), "s"), (present, "ing")]
    return [*forms, *((one, "ed") for one in pasts)]
