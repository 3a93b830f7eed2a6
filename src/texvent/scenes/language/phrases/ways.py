"""Ways that a sentence leaves out or names by another: "left, then right", "moves back"."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.language.words.english import VerbForm, list_verb_forms
from texvent.scenes.language.words.tokens import Token

_GOING = (
    "move", "go", "come", "fly", "drive", "roll", "slide", "walk", "run", "turn", "pan", "tilt",
    "travel", "translate", "rotate", "spin", "drift", "swim", "swing", "head", "ride", "jog",
    "rush", "race", "speed", "zoom", "sail", "cycle", "gallop", "trot", "yaw", "pitch", "crawl",
)  # fmt: skip
_FORMS: dict[str, VerbForm] = {
    text: form for base in _GOING for text, form in list_verb_forms(base)
}
"""Every form of the verbs of going somewhere."""
_OPPOSITE = {
    "left": "right", "right": "left", "up": "down", "down": "up", "forward": "backward",
    "forwards": "backward", "backward": "forward", "backwards": "forward", "upwards": "down",
    "downwards": "up", "towards": "away", "toward": "away", "away": "closer",
}  # fmt: skip
_ENDS = frozenset({"and", "then", "while", "at", "again", "quickly", "slowly", "fast", "before"})
"""What may follow a way that stands alone."""
_NEARING = {text: form for text, form in list_verb_forms("approach")}
_RUNNING = {text for base in ("run", "race", "dash", "sprint") for text, _ in list_verb_forms(base)}
_ARTICLES = frozenset({"a", "an", "the"})
_TIMES = frozenset({"while", "moment", "second", "seconds", "minute", "rain", "storm", "race",
                    "game", "start", "signal", "other"})  # fmt: skip
_CROSSING = {text: form for text, form in list_verb_forms("cross")}
_PAIRS = frozenset({"two", "both", "2"})
_MEETING = (
    ("towards", "each", "other"),
    ("toward", "each", "other"),
    ("towards", "one", "another"),
    ("past", "each", "other"),
)


def plain_ways(tokens: Sequence[Token]) -> list[Token]:
    """The tokens with ways said in full; reports name what the prompt has."""
    found: list[Token] = []
    at = 0
    while at < len(tokens):
        texts = [token.text for token in tokens[at : at + 3]]
        coming = tokens[at + 1].text if at + 1 < len(tokens) else "."
        if tuple(texts) in _MEETING and found and found[-1].text in _FORMS:
            found.extend(_say("in opposite directions", tokens[at : at + 3]))
            at += 3
        elif texts[1:] == ["each", "other"] and texts[0] in _NEARING:
            verb = _inflect("move", _NEARING[texts[0]])
            found.extend(_say(f"{verb} in opposite directions", tokens[at : at + 3]))
            at += 3
        else:
            is_chased = not _TIMES & {one.text for one in tokens[at + 1 : at + 4]}
            found.extend(_replace_one(found, tokens[at], coming, is_chased))
            at += 1
    return found


def _replace_one(
    before: Sequence[Token], token: Token, coming: str, is_chased: bool
) -> list[Token]:
    is_last = not coming[0].isalnum() or coming in _ENDS
    follows_verb = bool(before) and before[-1].text in _FORMS
    if token.text in _OPPOSITE and before and before[-1].text == "then":
        # As in "flies left, then right": it flies again.
        verb = next((one for one in reversed(before) if one.text in _FORMS), None)
        return [token] if verb is None else [Token(verb.text, verb.text, said=""), token]
    if token.text in _CROSSING and is_last and _PAIRS & {one.text for one in before}:
        form = _CROSSING[token.text]
        return _say(f"{_inflect('move', form)} in opposite directions", [token])
    if token.text == "after" and coming in _ARTICLES and not follows_verb:
        # As in "runs across the grass after a ball"; "after a while" is a time.
        runs = any(one.text in _RUNNING for one in before)
        return _say("chasing", [token]) if runs and is_chased else [token]
    if token.text == "past" and follows_verb and (is_last or coming == "from"):
        return _say("across", [token])
    if token.text == "back" and follows_verb and is_last:
        way = next((one.text for one in reversed(before) if one.text in _OPPOSITE), None)
        return [token] if way is None else _say(_OPPOSITE[way], [token])
    return [token]


def _say(plain: str, tokens: Sequence[Token]) -> list[Token]:
    said = " ".join(token.text for token in tokens)
    return [
        Token(word, word, said=said if number == 0 else "")
        for number, word in enumerate(plain.split())
    ]


def _inflect(base: str, form: VerbForm) -> str:
    return next((text for text, one in list_verb_forms(base) if one is form), base)
