"""What is on or in something: on its supporting surface, several side by side, or half inside."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from texvent.scenes.models.people.activities import DONE_SEATED, PERSON_NOUNS, SEATED, SEATS
from texvent.scenes.models.people.daily import SEAT
from texvent.scenes.models.people.posture import ANKLE
from texvent.scenes.models.protocol import Pose
from texvent.scenes.models.shapes import bounds
from texvent.scenes.models.support_surface import Support, find_support, top_heights
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import is_centred
from texvent.scenes.staging.placement.object_groups import ObjectGroup, half_extents_over_clip
from texvent.scenes.staging.trajectories.trajectory import Vector

_SEEN_SHARE = 0.6
"""Share of the height of what is in something that looks out of it."""
_ALIVE_SHARE = 0.75
"""The same of an animal, whose ears and antlers reach above its head."""
_CLOSED = frozenset({"car", "suv", "taxi", "police car", "van", "bus", "truck", "train", "pickup",
                     "fire engine", "airplane", "helicopter", "house", "building"})  # fmt: skip
"""What hides who is in it."""


def rest_on(group: ObjectGroup, target: ObjectGroup, neighbours: list[int]) -> Float64Array:
    """Put a group on the supporting surface of another object.

    Args:
        group: what rests; people who sit or lie take that posture and the target's heading.
        target: what it rests on; where that moves, it carries the group along.
        neighbours: indices of all objects on the target: each takes its part of the row.

    Returns:
        [3] the middle of the group, m.
    """
    if target.plan.motion.is_moving:
        group.carrier = target
    sits = _sits(group, target)
    support = _find_seat(target) if sits else _find_surface(target)
    scale = float(getattr(group.models[0], "scale", 1.0))
    is_person = group.noun.name in PERSON_NOUNS
    kind = group.plan.motion.kind
    _line_up(group, target, support, neighbours)
    x, y = support.middle
    height = support.height + _origin_height(group)
    if sits:
        part = _moving_part(target, (x, y))
        if part is not None:
            group.carrier, group.carried_on = target, part
        height = support.height - SEAT * scale
        if part is None and support.high[0] > support.low[0]:
            x = max(x, support.high[0] - 0.40 * scale)
        doing = SEATED + kind if kind in DONE_SEATED else "sit"
        group.plan = replace(group.plan, yaw=target.plan.yaw, gesture=doing)
        group.grips = _feet_on_ground(height, scale) if -0.3 < height < 0.0 else ()
    elif is_person and kind == "lie":
        group.plan = replace(group.plan, yaw=_lying_yaw(target), gesture="lie")
    elif is_person and kind == "stand":
        group.plan = replace(group.plan, yaw=target.plan.yaw)
    group.half = half_extents_over_clip(group.models, group.offsets, group.plan)
    return _in_world(target, (x, y, height))


def rest_in(group: ObjectGroup, target: ObjectGroup, neighbours: list[int]) -> Float64Array:
    """Put a group into a container so that its top looks out.

    Args and result: as for `rest_on`. People sit in what carries them, unseen in a closed car.
    """
    is_person = group.noun.name in PERSON_NOUNS
    if target.noun.name in _CLOSED:
        if target.plan.motion.is_moving:
            group.carrier = target
        lift = _origin_height(group)
        return _in_world(target, (0.0, 0.0, 0.05 * target.models[0].height + lift))
    if is_person or target.noun.habitat == "ground":
        return rest_on(group, target, neighbours)
    place = rest_on(group, target, neighbours)
    own, deep = group.models[0].height, target.models[0].height
    top = _find_surface(target).height
    seen = _SEEN_SHARE if group.noun.habitat == "fixed" else _ALIVE_SHARE
    low = max(top - (1.0 - seen) * own, 0.08 * deep)
    base = target.centre[2] + low + _origin_height(group)
    return np.array([place[0], place[1], base])


def _sits(group: ObjectGroup, target: ObjectGroup) -> bool:
    """Whether somebody sits there: on a seat, unless the prompt has them stand, lie or jump."""
    if group.noun.name not in PERSON_NOUNS:
        return False
    kind = group.plan.motion.kind
    is_seat = target.noun.name in SEATS and kind in DONE_SEATED
    return is_seat or kind in ("sit", "drive", "sail") or group.carrier is not None


def _find_seat(target: ObjectGroup) -> Support:
    """Where one sits on it: a level surface about as high as a chair's, else the largest."""
    if target.noun.name not in SEATS:
        return _find_surface(target)
    scale = float(getattr(target.models[0], "scale", 1.0))
    return find_support(target.models[0], near_m=SEAT * scale)


def _moving_part(target: ObjectGroup, place: tuple[float, float]) -> int | None:
    """Index of the part at a place of the surface, if it moves in the model: a swing's board."""
    model = target.models[0]
    first, later = (model.parts(Pose(time, 0.0, 0.0, "stand")) for time in (0.0, 0.61))
    x, y = (np.array([value]) for value in place)
    tops = [float(top_heights([part], x, y)[0]) for part in first]
    number = int(np.argmax(tops))
    is_still = np.allclose(first[number].to_body, later[number].to_body)
    return None if is_still else number


def _find_surface(target: ObjectGroup) -> Support:
    """The supporting surface; of a vehicle its roof."""
    model = target.models[0]
    if target.noun.motion == "drive":
        parts = model.parts(Pose(0.0, 0.0, 0.0, "stand"))
        roof = float(top_heights(parts, np.zeros(1), np.zeros(1))[0])
        return Support(roof, (0.0, 0.0), (0.0, 0.0))
    return find_support(model)


def _line_up(
    group: ObjectGroup, target: ObjectGroup, support: Support, neighbours: list[int]
) -> None:
    """Spread the copies along the longer side of the surface."""
    body, own = target.models[0], len(group.offsets)
    count, first = own * len(neighbours), own * neighbours.index(group.index)
    is_wide = body.width > body.length
    axis = 1 if is_wide else 0
    extent = support.high[axis] - support.low[axis]
    if extent <= 0.0:
        extent = 0.8 * max(body.width, body.length)
    size = max(group.models[0].width, group.models[0].length)
    if group.noun.name in PERSON_NOUNS:
        size = 0.5
    spacing = max(min(0.95 * extent / count, 1.4 * size), min(1.05 * size, extent))
    yaw = target.plan.yaw + (0.5 * math.pi if is_wide else 0.0)
    group.offsets = [
        (a * math.cos(yaw), a * math.sin(yaw), 0.0)
        for a in (spacing * (number - 0.5 * (count - 1)) for number in range(first, first + own))
    ]


def _lying_yaw(target: ObjectGroup) -> float:
    """Along the longer side, the head at the end that stands higher."""
    model = target.models[0]
    if model.width > model.length:
        return target.plan.yaw + 0.5 * math.pi
    parts = model.parts(Pose(0.0, 0.0, 0.0, "stand"))
    ends = np.linspace(0.40, 0.5, 9) * model.length
    back = float(np.max(top_heights(parts, -ends, np.zeros(9))))
    front = float(np.max(top_heights(parts, ends, np.zeros(9))))
    # Who lies has its head at its own back.
    return target.plan.yaw + (math.pi if front > back + 0.05 else 0.0)


def _feet_on_ground(height: float, scale: float) -> tuple[tuple[str, Vector], ...]:
    """Feet of who sits low: on the ground, not in it."""
    z = ANKLE * scale - height
    return tuple(
        (f"{name} foot", (0.42 * scale, side * 0.10 * scale, z))
        for name, side in (("left", 1.0), ("right", -1.0))
    )


def _origin_height(group: ObjectGroup) -> float:
    """Height of a group's origin above what it rests on, m."""
    if not is_centred(group.noun):
        return 0.0
    parts = group.models[0].parts(Pose(0.0, 0.0, 0.0, "sit"))
    return -float(bounds(parts)[0][2])


def _in_world(target: ObjectGroup, place: Vector) -> Float64Array:
    """A place in the target's body coordinates, where its middle is, in the world."""
    cosine, sine = math.cos(target.plan.yaw), math.sin(target.plan.yaw)
    x, y, z = place
    turned = np.array([x * cosine - y * sine, x * sine + y * cosine, z])
    return np.asarray(target.centre + turned)
