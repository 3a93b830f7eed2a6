"""Tokens: the phrases of a prompt, each the longest that the lexicon has, with all its senses."""

from __future__ import annotations

import itertools
import re
import unicodedata
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property
from typing import Any

from texvent_scenes.models.activities import ACTIVITIES, TIMED
from texvent_scenes.models.effects import LAMPS
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.people.outfit import list_props
from texvent_scenes.read.parsing.lexicon import (
    LONGEST_PHRASE,
    Lexicon,
    Sense,
    Senses,
    VerbSense,
    list_forms,
    word_set,
    word_table,
)
from texvent_scenes.read.parsing.quantities import (
    Found,
    list_figures,
    read_height,
    read_quantity,
    read_stated,
)
from texvent_scenes.words import find_literals

_OF_PARTICLES = ("plain", "lamp", "machine")
"""Subjects of what is no verb with a particle before a noun: "comes down the road"."""
_NEAR = 4
"""Words after a light verb among which what is done is named."""
MOST_WORDS = 1000
"""Words of a prompt that are read; later ones are not understood, all together."""
_NUMBER = (
    r"(?:(?<!\S)[-−])?(?:(?:\d+ )?\d+(?:\.\d+)?(?:(?: ?[/⁄] ?|[-–])\d+(?:\.\d+)?)+(?![\w-])"
    r"|\d+(?:,\d{3})*(?:\.\d+)?|(?<!\w)\.\d+)"
)
_WORD = re.compile(_NUMBER + r"|[^\W\d_]+(?:['’][^\W\d_]+)*|[^\W_]|[.,;:!?/()]")
_OWNER = re.compile(r"['’]s?$")
_GRAMMAR = ("articles", "pronouns", "conjunctions", "relatives", "style", "purpose", "camera",
            "infinitive")  # fmt: skip
"""Senses of words that a report does not list unless they are lost or shown."""
_MIXED = re.compile("(?<=[0-9])(?=[¼-¾⅐-⅞])")
"""Between "1" and "½", which NFKC would join to 11/2."""


@dataclass(frozen=True)
class Token:
    """Phrase of a prompt, with all its senses."""

    text: str
    """In lower case; of a picture as the prompt has it."""
    at: int
    """Number in the prompt, from 0."""
    senses: tuple[Sense, ...] = ()

    @property
    def is_sign(self) -> bool:
        """Whether it only separates words."""
        return not self.senses and not any(map(str.isalnum, self.text))

    @property
    def is_unknown(self) -> bool:
        """Whether it is a word that the reader does not know."""
        return not self.is_sign and (not self.senses or self.has("other"))

    @property
    def is_liquid(self) -> bool:
        """Whether it is seen in nothing but its vessel, or as a place: "a bottle of water"."""
        return self.text in word_set("things", "liquids")

    @property
    def is_framed(self) -> bool:
        """Whether it says that something is in the image: "in the frame"."""
        words = (one for one in self.text.split() if one not in word_set("senses", "articles"))
        return " ".join(words) in word_set("things", "framed")

    @property
    def is_grammar(self) -> bool:
        """Whether it says nothing by itself: "the", "is", "while", "footage"."""
        is_order = self.text in word_set("things", "order")
        return (self.has(*_GRAMMAR) and not is_order) or self.text in word_set("things", "grammar")

    def all(self, kind: str) -> tuple[Sense, ...]:
        """Senses of a kind."""
        return tuple([one for one in self.senses if one.kind == kind])

    def first(self, *kinds: str) -> Sense | None:
        """The first sense of one of the kinds."""
        return next((one for one in self.senses if one.kind in kinds), None)

    def says(self, kind: str, name: str) -> bool:
        """Whether it may say a field, an adverb or a part of the scene: "slowly" a pace."""
        return any(one.value[0] == name for one in self.all(kind))

    def value(self, kind: str) -> tuple[str, Any]:
        """Name and value of the first field, adverb or part of the scene that it says."""
        return next((one.value for one in self.all(kind)), ("", ""))

    @property
    def nouns(self) -> set[str]:
        """Nouns that it may be."""
        return {one.value.noun for one in self.all("noun")}

    @property
    def relations(self) -> set[str]:
        """Relations that it may mean."""
        return {one.value for one in self.all("relation")}

    @property
    def relation(self) -> str:
        """The first relation that it may mean, or ""."""
        return next((one.value for one in self.all("relation")), "")

    def has(self, *kinds: str) -> bool:
        """Whether it may be of one of the kinds."""
        return not self._kinds.isdisjoint(kinds)

    @cached_property
    def _kinds(self) -> frozenset[str]:
        """Kinds of its senses, which are asked for most of all."""
        return frozenset([one.kind for one in self.senses])

    def verbs(self, *forms: str) -> tuple[Sense, ...]:
        """Its senses as a verb in one of the forms."""
        return tuple(one for one in self.senses if one.kind == "verb" and one.form in forms)


NO_TOKEN = Token(".", -1)
"""Stands before the first token and after the last one."""


def token_at(tokens: Sequence[Token], at: int) -> Token:
    """A token by its number."""
    return tokens[at] if 0 <= at < len(tokens) else NO_TOKEN


def split_prompt(prompt: str, lexicon: Lexicon) -> tuple[Token, ...]:
    """Tokens of a prompt, in order."""
    text = _name_owners(unicodedata.normalize("NFKC", _MIXED.sub(" ", prompt)))
    found: list[Token] = []
    start = 0
    for begin, end, picture in (*find_literals(text), (len(text), len(text), None)):
        words, at = _WORD.findall(text[start:begin]), 0
        figures = list_figures(words, lexicon)
        while at < len(words):
            length, senses = _read_phrase(figures, at, lexicon, found)
            text_of = " ".join(words[at : at + length]).casefold()
            way = _of_journey(text_of, words[at + 1 :], found, lexicon)
            found = _without_article(found) if way or _is_shot(senses) else found
            senses = way or senses
            found.append(Token(text_of, len(found), senses))
            at += length
        if picture is not None:
            sense = Sense("picture", ("picture", picture))
            found.append(Token(picture.value, len(found), (sense,)))
        start = end
    found = _join_verbs(found, lexicon)
    if len(found) > MOST_WORDS:
        found[MOST_WORDS:] = [Token(f"{len(found) - MOST_WORDS} more words", MOST_WORDS)]
    return tuple(found)


def _without_article(before: Sequence[Token]) -> list[Token]:
    """Tokens without the article of the shot that follows: "a smooth tracking shot of a car"."""
    told = [*itertools.takewhile(
        lambda one: one.has("style", "scene") or (one.is_unknown and not one.is_sign),
        reversed(before[-_NEAR:]))]  # fmt: skip
    at = len(before) - 1 - len(told)
    if at < 0 or not before[at].has("articles"):
        return [*before]
    kept = (*before[:at], *before[at + 1 :])
    return [replace(one, at=number) for number, one in enumerate(kept)]


def _is_shot(senses: Senses) -> bool:
    """Whether a phrase says how a camera sees, and names no thing."""
    kinds = {one.kind for one in senses}
    return "shot" in kinds and "noun" not in kinds


def _of_journey(
    text: str, after: Sequence[str], before: Sequence[Token], lexicon: Lexicon
) -> Senses:
    """Senses of a way of the camera that a noun names: "a night drive through a tunnel"."""
    verb = word_table("journeys").get(text)
    led = before[-1] if before else NO_TOKEN
    is_named = not before or led.is_sign or led.has("articles", "scene", "style") or led.is_unknown
    is_done = any(one.text in _light_verbs() for one in before[-3:])
    leads = bool(after) and after[0].casefold() in word_set("things", "onward") | {"over", "past"}
    return lexicon.get((verb,), ()) if verb and is_named and leads and not is_done else ()


@cache
def _light_verbs() -> Mapping[str, str]:
    """Forms of verbs that say nothing before a noun of what is done → the names of the forms."""
    return {word: form for one in word_table("light")["verbs"] for word, form in list_forms(one)}


def _join_verbs(tokens: Sequence[Token], lexicon: Lexicon) -> list[Token]:
    """The tokens, with one verb for "makes a sharp turn" and "knits a blue scarf".

    What an act is done to stays a thing of its own where that is drawn: "plays a black guitar".
    """
    found, skipped, unread = list[Token](), set[int](), set[int]()
    for token in tokens:
        between: list[Token] = []
        for done in tokens[token.at + 1 : token.at + 1 + _NEAR]:
            if acts := _list_acts(token, done, lexicon):
                token = replace(token, senses=acts)
                props = {(noun, each.count > 1) for one in acts
                         for each in list_props(one.value.kind) for noun in each.nouns}  # fmt: skip
                said = {(one.value.noun, one.value.is_plural) for one in done.all("noun")}
                if not props & said:
                    token = replace(token, text=f"{token.text} {done.text}")
                    skipped |= {done.at, *(one.at for one in between if one.has("articles"))}
                    unread |= {one.at for one in between if one.has("field")}
                break
            if not (done.has("articles", "adverb", "field") or done.is_unknown) or done.is_sign:
                break
            between.append(done)
        if token.at not in skipped:
            senses = () if token.at in unread else token.senses
            found.append(replace(token, at=len(found), senses=senses))
    return found


def _list_acts(token: Token, done: Token, lexicon: Lexicon) -> Senses:
    """Senses of a verb with what is done a few words later, of "take" with "turn"."""
    if form := _light_verbs().get(token.text):
        nouns = word_table("light")["nouns"]
        said = lexicon.get(tuple(nouns.get(done.text, done.text).split()), ())
        acts = [VerbSense(*one.value) for one in said if one.kind == "pose"]
        acts += [one.value for one in said if one.kind == "verb" and one.form == "base"]
        if not done.has("noun"):
            return tuple(Sense("verb", one, form) for one in acts)
    said = lexicon.get((*token.text.split(), *done.text.split()), ())
    return tuple(one for one in said if one.kind == "verb" and one.value.kind in ACTIVITIES)


@cache
def _owned() -> tuple[tuple[re.Pattern[str], str | Callable[[re.Match[str]], str]], ...]:
    """Things with parts as they are written, and as they are read: "a car, its headlights".

    As in "a car's headlights", "the blades of a fan", "a fan blade", "a four-blade fan".
    """
    owned = word_table("parts")
    parts, opened = "|".join(owned), "|".join(sorted(word_set("things", "leaves")))
    bare = "|".join(
        rf"(?:{_list_names(owned[one])}) {one}" for one in sorted(word_set("things", "bare_parts"))
    )
    counts = word_table("senses")["field"]["count"].values()
    numbers = "|".join(one for each in counts for one in each if " " not in one)
    many = "|".join(one[:-1] for one in owned if one.endswith("s"))
    owners = _list_names(noun for one in owned.values() for noun in one)
    openers = _list_names(one.name for one in NOUNS.values() if one.acts & TIMED)
    of = r"of ((?:an?|the|his|her) (?:(?!(?:and|of|on|in|with|to)\b)\w+ ){0,2}?)?"
    rows = (
        (rf"\b(?:the )?({opened}) {of}({openers})\b", r"\2\3 \1"),
        (rf"\b({owners})['’]s ((?:\w+ )?(?:{parts}))\b", r"\1, its \2"),
        (rf"\b({bare})\b(?! and\b)", lambda found: ", its ".join(found[0].rsplit(" ", 1))),
        (rf"\b(?:the )?((?:\w+ )?(?:{parts})) {of}({owners})\b", r"\2\3, its \1"),
        (rf"\b({numbers}|\d+)[- ]({many})(?:d|\w?ed)? ({owners})\b", r"\3 with \1 \2s"),
    )
    return tuple((re.compile(pattern, re.IGNORECASE), said) for pattern, said in rows)


def _list_names(nouns: Iterable[str]) -> str:
    """All names of nouns, as a pattern."""
    said = {*nouns}
    said = said.union(*(NOUNS[one].synonyms for one in said if one in NOUNS))
    return "|".join(sorted(said, key=lambda one: (-len(one), one)))


def _name_owners(text: str) -> str:
    """A text that says "a car, its headlights" for those of a car."""
    words = {*re.findall(r"[^\W\d_]+", text.casefold())}
    for pattern, said in _owned() if words & _part_words() else ():
        text = pattern.sub(said, text)
    return text


@cache
def _part_words() -> frozenset[str]:
    """Words of parts, of several the last."""
    parts = [one.split()[-1] for one in (*word_table("parts"), *word_set("things", "leaves"))]
    single = [one.removesuffix("s") for one in parts]
    formed = [one + end for one in single for end in ("d", "ed", f"{one[-1:]}ed")]  # "legged"
    return frozenset((*parts, *single, *formed))


def _read_phrase(
    words: Sequence[str], at: int, lexicon: Lexicon, before: Sequence[Token]
) -> tuple[int, Senses]:
    """Number of words of the longest phrase at a word, and its senses."""
    length, senses, phrase = 1, tuple[Sense, ...](), list[str]()
    for end in range(at, len(words)):
        word = words[end].casefold()
        if end > at and word in word_set("senses", "articles"):
            continue
        phrase.append(_OWNER.sub("", word))
        if len(phrase) > LONGEST_PHRASE:
            break
        found = lexicon.get(tuple(phrase), ())
        if end == at and _OWNER.search(word):
            found = ()  # "the cat's" alone: whose, not what
        if len(phrase) > 1 and found:
            found = _without_chance(found, words, end, before)
            found = () if _is_shade(words, end, lexicon) else found
            found = () if _is_doing(words, end, lexicon) or _leads(words, end, lexicon) else found
            is_name = all(one.kind == "noun" for one in found)
            found = () if is_name and _begins_name(words, at, end, lexicon) else found
            is_thing = len(phrase) == 2 < end + 1 - at  # "approaching the camera", no camera
            found = tuple(one for one in found if one.kind != "noun" or not (
                is_thing or _is_counted(senses, one, before)))  # fmt: skip
        if found:
            length, senses = end + 1 - at, found
    figure = _read_figure(words, at, lexicon) if length == 1 else None
    return (length, senses) if figure is None else _as_senses(figure)


def _is_counted(first: Senses, whole: Sense, before: Sequence[Token]) -> bool:
    """Whether a number says how many there are on one thing: "three candles on a cake"."""
    is_many = any(one.kind == "noun" and one.value.is_plural for one in first)
    said = itertools.takewhile(lambda one: one.has("field"), reversed(before))
    is_said = any(one.says("field", "count") for one in said)  # "seven red candles on a cake"
    return is_many and is_said and not whole.value.is_plural


def _read_figure(words: Sequence[str], at: int, lexicon: Lexicon) -> Found | None:
    """A stated start or height, a quantity, or one that stays: "at a constant 600 rpm"."""
    if stated := read_stated(words, at):
        return stated
    if words[at].lstrip("-−.")[:1].isdecimal():
        return read_height(words, at) or read_quantity(words, at, lexicon)
    lead = 1 + (words[at].casefold() == "a")
    before, *rest = (*words[at : at + lead][-1:], *words[at + lead :])
    if not rest or before.casefold() not in word_set("senses", "steady"):
        return None
    further, said = read_quantity(rest, 0, lexicon)
    return (lead + further, said) if further > 1 and said else None


def _is_shade(words: Sequence[str], end: int, lexicon: Lexicon) -> bool:
    """Whether a phrase says what a thing is like that follows: "in a dark suit"."""
    after = tuple(one.casefold() for one in words[end + 1 : end + 2])
    is_noun = any(one.kind == "noun" for one in lexicon.get(after, ()))
    is_led = is_noun or words[end - 1] in ("a", "an")
    return is_led and words[end].casefold() in word_set("things", "shades")


def _is_doing(words: Sequence[str], end: int, lexicon: Lexicon) -> bool:
    """Whether a phrase's last word does what follows, or leads to it: "tilts up to follow"."""
    both = tuple(one.casefold() for one in words[end : end + 2])
    if len(both) == 2 and both[0] == "to":
        return {one.form for one in lexicon.get(both[1:], ())} == {"base"}
    is_act = len(both) == 2 and both[1].endswith("ing")
    return is_act and any(one.kind in ("scene", "effect") for one in lexicon.get(both, ()))


def _leads(words: Sequence[str], end: int, lexicon: Lexicon) -> bool:
    """Whether a phrase's last word begins a preposition of several: "turns | on top of a hill"."""
    after = tuple(one.casefold() for one in words[end : end + 3])
    return len(after) == 3 and any(one.kind == "relation" for one in lexicon.get(after, ()))


def _begins_name(words: Sequence[str], at: int, end: int, lexicon: Lexicon) -> bool:
    """Whether what is said to do something goes on as a name: "a walking robot dog"."""
    name = tuple(one.casefold() for one in words[end : end + 2])
    is_name = len(name) == 2 and any(one.kind == "noun" for one in lexicon.get(name, ()))
    return is_name and end == at + 1 and words[at].casefold().endswith("ing")


def _as_senses(found: Found) -> tuple[int, Senses]:
    """A quantity with its senses."""
    return found[0], tuple(Sense(kind, value) for kind, value in found[1])


def _is_switched(who: str, words: Sequence[str]) -> bool:
    """Whether a lamp follows its verb: "turns on the light", no "turns on the spot"."""
    return who == "lamp" and any(one.casefold() in {*LAMPS, "light", "lights"} for one in words)


def _is_act(words: Sequence[str], end: int, before: Sequence[Token]) -> bool:
    """Whether a person and a participle begin a sentence that says how: "crossing at dusk".

    Alone, or with what a crossing has or where it is seen from, "pedestrian crossing" is a place.
    """
    is_person = words[end - 1].casefold() in NOUNS["person"].synonyms
    after = words[end + 1].casefold() if end + 1 < len(words) else "."
    is_told = after[:1].isalpha() and after not in word_set("things", "of_places")
    return is_person and is_told and all(one.has("articles") for one in before)


def _without_chance(
    senses: Senses, words: Sequence[str], end: int, before: Sequence[Token]
) -> Senses:
    """Senses of several words that do not stand together by chance.

    As in "a dog moves in a circle" (no camera), "a pedestrian crossing the street", "a bus stops"
    (no things), "steps out from behind a car" (no view), "seen from the left" (no way), "comes
    down the road" (no fall), "headlights on a road" (no lamps that are lit).
    """
    after = words[end + 1].casefold() if end + 1 < len(words) else ""
    articles = word_set("senses", "articles")
    goes_on = articles | word_set("things", "routes")
    led_by = next((one.text for one in reversed(before) if not one.has("articles")), "")
    is_way = led_by in word_set("things", "over_ways")  # "crosses a zebra crossing from the right"
    is_verb = (
        words[end].endswith("ing")
        and not is_way
        and (
            after in goes_on
            or [one.casefold() for one in words[end + 1 : end + 3]] == ["in", "front"]
            or _is_act(words, end, before)
        )
    )
    is_seen = bool(before) and (before[-1].is_unknown or before[-1].has("style"))
    is_seen &= words[end - 1] in ("from", "the")
    is_placed = after == "of" and words[end].casefold() == "front"  # "a car in front of a house"
    is_many = bool(before) and before[-1].text.endswith(" of")  # "a stack of cardboard boxes"
    hues = [one.says("field", "colour") or one.text == "and" for one in reversed(before)]
    led = len([*itertools.takewhile(bool, hues)])
    led -= bool(led) and before[-led].text == "and"
    article = before[-2 - led :]  # "a green and white tram stops"
    is_single = any(one.text in ("a", "an") for one in article) and not is_many
    is_of_camera = not before or before[-1].is_sign or any(
        one.has("camera") or one.text.endswith("shot") for one in before[-9:])  # fmt: skip
    return tuple(
        one for one in senses
        if (one.kind != "noun" or not (is_verb or is_placed or (is_single and one.value.is_plural)))
        and (one.kind != "verb" or one.value.who != "camera" or is_of_camera)
        and (one.kind != "scene" or one.value[1] != "view" or after == "that"
             or after not in articles | {"to"})
        and not (after in articles and one.kind == "field" and one.value[0] == "is_lit")
        and (one.kind != "adverb" or not is_seen)
        and not (after in articles and one.kind == "verb" and one.value.who in _OF_PARTICLES
                 and one.value.relation is None and words[end] in word_set("things", "particles")
                 and not _is_switched(one.value.who, words[end + 1 : end + 5]))
    )  # fmt: skip
