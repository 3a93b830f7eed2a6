"""What the circumstances of a clause are about."""

from __future__ import annotations

from dataclasses import dataclass

OF_SCENE = frozenset(
    {"place", "light", "weather", "sky", "snow", "dust", "shadow", "glow", "clouds", "flicker",
     "waves"}
)  # fmt: skip
"""Kinds of referents that are no objects but their surroundings."""


@dataclass
class Scope:
    """What the circumstances of a clause are about."""

    subjects: list[int]
    """Objects that relations are about."""
    movers: list[int]
    """Objects whose motion directions and speeds are about; empty = the verb is not shown."""
    is_lost: bool = False
    """Whether the clause is about something that is not shown."""
    has_verb: bool = True
    is_verb_shown: bool = True
    has_object: bool = False
    acted_on: tuple[int, ...] = ()
    """Objects that the verb acts on: "candles on a cake" are on the cake, not who blows."""
    verb: str = ""
    """Base form of its verb."""
