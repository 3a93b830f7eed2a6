"""Whether bodies go to, come from, circle or face others, each copy by itself."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from texvent.scenes.models.protocol import Noun
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.claims.bodies import gap, part_boxes
from texvent.scenes.staging.claims.contact import is_on, touches

_SAMPLES = 13
_NEARER = 0.94
"""Share of the first distance that is left at least when something comes nearer."""
_AHEAD = 0.2
"""Least cosine between a heading and the way to what it is towards."""
_FACING = 0.75
"""The same of what faces something."""
_AT_SHARE, _AT_M = 0.6, 0.3
"""Gap up to which something starts at another: share of its size, m."""
_LOW_M = 2.0
"""Height up to which one jumps from the top of a thing."""
_ROUND_RAD = 1.5
"""Angle round something that a body must cover, or that several must be spread over."""
_FRONTLESS = ("roll", "stand", "slide")
"""Usual motion of what has no front to turn to its goal."""


def approaches(subjects: Sequence[Actor], targets: Sequence[Actor], duration_s: float) -> bool:
    """Every subject that moves comes nearer to a target, its front turned to it."""
    return all(_approaches(one, targets, duration_s) for one in subjects)


def _approaches(subject: Actor, targets: Sequence[Actor], duration_s: float) -> bool:
    times = np.linspace(0.0, duration_s, _SAMPLES)
    places = np.array([subject.middle(float(t)) for t in times])
    for target in targets:
        goals = np.array([target.middle(float(t)) for t in times])
        apart = np.linalg.norm(goals - places, axis=1)
        if apart[-1] > _NEARER * apart[0]:
            continue
        half = _SAMPLES // 3
        if not _has_front(subject.noun) or _points_at(
            subject, goals[half], float(times[half]), _AHEAD
        ):
            return True
    return False


def _has_front(noun: Noun) -> bool:
    return noun.motion not in _FRONTLESS


def _points_at(subject: Actor, goal: Float64Array, time_s: float, least: float) -> bool:
    """Whether the front of a body points to a place, over the ground."""
    to_world = subject.trajectory.at(time_s).to_world()
    front, way = to_world[:2, 0], (goal - subject.middle(time_s))[:2]
    long = float(np.linalg.norm(front) * np.linalg.norm(way))
    return long < 1e-9 or float(front @ way) > least * long


def faces(subjects: Sequence[Actor], targets: Sequence[Actor], duration_s: float) -> bool:
    """Every subject has its front to a target that is not itself."""
    time_s = 0.5 * duration_s
    return all(
        any(
            one is not target and _points_at(one, target.middle(time_s), time_s, _FACING)
            for target in targets
        )
        for one in subjects
    )


def comes_from(subjects: Sequence[Actor], targets: Sequence[Actor], duration_s: float) -> bool:
    """Every subject begins at a target and is farther from it in the end."""
    return all(
        any(_starts_at(one, target) and _leaves(one, target, duration_s) for target in targets)
        for one in subjects
    )


def lifts_from(subjects: Sequence[Actor], targets: Sequence[Actor], duration_s: float) -> bool:
    """Every subject begins at the surface of a target, above a low one, and leaves it."""
    return all(
        any(
            _leaves(one, target, duration_s)
            and (is_on(one, target, 0.0) if _is_low(target) else touches(one, target, 0.0))
            for target in targets
        )
        for one in subjects
    )


def _is_low(target: Actor) -> bool:
    return target.noun.habitat == "fixed" and target.model.height < _LOW_M


def _starts_at(subject: Actor, target: Actor) -> bool:
    apart = gap(part_boxes(subject, 0.0), part_boxes(target, 0.0))
    return apart < max(_AT_SHARE * max(subject.size_m, target.size_m), _AT_M)


def _leaves(subject: Actor, target: Actor, duration_s: float) -> bool:
    first, last = (
        float(np.linalg.norm(subject.middle(t) - target.middle(t))) for t in (0.0, duration_s)
    )
    return last > first


def goes_round(subjects: Sequence[Actor], targets: Sequence[Actor], duration_s: float) -> bool:
    """The subjects go round a target, or stand on several sides of it."""
    times = np.linspace(0.0, duration_s, _SAMPLES)
    for target in targets:
        middles = np.array([target.middle(float(t)) for t in times])[:, :2]
        ways = [
            np.array([one.middle(float(t)) for t in times])[:, :2] - middles for one in subjects
        ]
        angles = [np.unwrap(np.arctan2(way[:, 1], way[:, 0])) for way in ways]
        if max(float(np.ptp(angle)) for angle in angles) > _ROUND_RAD:
            return True
        if len(angles) > 1 and _spread([float(angle[0]) for angle in angles]) > _ROUND_RAD:
            return True
    return False


def _spread(angles: Sequence[float]) -> float:
    """The least arc that holds all directions, radians."""
    around = np.sort(np.mod(angles, 2.0 * math.pi))
    free = np.diff(np.append(around, around[0] + 2.0 * math.pi))
    return 2.0 * math.pi - float(free.max())
