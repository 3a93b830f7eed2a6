"""What animals do besides moving on, with the English verbs that mean it.

Loads nothing but the standard library, so that the sentence reader can import it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

ANIMAL_ACTS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "graze": ("graze", "browse", "forage"),
        "eat": ("eat", "nibble", "munch", "chew", "feed", "devour", "gnaw", "feast"),
        "drink": ("drink", "lap"),
        "sniff": ("sniff", "smell", "snuffle"),
        "peck": ("peck",),
        "bark": ("bark", "yap", "growl", "snarl", "meow", "bleat", "quack", "cluck", "yelp"),
        "howl": ("howl", "roar", "bellow", "moo", "crow", "neigh", "bray"),
        "wag": ("wag",),
        "shake": ("shake off", "shake itself", "shake dry"),
        "rear": ("rear", "rear up", "beg"),
        "buck": ("buck",),
        "paw": ("paw", "dig", "burrow"),
        "nod": ("nod",),
        "groom": ("groom", "lick", "preen"),
        "eat high": (),
        "chew": ("ruminate",),
        "lie and chew": (),
        "yawn": ("yawn",),
        "pant": ("pant",),
        "spray": (),
        "look up": ("look up",),
        "fight": ("fight", "spar"),
    }
)
"""Act → verbs; those that differ from its name are reported as shown by it."""
MOUTH_ACTS = frozenset({"graze", "eat", "eat high", "drink", "sniff", "peck"})
"""Acts in which the mouth is at the ground, or at what is eaten."""


_SAID_ELSEWISE = frozenset(
    {"eat high", "groom", "chew", "lie and chew", "yawn", "pant", "spray", "look up", "fight",
     "rear"}
)  # fmt: skip
"""Acts whose words are told from whole sentences, which mean what is shown."""
_SAY_MORE = frozenset({"dig", "burrow", "beg", "devour", "gnaw"})
"""Verbs that say more than their act shows."""


@dataclass(frozen=True)
class Stance:
    """How an act changes a standing animal."""

    head_down: float = 0.0
    """1 = the mouth is at the ground, -1 = the head is thrown up."""
    pitch: float = 0.0
    """Turn of the body about the hind feet, up, rad."""
    roll: float = 0.0
    """Turn of the body about its length, rad."""
    wag: float = 0.0
    """How far the tail is to its left, 1 = as far as it goes."""
    paws: tuple[float, float] = (0.0, 0.0)
    """How far the fore feet, left and right, are lifted, in shares of the leg."""
    seat: float = 0.0
    """1 = sitting."""
    gape: float = 0.0
    """How far the mouth is open, 0 to 1."""
    tongue: float = 0.0
    """How far the tongue is out, 0 to 1."""
    trunk: float = 0.0
    """1 = an elephant's trunk is up over its head."""


STANDING = Stance()


def act_stance(act: str, time_s: float) -> Stance:
    """An act at an instant; what is no act of `ANIMAL_ACTS` is standing."""
    make = _STANCES.get(act)
    return STANDING if make is None else make(time_s)


def by_trunk(stance: Stance) -> Stance:
    """The same act of an elephant: its trunk goes down and to its mouth, its head stays up."""
    down = max(stance.head_down, 0.0)
    if down == 0.0:
        return stance
    curled = min(max(0.5 + 7.0 * (down - 0.93), 0.0), 1.0)
    return replace(stance, head_down=0.1 * down, trunk=0.38 * curled)


def lowered(activity: str, time_s: float) -> tuple[float, float]:
    """How far a body sits and how far it lies, 0 to 1, at an instant."""
    changed = 0.5 - 0.5 * math.cos(math.pi * min(max((time_s - 0.35) / 0.7, 0.0), 1.0))
    return {
        "sit": (1.0, 0.0), "lie": (0.0, 1.0), "sit down": (changed, 0.0),
        "lie and chew": (0.0, 1.0), "lie down": (0.0, changed), "stand up": (0.0, 1.0 - changed),
    }.get(activity, (0.0, 0.0))  # fmt: skip


def shown_as(act: str, verb: str) -> str | None:
    """What is seen of a verb, where that is less than it says: nothing is heard."""
    if act in ("bark", "howl"):
        return "throw up its head"
    if act in _SAID_ELSEWISE:
        return None
    is_same = act == verb.split()[0] or (verb in ANIMAL_ACTS[act] and verb not in _SAY_MORE)
    return None if is_same else act


def _swing(time_s: float, rate_hz: float) -> float:
    return math.sin(2.0 * math.pi * rate_hz * time_s)


def _low(t: float) -> Stance:
    lap = _swing(t, 1.2)
    return Stance(head_down=0.93 + 0.07 * lap, wag=0.4 * _swing(t, 0.7), gape=0.2 + 0.2 * lap)


def _peck(t: float) -> Stance:
    return Stance(head_down=0.5 - 0.5 * math.cos(2.0 * math.pi * 1.1 * t))


def _bark(t: float) -> Stance:
    jerk = max(_swing(t, 1.1), 0.0)
    return Stance(head_down=0.15 - 0.75 * jerk, pitch=0.10 * jerk, gape=jerk)


def _howl(t: float) -> Stance:
    return Stance(head_down=-0.75 - 0.25 * _swing(t, 0.6), gape=0.7)


def _shake(t: float) -> Stance:
    roll = _swing(t, 1.7)
    return Stance(head_down=0.15, roll=0.34 * roll, wag=0.8 * roll)


def _rear(t: float) -> Stance:
    up = 0.5 - 0.5 * math.cos(math.pi * t)
    paw = 0.2 * up * _swing(t, 1.2)
    return Stance(pitch=0.85 * up, paws=(0.5 * up + paw, 0.5 * up - paw))


def _buck(t: float) -> Stance:
    kick = max(_swing(t, 0.9), 0.0)
    return Stance(head_down=0.5 * kick, pitch=-0.30 * kick)


def _paw(t: float) -> Stance:
    left = 0.5 * _swing(t, 1.1)
    return Stance(head_down=0.55, paws=(max(left, 0.0), max(-left, 0.0)))


def _groom(t: float) -> Stance:
    lick = _swing(t, 1.3)
    return Stance(head_down=0.18 + 0.14 * lick, paws=(1.5 + 0.2 * lick, 0.0), seat=1.0, gape=0.35,
                  tongue=0.75 + 0.25 * lick)  # fmt: skip


def _chew(t: float) -> Stance:
    return Stance(head_down=0.05 + 0.05 * _swing(t, 0.6), gape=0.45 + 0.45 * _swing(t, 1.3))


def _yawn(t: float) -> Stance:
    wide = 0.5 - 0.5 * math.cos(2.0 * math.pi * min(max(t - 0.15, 0.0) / 1.5, 1.0))
    return Stance(head_down=-0.45 * wide, gape=wide, tongue=0.9 * wide)


def _pant(t: float) -> Stance:
    breath = _swing(t, 1.6)
    return Stance(head_down=0.08 + 0.06 * breath, gape=0.6, tongue=1.3 + 0.3 * breath)


def _spray(t: float) -> Stance:
    return Stance(head_down=-0.2 + 0.16 * _swing(t, 0.7), trunk=0.92 + 0.08 * _swing(t, 1.1))


def _look_up(t: float) -> Stance:
    up = 0.5 - 0.5 * math.cos(math.pi * min(t / 1.6, 1.0))
    return Stance(head_down=0.15 - 1.15 * up)


def _fight(t: float) -> Stance:
    up = 0.55 + 0.25 * _swing(t, 0.9)
    paw = 0.35 * _swing(t, 1.8)
    return Stance(pitch=up, paws=(0.45 + paw, 0.45 - paw), gape=0.6, head_down=0.15)


_STANCES: Mapping[str, Callable[[float], Stance]] = MappingProxyType(
    {
        **dict.fromkeys(("graze", "eat", "drink", "sniff"), _low),
        "peck": _peck,
        "bark": _bark,
        "howl": _howl,
        "wag": lambda t: Stance(wag=1.5 * _swing(t, 1.3)),
        "shake": _shake,
        "rear": _rear,
        "buck": _buck,
        "paw": _paw,
        "nod": lambda t: Stance(head_down=0.25 + 0.25 * _swing(t, 0.9)),
        "groom": _groom,
        "chew": _chew,
        "eat high": lambda t: Stance(
            head_down=-0.15 + 0.15 * _swing(t, 0.8), gape=0.4 + 0.4 * _swing(t, 1.3)
        ),
        "lie and chew": _chew,
        "yawn": _yawn,
        "pant": _pant,
        "spray": _spray,
        "look up": _look_up,
        "fight": _fight,
    }
)
