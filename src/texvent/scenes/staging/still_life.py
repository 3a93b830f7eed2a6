"""Still lifes: a few things that the scene names alone, side by side."""

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


def is_still_life(description: SceneDescription) -> bool:
    """Whether a few things rest side by side, with nobody; the camera sways at most."""
    objects = description.objects
    return (
        2 <= len(objects) <= _MOST
        and not any(one.noun in PERSON_NOUNS or one.side == "far" for one in objects)
        and all(one.kind in _BESIDE for one in description.relations)
        and all(one.motion is None or one.motion.kind in _RESTS for one in objects)
        and all(move.kind in ("static", "handheld") for move in description.shot.moves)
        and description.shot.framing is None
    )


def still_yaw(description: SceneDescription, noun: Noun, model: Model, yaw: float) -> float:
    """Heading of a thing in a still life, else that which it has; the camera looks north.

    What is long and thin lies across the view, so that it is seen whole, such as a bat.
    """
    is_still, turn = is_still_life(description), math.copysign(_TURNED_RAD, math.cos(yaw))
    is_long = model.length > _STICK * max(model.width, model.height)
    if is_long and noun.habitat == "fixed" and (is_still or len(description.objects) == 1):
        return turn
    # Else its front to the camera, and some of its side.
    return turn - 0.5 * math.pi if is_still and description.shot.view == "front" else yaw
