"""Who is in front of a mirror or a screen looks at it, and both are seen from the side."""

from __future__ import annotations

import math
from dataclasses import replace

from texvent.scenes.staging.placement.object_groups import ObjectGroup, half_extents_over_clip

LOOKED_AT = frozenset(
    {"mirror", "television", "tv", "monitor", "computer", "aquarium", "easel", "blackboard",
     "whiteboard", "vending machine"}
)  # fmt: skip
"""Nouns with a face at which one looks who is in front of them."""
_TO_CAMERA_RAD = 0.45
"""How far both are turned to the camera out of facing each other."""
_APART_M = 0.55


def face(subject: ObjectGroup, target: ObjectGroup) -> tuple[float, float] | None:
    """Turn a group that stays in its place and what it is in front of to each other.

    Returns:
        Metres to the right and away at which the target stands; None: nothing is turned.
    """
    plan = subject.plan
    goes = plan.is_path or plan.path is not None or subject.carrier is not None
    if target.noun.name not in LOOKED_AT or goes or subject.noun.habitat != "ground":
        return None
    subject.plan = replace(plan, yaw=-_TO_CAMERA_RAD)
    target.plan = replace(target.plan, yaw=math.pi + _TO_CAMERA_RAD)
    for group in (subject, target):
        group.half = half_extents_over_clip(group.models, group.offsets, group.plan)
    apart = 0.5 * (subject.models[0].length + target.models[0].length) + _APART_M
    apart = max(apart, 0.5 * target.models[0].width)
    return apart * math.cos(_TO_CAMERA_RAD), -0.5 * apart * math.sin(_TO_CAMERA_RAD)
