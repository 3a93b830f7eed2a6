"""Prompt to tokens: words, numbers and signs."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass, replace

from texvent.scenes.description import Picture
from texvent.scenes.language.words.literals import find_literals

_TOKEN = re.compile(r"3[dD]\b|\d{1,3}(?:,\d{3})+|\d+(?:[.,]\d+)?|[^\W\d_]+(?:['’][^\W\d_]+)*|\S")

_ONES = ("one", "two", "three", "four", "five", "six", "seven", "eight", "nine")
_TENS = ("twenty", "thirty", "forty", "fifty", "sixty", "seventy", "eighty", "ninety")
_NUMBER = re.compile(rf"\b({'|'.join(_TENS)})[-\u2010\u2011 ]({'|'.join(_ONES)})\b", re.IGNORECASE)
"""As in "twenty-five"."""
_BULLET = re.compile(r"^[ \t]*(?:[-*+•]|#+|\d{1,2}[.)])[ \t]+", re.MULTILINE)
"""What opens a heading or an item of a list."""

_JOINT = re.compile(r"[-\u2010\u2011](?=[^\W\d_])")
"""A hyphen inside a word."""


@dataclass(frozen=True)
class Token:
    """One word, number or sign of a prompt."""

    text: str
    """Lower case, without a possessive 's."""
    written: str
    """As the prompt has it."""
    picture: Picture | None = None
    """What it names, if it is a picture's file, number of squares or text."""
    is_joined: bool = False
    """Whether a hyphen joins it to the next: "clay" in "clay-covered"."""
    sense: tuple[str, str] | None = None
    """What a name or a style means that is one token: "thing", "place" or "style", and which."""
    said: str | None = None
    """What the prompt has for it, where that is another phrase: "making its way" for "moving"."""

    @property
    def is_number(self) -> bool:
        """Whether it is written in digits; "3D" is none."""
        is_plain = self.picture is None and self.sense is None
        return self.text[0].isdigit() and self.text != "3d" and is_plain

    @property
    def reported(self) -> str:
        """What a report calls it."""
        return self.text if self.said is None else self.said

    @property
    def value(self) -> float:
        """The number that is written in digits: "1,000" = 1000, "3,5" = 3.5."""
        is_grouped = re.fullmatch(r"\d{1,3}(?:,\d{3})+", self.text) is not None
        return float(self.text.replace(",", "" if is_grouped else "."))

    @property
    def is_punctuation(self) -> bool:
        """Whether it only separates words."""
        return (
            self.picture is None
            and len(self.text) == 1
            and unicodedata.category(self.text).startswith("P")
        )


def tokenize_prompt(prompt: str) -> list[Token]:
    """Tokens of a prompt, in order; compatibility forms of Unicode (NFKC) are unified.

    Hyphens and quotation marks are left out.

    Example:
        >>> [token.text for token in tokenize_prompt("It's 3.5 km/h, Close-up!")]
        ['it', '3.5', 'km', '/', 'h', ',', 'close', 'up', '!']
    """
    normal = _BULLET.sub(". ", unicodedata.normalize("NFKC", prompt))
    normal = _NUMBER.sub(_in_digits, normal)
    tokens: list[Token] = []
    start = 0
    for begin, end, picture in find_literals(normal):
        tokens.extend(_list_words(normal[start:begin]))
        tokens.append(Token(picture.value.casefold(), picture.value, picture))
        start = end
    return [*tokens, *_list_words(normal[start:])]


def _in_digits(found: re.Match[str]) -> str:
    tens, ones = found[1].lower(), found[2].lower()
    return str(10 * (_TENS.index(tens) + 2) + _ONES.index(ones) + 1)


def _list_words(text: str) -> list[Token]:
    found: list[Token] = []
    for match in _TOKEN.finditer(text):
        joined = _JOINT.match(text, match.end()) is not None
        words = _expand(match[0])
        tokens = [Token(_fold(word), word) for word in words]
        tokens[-1] = replace(tokens[-1], is_joined=joined)
        found.extend(token for token in tokens if not _only_joins(token.text[0]))
    return found


def _only_joins(sign: str) -> bool:
    """Hyphens, quotation marks and marks of emphasis."""
    return sign in '"“”*_`~#' or unicodedata.category(sign) == "Pd"


def _expand(word: str) -> tuple[str, ...]:
    """As in "doesn't" = "does not", "we're" = "we"."""
    folded = word.casefold().replace("’", "'")
    if folded.endswith("n't"):
        return (word[:-3], "not") if len(folded) > len("n't") else ("not",)
    for ending in ("'re", "'ll", "'ve", "'d", "'m"):
        if folded.endswith(ending) and len(folded) > len(ending):
            return (word[: -len(ending)],)
    return (word,)


def _fold(word: str) -> str:
    folded = word.casefold()
    for ending in ("'s", "’s"):
        folded = folded.removesuffix(ending)
    return folded or word
