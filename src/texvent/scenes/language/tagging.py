"""Tokens to phrases: the longest entry of the lexicon wins, its neighbours decide between roles."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence, Set
from dataclasses import dataclass

from texvent.scenes.language.lexicon import ADJECTIVES, Lexicon, Meaning, Role
from texvent.scenes.language.tokens import Token

_BEFORE_NOUN = ADJECTIVES | {Role.DETERMINER, Role.NEGATION, Role.RELATION, Role.AND, Role.BREAK}
_LOCATIVE_PREPOSITIONS = frozenset(
    {"in", "on", "through", "across", "along", "at", "into", "up", "down", "onto", "over"}
)
"""Prepositions after which a mountain is a place to be, not an object to look at."""

_OWNERS = frozenset({"its", "it", "their", "his", "her"})
"""Words before a part of the object that the sentence is about ("its wheels")."""


@dataclass(eq=False)
class Phrase:
    """Some tokens with their meaning, and whether it had an effect on the scene."""

    meaning: Meaning
    tokens: tuple[Token, ...]
    is_used: bool = False

    @property
    def role(self) -> Role:
        """What it does in the sentence."""
        return self.meaning.role

    @property
    def text(self) -> str:
        """Its words, in lower case."""
        return " ".join(token.text for token in self.tokens)


def mark_used(phrases: Iterable[Phrase]) -> None:
    """These phrases had an effect."""
    for phrase in phrases:
        phrase.is_used = True


def tag_phrases(tokens: Sequence[Token], known: Lexicon) -> list[Phrase]:
    """Cut the tokens into phrases, each with the meaning that suits its neighbours."""
    phrases: list[Phrase] = []
    start = 0
    while start < len(tokens):
        window = tokens[start : start + known.longest]
        length, meanings = known.find([token.text for token in window])
        if length == 0:
            length, meanings = 1, [_read_unlisted(tokens[start])]
        stop = start + length
        following = [token.text for token in tokens[stop : stop + known.longest]]
        after = known.find(following)[1] if following else []
        meaning = _choose(meanings, phrases, after)
        phrases.append(Phrase(meaning, tuple(tokens[start:stop])))
        start = stop
    return phrases


def _read_unlisted(token: Token) -> Meaning:
    if token.is_number:
        return Meaning(Role.NUMBER, float(token.text.replace(",", ".")))
    if token.is_punctuation:
        return Meaning(Role.BREAK, token.text)
    return Meaning(Role.UNKNOWN)


def _choose(meanings: list[Meaning], before: list[Phrase], after: list[Meaning]) -> Meaning:
    """The meaning that suits the phrases before and what may come after."""
    by_role = {meaning.role: meaning for meaning in meanings}
    next_roles = {meaning.role for meaning in after}
    for first, second, is_first in _AMBIGUITIES:
        if first in by_role and second in by_role:
            return by_role[first if is_first(before, next_roles) else second]
    if len(meanings) > 1 and Role.VERB in by_role and _follows_determiner(before):
        return next(meaning for meaning in meanings if meaning.role is not Role.VERB)
    return meanings[0]


def _expects_noun(before: list[Phrase]) -> bool:
    return not before or before[-1].role in _BEFORE_NOUN


def _preposition(before: list[Phrase]) -> str | None:
    """The relation word before the determiner and adjectives that came last."""
    for phrase in reversed(before):
        if phrase.role is Role.RELATION or phrase.text in _LOCATIVE_PREPOSITIONS:
            return phrase.text
        if phrase.role not in ADJECTIVES | {Role.DETERMINER, Role.STEEP, Role.SNOW}:
            return None
    return None


def _is_owned(before: list[Phrase]) -> bool:
    return bool(before) and before[-1].text in _OWNERS


def _follows_determiner(before: list[Phrase]) -> bool:
    return bool(before) and before[-1].role is Role.DETERMINER


_AMBIGUITIES: tuple[tuple[Role, Role, Callable[[list[Phrase], Set[Role]], bool]], ...] = (
    (Role.SHADE, Role.GLOW, lambda before, after: Role.COLOUR in after),
    (Role.PART, Role.NOUN, lambda before, after: _is_owned(before)),
    (Role.NOUN, Role.VERB, lambda before, after: _expects_noun(before)),
    (
        Role.PLACE,
        Role.NOUN,
        lambda before, after: Role.PLACE in after or _preposition(before) in _LOCATIVE_PREPOSITIONS,
    ),
)
"""Two roles that a phrase can have, and (phrases before, roles after) → whether it is the first."""
