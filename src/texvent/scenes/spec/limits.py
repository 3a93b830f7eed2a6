"""Limits of fields: ranges of numbers, words of a vocabulary, names of colours.

A limit stands in a field's type: `Annotated[float, Between(0.0, 100.0)]`. Errors begin with the
path of the field, such as `objects[1].size`.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Any, Protocol, TypeAlias

from texvent._registry import suggest
from texvent.config import check_range
from texvent.errors import ConfigError, shown

Vocabulary: TypeAlias = Mapping[str, Collection[str]]
"""Kind of word ("noun", "motion", "place", "effect") → the words that a generator shows."""


class Limit(Protocol):
    """A condition on the value of a field."""

    def check(self, value: Any, where: str, words: Vocabulary) -> None:
        """Refuse a value with a `ConfigError`.

        Args:
            value: of the field, of its declared type.
            where: path of the field.
            words: those that the generator shows; kinds that it lacks are not checked.
        """
        ...

    def schema(self) -> dict[str, Any]:
        """The limit in JSON Schema."""
        ...


@dataclass(frozen=True)
class Between:
    """A range of numbers, both ends allowed."""

    low: float
    high: float

    def check(self, value: float, where: str, words: Vocabulary) -> None:
        """See `Limit.check`; NaN and infinity are outside."""
        del words
        check_range(where, value, self.low, self.high)

    def schema(self) -> dict[str, Any]:
        """See `Limit.schema`."""
        return {"minimum": self.low, "maximum": self.high}


@dataclass(frozen=True)
class Word:
    """A word of the vocabulary."""

    kind: str

    def check(self, value: str, where: str, words: Vocabulary) -> None:
        """See `Limit.check`."""
        known = words.get(self.kind)
        if known is None or value in known:
            return
        nouns = known.items() if isinstance(known, Mapping) else ()
        named = (name for name, one in nouns if value in getattr(one, "synonyms", ()))
        meant = next(named, None)
        hint = f"did you mean {shown(meant)}?" if meant else suggest(value, tuple(known))
        raise ConfigError(f"{where} is {shown(value)}; {hint}")

    def schema(self) -> dict[str, Any]:
        """See `Limit.schema`: the schema has the words, which editors offer, at one place."""
        return {"$ref": f"#/$defs/{self.kind}"}


@dataclass(frozen=True)
class Colour:
    """The name of a colour, or an sRGB code such as "#ff8000"."""

    of: str
    """Key of `colours.PALETTES`."""

    def check(self, value: str, where: str, words: Vocabulary) -> None:
        """See `Limit.check`."""
        # Imported here: plain values of a scene need no NumPy.
        from texvent.scenes.colours import PALETTES, find_colour

        del words
        find_colour(value, PALETTES[self.of], where)

    def schema(self) -> dict[str, Any]:
        """See `Limit.schema`."""
        return {"$ref": f"#/$defs/{self.of} colour"}
