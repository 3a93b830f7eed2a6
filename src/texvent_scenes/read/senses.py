"""Senses of nouns that have several, as the words around them decide."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

from texvent_scenes.models.protocol import Noun
from texvent_scenes.models.tables import trait_value
from texvent_scenes.read.lexicon import NounSense, Sense, Token, word_set
from texvent_scenes.words import list_plurals

_NEAR = 3
"""Words after a noun among which its verb is."""
_COMMON = frozenset({"", "indoor", "grass", "plain"})
"""Places that tell nothing of what is there."""


def choose_senses(tokens: Sequence[Token], nouns: Mapping[str, Noun]) -> list[Token]:
    """The tokens, with the noun that an ambiguous word means where the others speak for one.

    For an animal speaks what it does, for a tool or a machine where it is and what stands by it: a
    mouse runs, or lies beside a keyboard. Where nothing does, the word is not understood.
    """
    return [_choose(one, tokens, nouns) if not one.senses else one for one in tokens]


def _choose(token: Token, tokens: Sequence[Token], nouns: Mapping[str, Noun]) -> Token:
    found = find_nouns(token.text, nouns)
    after = tokens[token.at + 1 : token.at + 1 + _NEAR]
    kinds = {one.value.kind for each in after for one in each.all("verb")}
    places = {one.value for each in tokens for one in each.all("place")}
    places |= {one.value[-1] for each in tokens for one in each.all("scene")}  # "in space"
    others = {one.value.noun for each in tokens for one in each.all("noun")}
    scores = Counter({name: _score(nouns[name], kinds, places, others, nouns) for name in found})
    (best, score), (_, second) = [*scores.most_common(2), ("", 0), ("", 0)][:2]
    if score <= second:
        return token
    is_kind = token.text not in (best, *list_plurals(best))
    return replace(token, senses=(Sense("noun", NounSense(best, found[best], is_kind)),))


def find_nouns(word: str, nouns: Mapping[str, Noun]) -> dict[str, bool]:
    """Nouns that an ambiguous word may mean, such as "computer mouse" → whether it is a plural."""
    said = {one for one in word_set("ambiguous", "words") if word in (one, *list_plurals(one))}
    return {
        noun.name: word != one
        for one in said
        for noun in nouns.values()
        if any(f" {name}".endswith(f" {one}") for name in (noun.name, *noun.synonyms))
    }


def _score(
    noun: Noun, kinds: Collection[str], places: Collection[str], others: Collection[str],
    nouns: Mapping[str, Noun],
) -> int:  # fmt: skip
    """How much speaks for a noun: twice what it does, where it is, what is beside it."""
    does = {noun.motion, *noun.acts, *(("run", "jump", "move") if noun.speed_m_s else ())}
    does |= {"work", "spin"} if noun.is_working else set()
    home = trait_value("usual place", noun.name) or noun.place
    support = trait_value("usual support", noun.name) or ()
    alike = {one for one in others if one in nouns and home == nouns[one].place}
    beside = {one for one in others if trait_value("usual support", one) == support}
    is_doing = bool(does - {"stand"} & {*kinds})
    is_there = home in {*places} - _COMMON or bool(alike if home not in _COMMON else ())
    return 2 * is_doing + is_there + bool({*support} & {*others} or (support and beside))
