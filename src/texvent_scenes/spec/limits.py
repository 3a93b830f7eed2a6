"""Limits of fields: ranges of numbers, words of a vocabulary, names of colours.

A limit stands in a field's type: `Annotated[float, Between(0.0, 100.0)]`. `check` raises a
`ConfigError` that begins with the path of the field, such as `objects[1].size`; kinds of words that
the vocabulary lacks are not checked. `schema` is the limit in JSON Schema.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

from texvent._registry import nearest, suggest
from texvent.config import check_range
from texvent.errors import ConfigError, shown

Vocabulary: TypeAlias = Mapping[str, Collection[str]]
"""Kind of word ("noun", "motion", "place", "effect") → the words that a generator shows."""


@dataclass(frozen=True)
class Between:
    """A range of numbers, both ends allowed."""

    low: float
    high: float

    def check(self, value: float, where: str, words: Vocabulary) -> None:
        """Refuse a number outside, NaN and infinity too."""
        del words
        check_range(where, value, self.low, self.high)

    def schema(self) -> dict[str, Any]:
        """In JSON Schema."""
        return {"minimum": self.low, "maximum": self.high}


_MOST_MEANT = 3
"""Words that are offered in place of an unknown one."""


@dataclass(frozen=True)
class Word:
    """A word of the vocabulary."""

    kind: str

    def check(self, value: str, where: str, words: Vocabulary) -> None:
        """Refuse a word that is not shown."""
        known = words.get(self.kind)
        if known is None or value in known:
            return
        others = {
            other: name
            for name, one in (known.items() if isinstance(known, Mapping) else ())
            for key in ("synonyms", "names")
            for other in getattr(one, key, ())
        }
        parts = [name for name in known if value in name.split()]
        own = [others[value]] if value in others else parts
        near = nearest(value, tuple(known)) or others.get(nearest(value, tuple(others)) or "")
        meant = [shown(one) for one in (own or [near])[:_MOST_MEANT] if one]
        hint = f"did you mean {' or '.join(meant)}?" if meant else suggest(value, tuple(known))
        raise ConfigError(f"{where} is {shown(value)}; {hint}")

    def schema(self) -> dict[str, Any]:
        """The words, which editors offer, are at one place of the schema."""
        return {"$ref": f"#/$defs/{self.kind}"}


@dataclass(frozen=True)
class Colour:
    """The name of a colour, or an sRGB code such as "#ff8000"."""

    of: str
    """Key of `colours.PALETTES`."""

    def check(self, value: str, where: str, words: Vocabulary) -> None:
        """Refuse a colour without a name or a code."""
        # Imported here: plain values of a scene need no NumPy.
        from texvent_scenes.colours import PALETTES, find_colour

        del words
        find_colour(value, PALETTES[self.of], where)

    def schema(self) -> dict[str, Any]:
        """In JSON Schema."""
        return {"$ref": f"#/$defs/{self.of} colour"}
