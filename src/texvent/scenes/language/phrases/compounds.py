"""Nouns that are written apart: "suit case", "side walk"."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.language.vocabulary.objects import COLOURS, SIZES
from texvent.scenes.language.words.lexicon import Lexicon, Role
from texvent.scenes.language.words.tokens import Token

_LAST = frozenset(
    """
    case cases book books brush brushes walk walks mill mills boat boats ball balls road roads top
    tops fly flies flower flowers glasses apple apples tub tubs room rooms board boards place places
    gull gulls chair chairs bag bags pack packs shelf shelves way ways scraper scrapers plane planes
    cycle cycles craft yard yards berry berries melon melons cake cakes wear hopper card cards side
    sides
    """.split()  # noqa: SIM905
)
"""Second parts of nouns that people write as two words."""
_SIZES = frozenset(text for texts in SIZES.values() for text in texts)
_NO_FIRST = frozenset(
    {*COLOURS, *_SIZES, "the", "a", "an", "and", "in", "on", "of", "hot", "light"}
)


_SETTINGS = frozenset({"scene", "setting", "area", "environment", "landscape", "scenery"})
"""Nouns after a place that add nothing to it: "an ocean scene"."""


def _is_place(tokens: Sequence[Token], at: int, known: Lexicon) -> bool:
    """Whether a token names a place alone, and the next is not known with it."""
    texts = [token.text for token in tokens[at : at + 3]]
    is_plain = tokens[at].sense is None and tokens[at].said is None
    if not is_plain or known.find(texts)[0] > 1 or tokens[at + 1].text in _NO_FIRST:
        return False
    return bool(known.find(texts[:1])[1]) and known.find(texts[:1])[1][0].role is Role.PLACE


def join_compounds(tokens: Sequence[Token], known: Lexicon) -> list[Token]:
    """The tokens with two that are one known noun as one, reported as they are written."""
    found: list[Token] = []
    at = 0
    while at < len(tokens):
        joined = _join(tokens, at, known)
        found.append(tokens[at] if joined is None else joined)
        at += 1 if joined is None else 2
    return found


def _join(tokens: Sequence[Token], at: int, known: Lexicon) -> Token | None:
    pair = tokens[at : at + 2]
    if len(pair) == 2 and pair[1].text in _SETTINGS and _is_place(tokens, at, known):
        return Token(pair[0].text, pair[0].written, said=f"{pair[0].text} {pair[1].text}")
    if len(pair) < 2 or pair[1].text not in _LAST or pair[0].text in _NO_FIRST:
        return None
    if any(token.sense or token.picture or token.said is not None for token in pair):
        return None
    texts = [token.text for token in tokens[at : at + 3]]
    text = "".join(texts[:2])
    is_known = known.find(texts)[0] > 1 or known.find(texts[1:])[0] > 1
    if is_known or not any(one.role in (Role.NOUN, Role.PLACE) for one in known.find([text])[1]):
        return None
    return Token(text, text, said=" ".join(texts[:2]))
