"""Words of models and prompts → what scenes can show, by the lexicon of the reader."""

from __future__ import annotations

from collections.abc import Iterator

from texvent.scenes.read.lexicon import Sense, lexicon_of

ARTICLES = frozenset(("a", "an", "the"))
PLAIN = frozenset(("articles", "pronouns", "conjunctions", "small"))
"""Kinds of words without a meaning of their own."""
FIELDS = {("light", "kind"): "light", ("place", "weather"): "weather", ("place", "name"): "place",
          ("camera", "view"): "view"}  # fmt: skip
"""Part and field of a scene → kind of word."""


def resolve(word: str, kind: str) -> str | None:
    """What a word or phrase stands for; None where scenes have nothing for it.

    Args:
        word: as a model or a prompt has it.
        kind: "noun", "motion", "place", "colour", "material", "effect", "relation", "direction",
            "light", "weather", "view", "count" or "move" (of the camera).

    Example:
        >>> resolve("Automobiles", "noun"), resolve("driving", "motion"), resolve("wug", "noun")
        ('car', 'drive', None)
    """
    return next((meaning for one, meaning in list_meanings(word) if one == kind), None)


def list_meanings(word: str) -> Iterator[tuple[str, str]]:
    """Kinds of a word or phrase, and what it stands for as each."""
    if word.isdigit():
        yield "count", str(float(word))
    words = word.casefold().replace("_", " ").replace("-", " ").split()
    phrase = tuple(one for one in words if one not in ARTICLES)
    for sense in lexicon_of(None).senses.get(phrase, ()):
        yield from ((kind, str(one)) for kind, one in _meanings(sense) if one)


def is_plain(word: str) -> bool:
    """Whether a word has no meaning of its own: none is reported."""
    senses = lexicon_of(None).senses.get((word,), ())
    return any(sense.kind in PLAIN for sense in senses)


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
        case "scene":
            part, field, each = value
            yield FIELDS.get((part, field), field), each
