"""How scenery is scattered."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from texvent.scenes.scene import Colour

SNOW: Colour = (0.78, 0.82, 0.88)
_IN_BLOOM = ("flower", "crop row", "corn row")
_IN_LEAF = ("tree", "bush")


@dataclass(frozen=True)
class ScatterRule:
    """How many of one noun to scatter, in a band of distances from the camera."""

    noun: str
    count: int
    near: float
    """Nearest distance, in camera distances behind what the camera looks at."""
    far: float
    scale: tuple[float, float] = (0.8, 1.2)
    colours: tuple[Colour | None, ...] = (None,)
    fits_view: bool = False
    """Whether its size follows the camera distance, so that it neither towers nor vanishes."""
    is_metres: bool = False
    """Whether `near` and `far` are metres from the camera instead."""
    is_at_wall: bool = False
    """Whether it stands against a wall of the room; `near` and `far` do not count."""
    is_telling: bool = False
    """Whether the place is known by it, so that it stands in view if it can."""
    is_under: bool = False
    """Whether it lies flat under what the camera looks at: the lines of a court."""
    ahead_m: float = 0.0
    """How far ahead of who would else stand in its middle it lies: of a court with a net."""
    is_afloat: bool = False
    """Whether it lies in the water beside the land."""
    encloses: bool = False
    """Whether it is walls on both sides of all that is there, along the view."""
    is_beyond: bool = False
    """Whether it lies right across the view, just beyond all that is there."""
    faces_camera: bool = False
    """Whether its front is turned to the camera."""


def is_structure(rule: ScatterRule) -> bool:
    """Whether it is part of a place that is empty, too."""
    return rule.encloses or rule.is_beyond


def under_snow(rules: Iterable[ScatterRule]) -> list[ScatterRule]:
    """The same where snow lies: nothing blooms, pines for trees in leaf, white hills."""
    found = []
    for rule in rules:
        if rule.noun in _IN_LEAF:
            found.append(replace(rule, noun="pine"))
        elif rule.noun == "green hill":
            found.append(replace(rule, colours=(SNOW,)))
        elif rule.noun not in _IN_BLOOM:
            found.append(rule)
    return found


def facing(noun: str, count: int, near: float, far: float, small: float = 0.95) -> ScatterRule:
    """Something whose front faces the camera."""
    return ScatterRule(noun, count, near, far, (small, 1.1), faces_camera=True)


def under(noun: str, ahead_m: float = 0.0) -> ScatterRule:
    """Something on which all stands, so far ahead."""
    return ScatterRule(noun, 1, 0.0, 0.0, (1.0, 1.0), is_under=True, ahead_m=ahead_m)


def along_walls(*furniture: tuple[str, int], is_told: bool = True) -> tuple[ScatterRule, ...]:
    """Furniture against the walls; `is_told`: the room is known by what comes first."""
    return tuple(
        ScatterRule(
            noun, count, 0.0, 0.0, (0.95, 1.1), is_at_wall=True, is_telling=is_told and number == 0
        )
        for number, (noun, count) in enumerate(furniture)
    )
