"""Every phrase the reader knows, with the roles it can have in a sentence."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import Enum, auto
from functools import cached_property
from typing import Any

from texvent.scenes.inflection import list_plurals
from texvent.scenes.language.vocabulary import film as vocabulary_film
from texvent.scenes.language.vocabulary import function as vocabulary_function
from texvent.scenes.language.vocabulary import motion as vocabulary_motion
from texvent.scenes.language.vocabulary import objects as vocabulary_objects
from texvent.scenes.language.vocabulary import scene as vocabulary_scene
from texvent.scenes.language.vocabulary import verbs as vocabulary_verbs
from texvent.scenes.language.vocabulary.acts import (
    SIMILAR_ACTIVITIES,
    SIMILAR_GAITS,
    SIMILAR_MOTIONS,
)
from texvent.scenes.language.vocabulary.named_acts import NAMED_BY_NOUN
from texvent.scenes.language.vocabulary.objects import COMPOUNDS
from texvent.scenes.language.vocabulary.opaque import OPAQUE_COMPOUNDS
from texvent.scenes.language.words.english import (
    Pos,
    VerbForm,
    list_readings,
    list_verb_forms,
)
from texvent.scenes.models.effects import EFFECTS
from texvent.scenes.models.kinds import KINDS
from texvent.scenes.models.kinds.people import PEOPLE_GROUPS, TRAFFIC_WORDS
from texvent.scenes.models.people.activities import ACTIVITIES, HAND_GESTURES
from texvent.scenes.models.people.acts.words import ACTIVITY_NOUNS, COMPOUND_VERBS
from texvent.scenes.models.protocol import Noun


class Role(Enum):
    """What a phrase does in a sentence."""

    NOUN = auto()
    VERB = auto()
    COUNT = auto()
    COLOUR = auto()
    SHADE = auto()
    SIZE = auto()
    MATERIAL = auto()
    DIRECTION = auto()
    SIDE = auto()
    PACE = auto()
    UNIT = auto()
    RELATION = auto()
    STILL = auto()
    PART = auto()
    PLACE = auto()
    LIGHT = auto()
    LIGHTING = auto()
    WEATHER = auto()
    CLOUDS = auto()
    SNOW = auto()
    SKY = auto()
    STEEP = auto()
    WAVES = auto()
    DUST = auto()
    FLICKER = auto()
    SHADOW = auto()
    GLOW = auto()
    CAMERA = auto()
    CAMERA_MOVE = auto()
    VIEW = auto()
    FRAMING = auto()
    STYLE = auto()
    """Words of film that change nothing; the value says why, "" where nothing is asked for."""
    EFFECT = auto()
    ACTIVITY = auto()
    SIMILAR = auto()
    ROAD = auto()
    PICTURE = auto()
    FUNCTION = auto()
    """Words of grammar, which need no effect of their own."""
    UNKNOWN = auto()


@dataclass(frozen=True)
class Meaning:
    """One way to read a phrase."""

    role: Role
    pos: Pos
    value: Any = None
    form: VerbForm | None = None
    """Of verbs."""
    is_plural: bool = False
    """Of nouns."""
    is_substitute: bool = False
    """Of nouns: whether something else is shown, as a dog for a spaniel."""
    count: int | None = None
    """Of nouns: how many a word for a group means, such as "couple"."""
    can_be_both: bool = False
    """Of nouns: whether it is singular and plural alike, as "deer"."""


class Lexicon:
    """Every phrase the reader knows, by its words."""

    def __init__(self, nouns: Mapping[str, Noun]) -> None:
        self._meanings: dict[tuple[str, ...], list[Meaning]] = {}
        self._longest: dict[str, int] = {}
        for noun in nouns.values():
            self._add_noun(noun)
        for kinds in (COMPOUNDS, KINDS):
            for name, words in kinds.items():
                if name in nouns:
                    self._add_kinds(name, words)
                else:
                    self._add_opaque(words)
        self._add_opaque(OPAQUE_COMPOUNDS)
        for verb in vocabulary_verbs.VERBS:
            for text, form in list_forms(verb.base):
                self._add(text, Meaning(Role.VERB, Pos.VERB, verb, form))
        for text, meaning in (
            *_list_table_entries(),
            *_list_place_kinds(),
            *_list_effects(),
            *_list_people_groups(),
            *_list_activity_nouns(),
            *_list_nouns_of_verbs(),
        ):
            self._add(text, meaning)
        for base, role, value in (*_list_bare_verbs(), *_list_similar_verbs()):
            for text, form in list_forms(base):
                self._add(text, Meaning(role, Pos.VERB, value, form))

    def find(self, words: Sequence[str]) -> tuple[int, list[Meaning]]:
        """The longest known phrase at the start of `words`: its length and its meanings.

        Nothing known gives length 0 and no meanings.
        """
        longest = self._longest.get(words[0], 0) if words else 0
        for length in range(min(longest, len(words)), 0, -1):
            meanings = self._meanings.get(tuple(words[:length]))
            if meanings:
                return length, meanings
        return 0, []

    @property
    def phrases(self) -> frozenset[str]:
        """Every known phrase."""
        return frozenset(" ".join(phrase) for phrase in self._meanings)

    @cached_property
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
        key = (meaning.role, meaning.pos, _group_of(meaning))
        if all((one.role, one.pos, _group_of(one)) != key for one in meanings):
            meanings.append(meaning)
        self._longest[words[0]] = max(self._longest.get(words[0], 0), len(words))

    def _add_noun(self, noun: Noun) -> None:
        names = (noun.name, *noun.synonyms)
        for plural in noun.plurals:
            both = plural in names
            self._add(
                plural,
                Meaning(Role.NOUN, Pos.NOUN, noun.name, is_plural=not both, can_be_both=both),
            )
        for singular in (noun.name, *noun.synonyms):
            for number, text in enumerate(_list_forms_of_noun(singular)):
                self._add(text, Meaning(Role.NOUN, Pos.NOUN, noun.name, is_plural=number > 0))

    def _add_kinds(self, noun: str, words: Iterable[str]) -> None:
        for singular in words:
            forms = _list_forms_of_noun(singular)
            both = singular in forms[1:]
            for number, text in enumerate(forms):
                if tuple(text.replace("-", " ").split()) not in self._meanings:
                    self._add(
                        text,
                        Meaning(
                            Role.NOUN, Pos.NOUN, noun, is_plural=number > 0 and not both,
                            is_substitute=True, can_be_both=both,
                        ),
                    )  # fmt: skip

    def _add_opaque(self, words: Iterable[str]) -> None:
        """Compounds that cannot be shown, so that their last word is not taken for them."""
        for singular in words:
            for number, text in enumerate(_list_forms_of_noun(singular)):
                if tuple(text.split()) not in self._meanings:
                    self._add(text, Meaning(Role.UNKNOWN, Pos.NOUN, is_plural=number > 0))


UNMEASURED = ("once", "upside down", "right side up", "inside out")
"""Adverbs that are reported: how often, and which side up."""
_VERBS = frozenset(verb.base for verb in vocabulary_verbs.VERBS)


def _list_forms_of_noun(singular: str) -> tuple[str, ...]:
    """Singular and plurals; no plurals of compounds that end in a verb: "a bus stops"."""
    *first, last = singular.split()
    is_verb = bool(first) and last in _VERBS
    return (singular,) if is_verb else (singular, *list_plurals(singular))


def _group_of(meaning: Meaning) -> object:
    """What tells two readings of one role apart: who does a similar motion."""
    return meaning.value[1] if meaning.role is Role.SIMILAR else None


def list_forms(base: str) -> Iterator[tuple[str, VerbForm]]:
    """All forms of a verb of one or more words, such as "take off" and "arm wrestle"."""
    if base in COMPOUND_VERBS:
        *first, last = base.split()
        for word, form in list_verb_forms(last):
            yield " ".join((*first, word)), form
        return
    head, *tail = base.split()
    for word, form in list_verb_forms(head):
        yield " ".join((word, *tail)), form


def _list_bare_verbs() -> Iterator[tuple[str, Role, Any]]:
    """Verbs of the camera and of lights, and those that only an activity or an effect knows."""
    for move, bases in vocabulary_film.CAMERA_VERBS.items():
        for base in bases:
            yield base, Role.CAMERA_MOVE, move
    for base in vocabulary_scene.FLICKERS:
        yield base, Role.FLICKER, base
    for activity in (*ACTIVITIES.values(), *HAND_GESTURES.values()):
        for text in (*activity.words, *activity.near):
            words = text.replace("-", " ").split()
            head = next((one for one in COMPOUND_VERBS if words == one.split()), words[0])
            yield head, Role.ACTIVITY, head
    for effect in EFFECTS.values():
        for verb in effect.verbs:
            yield verb.split()[0], Role.ACTIVITY, verb


def _list_similar_verbs() -> Iterator[tuple[str, Role, Any]]:
    """Verbs shown by a motion near to theirs: of people, and of others."""
    for table, is_of_people in (
        (SIMILAR_ACTIVITIES, True),
        (SIMILAR_GAITS, True),
        (SIMILAR_GAITS, False),
        (SIMILAR_MOTIONS, False),
    ):
        for kind, bases in table.items():
            for base in bases:
                yield base, Role.SIMILAR, (kind, is_of_people)


def _list_effects() -> Iterator[tuple[str, Meaning]]:
    for kind, effect in EFFECTS.items():
        for noun in effect.nouns:
            yield noun, Meaning(Role.EFFECT, Pos.NOUN, kind)
            for plural in list_plurals(noun):
                yield plural, Meaning(Role.EFFECT, Pos.NOUN, kind, is_plural=True)
        for text in effect.adjectives:
            yield text, Meaning(Role.EFFECT, Pos.ADJECTIVE, kind)


def _list_people_groups() -> Iterator[tuple[str, Meaning]]:
    for kind, texts in TRAFFIC_WORDS.items():
        for text in texts:
            yield text, Meaning(Role.NOUN, Pos.NOUN, kind, can_be_both=True)
    for text, count in PEOPLE_GROUPS.items():
        noun = "elderly person" if text.split()[0] in ("elderly", "old") else "person"
        is_shown = text.endswith("couple")
        yield (
            text,
            Meaning(
                Role.NOUN,
                Pos.NOUN,
                noun,
                is_substitute=not is_shown,
                count=count,
                can_be_both=is_shown,
            ),
        )


def _list_activity_nouns() -> Iterator[tuple[str, Meaning]]:
    for singular in ACTIVITY_NOUNS:
        for number, text in enumerate(_list_forms_of_noun(singular)):
            yield text, Meaning(Role.UNKNOWN, Pos.NOUN, is_plural=number > 0)


def _list_nouns_of_verbs() -> Iterator[tuple[str, Meaning]]:
    """As "lane change": unknown as a thing, and a verb after one."""
    verbs = {verb.base: verb for verb in vocabulary_verbs.VERBS}
    for act in NAMED_BY_NOUN:
        verb = replace(verbs[act.verb], direction=act.direction or verbs[act.verb].direction)
        own = {text for text, _ in list_forms(act.verb)}
        for singular in act.nouns:
            if singular in own:
                continue
            for number, text in enumerate(_list_forms_of_noun(singular)):
                yield text, Meaning(Role.UNKNOWN, Pos.NOUN, is_plural=number > 0)
                yield text, Meaning(Role.VERB, Pos.VERB, verb, VerbForm.BASE)


def _list_place_kinds() -> Iterator[tuple[str, Meaning]]:
    for place, texts in vocabulary_scene.PLACE_KINDS.items():
        for singular in texts:
            for text in (singular, *list_plurals(singular)):
                yield text, Meaning(Role.PLACE, Pos.NOUN, place, is_substitute=True)


def _list_table_entries() -> Iterator[tuple[str, Meaning]]:
    for role, pos, table in _TABLES:
        for value, texts in table.items():
            for text in texts:
                yield text, Meaning(role, pos, value)
                if pos is Pos.NOUN:
                    for plural in _list_forms_of_noun(text)[1:]:
                        yield plural, Meaning(role, pos, value, is_plural=True)
    for role, pos, words in _WORDS:
        for text in words:
            is_plural = pos is Pos.NOUN and any(
                one.pos is Pos.NOUN and one.is_plural for one in list_readings(text.split()[-1])
            )
            # As in "a screen shows": of words of film, only this form is that of a verb.
            form = VerbForm.THIRD if pos is Pos.VERB and _ends_in_s(text) else None
            yield text, Meaning(role, pos, text, form, is_plural)
    for text in UNMEASURED:
        yield text, Meaning(Role.UNKNOWN, Pos.ADVERB)


def _ends_in_s(text: str) -> bool:
    return text.endswith("s") and " " not in text


_TABLES: tuple[tuple[Role, Pos, Mapping[Any, Iterable[str]]], ...] = (
    (Role.COUNT, Pos.NUMBER, vocabulary_objects.COUNTS),
    (Role.SIZE, Pos.ADJECTIVE, vocabulary_objects.SIZES),
    (Role.MATERIAL, Pos.ADJECTIVE, vocabulary_objects.MATERIALS),
    (Role.DIRECTION, Pos.ADVERB, vocabulary_motion.DIRECTIONS),
    (Role.SIDE, Pos.ADJUNCT, vocabulary_motion.SIDES),
    (Role.PACE, Pos.ADVERB, vocabulary_motion.PACES),
    (Role.PACE, Pos.ADJECTIVE, vocabulary_motion.PACE_ADJECTIVES),
    (Role.UNIT, Pos.NOUN, vocabulary_motion.UNITS),
    (Role.RELATION, Pos.PREPOSITION, vocabulary_motion.RELATIONS),
    (Role.FUNCTION, Pos.PREPOSITION, vocabulary_motion.OTHER_PREPOSITIONS),
    (Role.CAMERA_MOVE, Pos.ADJUNCT, vocabulary_film.CAMERA_PHRASES),
    (Role.CAMERA_MOVE, Pos.ADJECTIVE, vocabulary_film.CAMERA_ADJECTIVES),
    (Role.VIEW, Pos.ADJUNCT, vocabulary_film.VIEWS),
    (Role.FRAMING, Pos.ADJUNCT, vocabulary_film.FRAMINGS),
    (Role.STYLE, Pos.NOUN, vocabulary_film.STYLE_NOUNS),
    (Role.STYLE, Pos.ADJECTIVE, vocabulary_film.STYLE_ADJECTIVES),
    (Role.PLACE, Pos.NOUN, vocabulary_scene.PLACES),
    (Role.PLACE, Pos.ADJUNCT, vocabulary_scene.PLACE_ADVERBS),
    (Role.ROAD, Pos.ADJECTIVE, vocabulary_scene.ROAD_SHAPES),
    (Role.LIGHT, Pos.NOUN, vocabulary_scene.LIGHTS),
    (Role.LIGHT, Pos.ADJECTIVE, vocabulary_scene.LIGHT_ADJECTIVES),
    (Role.LIGHT, Pos.ADJUNCT, vocabulary_scene.LIGHT_PHRASES),
    (Role.WEATHER, Pos.NOUN, vocabulary_scene.WEATHERS),
    (Role.WEATHER, Pos.ADJECTIVE, vocabulary_scene.WEATHER_ADJECTIVES),
    (Role.CLOUDS, Pos.ADJUNCT, vocabulary_scene.CLOUDS),
)
"""Role, part of speech, and meaning → phrases for it."""
_WORDS: tuple[tuple[Role, Pos, Iterable[str]], ...] = (
    (Role.COLOUR, Pos.ADJECTIVE, vocabulary_objects.COLOURS),
    (Role.SHADE, Pos.ADJECTIVE, vocabulary_objects.SHADES),
    (Role.STILL, Pos.ADVERB, vocabulary_motion.STILL_WORDS),
    (Role.PART, Pos.NOUN, vocabulary_scene.PART_WORDS),
    (Role.SNOW, Pos.ADJECTIVE, (*vocabulary_scene.SNOWY, *vocabulary_scene.SNOW_CAPPED)),
    (Role.SNOW, Pos.NOUN, ("snow",)),
    (Role.SKY, Pos.NOUN, vocabulary_scene.SKY_WORDS),
    (Role.STEEP, Pos.ADJECTIVE, vocabulary_scene.STEEP),
    (Role.WAVES, Pos.NOUN, vocabulary_scene.WAVES),
    (Role.WAVES, Pos.ADJECTIVE, vocabulary_scene.ROUGH),
    (Role.DUST, Pos.NOUN, vocabulary_scene.DUST),
    (Role.SHADOW, Pos.NOUN, vocabulary_scene.SHADOW_WORDS),
    (Role.GLOW, Pos.NOUN, vocabulary_scene.GLOW_NOUNS),
    (Role.CAMERA, Pos.NOUN, vocabulary_film.CAMERA_WORDS),
    (Role.FLICKER, Pos.NOUN, vocabulary_scene.STROBES),
    (Role.FLICKER, Pos.NOUN, tuple(f"{one}s" for one in vocabulary_scene.STROBES[:2])),
    (Role.FUNCTION, Pos.NOUN, vocabulary_scene.TIMELAPSES),
    *((Role.FUNCTION, pos, words) for pos, words in vocabulary_function.FUNCTION_WORDS.items()),
)
"""Role, part of speech, and phrases that mean themselves."""
