"""Names of the acts of one object on another."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType


@dataclass(frozen=True)
class Act:
    """One act of a subject on its first target; its name is a `Relation.kind`."""

    is_single: bool = False
    """Whether it has one instant of contact."""


ACTS: Mapping[str, Act] = MappingProxyType(
    {
        **dict.fromkeys(
            ("hold", "carry", "wear", "ride", "ride along", "push", "pull", "work on", "give"),
            Act(),
        ),
        **dict.fromkeys(("on head", "on shoulder", "on back", "on lap"), Act()),
        **dict.fromkeys(("kick", "hit", "throw", "catch", "collide"), Act(is_single=True)),
    }
)
"""Relation kind → act."""
