"""Words of prompts by family: nouns, and all that a sentence says beside them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from texvent_scenes.assets.nouns import assets_of
from texvent_scenes.meanings import meanings_of
from texvent_scenes.models.nouns import FAMILIES
from texvent_scenes.models.protocol import Noun
from texvent_scenes.read.parsing.lexicon import lexicon_of
from texvent_scenes.scene_input import list_nouns
from texvent_scenes.words import list_plurals

_KINDS = {
    "motion": "motion", "place": "place", "light": "light", "weather": "weather",
    "effect": "effect", "colour": "colour", "material": "material", "move": "camera move",
    "view": "camera view", "framing": "camera framing", "relation": "relation",
    "direction": "direction",
}  # fmt: skip
"""Kinds of `meanings_of`, and the families that they are listed under."""
_READ_ONLY = ("route",)
"""Relations that sentences have and scene files have not."""


def names_of(noun: Noun) -> tuple[str, ...]:
    """Name of a noun, then its other names."""
    return (noun.name, *noun.synonyms, *noun.plurals)


def list_kinds() -> Iterator[tuple[str, tuple[str, ...]]]:
    """Kind and words of all that a sentence says beside nouns, the name in scene files first."""
    found: dict[tuple[str, str], dict[str, None]] = {}
    for phrase, senses in lexicon_of(None).items():
        for sense in senses:
            if sense.form not in ("", "base"):
                continue
            for kind, value in meanings_of((sense,)):
                name = phrase[-1] if kind == "colour" else str(value)  # "dark red" with red
                if kind in _KINDS and name not in _READ_ONLY:
                    found.setdefault((_KINDS[kind], name), {})[" ".join(phrase)] = None
    for family in dict.fromkeys(_KINDS.values()):
        for (kind, name), words in found.items():
            if kind == family and name:
                said = {each for one in words for each in list_plurals(one) if each != one} | {name}
                yield family, (name, *(one for one in words if one not in said))


def list_families(nouns: Mapping[str, Noun]) -> Iterator[tuple[str, Noun]]:
    """Family and noun, assets first."""
    for noun in nouns.values():
        if assets_of(noun):
            yield "assets", noun
    for family, members in FAMILIES.items():
        for member in members:
            noun = nouns[member.name]
            if not assets_of(noun):
                yield family, noun


def list_vocabulary() -> dict[str, list[tuple[str, ...]]]:
    """Family → its words, each with its other names."""
    found: dict[str, list[tuple[str, ...]]] = {}
    for family, noun in list_families(list_nouns()):
        found.setdefault(family, []).append(names_of(noun))
    for family, names in list_kinds():
        found.setdefault(family, []).append(names)
    return found
