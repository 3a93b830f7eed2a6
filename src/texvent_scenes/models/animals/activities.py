"""Activities of animals in place: mouths at the ground, wagging tails, sitting and lying."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

ANIMAL_ACTIVITIES: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "graze": ("graze", "forage"),
        "eat": ("eat", "nibble", "chew", "feed"),
        "drink": ("drink",),
        "sniff": ("sniff",),
        "peck": ("peck",),
        "wag": ("wag",),
    }
)
"""Act → its verbs."""
MOUTH_ACTIVITIES = frozenset({"graze", "eat", "drink", "sniff", "peck"})
"""Acts in which the mouth is at the ground, or at what is eaten."""


@dataclass(frozen=True)
class Stance:
    """Change that an activity makes to a standing animal."""

    head_down: float = 0.0
    """1 = the mouth is at the ground."""
    gape: float = 0.0
    """Opening of the mouth, 0 to 1."""
    wag: float = 0.0
    """Deflection of the tail to its left, 1 = as far as it goes."""


STANDING = Stance()


def activity_stance(act: str, time_s: float) -> Stance:
    """An act at an instant; what is no act of `ANIMAL_ACTIVITIES` is standing."""
    make = _STANCES.get(act)
    return STANDING if make is None else make(time_s)


def lowered(activity: str, time_s: float) -> tuple[float, float]:
    """Degrees of sitting and of lying, 0 to 1, at an instant."""
    changed = 0.5 - 0.5 * math.cos(math.pi * min(max((time_s - 0.35) / 0.7, 0.0), 1.0))
    return {
        "sit": (1.0, 0.0), "lie": (0.0, 1.0), "sit down": (changed, 0.0),
        "lie down": (0.0, changed), "stand up": (0.0, 1.0 - changed),
    }.get(activity, (0.0, 0.0))  # fmt: skip


def _swing(time_s: float, rate_hz: float) -> float:
    return math.sin(2.0 * math.pi * rate_hz * time_s)


def _low(t: float) -> Stance:
    lap = _swing(t, 1.2)
    return Stance(head_down=0.93 + 0.07 * lap, wag=0.4 * _swing(t, 0.7), gape=0.2 + 0.2 * lap)


_STANCES: Mapping[str, Callable[[float], Stance]] = MappingProxyType(
    {
        **dict.fromkeys(("graze", "eat", "drink", "sniff"), _low),
        "peck": lambda t: Stance(head_down=0.5 - 0.5 * math.cos(2.0 * math.pi * 1.1 * t)),
        "wag": lambda t: Stance(wag=1.5 * _swing(t, 1.3)),
    }
)
