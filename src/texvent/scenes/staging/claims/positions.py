"""Where a body is with respect to others over the clip: near, above, under, between, past."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor

_FINER = 8


class Body(NamedTuple):
    """All copies of an object over the clip."""

    places: Float64Array
    """[n, 3] mean of their middles at each instant, m."""
    low: Float64Array
    """[n, 3] least corner of all, m."""
    high: Float64Array
    copies: tuple[Actor, ...] = ()
    duration_s: float = 1.0


def measure(actors: Sequence[Actor], times: Float64Array) -> Body:
    """The copies of an object at some instants, s."""
    corners = np.array([[actor.corners(float(t)) for actor in actors] for t in times])
    middles = np.array([[actor.middle(float(t)) for actor in actors] for t in times])
    low, high = corners.min(axis=(1, 2)), corners.max(axis=(1, 2))
    return Body(middles.mean(axis=1), low, high, tuple(actors), float(times[-1]))


def gaps(subject: Body, target: Body) -> Float64Array:
    """[n] metres over the ground between the boxes of two bodies; 0 where they overlap."""
    apart = np.maximum(subject.low - target.high, target.low - subject.high)[:, :2]
    return np.asarray(np.hypot(*np.maximum(apart, 0.0).T))


def size_of(body: Body) -> float:
    """Greatest extent of the room that it needs over the clip, m."""
    return float(np.max(body.high - body.low))


def is_near(subject: Body, targets: list[Body]) -> bool:
    """At its side: at some instant, or all the time where both go along."""
    reach = BESIDE * max(_own_size(one) for one in (subject, *targets)) + BESIDE_M
    for target in targets:
        apart = gaps(subject, target)
        is_together = moves(subject) and moves(target)
        if float(apart.max() if is_together else apart.min()) >= reach:
            return False
    return True


BESIDE, BESIDE_M = 0.6, 0.6
"""Gap up to which something is beside another: share of the larger one's size, m."""
_LEAST_WAY_M = 0.1


def _own_size(body: Body) -> float:
    """Greatest extent of all copies at the first instant, m."""
    return float(np.max(body.high[0] - body.low[0]))


def moves(body: Body) -> bool:
    """Whether it leaves its place."""
    return float(np.linalg.norm(body.places[-1] - body.places[0])) > _LEAST_WAY_M


def middle_of(body: Body) -> Float64Array:
    """[3] where it is at mid clip, m."""
    return np.asarray(body.places[len(body.places) // 2])


def is_above(subject: Body, targets: list[Body]) -> bool:
    """Its foot is about as high as the target's top, over or next to it, at some instant."""
    for target in targets:
        tall = (subject.high - subject.low)[:, 2].min()
        is_high = subject.low[:, 2] > target.high[:, 2] - _LAPPED * tall
        is_there = gaps(subject, target) < 0.6 * _own_size(subject) + 0.5
        if not np.any(is_high & is_there):
            return False
    return True


_LAPPED = 0.25
"""Share of its height by which what is above something may reach below its top."""


def is_under(subject: Body, targets: list[Body]) -> bool:
    """Over the same ground, its middle below the target's top, at some instant."""
    target = targets[0]
    is_there = (gaps(subject, target) <= 0.05) & (subject.places[:, 2] < target.high[:, 2])
    if target.copies and target.copies[0].noun.name in _CLOSED_BELOW:
        places, low, high = subject.places[:, :2], target.low[:, :2], target.high[:, :2]
        is_there &= np.all((low < places) & (places < high), axis=1)
    return bool(np.any(is_there))


_CLOSED_BELOW = frozenset({"bush"})
"""Nouns without room below them: what is at their edge is beside them."""


def is_between(subject: Body, targets: list[Body]) -> bool:
    """Targets, or copies of the only one, are to both sides of it."""
    if len(targets) < 2:
        return _is_among_copies(subject, targets[0])
    first, second = middle_of(targets[0])[:2], middle_of(targets[1])[:2]
    way = second - first
    share = float((middle_of(subject)[:2] - first) @ way) / max(float(way @ way), 1e-9)
    return 0.1 < share < 0.9


def _is_among_copies(subject: Body, target: Body) -> bool:
    """Whether copies of the target stand to both sides of it at some instant."""
    half = len(subject.places) // 2
    others = np.array([copy.middle(0.5 * target.duration_s) for copy in target.copies])[:, :2]
    for place in subject.places[:: max(half // 6, 1), :2]:
        ways = others - place
        near = np.linalg.norm(ways, axis=1) < 2.0 * size_of(target) + size_of(subject)
        if near.sum() > 1 and np.min(ways[near] @ ways[near].T) < 0.0:
            return True
    return False


def goes_away(subject: Body, targets: list[Body]) -> bool:
    """It is farther from the target in the end, by more than a fifth of its own size."""
    apart = np.linalg.norm(subject.places - targets[0].places, axis=1)
    return bool(apart[-1] > apart[0] + 0.2 * _own_size(subject))


def _along(subject: Body, target: Body) -> Float64Array:
    """[n] metres by which the subject is ahead of the target, along the subject's way."""
    way = subject.places[-1] - subject.places[0]
    way = way / max(float(np.linalg.norm(way)), 1e-9)
    return np.asarray((subject.places - target.places) @ way)


def passes(subject: Body, targets: list[Body]) -> bool:
    """It goes by: before the target's middle, then after it; what stays in its place is near.

    A clip shorter than a second shows a part of that: beside the target is enough.
    """
    if not (moves(subject) or moves(targets[0])):
        return is_near(subject, targets)
    ahead = _along(subject, targets[0])
    beside = 0.5 * (size_of(subject) + size_of(targets[0])) if subject.duration_s < 1.0 else 0.0
    return bool(ahead.min() < beside and ahead.max() > -beside)


def overtakes(subject: Body, targets: list[Body]) -> bool:
    """Behind the target at the start, before it in the end; what is parked is overtaken too."""
    if not moves(targets[0]):
        return moves(subject) and passes(subject, targets)
    ahead = _along(subject, targets[0])
    return bool(ahead[0] < 0.0 < ahead[-1])


def goes_through(subject: Body, targets: list[Body]) -> bool:
    """Its middle is inside the target's box at some instant."""
    target = targets[0]
    places, low, high = (_finely(one) for one in (subject.places, target.low, target.high))
    inside = np.all((places > low) & (places < high), axis=1)
    return bool(np.any(inside))


def _finely(values: Float64Array) -> Float64Array:
    """[n, 3] between the instants too."""
    known = np.arange(len(values))
    wanted = np.linspace(0.0, len(values) - 1.0, _FINER * (len(values) - 1) + 1)
    return np.stack([np.interp(wanted, known, column) for column in values.T], axis=1)


def is_behind_in_line(subject: Body, targets: list[Body]) -> bool:
    """Behind a target that goes on, all the time."""
    return moves(targets[0]) and bool(np.all(_along(targets[0], subject) > 0.0))
