"""Who works on something: hands at it, as in "washes a car" or "paints a fence"."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from texvent.scenes.models.people.activities import WORKING
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.holding import is_person, size_of
from texvent.scenes.staging.claims.bodies import gap, part_boxes
from texvent.scenes.staging.trajectories.trajectory import Stationary, ahead

_NARROW_M = 0.7
"""Half of the width in the picture up to which one works at a thing's side, seen in profile."""
_TURN = 0.5
"""Turn of who works before a wide thing, so that hands are seen beside the back, rad."""
_ROOM = 0.6
"""Share of its height that a worker takes along a wide thing."""
_MOST_STEP_M = 0.8
"""Beyond the end of a thing, a longer step would not lead to it."""
_OVERLAP_M = 0.12
"""How far the hands reach into the thing at their farthest."""
_SAMPLES = 9
_CYCLE_S = 1.2
"""Time in which working hands reach every place."""


def work_at(subject: Actor, target: Actor, place: int = 0, crew: int = 1) -> Actor:
    """The worker, before the thing or at its side, within the reach of its hands.

    Args:
        subject: a person who stays and works; others are left where they are.
        target: a thing that stays.
        place: number of the worker, from 0, of those who work on the thing.
        crew: how many they are; a narrow thing has room for two, one at each side.
    """
    path = subject.trajectory
    if not isinstance(path, Stationary) or path.activity not in WORKING:
        return subject
    if target.is_mover or not is_person(subject):
        return subject
    state, model = target.trajectory.at(0.0), target.model
    cos, sin = abs(math.cos(state.yaw)), abs(math.sin(state.yaw))
    across = 0.5 * (cos * model.length + sin * model.width)
    deep = 0.5 * (sin * model.length + cos * model.width)
    x, y, z = state.position
    if across > _NARROW_M:
        along = (place - 0.5 * (crew - 1)) * _ROOM * size_of(subject.model)
        apart = deep + _reach(subject) * math.cos(_TURN)
        home = ahead((x + along, y, z), 0.5 * math.pi, -apart, path.home[2])
        return _step_up(subject, replace(path, home=home, yaw=0.5 * math.pi), target, -_TURN)
    if place > 1:
        return subject
    is_left = (path.home[0] <= x) if crew == 1 else place == 0
    yaw = 0.0 if is_left else math.pi
    home = ahead(state.position, yaw, -across - _reach(subject), path.home[2])
    return _step_up(subject, replace(path, home=home, yaw=yaw), target, 0.0)


def _step_up(subject: Actor, path: Stationary, target: Actor, turn: float) -> Actor:
    """Nearer by the gap that is left: what stands at an angle is thinner than its box."""
    turned = replace(path, yaw=path.yaw + turn)
    subject = replace(subject, trajectory=turned)
    times = np.linspace(0.0, _CYCLE_S, _SAMPLES)
    left = min(gap(part_boxes(subject, float(t)), part_boxes(target, float(t))) for t in times)
    home = ahead(path.home, path.yaw, min(left, _MOST_STEP_M), path.home[2])
    return replace(subject, trajectory=replace(turned, home=home))


def _reach(subject: Actor) -> float:
    """How far ahead of its middle its hands come while it works, m."""
    state = subject.trajectory.at(0.0)
    forward = np.array([math.cos(state.yaw), math.sin(state.yaw), 0.0])
    hands = np.array(
        [
            subject.anchor(name, float(time_s))[:, 3] - state.position
            for name in ("left hand", "right hand")
            for time_s in np.linspace(0.0, _CYCLE_S, _SAMPLES)
        ]
    )
    return max(float((hands @ forward).max()) - _OVERLAP_M, 0.0)
