"""Whether one body is on, in, or in the hands of another, by the exact shapes of both."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from texvent.scenes.models.machine_acts import STRUCK
from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.claims.bodies import Boxes, gap, part_boxes, top_below
from texvent.scenes.staging.placement.resting import TUBS

_INSTANTS = 7
_NEAREST = 5
"""Of 25 instants, those at which a stroke is looked for."""
_TOUCH_M, _TOUCH_SHARE = 0.02, 0.05
"""Gap that counts as contact: metres, and share of the smaller body."""
_SUNK_SHARE = 0.75
"""Share of its height that what is on something may lie below its surface: a rug's pile, snow."""
_SEAT_M, _HIPS = 0.1, 0.45
"""How far from its middle a seat reaches under who sits, m; greatest height of hips, as a share of
the size of who stands."""
_RIM_M = 0.02
"""How far the legs of who is in a tub may reach out, m."""
_LEAST_STAND = 0.2
"""Least size of what a person is on, as a share of the person's."""
_LOOSE = 1.15
"""How much larger than its container something may be over the ground, unless it is a stem."""
_SLIM = 1.5
_TALL_M = 1.3
"""Height from which a vehicle has a roof, or a rider of its own."""

_FALLING = 201
"""Instants of which the one is found at which what bounces touches the ground."""

Holds = Callable[[Actor, Actor, float], bool]
"""Whether a relation holds between two bodies at an instant, s."""


def holds_for_all(
    holds: Holds,
    subjects: Sequence[Actor],
    targets: Sequence[Actor],
    duration_s: float,
    *,
    always: bool = False,
) -> bool:
    """Whether every subject has the relation to one of the targets.

    What moves by itself needs it at some instant, what stays from the start, and what is held or
    ridden (`always`) all the time.
    """
    times = np.linspace(0.0, duration_s, _INSTANTS)
    for subject in subjects:
        own = times if subject.is_mover or any(t.is_mover for t in targets) else times[:1]
        if subject.is_mover and not always:
            own = np.append(own, _lowest(subject, duration_s))
        found = (any(holds(subject, target, float(t)) for target in targets) for t in own)
        if not (all(found) if always else any(found)):
            return False
    return True


def _lowest(actor: Actor, duration_s: float) -> float:
    """When a body is lowest, s."""
    times = np.linspace(0.0, duration_s, _FALLING)
    return float(min(times, key=lambda t: actor.trajectory.at(float(t)).position[2]))


def is_on(subject: Actor, target: Actor, time_s: float) -> bool:
    """It touches the target, over its middle, and is not sunk into it."""
    own, other = part_boxes(subject, time_s), part_boxes(target, time_s)
    (low, high), (base, top) = own.hull, other.hull
    if gap(own, other) > _tolerance(own, other) or not _is_over(own, other):
        return False
    if 0.5 * (low[2] + high[2]) < base[2] + 0.2 * (top[2] - base[2]) - _TOUCH_M:
        return False
    if subject.noun.name in PERSON_NOUNS:
        # The legs of who sits lie below the seat; a telephone carries no person.
        if subject.trajectory.at(time_s).activity == "sit" and not _has_seat(
            subject, other, time_s
        ):
            return False
        return float(np.max(top - base)) > _LEAST_STAND * float(np.max(high - low))
    surface = top_below(target, time_s, 0.5 * (low[:2] + high[:2]))
    return bool(surface < low[2] + _SUNK_SHARE * (high[2] - low[2]) + _TOUCH_M)


def _has_seat(subject: Actor, other: Boxes, time_s: float) -> bool:
    """Whether a part of what it sits on is below its hips, and not beside the knees."""
    x, y, foot = subject.trajectory.at(time_s).position
    tall = subject.model.height
    is_below = np.all(np.abs(other.high + other.low - 2.0 * np.array([x, y, 0.0]))[:, :2]
                      < (other.high - other.low)[:, :2] + 2.0 * _SEAT_M, axis=1)  # fmt: skip
    top = other.high[is_below, 2] - foot
    return bool(np.any((top > 0.0) & (top < _HIPS * tall)))


def hangs_on(subject: Actor, target: Actor, time_s: float) -> bool:
    """It touches the target, off the ground and not above its top."""
    own, other = part_boxes(subject, time_s), part_boxes(target, time_s)
    (low, high), (base, top) = own.hull, other.hull
    is_up = low[2] > base[2] + _TOUCH_M and high[2] < top[2] + _TOUCH_M
    return bool(is_up) and gap(own, other) <= _tolerance(own, other)


_SHUT = frozenset({"suitcase", "handbag", "backpack", "briefcase", "chest", "safe"})


def is_in(subject: Actor, target: Actor, time_s: float) -> bool:
    """It is no larger than the target, over its ground, and partly below its rim.

    Nothing is in what has no opening.
    """
    if target.noun.name in _SHUT:
        return False
    own, other = part_boxes(subject, time_s), part_boxes(target, time_s)
    (low, high), (base, top) = own.hull, other.hull
    size, room = high - low, top - base
    sunk = min(0.4 * size[2], 0.25 * room[2])
    is_stem = size[2] > _SLIM * float(np.max(size[:2]))
    is_inside = bool(
        (is_stem or np.all(np.sort(size[:2]) <= _LOOSE * np.sort(room[:2]) + _TOUCH_M))
        and np.all(base[:2] < 0.5 * (low + high)[:2])
        and np.all(0.5 * (low + high)[:2] < top[:2])
        and low[2] < top[2] - sunk + _TOUCH_M
        and high[2] > base[2]
    )
    is_person = subject.noun.name in PERSON_NOUNS and target.noun.name not in TUBS
    if target.noun.name in TUBS and subject.noun.name in PERSON_NOUNS:
        below = own.low[:, 2] < top[2] - _RIM_M
        is_inside = bool(
            np.any(below)
            and np.all(own.low[below, :2] > base[:2] - _RIM_M)
            and np.all(own.high[below, :2] < top[:2] + _RIM_M)
        )
    is_below_top = room[2] < _TALL_M or 0.5 * float((low + high)[2]) < top[2] - 0.1 * room[2]
    return is_below_top and (is_inside or (is_person and is_on(subject, target, time_s)))


def touches(subject: Actor, target: Actor, time_s: float) -> bool:
    """Its hands, or any other part of it, are at the target; or a string ties them."""
    if target.tether is not None and target.tether.holder is not None:
        return True
    own, other = part_boxes(subject, time_s), part_boxes(target, time_s)
    return gap(own, other) <= _TOUCH_M + 2.0 * _tolerance(own, other)


def rides(subject: Actor, target: Actor, time_s: float) -> bool:
    """It is at the target and over it, and not on the roof of something that is closed."""
    own, other = part_boxes(subject, time_s), part_boxes(target, time_s)
    (low, high), (base, top) = own.hull, other.hull
    middle, margin = 0.5 * (low + high)[:2], 0.1 * (top - base)[:2]
    is_over = np.all(middle > base[:2] - margin) and np.all(middle < top[:2] + margin)
    tall = float(top[2] - base[2])
    is_on_roof = target.noun.motion == "drive" and tall > _TALL_M and low[2] > base[2] + 0.6 * tall
    return bool(is_over and not is_on_roof) and gap(own, other) <= _TOUCH_M + _tolerance(own, other)


def strikes(
    subjects: Sequence[Actor], targets: Sequence[Actor], duration_s: float, *, moves: bool
) -> bool:
    """Whether a target comes into reach of a subject at some instant, and flies on.

    Args:
        subjects: who kicks, hits, throws or catches.
        targets: what they do it to; one of them is enough.
        duration_s: length of the clip, s.
        moves: whether the target must move, by more than its own size.
    """
    times = np.linspace(0.0, duration_s, 25)
    for target in targets:
        places = np.array([target.middle(float(t)) for t in times])
        way = float(np.linalg.norm(np.ptp(places, axis=0)))
        step = float(np.max(np.linalg.norm(np.diff(places, axis=0), axis=1)))
        swings = STRUCK in target.noun.acts and moves_parts(target, times)
        if moves and way < target.size_m and not swings:
            continue
        for subject in subjects:
            apart = [
                subject.middle(float(t)) - place for t, place in zip(times, places, strict=True)
            ]
            nearest = times[np.argsort(np.linalg.norm(apart, axis=1), kind="stable")[:_NEAREST]]
            for t in nearest:
                own, other = part_boxes(subject, float(t)), part_boxes(target, float(t))
                if gap(own, other) < step + 2.0 * _tolerance(own, other):
                    return True
    return False


def collide(subjects: Sequence[Actor], targets: Sequence[Actor], duration_s: float) -> bool:
    """Whether two of them that are not the same body touch, and are apart before."""
    times = np.linspace(0.0, duration_s, 4 * _INSTANTS)
    for one in subjects:
        for other in targets:
            if one is other:
                continue
            boxes = [(part_boxes(one, float(t)), part_boxes(other, float(t))) for t in times]
            meets = [gap(*pair) <= 2.0 * _tolerance(*pair) for pair in boxes]
            if any(meets) and not meets[0]:
                return True
    return False


def _tolerance(first: Boxes, second: Boxes) -> float:
    sizes = [float(np.max(high - low)) for low, high in (first.hull, second.hull)]
    return _TOUCH_M + _TOUCH_SHARE * min(sizes)


def _is_over(own: Boxes, other: Boxes) -> bool:
    """Whether the middle of the smaller one lies over the ground of the larger one."""
    (low, high), (base, top) = own.hull, other.hull
    if np.prod(high[:2] - low[:2]) > np.prod(top[:2] - base[:2]):
        low, high, base, top = base, top, low, high
    middle, margin = 0.5 * (low + high)[:2], 0.1 * (high - low)[:2]
    return bool(np.all(middle > base[:2] - margin) and np.all(middle < top[:2] + margin))


def moves_parts(actor: Actor, times: Float64Array) -> bool:
    """Whether an actor or any part of it changes place between instants, by 2 % of its size."""
    first = part_boxes(actor, float(times[0]))
    for t in times[1:]:
        now = part_boxes(actor, float(t))
        change = max(np.abs(now.low - first.low).max(), np.abs(now.high - first.high).max())
        if change > 0.02 * actor.size_m:
            return True
    return False
