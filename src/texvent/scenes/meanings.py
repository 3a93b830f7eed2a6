"""Meanings of a word: kinds and values of scenes that it may stand for."""

from __future__ import annotations

from collections.abc import Iterator

from texvent.scenes.read.lexicon import Sense, lexicon_of, word_set


def list_meanings(word: str) -> Iterator[tuple[str, object]]:
    """Kinds of a word or phrase, such as "noun" or "direction", and its value as each.

    Example:
        >>> [*list_meanings("automobiles")], [*list_meanings("leftwards")]
        ([('noun', 'car')], [('direction', 'left')])
    """
    if word.isdigit():
        yield "count", float(word)
    words = word.casefold().replace("_", " ").replace("-", " ").split()
    phrase = tuple(one for one in words if one not in word_set("senses", "articles"))
    for sense in lexicon_of(None).get(phrase, ()):
        yield from ((kind, one) for kind, one in _meanings(sense) if one is not None)


def _meanings(sense: Sense) -> Iterator[tuple[str, object]]:
    value = sense.value
    match sense.kind:
        case "noun":
            yield "noun", value.noun
        case "place" | "effect" | "relation":
            yield sense.kind, value
        case "pose":
            yield "motion", value[1]
        case "field" | "adverb":
            yield value
        case "verb":
            yield {"camera": "move", "source": "effect"}.get(value.who, "motion"), value.kind
            yield from (("direction", value.direction), ("relation", value.relation))
        case "scene":  # such as ("light", "kind", "dusk"), ("place", "weather", "fog")
            part, field, each = value
            yield part if field in ("kind", "name") else field, each
