"""What the models can do: a verb that its subject cannot do is reported, not shown otherwise."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from texvent.scenes.models.machine_acts import HANG, PULSE
from texvent.scenes.models.people.activities import (
    ACTIVITIES,
    HAND_GESTURES,
    HAND_NOUNS,
    PERSON_NOUNS,
)
from texvent.scenes.models.people.creatures.names import OF_UPRIGHT
from texvent.scenes.models.protocol import Noun

ANYTHING = frozenset(
    {"move", "stand", "fall", "rise", "sink", "spin", "slide", "roll", "bounce", "swing", "sway",
     "throw", "topple", "orbit", "hover", "enter", "leave", "appear", "jump", "fly", "lie", "flip",
     PULSE, HANG}
)  # fmt: skip
"""What every object can do: a path through the air or over the ground."""
_ROOTED = frozenset(
    {"volcano", "mountain", "house", "wooden house", "building", "skyscraper", "church", "tower",
     "castle", "bridge", "lighthouse", "barn", "wall", "fountain", "factory", "temple", "hill",
     "cliff", "windmill", "wind turbine", "power pylon", "water tower", "control tower"}
)  # fmt: skip
"""What stays where it is, and is thrown, rolled and tilted by nothing."""
_RIDES = frozenset({"roller coaster", "ferris wheel", "merry-go-round", "carousel"})
"""What goes round in its place, and nowhere."""
_GOING = frozenset({"move", "slide", "rise", "sink", "fall", "drive"})
_OF_LOOSE_THINGS = frozenset({"throw", "roll", "bounce", "flip", "hover", "jump", "swing"})
_TRAVELLER = frozenset({"turn", "reverse", "zigzag"})
_ANIMAL = frozenset(
    {
        "walk",
        "run",
        "sit",
        "swim",
        "dance",
        "crawl",
        "climb",
        "crouch",
        "roll over",
        "sit down",
        "lie down",
        "stand up",
    }
)
_VEHICLE = frozenset({"drive", "wheelie", "change lane", "park", "drift"})
_LEANING = frozenset({"bicycle", "motorcycle", "scooter"})
_VESSEL = frozenset({"sail"})

_BY_MOTION: Mapping[str, frozenset[str]] = MappingProxyType(
    {"drive": _VEHICLE | _TRAVELLER, "sail": _VESSEL | _TRAVELLER, "walk": _ANIMAL | _TRAVELLER,
     "run": _ANIMAL | _TRAVELLER, "swim": _ANIMAL | _TRAVELLER, "fly": _ANIMAL | _TRAVELLER,
     "paddle": _ANIMAL | _VESSEL | _TRAVELLER, "jump": _ANIMAL | _TRAVELLER}
)  # fmt: skip
"""Usual motion of a noun → what else such a thing can do."""


def is_person(noun: Noun) -> bool:
    """Whether it is a person."""
    return noun.name in PERSON_NOUNS


def is_upright(noun: Noun) -> bool:
    """Whether it is an animal, or a toy, with a person's joints."""
    return noun.name in OF_UPRIGHT


def is_hand(noun: Noun) -> bool:
    """Whether it is a hand that stands alone."""
    return noun.name in HAND_NOUNS


def is_living(noun: Noun) -> bool:
    """Whether it is a person or an animal."""
    return is_person(noun) or noun.motion in ("walk", "run", "jump", "swim", "paddle") or (
        noun.motion == "fly" and noun.habitat == "air" and noun.speed_m_s < 30.0
    )  # fmt: skip


def can_do(noun: Noun, kind: str) -> bool:
    """Whether its model can show a motion or activity.

    Args:
        noun: the object.
        kind: an `ObjectMotion.kind`.
    """
    if noun.name in _ROOTED and kind in _OF_LOOSE_THINGS:
        return False
    if noun.name in _RIDES and kind in _GOING:
        return False
    if (
        kind in noun.acts
        or kind in ANYTHING
        or kind == noun.motion
        or (kind == "work" and noun.is_working)
    ):
        return True
    if is_person(noun):
        return kind in ACTIVITIES or kind in _TRAVELLER or kind in _ANIMAL
    if is_hand(noun):
        return kind in HAND_GESTURES
    return kind in _BY_MOTION.get(noun.motion, ())
