"""Every phrase the parser knows, with the roles it can have in a sentence."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum, auto
from functools import cached_property
from typing import Any

from texvent.scenes.inflection import list_finite_forms, list_participles, list_plurals
from texvent.scenes.language import vocabulary_motion, vocabulary_objects, vocabulary_scene
from texvent.scenes.models.protocol import Noun


class Role(Enum):
    """What a phrase does in a sentence."""

    NOUN = auto()
    VERB = auto()
    COUNT = auto()
    NUMBER = auto()
    COLOUR = auto()
    SHADE = auto()
    SIZE = auto()
    NEGATION = auto()
    DETERMINER = auto()
    PRONOUN = auto()
    AND = auto()
    DIRECTION = auto()
    SIDE = auto()
    PACE = auto()
    SPEED_UNIT = auto()
    RELATION = auto()
    STILL = auto()
    PART = auto()
    PLACE = auto()
    LIGHT = auto()
    WEATHER = auto()
    CLOUDS = auto()
    SNOW = auto()
    SKY = auto()
    STEEP = auto()
    DUST = auto()
    FLICKER = auto()
    HERTZ = auto()
    SHADOW = auto()
    GLOW = auto()
    CAMERA = auto()
    CAMERA_MOVE = auto()
    VIEW = auto()
    FRAMING = auto()
    BREAK = auto()
    UNKNOWN = auto()


ADJECTIVES = frozenset({Role.COUNT, Role.NUMBER, Role.COLOUR, Role.SHADE, Role.SIZE, Role.PACE})
"""Roles that may stand between a determiner and its noun."""


@dataclass(frozen=True)
class Meaning:
    """One way to read a phrase."""

    role: Role
    value: Any = None
    form: str = ""
    """Of nouns: "singular" or "plural"; of verbs: "finite" or "participle"."""


class Lexicon:
    """Every phrase the grammar knows, by its words."""

    def __init__(self, nouns: Mapping[str, Noun]) -> None:
        self._meanings: dict[tuple[str, ...], list[Meaning]] = {}
        self._longest: dict[str, int] = {}
        self._add_nouns(nouns)
        self._add_verbs()
        self._add_tables()

    def find(self, words: Sequence[str]) -> tuple[int, list[Meaning]]:
        """The longest known phrase at the start of `words`: its length and its meanings.

        Nothing known gives length 0 and no meanings.
        """
        longest = self._longest.get(words[0], 0)
        for length in range(min(longest, len(words)), 0, -1):
            meanings = self._meanings.get(tuple(words[:length]))
            if meanings:
                return length, meanings
        return 0, []

    @property
    def words(self) -> frozenset[str]:
        """Every word that is part of a known phrase."""
        return frozenset(word for phrase in self._meanings for word in phrase)

    @cached_property
    def longest(self) -> int:
        """Number of words of the longest phrase."""
        return max(self._longest.values(), default=0)

    def _add(self, text: str, meaning: Meaning) -> None:
        words = tuple(text.replace("-", " ").split())
        meanings = self._meanings.setdefault(words, [])
        if all(known.role is not meaning.role for known in meanings):
            meanings.append(meaning)
        self._longest[words[0]] = max(self._longest.get(words[0], 0), len(words))

    def _add_nouns(self, nouns: Mapping[str, Noun]) -> None:
        for name, noun in nouns.items():
            for plural in noun.plurals:
                self._add(plural, Meaning(Role.NOUN, name, "plural"))
            for singular in (name, *noun.synonyms):
                self._add_noun_forms(singular, name)
        for word, name in vocabulary_scene.GENERIC_NOUNS.items():
            if name in nouns and tuple(word.split()) not in self._meanings:
                self._add_noun_forms(word, name)

    def _add_noun_forms(self, singular: str, name: str) -> None:
        self._add(singular, Meaning(Role.NOUN, name, "singular"))
        for plural in list_plurals(singular):
            self._add(plural, Meaning(Role.NOUN, name, "plural"))

    def _add_verbs(self) -> None:
        for verb in vocabulary_motion.VERBS:
            head, *tail = verb.base.split()
            finite: Iterable[str] = list_finite_forms(head)
            participles: Iterable[str] = list_participles(head)
            for forms, form in ((finite, "finite"), (participles, "participle")):
                for word in forms:
                    self._add(" ".join((word, *tail)), Meaning(Role.VERB, verb, form))
            for word in verb.irregular:
                self._add(word, Meaning(Role.VERB, verb, "participle"))

    def _add_tables(self) -> None:
        for role, table in _WORDS.items():
            for text in table:
                self._add(text, Meaning(role, text))
        for role, meanings in _MEANINGS.items():
            for value, texts in meanings.items():
                for text in texts:
                    forms = list_plurals(text) if role in _WITH_PLURALS else ()
                    for form in (text, *forms):
                        self._add(form, Meaning(role, value))


_MEANINGS: dict[Role, Mapping[Any, Iterable[str]]] = {
    Role.COUNT: vocabulary_objects.COUNTS,
    Role.SIZE: vocabulary_objects.SIZES,
    Role.DIRECTION: vocabulary_motion.DIRECTIONS,
    Role.SIDE: vocabulary_motion.SIDES,
    Role.PACE: vocabulary_motion.PACES,
    Role.SPEED_UNIT: vocabulary_motion.SPEED_UNITS,
    Role.RELATION: vocabulary_motion.RELATIONS,
    Role.CLOUDS: vocabulary_scene.CLOUDS,
    Role.HERTZ: vocabulary_scene.HERTZ,
    Role.CAMERA_MOVE: vocabulary_scene.CAMERA_MOVES,
    Role.VIEW: vocabulary_scene.VIEWS,
    Role.FRAMING: vocabulary_scene.FRAMINGS,
    Role.PLACE: vocabulary_scene.PLACES,
    Role.LIGHT: vocabulary_scene.LIGHTS,
    Role.WEATHER: vocabulary_scene.WEATHERS,
}
"""Role → meaning → phrases for it."""
_WITH_PLURALS = (Role.PLACE, Role.LIGHT, Role.WEATHER)
_WORDS: dict[Role, Iterable[str]] = {
    Role.COLOUR: vocabulary_objects.COLOURS,
    Role.SHADE: vocabulary_objects.SHADES,
    Role.NEGATION: vocabulary_objects.NEGATIONS,
    Role.DETERMINER: vocabulary_objects.DETERMINERS,
    Role.PRONOUN: vocabulary_objects.PRONOUNS,
    Role.AND: ("and", "or", "plus"),
    Role.STILL: vocabulary_motion.STILL_WORDS,
    Role.PART: vocabulary_scene.PART_WORDS,
    Role.SNOW: vocabulary_scene.SNOWY,
    Role.SKY: vocabulary_scene.SKY_WORDS,
    Role.STEEP: vocabulary_scene.STEEP,
    Role.DUST: vocabulary_scene.DUST,
    Role.FLICKER: vocabulary_scene.FLICKERS,
    Role.SHADOW: vocabulary_scene.SHADOW_WORDS,
    Role.GLOW: vocabulary_scene.GLOW_WORDS,
    Role.CAMERA: vocabulary_scene.CAMERA_WORDS,
}
"""Role → phrases that mean themselves."""
