"""The head of a noun group: which word it is, its kind, and whether there is one of it."""

from __future__ import annotations

from texvent.scenes.language.grammar.syntax import NounGroup
from texvent.scenes.language.vocabulary.function import HAPPENINGS
from texvent.scenes.language.words.english import Pos, list_readings
from texvent.scenes.language.words.lexicon import Role
from texvent.scenes.language.words.word import Word

_SHOWN = (Role.PLACE, Role.EFFECT)
"""Roles of nouns that are shown, but for things."""


def name_kind(head: Word) -> str:
    """The last word of a noun in the singular: "collie" for "border collies"."""
    last = head.tokens[-1].text
    return next((one.lemma for one in list_readings(last) if one.pos is Pos.NOUN), last)


def is_said_once(group: NounGroup) -> bool:
    """As in "a persons hand"; "a car traffic lights" are two things without a comma."""
    has_article = group.determiner is not None and group.determiner.text in ("a", "an")
    return has_article and not any(one.pos is Pos.NOUN for one in group.modifiers)


def find_head(group: NounGroup) -> Word:
    """Its head; the noun before it where the last word names nothing: "a fireworks finale"."""
    head = group.head_word
    readings = list_readings(head.text)
    is_noun = len(head.text) > 1 and any(one.pos is Pos.NOUN for one in readings)
    is_head = is_noun and head.lemma not in HAPPENINGS
    is_lost = head.role in (Role.UNKNOWN, Role.UNIT) and not is_head and bool(group.modifiers)
    before = group.modifiers[-1] if is_lost else None
    if before is not None and (before.read_as(Role.NOUN) is not None or before.role in _SHOWN):
        group.head = group.modifiers.pop()
    return group.head_word
