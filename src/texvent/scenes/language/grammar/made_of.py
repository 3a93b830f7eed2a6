"""Materials after their thing: "a ball made of steel" is a steel ball."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.language.words.english import Pos
from texvent.scenes.language.words.lexicon import Lexicon, Role
from texvent.scenes.language.words.tokens import Token

_FROM = (["of"], ["from"], ["out", "of"])
_IN_GROUP = (Role.NOUN, Role.COLOUR, Role.MATERIAL, Role.SIZE)


def bring_materials_forward(tokens: Sequence[Token], known: Lexicon) -> list[Token]:
    """The tokens with "made of red plastic" before its thing, as adjectives, without "made of"."""
    found = list(tokens)
    for at in range(len(found) - 2, 0, -1):
        texts = [one.text for one in found]
        if texts[at] != "made":
            continue
        way = next((one for one in _FROM if texts[at + 1 : at + 1 + len(one)] == one), None)
        first = at + 1 + len(way or ())
        last = _end_of_material(texts, first, known) if way else first
        thing = _start_of_group(texts, at, known)
        if last > first and thing < at:
            found[thing:last] = [*found[first:last], *found[thing:at]]
    return found


def _end_of_material(texts: Sequence[str], first: int, known: Lexicon) -> int:
    """Behind the material that begins there, colours before it; the same place if none does."""
    for last in range(first, len(texts)):
        roles = _roles(texts[last], known)
        if Role.MATERIAL in roles:
            return last + 1
        if Role.COLOUR not in roles:
            break
    return first


def _start_of_group(texts: Sequence[str], at: int, known: Lexicon) -> int:
    """Where the adjectives and nouns that end before a place begin."""
    while at and _roles(texts[at - 1], known) & {*_IN_GROUP}:
        at -= 1
    return at


def _roles(text: str, known: Lexicon) -> set[Role]:
    return {one.role for one in known.find([text])[1] if one.pos in (Pos.NOUN, Pos.ADJECTIVE)}
