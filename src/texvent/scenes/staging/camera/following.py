"""Whether a camera goes along with its subject, and how far."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from texvent.scenes.description import SceneDescription
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.camera.pieces import KEPT_TOGETHER

_LANDMARKS = KEPT_TOGETHER | {"through", "past", "from", "towards", "away from"}


_CROSSED = 0.7
"""How far, in its lengths or heights, a subject goes in the image of a camera that goes along."""
_ALONG = 0.7
"""What goes along with the subject strays by so many of its sizes at most."""


def goes_in_depth(description: SceneDescription, main: Actor) -> bool:
    """Whether the prompt says that it comes towards the camera or goes away from it."""
    motion = description.objects[main.object_index].motion
    return motion is not None and motion.direction in ("towards", "away")


def crosses_picture(description: SceneDescription, main: Actor) -> bool:
    """Whether the prompt says that it goes to a side, or how its speed changes.

    Neither is seen by a camera that goes along with it.
    """
    motion = description.objects[main.object_index].motion
    return motion is not None and (
        motion.direction in ("left", "right", "across") or motion.end_pace is not None
    )


def has_landmark(
    description: SceneDescription, main: Actor, kinds: frozenset[str] = _LANDMARKS
) -> bool:
    """Whether the subject moves with respect to something that must stay in the picture."""
    return any(
        relation.kind in kinds and relation.subject == main.object_index
        for relation in description.relations
    )


def stay_together(actors: Sequence[Actor], main: Actor, duration_s: float) -> bool:
    """Whether all that moves keeps its place relative to the subject, about."""
    movers = [actor for actor in actors if actor.is_mover and actor is not main]
    drifts = [
        np.linalg.norm(
            actor.middle(duration_s) - main.middle(duration_s)
            - actor.middle(0.0) + main.middle(0.0)
        )
        for actor in movers
    ]  # fmt: skip
    return all(float(drift) < 2.0 * main.size_m for drift in drifts)


def share_to_follow(actors: Sequence[Actor], main: Actor, duration_s: float) -> float:
    """Share of the subject's way that the camera should go along, so that it can be large.

    It still crosses the image. 0 where it hardly goes, or where other things do not go with it.
    """
    way = main.middle(duration_s) - main.middle(0.0)
    span = max(main.model.length, main.model.height)
    apart = [
        float(np.linalg.norm(actor.middle(duration_s) - actor.middle(0.0) - way))
        for actor in actors
    ]
    if max(apart) > _ALONG * span or main.enters or main.leaves:
        return 0.0
    return max(0.0, 1.0 - _CROSSED * span / max(float(np.linalg.norm(way)), 1e-6))
