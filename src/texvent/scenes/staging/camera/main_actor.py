"""Which object of a scene the camera is about."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.description import SceneDescription
from texvent.scenes.staging.actors import Actor


def choose_main(description: SceneDescription, actors: Sequence[Actor]) -> Actor:
    """The object the camera is about: as said, or the first that moves or could."""
    target = description.shot.target
    for actor in actors:
        if target is not None and actor.object_index == target:
            return actor
    if any(actor.enters or actor.leaves for actor in actors):
        return next(actor for actor in actors if actor.enters or actor.leaves)
    able = (actor for actor in actors if actor.is_mover or _is_able(actor))
    return next(able, actors[0])


def _is_able(actor: Actor) -> bool:
    return actor.noun.speed_m_s > 0.0 and actor.noun.habitat != "fixed"
