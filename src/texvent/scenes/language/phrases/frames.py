"""Openings of sentences: "there is" only says what is there, "a pan right" moves the camera."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from texvent.scenes.language.words.tokens import Token

_BEING = frozenset({"is", "are", "was", "were", "s"})
_POINTING = frozenset({"this", "these", "here"})
_ARTICLES = frozenset({"a", "an", "the", "some", "two", "three", "several", "many"})
_DENIED = frozenset({"no", "not", "nothing", "nobody", "none", "never", "without"})
_VIEWERS = frozenset({"i", "we", "you", "he", "she", "they"})
_WAYS = frozenset({"left", "right", "up", "down"})
_MOVES = {
    ("pan", ""): "pans", ("truck", ""): "trucks", ("tilt", ""): "tilts", ("crane", ""): "cranes",
    ("pedestal", "up"): "rises", ("pedestal", "down"): "descends",
    ("boom", "up"): "rises", ("boom", "down"): "descends",
}  # fmt: skip
"""Noun of a camera's move, and its way where the verb tells it too → the verb."""
_AFTER_MOVES = frozenset({"over", "across", "along", "past", "from", "to", "through", "around",
                          "towards", "above"})  # fmt: skip
"""Words after the way that tell that no thing is meant: unlike "a pan left on a stove"."""
_STOPS = frozenset({".", "!", "?", ";"})


def drop_frames(tokens: Sequence[Token]) -> list[Token]:
    """The tokens without openings that name nothing: what follows is what is to be seen."""
    found: list[Token] = []
    at = 0
    while at < len(tokens):
        length = _there_is(tokens, at) or _this_is(tokens, at)
        move = () if length else _camera_move(tokens, at)
        if not length and not move:
            found.append(tokens[at])
        found.extend(move)
        at += length or len(move) or 1
    return found


def _camera_move(tokens: Sequence[Token], at: int) -> tuple[Token, ...]:
    """As in "A truck left along a cliff", "a pan right over a city": as a sentence, or nothing."""
    coming = [token.text for token in tokens[at : at + 4]]
    opens = at == 0 or tokens[at - 1].text in _STOPS
    if not opens or len(coming) < 4 or coming[0] not in ("a", "the"):
        return ()
    verb = _MOVES.get((coming[1], coming[2])) or _MOVES.get((coming[1], ""))
    if verb is None or coming[2] not in _WAYS or coming[3] not in _AFTER_MOVES:
        return ()
    is_way_told = (coming[1], coming[2]) in _MOVES
    said = f"{coming[1]} {coming[2]}" if is_way_told else coming[1]
    way = replace(tokens[at + 2], said="") if is_way_told else tokens[at + 2]
    camera = replace(tokens[at], text="camera", said="")
    return (camera, replace(tokens[at + 1], text=verb, said=said), way)


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
