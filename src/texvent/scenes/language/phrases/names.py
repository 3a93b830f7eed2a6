"""Names of persons and cities: who "Anna Berg" is and what "Lisbon" is, no dictionary says."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.language.phrases.name_lists import (
    CHARACTERS,
    CITIES,
    MEN,
    TITLES,
    WOMEN,
)
from texvent.scenes.language.words.english import list_readings
from texvent.scenes.language.words.lexicon import Lexicon
from texvent.scenes.language.words.tokens import Token

_LINKS = frozenset({"van", "von", "de", "da", "di", "la", "del", "bin"})
"""Small words inside names."""
_NO_NAME_AFTER = frozenset(
    {"a", "an", "the", "this", "that", "of", "named", "called", "st", "saint"}
)
"""Words after which one first name is rather that of a thing: "the Victoria falls"."""
_BEING = frozenset({"is", "was", "has"})
_LONGEST = 4
_ABBREVIATED = ("mr", "mrs", "ms", "dr", "prof", "st")


def join_names(tokens: Sequence[Token], known: Lexicon) -> list[Token]:
    """The tokens with each name of a person or a city as one, which says what is shown for it."""
    found: list[Token] = []
    at = 0
    while at < len(tokens):
        length, sense = _find_name(tokens, at, known)
        if sense is None:
            found.append(tokens[at])
            at += 1
            continue
        own = [token for token in tokens[at : at + length] if token.text != "."]
        text = " ".join(token.text for token in own)
        found.append(Token(text, " ".join(token.written for token in own), sense=sense))
        at += length
    return found


def _find_name(
    tokens: Sequence[Token], at: int, known: Lexicon
) -> tuple[int, tuple[str, str] | None]:
    """Number of tokens of the name at `at`, and what is shown for it; 0 where none is."""
    for length in range(min(_LONGEST, len(tokens) - at), 0, -1):
        text = " ".join(token.text for token in tokens[at : at + length])
        if text in CHARACTERS:
            return length, ("thing", CHARACTERS[text])
        if text in CITIES and (length > 1 or _is_name(tokens[at])):
            return length, ("place", "city")
    if not _is_name(tokens[at]) or known.find([one.text for one in tokens[at : at + 3]])[0] > 1:
        return 0, None
    person = _find_person(tokens, at, known)
    return (0, None) if person is None else (person[0], ("thing", person[1]))


def _find_person(tokens: Sequence[Token], at: int, known: Lexicon) -> tuple[int, str] | None:
    """Number of tokens of a person's name, and who is shown."""
    first = tokens[at].text
    before = tokens[at - 1].text if at else ""
    if first in TITLES and at + 1 < len(tokens):
        length = 2 if first in _ABBREVIATED and tokens[at + 1].text == "." else 1
        if at + length < len(tokens) and _is_name(tokens[at + length]):
            return length + _count_names(tokens, at + length, known), TITLES[first]
        return None
    length = _count_names(tokens, at, known)
    who = "man" if first in MEN else "woman" if first in WOMEN else None
    if who is not None and (length > 1 or before not in _NO_NAME_AFTER):
        return length, who
    after = tokens[at + length].text if at + length < len(tokens) else ""
    is_told = after in _BEING or (after.endswith("ing") and length > 1)
    is_open = not before or before in (",", ".", "and")
    is_new = all(_is_unknown(token, known) for token in tokens[at : at + length])
    return (length, "person") if is_open and is_told and is_new and who is None else None


def _count_names(tokens: Sequence[Token], at: int, known: Lexicon) -> int:
    """How many tokens from `at` on are names: "Anna", "Anna Berg", "Ludwig van Berg"."""
    length = 1
    while at + length < len(tokens) and length < _LONGEST:
        token = tokens[at + length]
        is_link = token.text in _LINKS and at + length + 1 < len(tokens)
        if is_link and _is_name(tokens[at + length + 1]):
            length += 2
        elif _is_name(token) and _is_surname(token, known):
            length += 1
        else:
            break
    return length


def _is_surname(token: Token, known: Lexicon) -> bool:
    return token.text not in known.words or not token.text.endswith("ing")


def _is_name(token: Token) -> bool:
    """Whether it is written as a name: one capital letter, then small ones."""
    is_word = token.picture is None and token.sense is None and token.written[:1].isupper()
    return is_word and token.text.isalpha() and not token.written[1:2].isupper()


def _is_unknown(token: Token, known: Lexicon) -> bool:
    return token.text not in known.words and not list_readings(token.text)
