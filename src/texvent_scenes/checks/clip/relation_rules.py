"""Rules of relations: whether a body is so to another one, by boxes around both.

Left, right, front and behind are those of the image.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from texvent_scenes.checks.clip.body_boxes import BodyBoxes
from texvent_scenes.rendered_scene import Float64Array

_Flags = NDArray[np.bool_]
_Rule = Callable[[BodyBoxes, BodyBoxes], _Flags]
"""Whether a body is so to another one at each instant, [t]; [1] of relations of a whole way."""
_LEAST_DISPLACEMENT, _DIRECT, _AT_START = 0.1, 0.5, 0.25
"""Displacement, in sizes of a body, that is motion; least share of the way by which what goes
"towards" something comes nearer; gap in sizes at which what goes "from" something begins."""
_AROUND = np.array([(0, 0), (1, 0), (-1, 0), (0, 1), (0, -1)])
_HIDDEN, _CLEAR = 0.95, 1.0
"""Most half widths of both by which what comes from behind something is aside of it at first, and
least ones at the end."""
_ROUNDING = 1e-6
_FOOT, _BORNE, _SEATED = 0.3, 4, 0.6
"""Points of a foot around its middle, at so much of its size, of which something must be below so
many; height of a seat over that of who sits there."""
_BEHIND_KNEES = 0.25
"""From the middle of who sits, legs ahead, back to the seat, in the extents of the body."""
_TIP = 0.35
"""Most width of what is on a hill, as a share of that."""
_LANE_M, _STOPPED, _STOPPED_M = 3.0, 1.5, 8.0
"""Most metres aside of the line of a vehicle; gap to where something stops, in its sizes, and m."""
_ON_THE_WAY = 0.3
"""Distance from the line between two things at which something is between them, of its length."""
_BEFORE = 1.5
"""Half widths of both by which what is before or behind something may be aside of it."""
_LEAST_ARC, _ROUND = np.pi / 3.0, 0.15
"""Least angle of an arc around something, and how much its radius may differ, by its mean."""
_OBLIQUE = 0.5
"""Cosine of the angle up to which two go the same way."""
_STRAIGHT, _BY_SIDE = 0.8, 1.5
"""Cosine from which on something is straight before or behind a body; most gap then, in extents."""
_SENT = 0.5
"""Share of the way that what is sent to something has left at most."""
_BETWEEN = 24
"""Instants from one to the next at which a body is compared with what it goes through."""
_PROTRUDING, _SUNKEN, _OVERHANG = 0.12, 0.2, 2.5
"""Share of the size of what is in a container that may be beyond its sides, and least share of its
height below the rim; most extent of it, in those of the container, that does not hide it."""

_SHALLOW_M = 0.06
"""Height of what one stands in as on the ground, m: a puddle."""


def are_still(*bodies: BodyBoxes) -> bool:
    """Whether bodies stay in their places."""
    return all(
        np.ptp(one.middle, axis=0).max() <= _LEAST_DISPLACEMENT * one.size.max() for one in bodies
    )


def _within(one: BodyBoxes, other: BodyBoxes, axes: int, share: float = 0.0) -> _Flags:
    """Whether its middle is in the other's box, grown by a share of its own size, along `axes`."""
    room = 0.55 * other.size + share * one.size + 0.02
    return np.asarray((np.abs(one.middle - other.middle) <= room)[:, :axes].all(axis=1))


def _is_shallow(other: BodyBoxes) -> _Flags:
    """Whether it is so low that what is in it stands on the ground below it: a puddle."""
    return np.asarray(other.size[:, 2] <= _SHALLOW_M)


def _is_amid(one: BodyBoxes, other: BodyBoxes) -> _Flags:
    """Whether its middle is between the outermost parts of the other, seen from above."""
    low, high = other.parts[:, 0, :2].min(axis=0), other.parts[:, 1, :2].max(axis=0)
    at = (one.middle - other.middle + other.middle[0])[:, :2]
    return np.asarray(((at >= low) & (at <= high)).all(axis=1))


def _changes_sides(one: BodyBoxes, other: BodyBoxes, sign: int) -> _Flags:
    """Whether it ends in the other, or of sign 1 begins there, and comes from, or goes, outside.

    What is inside by the wall is farther out at the other end of its way.
    """
    is_amid = _is_amid(one, other)[::-sign]
    return np.asarray(is_amid[-1:] & (_recedes(one, other, sign, 2)[-1:] | ~is_amid[:1]))


def _comes_down_into(one: BodyBoxes, other: BodyBoxes) -> _Flags:
    """Whether it ends within the other, below its top, and was above that or beside it at first."""
    is_amid, above_m = _is_amid(one, other), _clears(one, other, 0.5)
    return np.asarray(is_amid[-1:] & (above_m[-1:] < 0.0) & ((above_m[:1] >= 0.0) | ~is_amid[:1]))


def _is_in_lane(one: BodyBoxes, other: BodyBoxes, sign: int) -> _Flags:
    """Whether it is in one line with another vehicle, before it (1) or behind it (-1)."""
    off, ahead = (one.middle - other.middle)[:, :2], other.ahead
    aside = np.abs(off[:, 0] * ahead[:, 1] - off[:, 1] * ahead[:, 0])
    return np.asarray((sign * (off * ahead).sum(axis=1) > 0.0) & (aside <= _LANE_M))


def _crosses_before(one: BodyBoxes, other: BodyBoxes) -> _Flags:
    """Whether it is before another one in the image, or ahead of it on its way."""
    return np.asarray(_deeper(one, other, -1) | _is_in_lane(one, other, 1))


def _is_stopped(one: BodyBoxes, other: BodyBoxes) -> _Flags:
    """Whether it comes to rest short of the other, near it."""
    off = (other.middle - one.middle)[-1, :2]
    gap = np.abs(off) - 0.5 * (one.size + other.size)[-1, :2]
    most_m = min(max(_STOPPED * one.size[-1].max(), _LANE_M), _STOPPED_M)
    is_near = np.linalg.norm(np.maximum(gap, 0.0)) <= most_m
    return np.array([is_near and off @ one.ahead[-1] > 0.0])


def _is_contained(one: BodyBoxes, other: BodyBoxes) -> _Flags:
    """Whether it is between the sides of a container, above its floor and partly below its rim."""
    room = np.maximum(0.5 * (other.size - one.size), 0.0) + _PROTRUDING * one.size
    is_amid = (np.abs(one.middle - other.middle) <= room)[:, :2].all(axis=1)
    is_below = _clears(one, other, 0.5) <= -_SUNKEN * np.minimum(one.size, other.size)[:, 2]
    is_above_floor = _clears(one, other, -0.5) >= -_PROTRUDING * one.size[:, 2] - 0.01
    is_held = one.size[:, :2].max(axis=1) <= _OVERHANG * other.size[:, :2].max(axis=1)
    return np.asarray(is_amid & is_below & is_above_floor & is_held)


def _is_enclosed(one: BodyBoxes, other: BodyBoxes) -> _Flags:
    """Whether it is in a container as `_is_contained`, and its top is below the rim."""
    top_m = _clears(one, other, 0.5) + one.size[:, 2]
    return np.asarray(_is_contained(one, other) & (top_m <= _PROTRUDING * one.size[:, 2]))


def _clears(one: BodyBoxes, other: BodyBoxes, share: float) -> Float64Array:
    """[t] height of its lowest point above a level of the other, -0.5 below to 0.5 on top, m."""
    level = other.middle[:, 2] + share * other.size[:, 2]
    return np.asarray(one.middle[:, 2] - 0.5 * one.size[:, 2] - level)


def _is_on(one: BodyBoxes, other: BodyBoxes) -> _Flags:
    """Whether parts of the other are below most of its foot, and none of it above."""
    tall = one.size[:, 2]
    room = 0.2 * tall + 0.05 + np.ptp(one.middle[:, 2])  # it may bounce
    foot_m = one.middle[:, 2] - 0.5 * tall
    low, high = (one[:, None] for one in (foot_m - room, foot_m + _SEATED * tall + 0.05))
    gone = (other.middle - other.middle[0])[:, None]
    parts = other.parts[None] + gone[:, :, None] if are_still(other) else _own_box(other)
    bears = (parts[..., 1, 2] >= low) & (parts[..., 0, 2] <= high)
    is_larger = np.asarray(one.size > other.size)  # such as a person on a chair, a bird on a fence
    reach = np.asarray(np.where(is_larger, 0.1 * other.size, _FOOT * one.size))[:, :2]
    found = np.zeros((2, len(tall)))
    back = np.where(
        np.any(is_larger, axis=1)[:, None], one.ahead * _BEHIND_KNEES * one.size[:, :2], 0.0
    )
    for way, (number, share) in itertools.product(_AROUND, enumerate((0.0, 1.0))):
        spot = (one.middle[:, :2] + way * reach - share * back)[:, None]
        is_below = ((parts[..., 0, :2] <= spot) & (parts[..., 1, :2] >= spot)).all(axis=-1)
        found[number] += (is_below & bears).any(axis=1)
    return np.asarray((found.max(axis=0) >= _BORNE) & (_clears(one, other, 0.5) <= room))


def _is_on_tip(one: BodyBoxes, other: BodyBoxes) -> _Flags:
    """Whether it is on the other, and so narrow that its foot does not stand out over the tip."""
    is_narrow = one.size[:, :2].max(axis=1) <= _TIP * other.size[:, :2].min(axis=1)
    return np.asarray(_is_on(one, other) & is_narrow)


def _is_on_face(one: BodyBoxes, other: BodyBoxes) -> _Flags:
    """Whether it is within the edge of a flat shape, and touches it."""
    off, room = np.abs(one.middle - other.middle), 0.5 * (other.size - one.size)
    is_within = (off <= np.maximum(room, 0.0) + 0.1 * one.size)[:, 2]
    gap = off - 0.5 * (other.size + one.size)
    return np.asarray(is_within & (gap[:, :2] <= 0.02).all(axis=1))


def _own_box(one: BodyBoxes) -> Float64Array:
    """[t, 1, 2, 3] its box as its only part, of a body that may turn."""
    half = 0.5 * one.size + 0.02
    return np.stack([one.middle - half, one.middle + half], axis=1)[:, None]


def _is_hung(one: BodyBoxes, other: BodyBoxes) -> _Flags:
    """Whether it touches a side of the other, no higher than that and no lower."""
    gap = np.abs(one.middle - other.middle) - 0.5 * (one.size + other.size)
    is_beside = (gap[:, :2] <= 0.05).all(axis=1)
    return np.asarray(is_beside & (gap[:, 2] <= -0.98 * one.size[:, 2]))


def _is_under(one: BodyBoxes, other: BodyBoxes) -> _Flags:
    """Whether a part of the other is above it, and none where it is itself."""
    (low, high), middle = other.parts.swapaxes(0, 1), one.middle[:, None]
    slim = 0.4 * one.size[:, None]
    is_met = ((low < middle + slim) & (high > middle - slim)).all(axis=2)
    is_over = ((low < middle) & (high > middle))[..., :2].all(axis=2)
    is_roof = is_over & np.asarray(low[:, 2] >= middle[..., 2])
    return np.asarray(~is_met.any(axis=1) & is_roof.any(axis=1))


def _aside(one: BodyBoxes, other: BodyBoxes) -> Float64Array:
    """[t] how far it is to the other's right in the image, in half widths of both."""
    half = sum(0.5 * body.size[:, :2].max(axis=1) / np.maximum(body.seen[:, 2], 1e-3)
               for body in (one, other))  # fmt: skip
    return np.asarray((one.seen - other.seen)[:, 0] / half)


def _deeper(one: BodyBoxes, other: BodyBoxes, sign: int) -> _Flags:
    is_near = np.abs(_aside(one, other)) <= _BEFORE
    return np.asarray(is_near & (sign * (one.seen - other.seen)[:, 2] > 0.0))


def _is_on_side(one: BodyBoxes, other: BodyBoxes, sign: int) -> _Flags:
    """Whether it is before (1) or behind (-1) a body that has a face.

    It is at that side of the body, or so in the image and not at the body's other side.
    """
    off = (one.middle - other.middle)[:, :2]
    ahead = sign * (off * other.ahead).sum(axis=1) / np.maximum(np.linalg.norm(off, axis=1), 1e-6)
    is_seen_so = _deeper(one, other, -sign) & (ahead > -_OBLIQUE)
    return np.asarray(is_seen_so | ((ahead >= _STRAIGHT) & _is_near(one, other, _BY_SIDE)))


def _recedes(one: BodyBoxes, other: BodyBoxes, sign: int, axes: int = 3) -> _Flags:
    """Whether it has come so much nearer or gone away along `axes`, and not mostly past it."""
    off = (one.middle - other.middle)[:, :axes]
    away, way = np.linalg.norm(off, axis=1), off - off[0]
    gone = sign * (away - away[0])
    is_direct = gone >= _DIRECT * np.linalg.norm(way, axis=1)
    return np.asarray((gone > _LEAST_DISPLACEMENT * one.size.max()) & is_direct)


def _touches_top(one: BodyBoxes, other: BodyBoxes) -> _Flags:
    """Whether its foot is at the top of the other, give or take some of its height."""
    is_level = np.abs(_clears(one, other, 0.5)) < 2.0 * _LEAST_DISPLACEMENT * one.size[:, 2] + 0.02
    return np.asarray(_within(one, other, 2) & is_level)


def _climbs(one: BodyBoxes, other: BodyBoxes, sign: int) -> _Flags:
    """Whether it gets higher, or of sign -1 lower, where the other is."""
    risen = sign * (one.middle[-1] - one.middle[0])[2]
    is_high = risen > _LEAST_DISPLACEMENT * one.size[0, 2]
    return np.asarray(_within(one, other, 2, 1.0)[[0, -1]] & is_high)


def _is_passing(one: BodyBoxes, other: BodyBoxes, share: float = 0.0) -> _Flags:
    """Whether its way begins before the other and ends behind it, or in a share of both sizes."""
    off = (one.middle - other.middle)[:, :2]
    displacement = off[-1] - off[0]
    if np.linalg.norm(displacement) < _ROUNDING * one.size.max():  # it is where it was
        return np.array([False])
    room = share * (one.size.max() + other.size.max()) * np.linalg.norm(displacement)
    return np.array([off[0] @ displacement < room and off[-1] @ displacement > -room])


def _is_through(one: BodyBoxes, other: BodyBoxes) -> _Flags:
    """Whether it goes in before the middle and out behind it, meets no part, and one is above."""
    (low, high), middle = other.parts.swapaxes(0, 1), _refined(one.middle)[:, None]
    slim = 0.3 * _refined(one.size)[:, None]
    is_met = ((low < middle + slim) & (high > middle - slim)).all(axis=2).any(axis=1)
    is_under = ((low < middle) & (high > middle))[..., :2].all(axis=2)
    is_roofed = (is_under & (low[:, 2] > middle[..., 2])).any(axis=1)
    return np.asarray(_is_passing(one, other) & ~is_met.any() & is_roofed)


def _refined(values: Float64Array) -> Float64Array:
    """[t, 3] values at many instants between these: a door is thinner than a step is long."""
    at = np.linspace(0.0, len(values) - 1.0, _BETWEEN * (len(values) - 1) + 1)
    columns = (np.interp(at, np.arange(len(values)), one) for one in values.T)
    return np.stack([*columns], axis=1)


def _is_around(one: BodyBoxes, other: BodyBoxes) -> _Flags:
    """Whether it goes half of the way around, or on an arc about it, or stays, as in a ring."""
    x, y = (one.middle - other.middle)[:, :2].T
    turned, far = np.ptp(np.unwrap(np.arctan2(y, x))), np.hypot(x, y)
    is_arc = turned >= _LEAST_ARC and np.ptp(far) <= _ROUND * far.mean()
    return np.array([turned >= 1.05 * np.pi or is_arc or are_still(one)])


def _is_near(one: BodyBoxes, other: BodyBoxes, share: float) -> _Flags:
    """Whether the gap on the ground is at most a share of the greater one's extent."""
    gap = np.abs(one.middle - other.middle) - 0.5 * (one.size + other.size)
    extent = np.maximum(one.size.max(axis=1), other.size.max(axis=1))
    return np.asarray(np.linalg.norm(np.maximum(gap[:, :2], 0.0), axis=1) <= share * extent)


def _is_beside(one: BodyBoxes, other: BodyBoxes) -> _Flags:
    """Whether it is near, and as high: not on a desk under which the other one lies.

    The gap is at most 1.5 times the geometric mean of both extents: a ball 8 m from a house is not
    next to it, a car that far is.
    """
    apart = np.abs(one.middle - other.middle) - 0.5 * (one.size + other.size)
    gap = np.linalg.norm(np.maximum(apart[:, :2], 0.0), axis=1)
    extent = np.sqrt(one.size.max(axis=1) * other.size.max(axis=1))
    return np.asarray((gap <= 1.5 * extent) & (apart[:, 2] <= 0.25 * one.size.max(axis=1)))


def is_between(one: BodyBoxes, first: BodyBoxes, second: BodyBoxes) -> _Flags:
    """Whether its middle is near the way from one to the other, and its foot not above both."""
    way = (second.middle - first.middle)[:, :2]
    off = (one.middle - first.middle)[:, :2]
    length = np.maximum(np.linalg.norm(way, axis=1), 1e-6)
    along = (off * way).sum(axis=1) / length**2
    aside = np.abs(off[:, 0] * way[:, 1] - off[:, 1] * way[:, 0]) / length
    tops = [each.middle[:, 2] + 0.5 * each.size[:, 2] for each in (first, second)]
    is_below = one.middle[:, 2] - 0.5 * one.size[:, 2] <= np.minimum(*tops)
    return np.asarray((along > 0.0) & (along < 1.0) & (aside <= _ON_THE_WAY * length) & is_below)


def _is_following(one: BodyBoxes, other: BodyBoxes) -> _Flags:
    """Whether it heads for another one, which moves and does not come towards it."""
    off = (other.middle - one.middle)[:, :2]
    gone = (np.gradient(other.middle[:, :2], axis=0) * one.ahead).sum(axis=1)
    is_led = gone > -_OBLIQUE * np.linalg.norm(np.gradient(other.middle[:, :2], axis=0), axis=1)
    return np.asarray(
        ((off * one.ahead).sum(axis=1) > 0.0) & is_led & ~np.asarray(are_still(other))
    )


def _faces(one: BodyBoxes, other: BodyBoxes) -> _Flags:
    """Whether its heading is that of the nearest point of another one, or it is in its box."""
    near = np.clip(one.middle, other.middle - 0.5 * other.size, other.middle + 0.5 * other.size)
    off = (near - one.middle)[:, :2]
    return np.asarray((off * one.ahead).sum(axis=1) >= _OBLIQUE * np.linalg.norm(off, axis=1))


def _is_sent(one: BodyBoxes, other: BodyBoxes) -> _Flags:
    """Whether what is thrown or kicked comes at least half of the way to another one."""
    apart = np.abs(one.middle - other.middle) - 0.5 * (one.size + other.size)
    gap = np.linalg.norm(np.maximum(apart[:, :2], 0.0), axis=1)
    return np.array([gap[0] > 0.0 and gap.min() <= _SENT * gap[0]])


def _overtakes(one: BodyBoxes, other: BodyBoxes) -> _Flags:
    """Whether it goes the same way as the other, from behind it to before it."""
    way, led = ((body.middle[-1] - body.middle[0])[:2] for body in (one, other))
    along = (one.middle - other.middle)[:, :2] @ way
    return np.array([along[0] < 0.0 < along[-1] and (are_still(other) or bool(led @ way > 0.0))])


def _emerges(one: BodyBoxes, other: BodyBoxes) -> _Flags:
    """Whether it is behind the other in the image at first, and no longer at the end."""
    top_m = one.middle[0, 2] + 0.5 * one.size[0, 2]
    low = other.parts[other.parts[:, 0, 2] < top_m]
    if not len(low):
        return np.array([False])
    wide = [np.ptp(low.reshape(-1, 3)[:, :2], axis=0).max(), one.size[0, :2].max()]
    half = sum(0.5 * width / np.maximum(body.seen[:, 2], 1e-3)
               for width, body in zip(wide, (other, one), strict=True))  # fmt: skip
    off = one.seen - other.seen
    aside = np.abs(off[:, 0]) / half
    is_behind = (off[:, 2] > 0.0) & (aside <= _HIDDEN)
    return np.asarray(is_behind[:1] & (aside >= _CLEAR)[-1:])


def _goes_beside(one: BodyBoxes, other: BodyBoxes) -> _Flags:
    """Whether it is beside another one that goes the same way."""
    way, led = ((body.middle[-1] - body.middle[0])[:2] for body in (one, other))
    is_along = led @ way > _OBLIQUE * np.linalg.norm(led) * np.linalg.norm(way)
    return np.asarray(_is_beside(one, other) & np.asarray(is_along))


RULES: Mapping[str, _Rule] = {
    "follow": _is_following,
    "on a slope": _is_on, "on a tip": _is_on_tip,
    "on": _is_on, "on a face": _is_on_face, "under": _is_under, "around": _is_around,
    "overtake": _overtakes, "going beside": _goes_beside,
    "facing": _faces, "sent": _is_sent,
    "past": lambda one, other: _is_passing(one, other, 0.5 * are_still(other)),
    "in": lambda one, other: _within(one, other, 3) | (_is_shallow(other) & _is_on(one, other)),
    "front of what drives": _crosses_before,
    "front in a lane": lambda one, other: _is_in_lane(one, other, 1),
    "behind in a lane": lambda one, other: _is_in_lane(one, other, -1), "stopped": _is_stopped,
    "on a seat": lambda one, other: _within(one, other, 2) & (_clears(one, other, 0.0) < 0.0),
    "push": lambda one, other: _is_near(one, other, 0.5),
    "pull": lambda one, other: _is_near(one, other, 0.5),
    "act on": lambda one, other: _is_near(one, other, 0.1),
    "catch": lambda one, other: _is_near(one, other, 0.2)[-1:],
    "contained": _is_contained, "enclosed": _is_enclosed, "hung": _is_hung,
    "never": lambda one, other: np.zeros(1, dtype=np.bool_),
    "through an opening": _is_through,
    "through": lambda one, other: _is_passing(one, other) & _within(one, other, 2),
    "above": lambda one, other: _within(one, other, 2, 0.5) & (_clears(one, other, 0.4) >= 0.0),
    "behind": lambda one, other: _deeper(one, other, 1),
    "front": lambda one, other: _deeper(one, other, -1),
    "behind a body": lambda one, other: _is_on_side(one, other, -1),
    "front of a body": lambda one, other: _is_on_side(one, other, 1),
    "left of": lambda one, other: _aside(one, other) <= -0.5,
    "right of": lambda one, other: _aside(one, other) >= 0.5,
    "beside": _is_beside,
    "at": lambda one, other: _is_near(one, other, 0.4),
    "with": lambda one, other: _is_near(one, other, 1.0),
    "towards": lambda one, other: _recedes(one, other, -1),
    "away from": lambda one, other: _recedes(one, other, 1),
    "to": lambda one, other: _recedes(one, other, -1, 2)[-1:] & _is_near(one, other, 0.5)[-1:],
    "into": lambda one, other: _changes_sides(one, other, -1),
    "down into": _comes_down_into,
    "out of": lambda one, other: _changes_sides(one, other, 1),
    "from behind": lambda one, other: _emerges(one, other),
    "off": lambda one, other: _is_on(one, other)[:1] & ~_touches_top(one, other)[-1:],
    "up": lambda one, other: _climbs(one, other, 1),
    "down": lambda one, other: _climbs(one, other, -1),
    "from": lambda one, other: _recedes(one, other, 1) & _is_near(one, other, _AT_START)[:1],
}  # fmt: skip
"""Kind of relation → whether a body is so to another; acts have none."""
