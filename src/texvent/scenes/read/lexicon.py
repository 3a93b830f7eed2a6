"""Lexicon: phrases in all their forms, and the senses that each may have."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from types import MappingProxyType
from typing import Any

from texvent.scenes.colours import COLOURS, SHADES
from texvent.scenes.inflection import list_finite_forms, list_plurals
from texvent.scenes.models.animals.acts import ANIMAL_ACTS
from texvent.scenes.models.effects import EFFECTS
from texvent.scenes.models.people.activities import ACTIVITIES, DVS_GESTURES, HAND_GESTURES
from texvent.scenes.models.places import place_names
from texvent.scenes.models.protocol import Noun
from texvent.scenes.read.kept import kept

PLURAL_COUNT = 3
"""Copies that a bare plural means: "birds fly"."""
Phrase = tuple[str, ...]


@cache
def read_table(name: str) -> Mapping[str, Any]:
    """Table of words, from a TOML file of `data/`."""
    text = (files("texvent.scenes.read") / "data" / f"{name}.toml").read_text(encoding="utf-8")
    return MappingProxyType(tomllib.loads(text))


@cache
def word_set(table: str, key: str) -> frozenset[str]:
    """Words of an entry of words.toml."""
    return frozenset(read_table("words")[table][key].split())


@dataclass(frozen=True)
class NounSense:
    """Noun that a word names."""

    noun: str
    is_plural: bool = False
    is_kind: bool = False
    """Whether the word means a kind that is shown as this noun: "terrier", a dog."""
    usual: str = ""
    """What who is named so does if nothing else is said: "dancer"."""


@dataclass(frozen=True)
class VerbSense:
    """Verb, and what it asks for of its subject and its object."""

    who: str = ""
    """Subject that it needs: "person", "hand", "animal", "camera", "lamp", "mover" (a person whose
    object moves), "source" (of an effect), "plain" (anything) or "auxiliary"."""
    kind: str = ""
    """Motion, activity, camera move or effect."""
    pace: float = 1.0
    end_pace: float | None = None
    direction: str | None = None
    relation: str | None = None
    """Relation to its object."""
    object: str | None = None
    """Motion of its object."""
    is_near: bool = False
    """Whether it is reported as shown by another one."""


@dataclass(frozen=True)
class Sense:
    """Meaning that a phrase may have."""

    kind: str
    """Part of the grammar: "noun", "verb", "direction", "colour", "relation", ..."""
    value: Any
    form: str = ""
    """Of a verb: "base", "s", "ing" or "ed"."""


@dataclass(frozen=True)
class Lexicon:
    """Phrases, as words in lower case without articles, and their senses."""

    senses: Mapping[Phrase, tuple[Sense, ...]]
    longest: int


@cache
def common_lexicon() -> Lexicon:
    """Lexicon of the embedded nouns."""
    from texvent.scenes.models.nouns import NOUNS

    return make_lexicon(NOUNS)


def make_lexicon(nouns: Mapping[str, Noun]) -> Lexicon:
    """Lexicon of what can be shown with these nouns."""
    found: dict[Phrase, list[Sense]] = {}
    articles = word_set("grammar", "articles")
    for text, sense in _list_senses(nouns):
        phrase = tuple(one for one in text.replace("-", " ").split() if one not in articles)
        senses = found.setdefault(phrase or (text,), [])
        if sense not in senses:
            senses.append(sense)
    for word in word_set("ambiguous", "words"):
        for form in (word, *list_plurals(word)):
            found.pop((form,), None)
    plain = {phrase: tuple(senses) for phrase, senses in found.items()}
    return Lexicon(MappingProxyType(plain), max(map(len, plain)))


def find_noun(word: str, nouns: Mapping[str, Noun]) -> str | None:
    """The noun that a word names, or shows as a kind; None: none.

    Example:
        >>> from texvent.scenes.models.nouns import NOUNS
        >>> find_noun("fire truck", NOUNS), find_noun("cocker spaniel", NOUNS)
        ('fire engine', None)
    """
    return next((one.value.noun for one in _find(word, nouns) if one.kind == "noun"), None)


def find_place(word: str) -> str | None:
    """The place that a word names; None: none.

    Example:
        >>> find_place("meadow")
        'grass'
    """
    return next((one.value for one in _find(word, None) if one.kind == "place"), None)


def _find(word: str, nouns: Mapping[str, Noun] | None) -> tuple[Sense, ...]:
    return lexicon_of(nouns).senses.get(tuple(word.casefold().replace("-", " ").split()), ())


def lexicon_of(nouns: Mapping[str, Noun] | None) -> Lexicon:
    """Lexicon of nouns; None: the embedded ones."""
    from texvent.scenes.models.nouns import NOUNS

    return common_lexicon() if nouns is None or nouns is NOUNS else make_lexicon(nouns)


def _list_senses(nouns: Mapping[str, Noun]) -> Iterator[tuple[str, Sense]]:
    yield from _list_things(nouns)
    yield from _list_verbs()
    yield from _list_models()
    yield from _list_phrases()
    grammar = read_table("words")["grammar"]
    for kind in (
        "articles",
        "camera",
        "pronouns",
        "conjunctions",
        "relatives",
        "negations",
        "small",
    ):
        for word in grammar[kind].replace("|", " ").split():
            yield word, Sense(kind, word)
    for phrase in _split(grammar["style"]):
        yield phrase, Sense("style", phrase)


_ONE_OF = ("directions", "paces", "relations", "placements", "counts", "sizes", "materials",
           "lights", "lamps", "weather", "place_phrases", "shots", "views", "framings",
           "film")  # fmt: skip
"""Tables of words.toml: value = phrases."""


def _list_phrases() -> Iterator[tuple[str, Sense]]:
    words = read_table("words")
    for table in _ONE_OF:
        for value, phrases in words[table].items():
            for phrase in _split(phrases):
                yield phrase, Sense(table, value)
    for phrase in _split(words["other"]["phrases"]):
        yield phrase, Sense("other", phrase)
    for preposition, meaning in words["ways"].items():
        kind, way = meaning.split()
        yield preposition, Sense("relations", kind, way)
    for table in ("light", "place"):
        for phrase, fields in words[table].items():
            values = {k: tuple(v) if isinstance(v, list) else v for k, v in fields.items()}
            yield phrase, Sense(f"{table} fields", values)
    for word in words["crossings"]["words"].split():
        yield word, Sense("crossing", True)
    for quantity, units in words["units"].items():
        for unit, factor in units.items():
            yield unit, Sense("unit", (quantity, factor))
    for colour in COLOURS:
        yield colour, Sense("colour", colour)
    for shade in SHADES:
        yield shade, Sense("shade", shade)


def _list_things(nouns: Mapping[str, Noun]) -> Iterator[tuple[str, Sense]]:
    nouns = kept("nouns", nouns)
    said = [one for one in nouns.values() if not one.name.startswith(_UNSAID)]
    for noun in said:
        for name in (noun.name, *noun.synonyms):
            yield name, Sense("noun", NounSense(noun.name))
    for noun in said:
        for name in (noun.name, *noun.synonyms):
            yield from _list_plurals(name, NounSense(noun.name, is_plural=True))
        for name in noun.plurals:
            yield name, Sense("noun", NounSense(noun.name, is_plural=True))
    names = {name for noun in nouns.values() for name in (noun.name, *noun.synonyms, *noun.plurals)}
    doers = {
        doer: activity
        for activity, phrases in read_table("words")["doers"].items()
        for doer in _split(phrases)
    }
    for noun_name, kinds in read_table("kinds").items():
        for kind in _split(kinds) if noun_name in nouns else ():
            if kind in names:
                continue
            usual = doers.get(kind, "")
            is_mass = kind in word_set("things", "plurals")
            yield kind, Sense("noun", NounSense(noun_name, is_mass, True, usual))
            yield from _list_plurals(kind, NounSense(noun_name, True, True, usual))
    for place, phrases in place_names().items():
        for phrase in phrases:
            for form in (phrase, *list_plurals(phrase)):
                yield form, Sense("place", place)
    for place, phrases in read_table("words")["place_names"].items():
        for phrase in _split(phrases):
            for form in (phrase, *list_plurals(phrase)):
                yield form, Sense("place", place)


_UNSAID = ("parked ", "flying ", "upright ")
"""Begin the names of variants of nouns, which no sentence names: it says that a bicycle stands."""


def _list_plurals(name: str, sense: NounSense) -> Iterator[tuple[str, Sense]]:
    for plural in list_plurals(name):
        if plural != name:
            yield plural, Sense("noun", sense)


def _list_verbs() -> Iterator[tuple[str, Sense]]:
    words = read_table("words")
    for table, is_near in (("motions", False), ("near", True)):
        for kind, verbs in words[table].items():
            for verb in verbs.split():
                base, _, pace = verb.partition("*")
                sense = VerbSense("plain", kind, float(pace or 1.0), is_near=is_near)
                yield from _inflect(base, sense)
    for base, fields in words["verbs"].items():
        yield from _inflect(base, VerbSense("plain", **fields))
    for kind, verbs in words["moved"].items():
        for base in verbs.split():
            yield from _inflect(base, VerbSense("mover", object=kind))
    for move, verbs in words["camera_verbs"].items():
        for base in _split(verbs):
            yield from _inflect(base, VerbSense("camera", move))
    for base in words["blinking"]["verbs"].split():
        yield from _inflect(base, VerbSense("lamp"))
    for base in words["auxiliaries"]["words"].split():
        yield from _inflect(base, VerbSense("auxiliary"))


_PERFORMERS = (
    ("person", kept("activities", ACTIVITIES)),
    ("hand", kept("hand_gestures", HAND_GESTURES)),
)


def _list_models() -> Iterator[tuple[str, Sense]]:
    """Words of activities, gestures, acts of animals and effects."""
    for who, table in _PERFORMERS:
        for name, activity in table.items():
            for phrase in activity.words:
                yield from _inflect(phrase, VerbSense(who, name))
            for phrase in activity.near:
                yield from _inflect(phrase, VerbSense(who, name, is_near=True))
            for phrase in activity.named:
                yield phrase, Sense("pose", (who, name))
    for phrase, name in DVS_GESTURES.items():
        yield phrase, Sense("pose", ("person", name))
    for name, verbs in ANIMAL_ACTS.items():
        for verb in verbs:
            yield from _inflect(verb, VerbSense("animal", name))
    for name, effect in kept("effects", EFFECTS).items():
        for verb in effect.verbs:
            yield from _inflect(verb, VerbSense("source", name))
        for phrase in effect.nouns:
            for form in (phrase, *list_plurals(phrase)):
                yield form, Sense("effect", name)
        for phrase in effect.adjectives:
            yield phrase, Sense("effect adjective", name)
    for name, verbs in read_table("words")["effects"]["pouring"].items():
        for verb in verbs.split():
            yield from _inflect(verb, VerbSense("liquid", name))
    for word in word_set("effects", "liquids"):
        yield word, Sense("liquid", word)


def _split(phrases: str) -> list[str]:
    return [" ".join(phrase.split()) for phrase in phrases.split("|")]


def _inflect(phrase: str, sense: VerbSense) -> Iterator[tuple[str, Sense]]:
    """Forms of a verb phrase: its first word is the verb."""
    base, _, rest = phrase.replace("-", " ").partition(" ")
    for word, form in verb_forms(base):
        yield f"{word} {rest}".strip(), Sense("verb", sense, form)


def verb_forms(base: str) -> list[tuple[str, str]]:
    """Forms of a verb.

    Example:
        >>> verb_forms("carry")
        [('carry', 'base'), ('carries', 's'), ('carrying', 'ing'), ('carried', 'ed')]
    """
    stem = base[:-1] if base.endswith("e") and not base.endswith("ee") else base
    regular = (
        f"{base[:-1]}ied" if base.endswith("y") and base[-2:-1] not in "aeiou" else f"{stem}ed"
    )
    written = read_table("words")["irregular"].get(base, f"{stem}ing {regular}")
    present, *pasts = written.split()
    forms = [(base, "base"), (list_finite_forms(base)[-1], "s"), (present, "ing")]
    return [*forms, *((past_form, "ed") for past_form in pasts)]
