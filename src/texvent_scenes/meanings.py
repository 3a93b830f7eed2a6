"""Meanings of a word: kinds and values of scenes that it may stand for."""

from __future__ import annotations

from collections.abc import Iterator

from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.read.parsing.lexicon import Senses, lexicon_of
from texvent_scenes.read.parsing.senses import find_nouns
from texvent_scenes.read.parsing.tokens import split_prompt

_FIELDS = {"turns_hz": "rate_hz"}
"""Fields of words, and of scenes, where they differ."""


def list_meanings(word: str) -> Iterator[tuple[str, object]]:
    """Kinds of a word or phrase, such as "noun" or "direction", and its value as each.

    Example:
        >>> [*list_meanings("automobiles")], [*list_meanings("leftwards")]
        ([('noun', 'car')], [('direction', 'left')])
    """
    tokens = split_prompt(word.replace("_", " "), lexicon_of(None))
    if len(tokens) == 1 and not tokens[0].senses:  # of an ambiguous word all that it may mean
        return iter([("noun", noun) for noun in find_nouns(tokens[0].text, NOUNS)])
    return meanings_of(tokens[0].senses if len(tokens) == 1 else ())


def meanings_of(senses: Senses) -> Iterator[tuple[str, object]]:
    """The same of the senses of a token."""
    for sense in senses:
        value = sense.value
        match sense.kind:
            case "noun":
                yield "noun", value.noun
            case "place" | "effect" | "relation":
                yield sense.kind, value
            case "pose":
                yield "motion", value[1]
            case "field" | "adverb":
                name, *said = value
                yield _FIELDS.get(name, name), *said
            case "verb":
                yield {"camera": "move", "source": "effect"}.get(value.who, "motion"), value.kind
                said = (("direction", value.direction), ("relation", value.relation))
                yield from (one for one in said if one[1] not in (None, "with"))  # of company
            case "shot":  # such as "pan left"
                yield "move", str(value).split()[0]
            case "scene":  # such as ("light", "kind", "dusk"), ("place", "weather", "fog")
                part, field, each = value
                yield part if field in ("kind", "name") else field, each
