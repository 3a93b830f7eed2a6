"""Prompt to tokens: words, numbers and signs."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass

from texvent.scenes.description import Picture
from texvent.scenes.language.words.literals import find_literals

_TOKEN = re.compile(r"\d+(?:[.,]\d+)?|[^\W\d_]+(?:['’][^\W\d_]+)*|\S")


@dataclass(frozen=True)
class Token:
    """One word, number or sign of a prompt."""

    text: str
    """Lower case, without a possessive 's."""
    written: str
    """As the prompt has it."""
    picture: Picture | None = None
    """What it names, if it is a picture's file, number of squares or text."""

    @property
    def is_number(self) -> bool:
        """Whether it is written in digits."""
        return self.text[0].isdigit() and self.picture is None

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
    normal = unicodedata.normalize("NFKC", prompt)
    tokens: list[Token] = []
    start = 0
    for begin, end, picture in find_literals(normal):
        tokens.extend(_list_words(normal[start:begin]))
        tokens.append(Token(picture.value.casefold(), picture.value, picture))
        start = end
    return [*tokens, *_list_words(normal[start:])]


def _list_words(text: str) -> list[Token]:
    words = (part for match in _TOKEN.finditer(text) for part in _expand(match[0]))
    tokens = (Token(_fold(word), word) for word in words)
    return [token for token in tokens if not _only_joins(token.text[0])]


def _only_joins(sign: str) -> bool:
    """Hyphens and quotation marks."""
    return sign in '"“”' or unicodedata.category(sign) == "Pd"


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
