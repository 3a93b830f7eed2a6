"""Whether people are told as people: by a head in the picture, and at work by their hands."""

from __future__ import annotations

import numpy as np

from texvent.generate.seen_words.picture import Picture, View
from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.models.people.figure import HEAD_SIZE
from texvent.scenes.projection import project
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.hand_work.working import tool_tip

LEAST_INSTANTS = 2
"""Views that must show the head."""
LEAST_HEAD = 0.4
"""Share of the head's disc in the picture that must be unhidden, and how much of it inside."""
LARGE_HEAD = 0.16
"""Height of a head, as a share of the picture's height, from which on a person is told by it."""
HAND_M = 0.15
"""What lies so near to the middle of a palm, along the view, does not hide it, m."""
ARM_M, SLIM_M = 0.26, 0.1
"""From a palm or the tip of a tool to the middle of the hand, the forearm or the tool, and half
thickness of those, at most, m."""
LEAST_SEEN = 0.5
"""Share of the views in which a hand at work must be seen."""
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


def are_hands_hidden(picture: Picture, worker: Actor) -> bool:
    """Whether neither the palm at work nor the tip of its tool is in view for most of the clip."""
    seen = [_is_hand_seen(picture, view, worker) for view in picture.views]
    return sum(seen) < LEAST_SEEN * len(seen)


def _is_hand_seen(picture: Picture, view: View, worker: Actor) -> bool:
    """Whether the palm, the tip, or what they lie on is what the image has at their place."""
    tips = tool_tip(worker, view.time_s)
    for x, y, far in project(view.camera, picture.size, tips):
        is_inside = 0.0 <= x < picture.size.width and 0.0 <= y < picture.size.height
        if far <= 0.0 or not is_inside:
            continue
        nearest = int(np.argmin(np.abs(picture.points - (x, y)).max(axis=1)))
        if view.instance[nearest] != worker.instance:
            found = view.depth[nearest] > far - HAND_M
        else:
            shape = view.shapes.to_world[view.number[nearest]]
            is_slim = float(np.sort(np.linalg.norm(shape[:, :3], axis=0))[1]) < SLIM_M
            near_m = float(np.linalg.norm(shape[:, 3] - tips, axis=1).min())
            found = is_slim and near_m < ARM_M
        if found:
            return True
    return False
