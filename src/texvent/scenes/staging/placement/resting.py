"""What is on, in or at something: on its supporting surface, looking out of it, or around it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from texvent.scenes.models.people.activities import (
    DONE_SEATED,
    PERSON_NOUNS,
    SEATED,
    TO_AND_FROM_SEATS,
)
from texvent.scenes.models.people.posture import SEAT
from texvent.scenes.models.protocol import Pose
from texvent.scenes.models.support_surface import Support, find_support, top_heights
from texvent.scenes.models.tables import nouns_with
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import is_centred
from texvent.scenes.staging.placement.object_groups import ObjectGroup, list_around

_SEEN_SHARE, _ALIVE_SHARE = 0.6, 0.75
"""Share of the height of what is in something that looks out of it; of an animal, whose ears reach
above its head."""
_PROFILE_RAD = -0.35
"""Heading of a seat on which a person sits down: the way down is seen from the side."""
_FRONT_M = 0.40
"""From the front edge of a seat to the hips."""
_SEATED_M, _STANDING_M = 0.28, 0.35
"""From the edge of a table to the middle of who sits or stands at it."""
_PERSON_M = 0.5
"""Room for one of several people on something."""
_EYE_M, _UNDER_TOP_M = 1.5, 0.12
"""Height of the middle of what hangs, and least distance to the top of what it hangs on."""


def rest_on(group: ObjectGroup, target: ObjectGroup, neighbours: Sequence[int]) -> Float64Array:
    """[3] the middle of a group that is put on the supporting surface of another object, m.

    People who sit or lie take that posture and the target's heading; a target that moves carries
    the group along. `neighbours` are the indices of all objects on the target, one for each copy.
    """
    if group.noun.name in nouns_with("hangs") and target.noun.name in nouns_with("upright face"):
        return _hang_on(group, target, neighbours)
    kind, is_person = group.plan.motion.kind, group.noun.name in PERSON_NOUNS
    if target.plan.motion.is_moving:
        group.carrier = target
    elif is_person and kind in TO_AND_FROM_SEATS:
        target.plan = replace(target.plan, yaw=_PROFILE_RAD)
    if is_person and _sits(group, target):
        return _seat_on(group, target, neighbours)
    support = find_support(target.models[0])
    _line_up(group, target, support, neighbours)
    if is_person and kind in ("lie", "stand"):
        yaw = target.plan.yaw if kind == "stand" else _lying_yaw(target)
        group.plan = replace(group.plan, yaw=yaw, gesture=kind)
    group.fit()
    return target.to_world(*support.middle, support.height + group.origin_m)


def _sits(group: ObjectGroup, target: ObjectGroup) -> bool:
    """Whether a person sits there: on a seat, unless the scene has them stand, lie or jump."""
    kind = group.plan.motion.kind
    may_sit = kind in DONE_SEATED or group.scene_object.motion is None
    is_seated = kind in ("sit", "drive", "sail", *TO_AND_FROM_SEATS)
    return is_seated or (may_sit and target.noun.name in nouns_with("seat"))


def _seat_on(group: ObjectGroup, target: ObjectGroup, neighbours: Sequence[int]) -> Float64Array:
    """People on a seat, or on the part of it that moves: the board of a swing."""
    scale = float(getattr(group.models[0], "scale", 1.0))
    is_seat = target.noun.name in nouns_with("seat")
    seat_m = SEAT * float(getattr(target.models[0], "scale", 1.0))
    support = find_support(target.models[0], near_m=seat_m if is_seat else None)
    _line_up(group, target, support, neighbours)
    x, y = support.middle
    part = _moving_part(target, (x, y))
    if part is not None:
        group.carrier, group.carried_on = target, part
    elif support.high[0] > support.low[0]:
        x = max(x, support.high[0] - _FRONT_M * scale)
    kind = group.plan.motion.kind
    doing = SEATED + kind if kind in DONE_SEATED else "sit"
    doing = kind if kind in TO_AND_FROM_SEATS else doing
    group.plan = replace(group.plan, yaw=target.plan.yaw, gesture=doing)
    group.fit()
    return target.to_world(x, y, support.height - SEAT * scale)


def rest_in(group: ObjectGroup, target: ObjectGroup, neighbours: Sequence[int]) -> Float64Array:
    """As `rest_on`, in a container so that its top looks out, and unseen in what is closed."""
    if target.noun.name in nouns_with("closed") | nouns_with("passage"):
        if target.plan.motion.is_moving:
            group.carrier = target
        low = 0.05 * target.models[0].height if target.noun.name in nouns_with("closed") else 0.0
        return target.to_world(0.0, 0.0, low + group.origin_m)
    place = rest_on(group, target, neighbours)
    if group.noun.name in PERSON_NOUNS or target.noun.habitat == "ground":
        return place
    seen = _SEEN_SHARE if group.noun.habitat == "fixed" else _ALIVE_SHARE
    rim, tall = find_support(target.models[0]).height, group.models[0].height
    low = max(rim - (1.0 - seen) * tall, 0.08 * target.models[0].height)
    return np.array([place[0], place[1], target.centre[2] + low + group.origin_m])


def place_at(group: ObjectGroup, target: ObjectGroup, neighbours: Sequence[int]) -> Float64Array:
    """As `rest_on`, around a table and turned to it, the camera's side last.

    People sit on chairs there unless what they do is done standing.
    """
    said = (group.scene_object.motion, *group.scene_object.then)
    kinds = {one.kind for one in said if one is not None and one.kind != "stand"}
    scale = float(getattr(group.models[0], "scale", 1.0))
    is_person = group.noun.name in PERSON_NOUNS
    group.on_chairs = is_person and (not kinds or bool(kinds & {"sit", "sit down", *DONE_SEATED}))
    reach = (_SEATED_M if group.on_chairs else _STANDING_M) * scale
    wide, deep, _ = target.half_at_rest() + reach
    places = list_around(len(neighbours), float(wide), float(deep))
    first = neighbours.index(group.index)
    chosen = [places[(first + number) % len(places)] for number in range(len(group.models))]
    lift = SEAT * (1.0 - min(scale, 1.0)) if group.on_chairs else 0.0
    group.offsets = [(x, y, lift) for x, y, _ in chosen]
    group.yaws = [yaw for _, _, yaw in chosen]
    if group.on_chairs:
        done = sorted(kinds & DONE_SEATED)
        group.plan = replace(group.plan, gesture=SEATED + done[0] if done else "sit", path=None)
    group.fit()
    return np.array([target.centre[0], target.centre[1], group.origin_m])


def _hang_on(group: ObjectGroup, target: ObjectGroup, neighbours: Sequence[int]) -> Float64Array:
    """Flat things side by side before an upright face, as pictures on a wall."""
    model, face, yaw = group.models[0], target.models[0], target.plan.yaw
    along_it = 0.5 * math.pi if group.plan.is_path else 0.0
    group.plan = replace(group.plan, yaw=yaw + along_it)
    count = len(group.models)
    shifts = [1.2 * model.width * (number - 0.5 * (count - 1)) for number in range(count)]
    group.offsets = [(-one * math.sin(yaw), one * math.cos(yaw), 0.0) for one in shifts]
    group.fit()
    share = (neighbours.index(group.index) + 0.5 * count) / len(neighbours) - 0.5
    middle = min(_EYE_M, face.height - 0.5 * model.height - _UNDER_TOP_M)
    foot = max(middle - 0.5 * model.height, 0.0)
    height = foot + (0.5 * model.height if is_centred(group.noun) else 0.0)
    place = target.to_world(0.5 * (face.length + model.length), -share * face.width, 0.0)
    return np.array([place[0], place[1], height])


def _moving_part(target: ObjectGroup, place: tuple[float, float]) -> int | None:
    """Index of the part at a place of the surface, if it moves in the model: a swing's board."""
    model = target.models[0]
    first, later = (model.parts(Pose(time, 0.0, 0.0, "stand")) for time in (0.0, 0.61))
    x, y = (np.array([value]) for value in place)
    number = int(np.argmax([float(top_heights([part], x, y)[0]) for part in first]))
    is_still = np.allclose(first[number].to_body, later[number].to_body)
    return None if is_still else number


def _line_up(
    group: ObjectGroup, target: ObjectGroup, support: Support, neighbours: Sequence[int]
) -> None:
    """Spread the copies along the longer side of the surface; several carriers share them out."""
    body, own, several = target.models[0], len(group.offsets), len(target.offsets)
    first = neighbours.index(group.index)
    axis = 1 if body.width > body.length else 0
    extent = support.high[axis] - support.low[axis]
    if extent <= 0.0:
        extent = 0.8 * max(body.width, body.length)
    is_person = group.noun.name in PERSON_NOUNS
    size = _PERSON_M if is_person else max(group.models[0].width, group.models[0].length)
    count = math.ceil(len(neighbours) / several)
    spacing = max(min(0.95 * extent / count, 1.4 * size), min(1.05 * size, extent))
    yaw = target.plan.yaw + 0.5 * math.pi * axis
    group.offsets = []
    for number in range(first, first + own):
        x, y, z = target.offsets[number % several] if several > 1 else (0.0, 0.0, 0.0)
        along = spacing * (number // several - 0.5 * (count - 1))
        group.offsets.append((x + along * math.cos(yaw), y + along * math.sin(yaw), z))


def _lying_yaw(target: ObjectGroup) -> float:
    """Along the longer side, the head at the end that stands higher."""
    model = target.models[0]
    if model.width > model.length:
        return target.plan.yaw + 0.5 * math.pi
    parts = model.parts(Pose(0.0, 0.0, 0.0, "stand"))
    ends = np.linspace(0.40, 0.5, 9) * model.length
    back, front = (float(np.max(top_heights(parts, one, np.zeros(9)))) for one in (-ends, ends))
    # Who lies has its head at its own back.
    return target.plan.yaw + (math.pi if front > back + 0.05 else 0.0)
