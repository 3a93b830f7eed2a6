"""Quantities of a prompt: numbers of things, and numbers with their units, as kinds and values."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any, TypeAlias

from texvent_scenes.read.parsing.lexicon import word_table

Found: TypeAlias = tuple[int, tuple[tuple[str, Any], ...]]
"""Number of words that a quantity takes, and the kinds and values of its senses."""
Units: TypeAlias = Mapping[tuple[str, ...], Sequence[Any]]
"""Phrase → its senses, those of units among them."""
_ARTICLES = ("a", "an", "the")
_LEVELS = ("sea", "water", "lake", "river", "road", "street", "grass", "field", "meadow", "desert")
"""Words of places whose ground is at height 0."""
_HEIGHTS = ("height", "altitude")
MAX_COUNT = 24
"""Most copies of one object."""
_RANGES = {
    "speed_m_s": (0.0, 1000.0), "start_s": (0.0, 86_400.0), "height_m": (0.0, 10_000.0),
    "distance_m": (0.0, 10_000.0),
}  # fmt: skip
_HERTZ = (0.001, 100_000.0)
"""Least and most of a quantity of scenes."""
_SIGNS = str.maketrans("−⁄", "-/")


def _lengths() -> Mapping[str, float]:
    """Units of lengths → m."""
    found: Mapping[str, float] = word_table("said_after")["from"]["units"]
    return found


def list_figures(words: Sequence[str], lexicon: Units) -> list[str]:
    """The words, with figures for the numbers before units: "2 metres", "50 hertz"."""
    lengths = {one for each in word_table("said_after").values() for one in each["units"]}
    low, found = [one.casefold() for one in words], list(words)
    for at, word in enumerate(low[:-1]):
        units = [tuple(low[at + 1 : at + 1 + length]) for length in (1, 2, 3)]
        is_unit = low[at + 1] in lengths or any(
            sense.kind == "unit" for one in units for sense in lexicon.get(one, ())
        )
        fields = [one.value for one in lexicon.get((word,), ()) if one.kind == "field"]
        counts = [word_table("tens").get(word), *(one[1] for one in fields if one[0] == "count")]
        figure = next(filter(None, counts), None) if is_unit else None
        found[at] = words[at] if figure is None else f"{figure:g}"
    return found


def read_height(words: Sequence[str], at: int) -> Found | None:
    """A height of what is in the air: "2 m above the ground", "5 m over" the sea.

    Above another thing it is another height.
    """
    unit, over, *rest = ([one.casefold() for one in words[at + 1 : at + 5]] + ["", ""])[:4]
    factor = _lengths().get(unit)
    if factor is None or over not in ("above", "over", "off") or not words[at][0].isdigit():
        return None
    below = next((one for one in rest if one not in _ARTICLES), "")
    is_ground = below == "ground"
    try:
        value = factor * float(words[at])
    except ValueError:
        return None
    if not is_ground and (below not in _LEVELS or over == "off"):
        return None
    least, most = _RANGES["height_m"]
    length = 4 + rest.index(below) if is_ground else 2
    return length, (("adverb", ("height_m", value)),) * (least <= value <= most)


def read_stated(words: Sequence[str], at: int) -> Found | None:
    """A start or a height: "after 2 seconds", "from 1 m", "at a height of 1 metre"."""
    first, *rest = [one.casefold() for one in words[at : at + 6]]
    how = word_table("said_after").get(first, {"units": {}})
    skipped = 3 if rest[1:2] and rest[1] in _HEIGHTS and rest[2:3] == ["of"] else 0
    number, unit, after = (*rest[skipped : skipped + 3], "", "", "")[:3]
    is_behind = not skipped and after in _HEIGHTS  # "at 2 m altitude"
    factor = how["units"].get(unit)
    if not number.replace(".", "").isdecimal() or factor is None or after in ("/", "per"):
        return None  # "from 10 m/s"
    if first == "at" and not (skipped or is_behind):
        return None  # "stops at 2 m"
    value, (least, most) = factor * float(number), _RANGES[how["field"]]
    said = ((how["kind"], (how["field"], value)),) * (least <= value <= most)
    return skipped + 3 + is_behind, said


def read_quantity(words: Sequence[str], at: int, lexicon: Units) -> Found:
    """A number of things, or a speed or frequency with its unit ("1 1/2 Hz"), in range.

    Of "0.5/2 m/s" and "2-3 Hz" it is open which number is meant.
    """
    text = re.sub(" ?/ ?", "/", words[at].replace(",", "").translate(_SIGNS))
    try:
        number = float(sum(Fraction(one) for one in text.removeprefix("-").split()))
    except (ValueError, ZeroDivisionError, OverflowError):
        return 1, ()
    number = -number if text.startswith("-") else number
    units = [tuple(one.casefold() for one in words[at + 1 : at + 1 + most]) for most in (3, 2, 1)]
    senses = [(unit, one.value) for unit in units for one in lexicon.get(unit, ())
              if one.kind == "unit"]  # fmt: skip
    if unit_m := _lengths().get(" ".join(units[-1])):
        senses.append((units[-1], ("distance_m", unit_m)))  # "2 m behind a car"
    for unit, (field, factor) in senses[:1]:
        least, most = _RANGES.get(field, _HERTZ)
        said = ("adverb", (field, number * factor))
        return 1 + len(unit), (said,) * (least <= number * factor <= most)
    count = ("field", ("count", max(1, min(round(number), MAX_COUNT))))
    return 1, (count,) if number >= 0.0 and number.is_integer() else ()
