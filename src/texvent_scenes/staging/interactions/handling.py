"""Acts on a thing that is at hand: it is where its activity has it, before or in the hands."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from texvent_scenes.models.activities import TIMED, Upon, upon_of
from texvent_scenes.models.shapes import Affine
from texvent_scenes.staging.actors import Actor, size_of
from texvent_scenes.staging.interactions.holding import (
    along_tool,
    carried,
    held_at,
    is_person,
    is_tool,
    scaled,
)
from texvent_scenes.staging.tracks.track import rotation

_BEGUN_S = 0.1
"""Instant at which an act of a part of the thing begins."""
_ASLANT_M = 0.09
"""Most distance ahead of what is beside it on a bench, so that none hides the others, m."""
_APART = 1.15
"""Distance of things side by side, in their widths."""


def handle(subject: Actor, target: Actor, number: int = 0) -> tuple[Actor, Actor]:
    """Both, the thing at the place of what the subject's activity is done to.

    Args:
        subject: who does it, at rest.
        target: what it is done to.
        number: place of the thing in a row of several.
    """
    upon = upon_of(subject.track.at(0.0).activity.rpartition(" and ")[2])
    if upon is None:
        return subject, target
    is_before = upon.at == "front"
    offset = _before(upon, subject, target) if is_before else _at(upon, subject, target)
    aside = (number + 1) // 2 * (-1.0 if number % 2 else 1.0) * _APART
    across_m = aside * target.model.width
    along_m = math.copysign(min(abs(across_m), _ASLANT_M), across_m) * (upon.at == "ground")
    offset = offset + np.outer([along_m, across_m, 0.0], [0.0, 0.0, 0.0, 1.0])
    place = "ground" if is_before else upon.at
    kept = target.track.at(0.0).activity
    is_upright = not (is_tool(target) and place.endswith("hand"))
    path = held_at(subject, place, offset, is_upright=is_upright, activity=kept)
    begun_s = _BEGUN_S if kept in TIMED else None
    return subject, carried(target, replace(path, contact_s=begun_s), subject)


def _at(upon: Upon, subject: Actor, target: Actor) -> Affine:
    """At a place of the body: what is a tool by its handle, other things upright."""
    if is_tool(target) and upon.at.endswith("hand"):
        return along_tool(target)
    x, y, z = scaled(upon.place, size_of(subject.model))
    turn = rotation(upon.turn or 0.0, 0.0, 0.0)
    return np.column_stack([turn, [x, y, z + target.foot_m]])


def _before(upon: Upon, subject: Actor, target: Actor) -> Affine:
    """On the ground, its longer side across or as the act has it, so far before the body."""
    model, (gap, y, z) = target.model, scaled(upon.place, size_of(subject.model))
    gap += 0.0 if is_person(subject) else 0.5 * subject.model.length
    is_across = upon.turn is None and model.length > model.width
    deep = model.width if is_across else model.length
    yaw = 0.5 * math.pi if is_across else upon.turn or 0.0
    return np.column_stack([rotation(yaw, 0.0, 0.0), [gap + 0.5 * deep, y, z + target.foot_m]])
