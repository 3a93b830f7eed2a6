"""Whether people are told as people: who is without a head in the picture is not."""

from __future__ import annotations

import numpy as np

from texvent.generate.seen_words.picture import Picture, View
from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.models.people.figure import HEAD_SIZE
from texvent.scenes.projection import project
from texvent.scenes.staging.actors import Actor

LEAST_INSTANTS = 2
"""Views that must show the head."""
LEAST_HEAD = 0.4
"""Share of the head's disc in the picture that must be unhidden, and how much of it inside."""
LARGE_HEAD = 0.16
"""Height of a head, as a share of the picture's height, from which on a person is told by it."""
_AT_HEAD_M = 0.4
"""What lies so near to the head, along the view, is a hat, glasses or a hand, m."""


def judge_head(picture: Picture, actor: Actor | None) -> str | None:
    """Why a person is not told as one, or None: its head is out of view or hidden.

    Args:
        picture: of the staged scene.
        actor: one of its bodies; None: scenery.
    """
    if actor is None or actor.noun.name not in PERSON_NOUNS:
        return None
    faults = [_look_at_head(picture, view, actor)[0] for view in picture.views]
    if faults.count(None) >= min(LEAST_INSTANTS, len(faults)):
        return None
    return next(fault for fault in faults if fault is not None)


def is_portrait(picture: Picture, actor: Actor | None) -> bool:
    """Whether a person is told by a large head, however much of the body is out of view."""
    if actor is None or actor.noun.name not in PERSON_NOUNS:
        return False
    heads = [_look_at_head(picture, view, actor) for view in picture.views]
    large = [fault is None and size >= LARGE_HEAD for fault, size in heads]
    return sum(large) >= min(LEAST_INSTANTS, len(large))


def _look_at_head(picture: Picture, view: View, actor: Actor) -> tuple[str | None, float]:
    """Why a head is not seen, or None; and its height, as a share of the picture's."""
    middle = actor.anchor("head", view.time_s)[:, 3]
    radius = 0.5 * HEAD_SIZE * float(getattr(actor.model, "scale", 1.0))
    x, y, depth = project(view.camera, view.size, middle[None])[0]
    if depth <= radius:
        return "head out of view", 0.0
    lens = view.camera.lens
    focal_px = view.camera.focal * view.size.width if lens is None else lens.fx
    reach = focal_px * radius / depth
    inner = np.minimum([x, y], [view.size.width - x, view.size.height - y])
    if np.any(inner < (2.0 * LEAST_HEAD - 1.0) * reach):
        return "head out of view", 0.0
    size = 2.0 * float(reach) / view.size.height
    near = np.linalg.norm(picture.points - [x, y], axis=1) <= reach
    if not near.any():
        return None, size  # too small to tell: sights judge that
    is_own = view.instance[near] == actor.instance
    is_at_it = is_own | (np.abs(view.depth[near] - depth) < _AT_HEAD_M)
    return (None if is_at_it.mean() >= LEAST_HEAD else "head hidden"), size
