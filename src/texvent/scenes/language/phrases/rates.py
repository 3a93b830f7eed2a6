"""Rates in words as plain ones: "10 times per second" and "every 100 ms" are "at 10 Hz"."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.language.words.tokens import Token

_NUMBERS = {
    **{word: float(number) for number, word in enumerate(
        ("one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven",
         "twelve"), start=1)},
    "fifteen": 15.0, "twenty": 20.0, "once": 1.0, "twice": 2.0,
}  # fmt: skip
_UNITS_S = {"second": 1.0, "seconds": 1.0, "sec": 1.0, "secs": 1.0, "s": 1.0, "ms": 1e-3,
            "millisecond": 1e-3, "milliseconds": 1e-3, "minute": 60.0, "minutes": 60.0}  # fmt: skip
_PER = frozenset({"per", "a", "each", "every"})
_OPENINGS = tuple(
    tuple(text.split())
    for text in (
        "at a frequency of", "with a frequency of", "at a rate of", "with a rate of",
        "at a constant rate of", "at a constant frequency of",
        "at a speed of", "with a speed of", "at a constant speed of",
        "at a constant", "at a steady", "at a fixed", "at exactly", "at precisely", "at a full",
    )
)  # fmt: skip
"""What says no more than "at" before a number."""
_REPEATS = (("every",), ("with", "a", "period", "of"), ("at", "intervals", "of"))
"""What opens the time between two of what is done."""
_LONGEST = 2 + max(len(opening) for opening in (*_OPENINGS, *_REPEATS))


def plain_rates(tokens: Sequence[Token]) -> list[Token]:
    """The tokens with rates said in Hz; reports name what the prompt has."""
    found: list[Token] = []
    at = 0
    while at < len(tokens):
        window = tokens[at : at + _LONGEST]
        length = _count_opening(window)
        if length:
            found.append(Token("at", "at", said=""))
        else:
            length, rate_hz = _read_rate(window)
            if length:
                has_at = bool(found) and found[-1].text == "at"
                said = " ".join(token.text for token in window[:length])
                found += [] if has_at else [Token("at", "at", said="")]
                found += [Token(f"{rate_hz:g}", said, said=said), Token("hz", "hz", said="")]
            else:
                found.append(tokens[at])
        at += max(length, 1)
    return found


def _count_opening(window: Sequence[Token]) -> int:
    """Tokens before a number that say no more than "at"."""
    texts = tuple(token.text for token in window)
    return next(
        (
            len(opening)
            for opening in _OPENINGS
            if texts[: len(opening)] == opening and _read_number(window[len(opening) :])
        ),
        0,
    )


def _read_rate(window: Sequence[Token]) -> tuple[int, float]:
    """How many tokens say a rate, and the rate, Hz; zeros where none is said."""
    texts = tuple(token.text for token in window)
    for opening in _REPEATS:
        at = len(opening)
        period = _read_number(window[at:])
        unit = texts[at + 1] if len(texts) > at + 1 else ""
        if texts[:at] == opening and period and unit in _UNITS_S:
            return at + 2, 1.0 / (period * _UNITS_S[unit])
    number = _read_number(window[:1])
    at = 2 if texts[1:2] == ("times",) else 1
    says_times = at == 2 or texts[:1] in (("once",), ("twice",))
    per, unit = (*texts[at : at + 2], "", "")[:2]
    if number and says_times and per in _PER and unit in ("second", "minute"):
        return at + 2, number / _UNITS_S[unit]
    return 0, 0.0


def _read_number(window: Sequence[Token]) -> float:
    """The number with which tokens begin; 0 if there is none."""
    if not window:
        return 0.0
    first = window[0]
    return first.value if first.is_number else _NUMBERS.get(first.text, 0.0)
