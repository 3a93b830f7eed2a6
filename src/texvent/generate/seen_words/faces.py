"""Whether things that are known by their face, such as a poster, show it to the camera."""

from __future__ import annotations

import numpy as np

from texvent.generate.seen_words.picture import Picture, View
from texvent.scenes.staging.actors import Actor

FACED = frozenset(
    {"checkerboard", "chessboard", "poster", "picture frame", "large painting", "map", "sign",
     "stop sign", "dartboard", "archery target", "clock", "tv", "television", "monitor", "tablet",
     "blackboard", "whiteboard", "mirror", "page", "newspaper", "billboard", "playing card",
     "calendar", "banner", "flight board", "scoreboard", "photo", "postcard", "envelope"}
)  # fmt: skip
"""Nouns of flat things that are told by what is on their face."""
_TWO_SIDED = frozenset({"newspaper"})
"""Those of them with print on both sides."""
_HANGING = frozenset({"dartboard"})
LEAST_HEIGHT_M = 1.0
"""Height at which a dartboard hangs at least, m."""
LEAST_COSINE = 0.3
"""Of the angle between the face and the way to the camera."""
LEAST_VIEWS = 0.5
"""Share of the views that must show the face."""


def judge_face(picture: Picture, actor: Actor | None) -> str | None:
    """Why a flat thing is not recognised, or None: the camera sees its edge or its back.

    Args:
        picture: of the staged scene.
        actor: one of its bodies; None: scenery.
    """
    if actor is None or actor.noun.name not in FACED:
        return None
    if actor.noun.name in _HANGING and actor.middle(0.0)[2] < LEAST_HEIGHT_M:
        return "it is on the ground"
    sides = (actor.model.length, actor.model.width, actor.model.height)
    axis = int(np.argmin(sides))
    if axis == 1:
        return None  # no front at +x and none at the top
    cosines = [_cosine(actor, view, axis) for view in picture.views]
    if actor.noun.name in _TWO_SIDED:
        cosines = [abs(one) for one in cosines]
    shown = [one >= LEAST_COSINE for one in cosines]
    return None if np.mean(shown) >= LEAST_VIEWS else "its face is not in view"


def _cosine(actor: Actor, view: View, axis: int) -> float:
    face = actor.trajectory.at(view.time_s).to_world()[:, axis]
    way = np.asarray(view.camera.position) - actor.middle(view.time_s)
    return float(face @ way) / max(float(np.linalg.norm(way) * np.linalg.norm(face)), 1e-9)
