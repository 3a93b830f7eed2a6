"""Names of the acts of one object on another, with the English verbs that mean them.

Loads nothing but the standard library, so that the sentence reader can import it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType


@dataclass(frozen=True)
class Act:
    """One act; its name is a `Relation.kind`."""

    words: tuple[str, ...]
    """Verbs in their base form, and prepositions, that lead to the target."""
    is_single: bool = False
    """Whether it has one instant of contact."""


ACTS: Mapping[str, Act] = MappingProxyType(
    {
        "hold": Act(("hold", "grip", "grasp", "clutch", "hold up", "use", "wield", "fly")),
        "carry": Act(("carry", "bring", "transport", "walk with", "lift")),
        "wear": Act(("wear", "put on", "dressed in", "have on", "clad in")),
        "ride": Act(("ride", "ride on", "ride a")),
        "push": Act(("push", "shove")),
        "pull": Act(("pull", "drag", "tow", "haul")),
        "kick": Act(("kick", "boot", "shoot", "dribble with the feet"), is_single=True),
        "hit": Act(("hit", "strike", "bat", "smash", "swing at", "serve"), is_single=True),
        "throw": Act(("throw", "toss", "pitch", "hurl", "pass", "fling", "bowl"), is_single=True),
        "catch": Act(("catch", "receive"), is_single=True),
    }
)
"""Relation kind → act of the subject on its first target."""
