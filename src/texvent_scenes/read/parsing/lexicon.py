"""Lexicon: phrases in all their forms with their senses."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cache
from itertools import chain, product, repeat
from types import MappingProxyType
from typing import Any, TypeAlias

from texvent_scenes.colours import SURFACES
from texvent_scenes.models.activities import (
    ACTIVITIES,
    ANIMAL_ACTIVITIES,
    DVS_GESTURES,
    HAND_GESTURES,
    Activity,
)
from texvent_scenes.models.effects import EFFECTS
from texvent_scenes.models.nouns import NOUNS, SCENERY_ONLY, VARIANTS
from texvent_scenes.models.places import PLACES
from texvent_scenes.models.protocol import Noun
from texvent_scenes.models.tables import read_table
from texvent_scenes.words import list_plurals, list_verb_forms


def word_table(name: str) -> Any:
    """A table of words.toml."""
    return read_table("words", "read")[name]


@cache
def word_set(table: str, key: str) -> frozenset[str]:
    """Words of an entry of words.toml."""
    return frozenset(word_table(table)[key])


def list_forms(phrase: str) -> list[tuple[str, str]]:
    """Forms of a phrase that begins with a verb, and the name of each: "walks in"."""
    base, _, rest = phrase.partition(" ")
    if " ".join((base, *rest.split()[:1])) in word_set("things", "compound_verbs"):
        return [(f"{base} {words}", form) for words, form in list_forms(rest)]  # "ice skating"
    forms = list_verb_forms(base, word_table("irregular").get(base, ""))
    return [(f"{word} {rest}".strip(), form) for word, form in forms]


@cache
def deeds() -> Mapping[str, str]:
    """Words of who does something → what that is: "pianists"."""
    said = word_table("deeds").items()
    return {
        form: deed for deed, words in said for word in words for form in (word, *list_plurals(word))
    }


@dataclass(frozen=True)
class NounSense:
    """Noun that a word names."""

    noun: str
    is_plural: bool = False
    is_kind: bool = False
    """Whether the word means a kind that is shown as this noun: "terrier", a dog."""
    members: tuple[tuple[str, int], ...] = ()
    """Nouns of a group of people, and how many of each: "couple"; the first is `noun`."""


@dataclass(frozen=True)
class VerbSense:
    """Verb, and what it asks for of its subject and its object."""

    who: str = "plain"
    """Subject that it needs: "person", "hand", "animal", "camera", "lamp", "source" (of an effect),
    "walker" (on feet), "machine", "body" (what rolls or drives), "bearer" (of a load),
    "belt", a noun, or "plain" (anything)."""
    kind: str = ""
    """Motion, activity, camera move or effect."""
    pace: float = 1.0
    end_pace: float | None = None
    direction: str | None = None
    relation: str | None = None
    """Relation to its object."""
    object: str = ""
    """Motion of its object."""
    brings: str = ""
    """Noun of the object that it needs not say: "kicks a penalty"."""
    aims: str = ""
    """Noun of what it sends that to: "scores"."""
    is_near: bool = False
    """Whether it is reported as shown by another one."""


@dataclass(frozen=True)
class Sense:
    """Meaning that a phrase may have."""

    kind: str
    """Part of the grammar: "noun", "place", "verb", "relation", "shot", "pose", "effect"; "field"
    (of an object), "adverb" (of a motion) and "scene" (of the camera, the light or the place),
    whose values are names with values; "unit"; "other" (nothing that is shown); or of words.toml's
    [grammar]."""
    value: Any
    form: str = ""
    """Form of a verb: "base", "s", "ing" or "ed"."""


Senses: TypeAlias = tuple[Sense, ...]
Lexicon: TypeAlias = Mapping[tuple[str, ...], Senses]
"""Phrases, as words in lower case without articles, and their senses."""
LONGEST_PHRASE = 8
"""Most words of a phrase that is read."""


def lexicon_of(nouns: Mapping[str, Noun] | None) -> Lexicon:
    """Lexicon of nouns; None: the embedded ones, of which it is made once."""
    return _embedded() if nouns is None or nouns is NOUNS else _make(nouns)


@cache
def _embedded() -> Lexicon:
    return _make(NOUNS)


def _make(nouns: Mapping[str, Noun]) -> Lexicon:
    found: dict[tuple[str, ...], dict[Sense, None]] = {}
    articles = word_set("senses", "articles")
    for text, sense in (*_list_nouns(nouns), *_list_verbs(), *_list_effects(), *_list_words()):
        words = text.replace("-", " ").split()
        phrase = tuple(one for one in words if one not in articles) or (text,)
        found.setdefault(phrase, {})[sense] = None
    for word in sorted(word_set("ambiguous", "words")):
        for form in (word, *list_plurals(word)):
            said = found.pop((form,), {})  # a camera may track
            kept = (one for one in said if (one.kind == "verb" and one.value.who == "camera")
                    or (one.kind == "place" and form != word))  # fmt: skip
            found[(form,)] = dict.fromkeys(kept)  # "the plains"
    return MappingProxyType({phrase: tuple(one) for phrase, one in found.items()})


def _list_nouns(nouns: Mapping[str, Noun]) -> Iterator[tuple[str, Sense]]:
    said = [
        one for one in nouns.values() if one.name not in SCENERY_ONLY and one.name not in VARIANTS
    ]
    plurals = {name: NounSense(one.name, is_plural=True) for one in said for name in one.plurals}
    names = {name: NounSense(one.name) for one in said for name in (one.name, *one.synonyms)}
    others = {**read_table("kinds", "read")}
    same = others.pop("same")
    for is_kind, table in ((True, others), (False, same)):
        for noun, kind in ((noun, kind) for noun, kinds in table.items() for kind in kinds):
            if noun in nouns and kind not in plurals:
                names.setdefault(kind, NounSense(noun, is_kind=is_kind))
    for name, one in names.items():
        yield name, Sense("noun", one)
    for name, one in names.items():
        for plural in (one for one in list_plurals(name) if one != name):
            yield plural, Sense("noun", replace(one, is_plural=True))
    for name, sense in plurals.items():
        yield name, Sense("noun", sense)
    for name, members in word_table("groups").items():
        if all(one in nouns for one in members):
            whole = NounSense(next(iter(members)), members=tuple(members.items()))
            yield name, Sense("noun", whole)


def _list_verbs() -> Iterator[tuple[str, Sense]]:
    """Verbs; what only persons, hands or animals can do goes before what anything can."""
    for phrase, sense in (*_list_activities(), *_list_plain_verbs()):
        for words, form in list_forms(phrase.replace("-", " ")):
            yield words, Sense("verb", sense, form)


def _list_plain_verbs() -> Iterator[tuple[str, VerbSense]]:
    for who, kinds in word_table("doing").items():
        for verb, kind in ((verb, kind) for kind, verbs in kinds.items() for verb in verbs):
            base, _, pace = verb.partition("*")
            yield base, VerbSense(who, kind, float(pace or 1))
    for phrase, said in word_table("verbs").items():
        senses = said if isinstance(said, list) else [said]
        yield from ((base, VerbSense(**one)) for base, one in product(expand(phrase), senses))


_PERFORMERS = (("person", ACTIVITIES), ("hand", HAND_GESTURES))


def _list_activities() -> Iterator[tuple[str, VerbSense]]:
    for who, table in _PERFORMERS:
        for name, activity in table.items():
            for is_near, phrases in ((False, activity.words), (True, activity.near)):
                yield from ((one, VerbSense(who, name, is_near=is_near))
                            for phrase in phrases for one in _list_numbers(phrase))  # fmt: skip
            yield from _list_acts(who, name, activity)
    for name, activity in ANIMAL_ACTIVITIES.items():
        yield from ((verb, VerbSense("animal", name)) for verb in activity.words)
        yield from _list_acts("animal", name, activity)
    for name, effect in EFFECTS.items():
        yield from ((verb, VerbSense("source", name)) for verb in effect.verbs)


def _list_numbers(phrase: str) -> Iterator[str]:
    """A phrase of an act, and the same of several things: "iron a shirt", "iron shirts"."""
    yield phrase
    verb, article, what = phrase.partition(" a ")
    if article and what.split()[-1] not in _PARTICLES:
        yield from (f"{verb} {one}" for one in list_plurals(what) if one != what)


def _list_acts(who: str, name: str, activity: Activity) -> Iterator[tuple[str, VerbSense]]:
    """Verbs of an act on something."""
    motion = (activity.upon or {}).get("motion", "")
    yield from ((verb, VerbSense(who, name, relation="act on", object=motion))
                for verb in activity.verbs)  # fmt: skip


def _list_effects() -> Iterator[tuple[str, Sense]]:
    """Nouns of effects, and activities and gestures that are named by a noun."""
    for name, effect in EFFECTS.items():
        for phrase in effect.nouns:
            yield from _with_plurals(phrase, Sense("effect", name))
    for who, table in _PERFORMERS:
        for name, activity in table.items():
            named = (*activity.named, *_list_passives(activity))
            if who == "hand":
                named += tuple(f"{one} {word}" for one in activity.named
                               for word in sorted(word_set("things", "signing")))  # fmt: skip
            yield from ((phrase, Sense("pose", (who, name))) for phrase in named)
    yield from ((phrase, Sense("pose", ("person", name))) for phrase, name in DVS_GESTURES.items())


def _list_passives(activity: Activity) -> Iterator[str]:
    """Passives of acts, without who does it: "a pancake being flipped"."""
    for phrase in activity.words:
        verb, _, rest = phrase.partition(" ")
        what = " ".join(one for one in rest.split() if one not in word_set("senses", "articles"))
        if what and not any(one in _PARTICLES for one in what.split()):
            yield from (f"{what} being {word}" for word, form in list_forms(verb) if form == "ed")


_PARTICLES = frozenset(
    {"on", "in", "at", "with", "for", "to", "into", "down", "up", "out", "off", "over", "around",
     "his", "her", "their"}
)  # fmt: skip
"""Words after a verb of an act that is done to nothing, or to a part of oneself."""


def _list_words() -> Iterator[tuple[str, Sense]]:
    """Words of places, and those of words.toml: the path to a list of phrases is their sense."""
    for place, one in PLACES.items():
        for name in one.names:
            yield from _with_plurals(name, Sense("place", place))
    moves = (
        (move, verb) for move, verbs in word_table("doing")["camera"].items() for verb in verbs
    )
    for move, verb in moves:  # "a rotating camera"; verbs of several words have no such form
        if " " not in verb:
            yield f"{list_verb_forms(verb)[2][0]} camera", Sense("shot", move)
    yield from ((name, Sense("field", ("colour", name))) for name in SURFACES)
    for count, phrases in word_table("senses")["field"]["count"].items():
        times = Sense("adverb", ("times", float(count)))
        yield from ((f"{one} times", times) for one in phrases if " " not in one)
    for field, units in word_table("units").items():
        yield from ((unit, Sense("unit", (field, each))) for unit, each in units.items())
    for path, phrases in _walk(word_table("senses")):
        yield from zip(phrases, repeat(_sense_of(*path)))
    for row in word_table("acting"):
        yield from zip(_list_acting(row), repeat(_sense_of(*row["sense"])))
    yield from _list_amounts()


def _list_amounts() -> Iterator[tuple[str, Sense]]:
    """Phrases of weather with how much of it there is: "heavy snow", "it rains heavily"."""
    said = word_table("senses")["scene"]["place"]["weather"]
    for weather, amounts in word_table("amounts").items():
        whole = _sense_of("scene", "place", "weather", weather)
        acting = [row for row in word_table("acting") if row["sense"][-1] == weather]
        phrases = {one for each in said[weather] for one in expand(each)}
        phrases |= {one for row in acting for one in _list_acting(row)}
        told = {words.split()[0] for words in phrases} & {*chain(*amounts.values())}
        phrases |= {noun for row in acting for noun in row["nouns"]}
        bare = sorted(one for one in phrases if one.split()[0] not in told)
        for amount, words in amounts.items():
            share = _sense_of("scene", "place", "weather_amount", amount)
            for word, phrase in product(words, bare):
                text = f"{phrase} {word}" if word.endswith("ly") else f"{word} {phrase}"
                yield from ((text, sense) for sense in (whole, share))


def _list_acting(row: Mapping[str, Any]) -> Iterator[str]:
    """Phrases of weather and effects with their verbs: "falling snow", "snow is drifting down"."""
    yield from row.get("alone", ())
    verbs = [one for each in row["verbs"] for one in expand(each)]
    for noun, phrase in product(row["nouns"], verbs):
        for words, form in list_forms(phrase):
            yield f"{noun} {words}"
            if form == "ing":
                said = f"{words.split()[0]} {noun}", f"{noun} is {words}", f"{noun} are {words}"
                yield from said


def _walk(table: Mapping[str, Any], path: tuple[str, ...] = ()) -> Iterator[tuple[Any, list[str]]]:
    """Lists of a table of tables, each with the keys that lead there."""
    for key, value in table.items():
        if isinstance(value, list):
            around = _AROUND if "shot" in path or "camera" in path else "{}"
            yield (*path, key), [each for one in value for each in expand(around.format(one))]
        else:
            yield from _walk(value, (*path, key))


_AROUND = "(from |by |with |in |){}( only|)"
"""Words about a shot that say no more: "from an aerial view", "forward motion only"."""


def expand(phrase: str) -> Iterator[str]:
    """Phrases with one of the words between brackets each: "(top|overhead) view( of|)"."""
    parts = re.split(r"[()]", phrase)
    choices = [one.split("|") if number % 2 else [one] for number, one in enumerate(parts)]
    yield from (" ".join("".join(one).split()) for one in product(*choices))


def _sense_of(kind: str, *rest: str) -> Sense:
    """As "scene", "light", "kind", "dusk"; "field", "size", "1.4"; or "relation", "on"."""
    if kind in ("field", "adverb", "scene"):
        value = (rest[-1],) if "backdrops" in rest else _plain(rest[-1])
        return Sense(kind, (*rest[:-1], value))
    return Sense(kind, rest[0] if rest else kind)


def _with_plurals(phrase: str, sense: Sense) -> Iterator[tuple[str, Sense]]:
    yield from ((form, sense) for form in dict.fromkeys((phrase, *list_plurals(phrase))))


def _plain(value: str) -> str | float | bool:
    """As "true" = True, "0.5" = 0.5."""
    if value in ("true", "false"):
        return value == "true"
    return float(value) if value.replace(".", "").isdigit() else value
