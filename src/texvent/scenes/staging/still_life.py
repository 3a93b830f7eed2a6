"""Still lifes: a few things that the prompt names alone, side by side."""

from __future__ import annotations

import math

from texvent.scenes.description import SceneDescription
from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.models.protocol import Model, Noun

_MOST = 3
_BESIDE = frozenset({"beside", "left of", "right of", "with"})
"""Relations that things side by side may have."""
_TURNED_RAD = 0.4
_STICK = 2.0
_RESTS = frozenset({"stand", "hang", "sit", "lie", "work"})
_CLOSER, _LARGEST = 2.0, 3.5
"""Things are brought closer in size from this ratio on, and by this factor at most."""


def is_still_life(description: SceneDescription) -> bool:
    """Whether a few things rest side by side, with nobody; the camera sways at most."""
    objects = description.objects
    return (
        2 <= len(objects) <= _MOST
        and not any(one.noun in PERSON_NOUNS for one in objects)
        and not any(one.side == "far" for one in objects)
        and all(one.kind in _BESIDE for one in description.relations)
        and all(one.motion is None or one.motion.kind in _RESTS for one in objects)
        and all(move.kind in ("static", "handheld") for move in description.shot.moves)
        and description.shot.framing is None
    )


def still_yaw(description: SceneDescription, noun: Noun, model: Model, yaw: float) -> float:
    """Heading of a thing in a still life, else that which it has; the camera looks north.

    What is long and thin lies across the view, so that it is seen whole: a bat, an open umbrella.
    """
    is_still = is_still_life(description)
    is_long = model.length > _STICK * max(model.width, model.height) or noun.name in _FROM_SIDE
    if is_long and noun.habitat == "fixed" and (is_still or len(description.objects) == 1):
        return math.copysign(_TURNED_RAD, math.cos(yaw))
    if is_still and description.shot.view == "front":
        # Its front to the camera, and some of its side.
        return -0.5 * math.pi + math.copysign(_TURNED_RAD, math.cos(yaw))
    return yaw


_FROM_SIDE = frozenset({"umbrella"})


def enlarge_beside(size_m: float, largest_m: float) -> float:
    """Factor for what stands beside something larger: of a ratio of 8, one of 4 is left.

    Example:
        >>> enlarge_beside(0.2, 1.6), enlarge_beside(0.2, 0.3)
        (2.0, 1.0)
    """
    return min(max(math.sqrt(largest_m / size_m / _CLOSER), 1.0), _LARGEST)
