"""Openings that only say that something is there: "there is", "this is a picture of"."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.language.words.tokens import Token

_BEING = frozenset({"is", "are", "was", "were", "s"})
_POINTING = frozenset({"this", "these", "here"})
_ARTICLES = frozenset({"a", "an", "the", "some", "two", "three", "several", "many"})
_DENIED = frozenset({"no", "not", "nothing", "nobody", "none", "never", "without"})
_VIEWERS = frozenset({"i", "we", "you", "he", "she", "they"})


def drop_frames(tokens: Sequence[Token]) -> list[Token]:
    """The tokens without openings that name nothing: what follows is what is to be seen."""
    found: list[Token] = []
    at = 0
    while at < len(tokens):
        length = _there_is(tokens, at) or _this_is(tokens, at)
        if not length:
            found.append(tokens[at])
        at += length or 1
    return found


def _being_after(tokens: Sequence[Token], at: int) -> int:
    """Number of tokens of "there is", "there's" at that place; 0 where no such comes."""
    if tokens[at].written.casefold().endswith(("'s", "’s")):
        return 1
    is_being = at + 1 < len(tokens) and tokens[at + 1].text in _BEING
    return 2 if is_being else 0


def _there_is(tokens: Sequence[Token], at: int) -> int:
    """As in "There is a dog on the lawn"."""
    is_open = at == 0 or tokens[at - 1].is_punctuation or tokens[at - 1].text in ("and", "where")
    if tokens[at].text != "there" or not is_open:
        return 0
    length = _being_after(tokens, at)
    after = at + length
    return length if after < len(tokens) and tokens[after].text not in _DENIED else 0


def _this_is(tokens: Sequence[Token], at: int) -> int:
    """As in "This is a photo of a dog", "It's a dog", "this is how he cooks", at the start."""
    is_pointing = tokens[at].text in _POINTING
    if at > 0 or not (is_pointing or tokens[at].text == "it"):
        return 0
    length = _being_after(tokens, at)
    coming = [token.text for token in tokens[at + length : at + length + 2]]
    if not length or not coming or coming[0] in _DENIED:
        return 0
    if coming[0] == "how":
        return length + 1 if coming[1:] and coming[1] in _VIEWERS else 0
    return length if is_pointing or coming[0] in _ARTICLES else 0
