"""Tokens of a prompt: the longest phrases that the lexicon has, numbers, pictures and signs."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Sequence
from dataclasses import dataclass

from texvent.scenes.literals import find_literals
from texvent.scenes.read.lexicon import LONGEST_PHRASE, Lexicon, Sense, word_set

MOST_WORDS = 1000
"""Words of a prompt that are read; later ones are not understood, all together."""
MAX_COUNT = 24
"""Most copies of one object."""
_RANGES = {"speed_m_s": (0.0, 1000.0), "rate_hz": (0.001, 100_000.0)}
"""Least and most of a quantity of scenes."""
_WORD = re.compile(r"\d+(?:,\d{3})*(?:\.\d+)?|[^\W\d_]+(?:['’][^\W\d_]+)*|[^\W_]|[.,;:!?/()]")
_IS = re.compile(r"(?i)\b(it|that|there|he|she|camera)['’]s\b")
_OWNER = re.compile(r"['’]s?$")


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

    def all(self, kind: str) -> tuple[Sense, ...]:
        """Senses of a kind."""
        return tuple(one for one in self.senses if one.kind == kind)

    def first(self, *kinds: str) -> Sense | None:
        """The first sense of one of the kinds."""
        return next((one for one in self.senses if one.kind in kinds), None)

    def has(self, *kinds: str) -> bool:
        """Whether it may be of one of the kinds."""
        return any(one.kind in kinds for one in self.senses)

    def verbs(self, *forms: str) -> tuple[Sense, ...]:
        """Its senses as a verb in one of the forms."""
        return tuple(one for one in self.senses if one.kind == "verb" and one.form in forms)


NO_TOKEN = Token(".", -1)
"""Stands before the first token and after the last one."""


def split_prompt(prompt: str, lexicon: Lexicon) -> tuple[Token, ...]:
    """Tokens of a prompt, in order."""
    text = unicodedata.normalize("NFKC", prompt)
    found: list[Token] = []
    start = 0
    for begin, end, picture in (*find_literals(text), (len(text), len(text), None)):
        words, at = _WORD.findall(_IS.sub(r"\1 is", text[start:begin])), 0
        while at < len(words):
            length, senses = _read_phrase(words, at, lexicon, found)
            text_of = " ".join(words[at : at + length]).casefold()
            found.append(Token(text_of, len(found), senses))
            at += length
        if picture is not None:
            sense = Sense("picture", ("picture", picture))
            found.append(Token(picture.value, len(found), (sense,)))
        start = end
    if len(found) > MOST_WORDS:
        found[MOST_WORDS:] = [Token(f"{len(found) - MOST_WORDS} more words", MOST_WORDS)]
    return tuple(found)


def _read_phrase(
    words: Sequence[str], at: int, lexicon: Lexicon, before: Sequence[Token]
) -> tuple[int, tuple[Sense, ...]]:
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
        if found:
            length, senses = end + 1 - at, found
    is_number = length == 1 and words[at][0].isdecimal()
    return _read_quantity(words, at, lexicon) if is_number else (length, senses)


def _without_chance(
    senses: tuple[Sense, ...], words: Sequence[str], end: int, before: Sequence[Token]
) -> tuple[Sense, ...]:
    """Senses of several words that do not stand together by chance.

    As in "a dog moves in a circle" (no camera), "a pedestrian crossing the street", "a bus stops"
    (no things), "steps out from behind a car" (no view).
    """
    after = words[end + 1].casefold() if end + 1 < len(words) else ""
    articles = word_set("senses", "articles")
    is_verb = words[end].endswith("ing") and after in articles
    is_single = any(one.text in ("a", "an") for one in before[-2:])
    is_of_camera = not before or before[-1].is_sign or any(one.has("camera") for one in before[-9:])
    return tuple(
        one for one in senses
        if (one.kind != "noun" or not (is_verb or (is_single and one.value.is_plural)))
        and (one.kind != "verb" or one.value.who != "camera" or is_of_camera)
        and (one.kind != "scene" or one.value[1] != "view" or after not in articles)
    )  # fmt: skip


def _read_quantity(
    words: Sequence[str], at: int, lexicon: Lexicon
) -> tuple[int, tuple[Sense, ...]]:
    """A number of things, or a speed or frequency with its unit, in the range of scenes."""
    number = float(words[at].replace(",", ""))
    for length in (3, 2, 1):
        unit = tuple(word.casefold() for word in words[at + 1 : at + 1 + length])
        for sense in lexicon.get(unit, ()):
            if sense.kind == "unit":
                field, factor = sense.value
                least, most = _RANGES[field]
                is_shown = least <= number * factor <= most
                said = Sense("adverb", (field, number * factor))
                return 1 + length, (said,) if is_shown else ()
    return 1, (Sense("field", ("count", max(1, min(round(number), MAX_COUNT)))),)
