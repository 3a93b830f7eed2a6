"""In a corridor, an alley or a tunnel one comes along it, and is seen along it."""

from __future__ import annotations

from dataclasses import replace

from texvent.scenes.description import ObjectMotion, SceneDescription

LANES = frozenset({"corridor", "hospital corridor", "school hallway", "alley", "road tunnel"})
"""Places between two walls."""
_GOING = frozenset(
    {"walk", "run", "move", "drive", "crawl", "roll", "slide", "skate", "cycle", "dance"}
)
_ACROSS = frozenset({"truck", "orbit"})
"""Moves of a camera that looks across what goes."""


def go_along(description: SceneDescription) -> SceneDescription:
    """Who goes in a lane comes towards the camera, unless the prompt says which way."""
    shot = description.shot
    is_seen_across = shot.view in ("side", "top", "aerial") or any(
        move.kind in _ACROSS or (move.kind == "follow" and move.direction == "side")
        for move in shot.moves
    )
    if description.surroundings.place not in LANES or is_seen_across:
        return description
    objects = tuple(
        replace(one, motion=_along(one.motion), then=tuple(_along(each) for each in one.then))
        if one.motion is not None
        else one
        for one in description.objects
    )
    return replace(description, objects=objects)


def _along(motion: ObjectMotion) -> ObjectMotion:
    if motion.kind not in _GOING or motion.direction is not None:
        return motion
    return replace(motion, direction="towards")
