"""What a preposition says besides where something is: "into", "out of", "against", "across"."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial

import numpy as np

from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.claims.bodies import gap, part_boxes
from texvent.scenes.staging.claims.contact import is_in, is_on, touches
from texvent.scenes.staging.claims.courses import faces
from texvent.scenes.staging.claims.positions import Body, gaps, is_near
from texvent.scenes.staging.placement.spatial_relations import GATES
from texvent.scenes.staging.trajectories.manoeuvres import LANE_M

_INSTANTS = 13
_TOUCH_M, _TOUCH_SHARE = 0.04, 0.05
"""Gap up to which something is against another: metres, and share of the smaller one."""
_AT_M, _AT_SHARE = 0.4, 0.4
"""Gap up to which something is at another: metres, and share of the larger one."""
_ACROSS = 0.35
"""Share of the target's extent that who goes across it covers at least."""
_ALONG_COSINE = 0.8
"""Least cosine between a way and the long axis of what it is along."""
_ON_SLOPE, _RISE = 3, 0.4
"""Instants at which who goes up or down a slope touches it at least, and share of its height."""
_LONG = 1.5
"""How much longer than wide a thing is that has a long axis."""

Way = Callable[[Body, list[Body]], bool]


def _changes(
    holds: Callable[[Actor, Actor, float], bool], *, begins: bool
) -> Callable[[Body, list[Body]], bool]:
    """A check that every copy has a relation only in the end, or (`begins`) only at the start."""

    def check(subject: Body, targets: list[Body]) -> bool:
        others = [copy for target in targets for copy in target.copies]
        first, last = (0.0, subject.duration_s) if begins else (subject.duration_s, 0.0)
        return all(
            any(holds(one, other, first) and not holds(one, other, last) for other in others)
            for one in subject.copies
        )

    return check


def _is_inside(subject: Actor, target: Actor, time_s: float) -> bool:
    """It is in a vessel; of who goes into a tunnel or through a gate the front is."""
    if target.noun.name not in GATES:
        return is_in(subject, target, time_s)
    state = subject.trajectory.at(time_s)
    ahead = 0.5 * subject.model.length * state.to_world()[:, 0]
    front = subject.middle(time_s) + ahead
    low, high = part_boxes(target, time_s).hull
    return bool(np.all(front > low) and np.all(front < high))


def _lies_against(subject: Body, targets: list[Body]) -> bool:
    """Its surface is at the target's: what stays all the time, what moves at some instant."""
    others = [copy for target in targets for copy in target.copies]
    return all(_is_against(one, others, subject.duration_s) for one in subject.copies)


def _is_against(subject: Actor, others: Sequence[Actor], duration_s: float) -> bool:
    times = np.linspace(0.0, duration_s, _INSTANTS)
    found = []
    for time_s in times if subject.is_mover else times[:1]:
        own = part_boxes(subject, float(time_s))
        sizes = [float(np.max(own.hull[1] - own.hull[0]))]
        reach = _TOUCH_M + _TOUCH_SHARE * min(sizes)
        found.append(any(gap(own, part_boxes(one, float(time_s))) < reach for one in others))
    return any(found)


def _goes_across(subject: Body, targets: list[Body]) -> bool:
    """It covers a clear share of the target's extent along its way."""
    way = (subject.places[-1] - subject.places[0])[:2]
    long = float(np.linalg.norm(way))
    if long < 1e-6:
        return False
    extent = (targets[0].high[0] - targets[0].low[0])[:2]
    return long > _ACROSS * float(np.abs(way / long) @ extent)


def _goes_along(subject: Body, targets: list[Body]) -> bool:
    """Its way, or its own long axis where it stays, is that of the target, and it is near."""
    if not is_near(subject, targets):
        return False
    way = (subject.places[-1] - subject.places[0])[:2]
    if float(np.linalg.norm(way)) < 0.1:
        return True
    extent = np.sort((targets[0].high[0] - targets[0].low[0])[:2])
    is_long = extent[1] > _LONG * extent[0]
    axis = int(np.argmax((targets[0].high[0] - targets[0].low[0])[:2]))
    is_parallel = abs(way[axis]) > _ALONG_COSINE * float(np.linalg.norm(way))
    near = gaps(subject, targets[0]) < 0.5 * float(extent[0]) + 1.0
    return bool(np.mean(near) > 0.5) and (is_parallel or not is_long)


def _rests(subject: Body, targets: list[Body]) -> bool:
    return any(
        holds(one, other, time_s)
        for one in subject.copies
        for target in targets
        for other in target.copies
        for holds in (is_on, is_in)
        for time_s in (0.0, subject.duration_s)
    )


def _is_close(subject: Body, targets: list[Body]) -> bool:
    """As near to it at some instant as who is "at" a window; a thing touches it."""
    if subject.copies[0].noun.habitat == "fixed" and not subject.copies[0].is_mover:
        return _lies_against(subject, targets)
    reach = _AT_M + _AT_SHARE * max(_extent(one) for one in (subject, *targets))
    # What stands beside a road is half a lane further from who stops there.
    reach += 0.5 * LANE_M if subject.copies[0].noun.motion == "drive" else 0.0
    times = [float(t) for t in np.linspace(0.0, subject.duration_s, 5)]
    return all(
        any(gap(part_boxes(own, t), part_boxes(one, t)) < reach
            for own in subject.copies for one in target.copies for t in times)
        for target in targets
    )  # fmt: skip


def _extent(body: Body) -> float:
    """Greatest extent of one copy in the beginning, m."""
    hulls = [part_boxes(one, 0.0).hull for one in body.copies]
    return float(max(np.max(high - low) for low, high in hulls))


def _is_opposite(subject: Body, targets: list[Body]) -> bool:
    others = [copy for target in targets for copy in target.copies]
    return faces(subject.copies, others, subject.duration_s)


def _goes_on_slope(subject: Body, targets: list[Body], *, sign: float) -> bool:
    """It is on the target, and rises (sign 1) or sinks (-1) by a good part of its height."""
    tall = float((targets[0].high - targets[0].low)[0, 2])
    others = [copy for target in targets for copy in target.copies]
    times = np.linspace(0.0, subject.duration_s, _INSTANTS)
    for one in subject.copies:
        heights = np.array([one.middle(float(t))[2] for t in times])
        is_there = [any(touches(one, other, float(t)) for other in others) for t in times]
        if sum(is_there) < _ON_SLOPE or sign * (heights[-1] - heights[0]) < _RISE * tall:
            return False
    return True


WAYS: Mapping[str, Way] = {
    "into": _changes(_is_inside, begins=False),
    "onto": _changes(is_on, begins=False),
    "out of": _changes(_is_inside, begins=True),
    "off": _changes(lambda one, other, t: is_on(one, other, t) or touches(one, other, t),
                    begins=True),
    "against": _lies_against,
    "across": _goes_across,
    "along": _goes_along,
    "opposite": _is_opposite,
    "at": _is_close,
    "lead": _is_close,
    "up": partial(_goes_on_slope, sign=1.0),
    "down": partial(_goes_on_slope, sign=-1.0),
    "not on": lambda subject, targets: not _rests(subject, targets),
}  # fmt: skip
"""`Relation.way` → whether a scene shows it."""
