"""What is on or in something: on its supporting surface, several side by side, or half inside."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from texvent.scenes.models.people.activities import (
    DONE_SEATED,
    PERSON_NOUNS,
    SEATED,
    SEATS,
    TO_AND_FROM_SEATS,
)
from texvent.scenes.models.people.posture import ANKLE, SEAT
from texvent.scenes.models.protocol import Pose
from texvent.scenes.models.shapes import bounds
from texvent.scenes.models.support_surface import Support, find_support, top_heights
from texvent.scenes.models.traits import nouns_with, trait_value
from texvent.scenes.models.wrapped.hollow import HollowModel
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import is_centred
from texvent.scenes.staging.placement.cages import CAGES, keep_in_cage
from texvent.scenes.staging.placement.contents import pack
from texvent.scenes.staging.placement.object_groups import ObjectGroup, half_extents_over_clip
from texvent.scenes.staging.placement.tables.plating import is_dished, lay_on_dish
from texvent.scenes.staging.trajectories.trajectory import Vector

GATEWAYS = frozenset({"door", "gate", "arch"})
"""In what one stands on the ground."""
TUBS = frozenset({"bathtub", "box", "barrel", "basket", "bucket", "crate", "laundry basket"})
"""In what people stand with their legs inside."""
_TUB_SHARE, _TUB_FLOOR_M = 0.45, 0.05
"""Share of a person's height below the rim at most; thickness of the floor, m."""
_SEEN_SHARE = 0.6
"""Share of the height of what is in something that looks out of it."""
_SWIMMER_SHARE = 0.5
"""The same of a fish."""
_ALIVE_SHARE = 0.75
"""The same of an animal, whose ears and antlers reach above its head."""
_PROFILE = -0.35
"""Heading of a seat on which a person sits down: the way down is seen from the side, rad."""
_HIDING = nouns_with("hides its riders") | {"house", "building"}
"""What hides who is in it."""


def rest_on(group: ObjectGroup, target: ObjectGroup, neighbours: list[int]) -> Float64Array:
    """Put a group on the supporting surface of another object.

    Args:
        group: what rests; people who sit or lie take that posture and the target's heading.
        target: what it rests on; where that moves, it carries the group along.
        neighbours: indices of all objects on the target, one for each copy: its part of the row.

    Returns:
        [3] the middle of the group, m.
    """
    if is_dished(group, target):
        top = _find_surface(target).height
        return lay_on_dish(group, target, top, len(neighbours))
    kind = group.plan.motion.kind
    if target.noun.name == "conveyor belt":
        group.belt = target
    elif target.plan.motion.is_moving:
        group.carrier = target
    sits = _sits(group, target)
    if sits and kind in TO_AND_FROM_SEATS and not target.plan.motion.is_moving:
        target.plan = replace(target.plan, yaw=_PROFILE)
    is_person = group.noun.name in PERSON_NOUNS
    support = _find_seat(target) if sits else _find_surface(target, is_person=is_person)
    scale = float(getattr(group.models[0], "scale", 1.0))
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
        doing = kind if kind in TO_AND_FROM_SEATS else doing
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
    if target.noun.name in CAGES and group.noun.habitat != "fixed":
        return _in_world(target, (0.0, 0.0, keep_in_cage(group, target)))
    if target.noun.name in _HIDING:
        if target.plan.motion.is_moving:
            group.carrier = target
        lift = _origin_height(group)
        return _in_world(target, (0.0, 0.0, 0.05 * target.models[0].height + lift))
    if target.noun.name in GATEWAYS:
        group.plan = replace(group.plan, yaw=target.plan.yaw)
        ahead = 0.25 * group.models[0].length
        return _in_world(target, (ahead, 0.0, _origin_height(group)))
    if target.noun.name == "window":
        return _rest_in_window(group, target)
    if is_person or target.noun.habitat == "ground":
        return _sink(group, target, rest_on(group, target, neighbours))
    if group.noun.habitat == "fixed" and len(target.models) == 1 and not _is_shelf(target):
        first = neighbours.index(group.index)
        low = pack(group, target, _rim_of(target), first, len(neighbours))
        group.half = half_extents_over_clip(group.models, group.offsets, group.plan)
        if target.plan.motion.is_moving:
            group.carrier = target
        return np.asarray(target.centre + np.array([0.0, 0.0, low + _origin_height(group)]))
    place = rest_on(group, target, neighbours)
    tall, deep = group.models[0].height, target.models[0].height
    top, is_hollow = _rim_of(target), isinstance(target.models[0], HollowModel)
    seen = _SEEN_SHARE if group.noun.habitat == "fixed" or is_hollow else _ALIVE_SHARE
    if group.noun.motion == "swim":
        seen = _SWIMMER_SHARE
        inside = 0.5 * min(target.models[0].length, target.models[0].width)
        group.pool_m = max(inside - 0.5 * group.models[0].length, 0.1 * inside)
        group.offsets = [(0.0, 0.0, 0.0) for _ in group.offsets]
    low = max(top - (1.0 - seen) * tall, 0.08 * deep)
    base = target.centre[2] + low + _origin_height(group)
    return np.array([place[0], place[1], base])


def _rim_of(target: ObjectGroup) -> float:
    """Height over its foot up to which a container reaches, m."""
    model = target.models[0]
    return model.height if isinstance(model, HollowModel) else _find_surface(target).height


def _sink(group: ObjectGroup, target: ObjectGroup, place: Float64Array) -> Float64Array:
    """Where a person in a tub stands: on its floor, or deep enough in it; others at their place."""
    if group.noun.name not in PERSON_NOUNS or target.noun.name not in TUBS:
        return place
    sunk = _rim_of(target) - _TUB_SHARE * group.models[0].height
    return np.array([place[0], place[1], target.centre[2] + max(sunk, _TUB_FLOOR_M)])


def _is_shelf(target: ObjectGroup) -> bool:
    """Whether what is "in" it lies in a row: long things are no vessels."""
    model = target.models[0]
    return max(model.length, model.width) > _LONG * min(model.length, model.width)


_LONG = 2.5


def _rest_in_window(group: ObjectGroup, target: ObjectGroup) -> Float64Array:
    """A person stands behind the open window; animals and things are on its sill."""
    scale = float(getattr(target.models[0], "scale", 1.0))
    _line_up(group, target, Support(0.0, (0.0, -0.5), (0.0, 0.5)), [group.index])
    if group.noun.name in PERSON_NOUNS:
        group.plan = replace(group.plan, yaw=target.plan.yaw)
        low = 0.0 if group.models[0].height > _TALL_M else 0.35
        return _in_world(target, (-0.30 * scale, 0.0, low))
    group.plan = replace(group.plan, yaw=target.plan.yaw + 0.5 * math.pi)
    return _in_world(target, (0.04 * scale, 0.0, 0.645 * scale + _origin_height(group)))


_TALL_M = 1.45
"""Whose head is above the sill; others stand on something behind it."""


def _sits(group: ObjectGroup, target: ObjectGroup) -> bool:
    """Whether a person sits there: on a seat, unless the prompt has them stand, lie or jump."""
    if group.noun.name not in PERSON_NOUNS:
        return False
    kind = group.plan.motion.kind
    if kind == "run in place":
        return False
    if kind == "stand" and (trait_value("seats", target.noun.name) or target.noun.motion == "sail"):
        return False
    is_seat = target.noun.name in SEATS and kind in DONE_SEATED
    sits = kind in TO_AND_FROM_SEATS or kind in ("sit", "drive", "sail")
    return is_seat or sits or group.carrier is not None


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


def _find_surface(target: ObjectGroup, *, is_person: bool = False) -> Support:
    """The supporting surface; of a vehicle where it carries things or people, or its roof."""
    model = target.models[0]
    loads = trait_value("carries at", target.noun.name)
    if loads is not None and not is_person:
        scale = float(getattr(model, "scale", 1.0))
        x, y, z = (scale * value for value in loads)
        return Support(z, (x, y), (x, y))
    seats = trait_value("seats", target.noun.name)
    if seats is not None:
        x, y, _ = seats[0]
        height = top_heights(
            model.parts(Pose(0.0, 0.0, 0.0, "stand")), np.array([x]), np.array([y])
        )
        return Support(float(height[0]), (x, y), (x, y))
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
    count, first = len(neighbours), neighbours.index(group.index)
    is_wide = body.width > body.length
    axis = 1 if is_wide else 0
    extent = support.high[axis] - support.low[axis]
    if extent <= 0.0:
        extent = 0.8 * max(body.width, body.length)
    size = max(group.models[0].width, group.models[0].length)
    if group.noun.name in PERSON_NOUNS:
        size = 0.5
    several = len(target.offsets)
    count = math.ceil(count / several)
    spacing = max(min(0.95 * extent / count, 1.4 * size), min(1.05 * size, extent))
    yaw = target.plan.yaw + (0.5 * math.pi if is_wide else 0.0)
    group.offsets = []
    for number in range(first, first + own):
        # Several carriers share out what is on them: each person has a mat.
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
