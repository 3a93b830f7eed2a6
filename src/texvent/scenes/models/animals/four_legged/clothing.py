"""What four-legged animals wear: a coat or a sweater on the trunk, a hat or glasses on the head."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from texvent.scenes.models.anchors import locate
from texvent.scenes.models.animals.four_legged.animal import Animal
from texvent.scenes.models.protocol import Model, Noun, Pose
from texvent.scenes.scene import Colour

TRUNK_CLOTHES = frozenset({"sweater", "coat", "jacket", "shirt", "hoodie", "vest"})
"""Nouns that show as cloth around the trunk of a four-legged animal."""
_USUAL: Colour = (0.55, 0.06, 0.05)
_ORANGE: Colour = (0.80, 0.26, 0.02)
_PERSONS_HEAD_M = 0.115
"""From the middle of a person's head to its crown, m."""


def wears_on_trunk(noun: Noun, garment: str) -> bool:
    """Whether a garment shows as cloth around the trunk of an animal."""
    return garment in TRUNK_CLOTHES and _animal_of(noun) is not None


def clothe(noun: Noun, worn: Iterable[tuple[str, Colour | None]]) -> Noun:
    """The noun of a four-legged animal in what covers its trunk.

    Args:
        noun: any noun; what is no four-legged animal is returned as it is.
        worn: nouns of garments with their colours; None = a usual one.
    """
    animal = _animal_of(noun)
    if animal is None:
        return noun
    build: Any = noun.build
    for name, colour in worn:
        if name in TRUNK_CLOTHES:
            hue = colour or (_ORANGE if name == "vest" else _USUAL)
            animal = replace(animal, cloth=hue)
    return replace(noun, build=partial(build.func, animal, *build.args[1:]))


def share_of_head(model: Model) -> float:
    """Size of an animal's head relative to a person's: hats and glasses fit it."""
    pose = Pose(0.0, 0.0, 0.0, "stand")
    middle, crown = (locate(model, place, pose)[:, 3] for place in ("head", "crown"))
    return float(np.linalg.norm(crown - middle)) / _PERSONS_HEAD_M


def has_fitting_head(noun: Noun) -> bool:
    """Whether its model names places on its head."""
    return _animal_of(noun) is not None


def _animal_of(noun: Noun) -> Animal | None:
    build: Any = noun.build
    args = getattr(build, "args", ())
    return args[0] if args and isinstance(args[0], Animal) else None
