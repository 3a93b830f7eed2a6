"""Things with a face: who is before a mirror or a screen looks at it; pictures hang on walls."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from texvent.scenes.description import Relation, SceneDescription
from texvent.scenes.models.protocol import Noun
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import is_centred
from texvent.scenes.staging.placement.object_groups import ObjectGroup, half_extents_over_clip

LOOKED_AT = frozenset(
    {"mirror", "television", "tv", "monitor", "computer", "aquarium", "easel", "blackboard",
     "whiteboard", "vending machine"}
)  # fmt: skip
"""Nouns with a face at which one looks who is in front of them."""
STOOD_AT = frozenset({"window", "aquarium", "easel", "blackboard", "whiteboard"})
"""Nouns that one looks at who stands at them."""
_TO_CAMERA_RAD = 0.45
"""How far both are turned to the camera out of facing each other."""
_APART_M = 0.55


def face(
    subject: ObjectGroup, target: ObjectGroup, relation: Relation
) -> tuple[float, float] | None:
    """Turn a group that stays in its place and what it is in front of, or at, to each other.

    Returns:
        Metres to the right and away at which the target stands; None: nothing is turned.
    """
    plan = subject.plan
    goes = plan.is_path or plan.path is not None or subject.carrier is not None
    nouns = LOOKED_AT if relation.kind == "front" else STOOD_AT if relation.way == "at" else ()
    if target.noun.name not in nouns or goes or subject.noun.habitat != "ground":
        return None
    subject.plan = replace(plan, yaw=-_TO_CAMERA_RAD)
    target.plan = replace(target.plan, yaw=math.pi + _TO_CAMERA_RAD)
    for group in (subject, target):
        group.half = half_extents_over_clip(group.models, group.offsets, group.plan)
    apart = 0.5 * (subject.models[0].length + target.models[0].length) + _APART_M
    apart = max(apart, 0.5 * target.models[0].width)
    return apart * math.cos(_TO_CAMERA_RAD), -0.5 * apart * math.sin(_TO_CAMERA_RAD)


_BORNE = frozenset({"on", "in", "with"})
_HUNG = frozenset(
    {"picture frame", "poster", "clock", "mirror", "tv", "map", "sign", "dartboard", "mask",
     "guitar", "laser dot"}
)  # fmt: skip
"""Flat things with their front at +x."""
_UPRIGHT = frozenset({"wall", "fence", "door", "garage front"})
"""What they hang on, at its front."""
_CLOCK, _FACADES = (
    "clock",
    frozenset(
        {
            "building",
            "tower",
            "church",
            "house",
            "castle",
            "skyscraper",
            "train station",
            "lighthouse",
        }
    ),
)
"""What is high up on a building, and as large as one sees it from the street."""
_UP, _OF_FACADE = 0.72, 0.45
"""Its height, as a share of the building's, and its size, as a share of the building's width."""
_UNDER_TOP_M = 0.12
_EYE_M = 1.5
"""Height of the middle of what hangs, where there is room."""


def hangs(own: Noun, target: Noun) -> bool:
    """Whether the one is "on" the other as a picture is on a wall."""
    is_high_up = own.name == _CLOCK and target.name in _FACADES
    return is_high_up or (own.name in _HUNG and target.name in _UPRIGHT)


def hang_clocks(description: SceneDescription, nouns: Mapping[str, Noun]) -> SceneDescription:
    """The description with a clock that comes with a building on its face, and as large as that."""
    objects, relations = list(description.objects), []
    for one in description.relations:
        ends = [one.subject, *one.targets]
        clock = next((n for n in ends if objects[n].noun == _CLOCK), None)
        facade = next((n for n in ends if objects[n].noun in _FACADES), None)
        if clock is None or facade is None or one.kind not in _BORNE:
            relations.append(one)
            continue
        small, large = (
            nouns[objects[n].noun].build(colour=None, scale=objects[n].scale, seed=0)
            for n in (clock, facade)
        )
        wanted = _OF_FACADE * min(large.length, large.width) / max(small.width, small.height)
        objects[clock] = replace(objects[clock], scale=objects[clock].scale * max(wanted, 1.0))
        relations.append(replace(one, kind="on", subject=clock, targets=(facade,)))
    return replace(description, objects=tuple(objects), relations=tuple(relations))


def hang_on(group: ObjectGroup, target: ObjectGroup, neighbours: list[int]) -> Float64Array:
    """Put a group side by side before the face of another object.

    Args:
        group: flat things; they get the target's heading.
        target: what they hang on.
        neighbours: indices of all objects there, one for each copy, which share its width.

    Returns:
        [3] the middle of the group, m.
    """
    model, face = group.models[0], target.models[0]
    yaw = target.plan.yaw
    # What moves on a wall goes along it.
    along_it = 0.5 * math.pi if group.plan.is_path else 0.0
    group.plan = replace(group.plan, yaw=yaw + along_it)
    ahead, aside = (math.cos(yaw), math.sin(yaw)), (-math.sin(yaw), math.cos(yaw))
    step = 1.2 * model.width
    count = len(group.models)
    group.offsets = [
        (shift * aside[0], shift * aside[1], 0.0)
        for shift in (step * (n - 0.5 * (count - 1)) for n in range(count))
    ]
    group.half = half_extents_over_clip(group.models, group.offsets, group.plan)
    share = (neighbours.index(group.index) + 0.5 * len(group.offsets)) / len(neighbours) - 0.5
    out, along = 0.5 * (face.length + model.length), -share * face.width
    middle = min(_EYE_M, face.height - 0.5 * model.height - _UNDER_TOP_M)
    if target.noun.name in _FACADES:
        middle = _UP * face.height
    foot = max(middle - 0.5 * model.height, 0.0)
    height = foot + (0.5 * model.height if is_centred(group.noun) else 0.0)
    x = target.centre[0] + out * ahead[0] + along * aside[0]
    y = target.centre[1] + out * ahead[1] + along * aside[1]
    return np.array([x, y, height])
