"""Whether the camera stands and looks as its words say."""

from __future__ import annotations

import numpy as np

from texvent.generate.seen_words.picture import Picture
from texvent.scenes.description import Claim, SceneDescription

STEEP_DOWN, SLANT_DOWN = 0.85, 0.2
"""Sine of the angle at which the camera looks down in a top view, and at least from the air."""
LOW_M = 0.7
"""Height at which a camera is low in any case, m."""
KNEE_M, LOOKING_UP = 1.8, 0.05
"""Height up to which it is low if it looks up, m; and sine of the angle at which it does."""
LEAST_CLOSE = 0.45
"""Share of the picture's width or height that a thing in close-up fills."""

MOST_WIDE = 0.5
"""The same up to which a shot is wide."""


def judge_camera(picture: Picture, description: SceneDescription, claim: Claim) -> str | None:
    """Why a view or a framing is not seen, or None."""
    down = [-float(view.camera.rotation[2, 2]) for view in picture.views]
    if claim.value == "top" and max(down) < STEEP_DOWN:
        return "the camera does not look straight down"
    if claim.value == "aerial" and max(down) < SLANT_DOWN:
        return "the camera does not look down"
    if claim.value == "low":
        return _judge_low(picture)
    if claim.value == "close" and _greatest_extent(picture) < LEAST_CLOSE:
        return "things are small in the picture"
    if claim.value == "wide" and _greatest_extent(picture) > MOST_WIDE:
        return "things fill the picture"
    return None


def _judge_low(picture: Picture) -> str | None:
    for view in picture.views:
        height, up = float(view.camera.position[2]), float(view.camera.rotation[2, 2])
        if height <= LOW_M or (height <= KNEE_M and up >= LOOKING_UP):
            return None
    return "the camera is not low"


def _greatest_extent(picture: Picture) -> float:
    """Of any thing in any view, as a share of the picture's width or height."""
    edge = np.array([picture.size.width, picture.size.height])
    best = 0.0
    for view in picture.views:
        for one in np.unique(view.instance[view.instance > 0]):
            at = picture.points[view.instance == one]
            best = max(best, float((np.ptp(at, axis=0) / edge).max()))
    return best
