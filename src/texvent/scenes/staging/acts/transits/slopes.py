"""Up and down ramps and stairs, whose side is turned to the viewer."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise

import numpy as np

from texvent.scenes.description import ObjectMotion
from texvent.scenes.models.support_surface import top_heights
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.transits.surfaces import rest_height
from texvent.scenes.staging.acts.transits.tops import ROLLING, choose_yaw, with_path
from texvent.scenes.staging.body_boxes import own_parts
from texvent.scenes.staging.trajectories.legs import Leg, Legs, flight_s
from texvent.scenes.staging.trajectories.trajectory import Stationary, Vector

SLOPED = frozenset({"ramp", "skate ramp", "stairs", "slide"})
"""Nouns with a slope along their length."""
_SAMPLES, _STEPS = 49, 9
_SHARE, _MOST_S = 0.72, 1.5
"""Share of the clip in which the slope is covered, at most so many seconds."""
_LEVEL_M = 0.05
_BOUNCE_M = 0.16
"""Height of a bounce over the higher step."""


def go_on_slope(
    subject: Actor,
    target: Actor,
    motion: ObjectMotion,
    duration_s: float,
    turn: float,
    *,
    is_up: bool,
) -> tuple[Actor, Actor]:
    """Up or down a slope, on its surface; what bounces goes from step to step.

    Args:
        subject: who goes.
        target: the slope; it turns.
        motion: of the subject.
        duration_s: length of the clip, s.
        turn: 0 for the first of several .. 1 for the last, which starts later.
        is_up: whether it goes up.
    """
    path = target.trajectory
    if not isinstance(path, Stationary):
        return subject, target
    ways, tops = _profile(target)
    yaw = choose_yaw(subject, target)
    # Along +x of the body the profile falls, or rises where its sign is -1.
    falls = float(np.corrcoef(ways, tops)[0, 1]) < 0.0
    is_ahead = falls != is_up
    target = replace(target, trajectory=replace(path, yaw=yaw if is_ahead else yaw + math.pi))
    along = ways if is_ahead else -ways[::-1]
    heights = tops if is_ahead else tops[::-1]
    lift = rest_height(subject)
    rolls = motion.kind in ROLLING and _is_round(subject)

    def spot(way: float, height: float) -> Vector:
        x, y, z = path.home
        raised = z + height + lift
        return (x + way * math.cos(yaw), y + way * math.sin(yaw), raised)

    seconds = min(_SHARE * duration_s, _MOST_S) * (1.0 - 0.25 * turn)
    wait = 0.3 * turn * seconds
    if motion.kind == "bounce":
        treads = _find_treads(along, heights)
        return with_path(subject, _bounce(treads, spot, yaw, seconds)), target
    line = _line_of_edges(along, heights)
    radius = 0.5 * subject.model.height if rolls else 0.0
    slope = [spot(way, _over(radius, line, way)) for way in line[0]]
    legs = _over_line(subject, motion.kind, slope, (seconds, wait), is_up=is_up, rolls=rolls)
    end, speed = slope[-1], math.dist(slope[0], slope[-1]) / seconds
    left = max(duration_s - seconds - wait, 0.2)
    far = spot(float(line[0][-1]) + (0.6 if is_up else 1.0) * speed * left, end[2] - path.home[2])
    far = (far[0], far[1], end[2])
    gait = motion.kind if motion.kind in ("walk", "run") else "move"
    if not is_up:
        legs.append(Leg(far, left, gait, slows=rolls))
    else:
        legs.append(Leg(end, left, "stand"))
    return with_path(subject, Legs(slope[0], yaw, tuple(legs), radius, radius)), target


def _over_line(
    subject: Actor, kind: str, slope: list[Vector], times: tuple[float, float],
    *, is_up: bool, rolls: bool,
) -> list[Leg]:  # fmt: skip
    """Legs along a slope; what rolls down becomes faster."""
    seconds, wait = times
    gait = kind if kind in ("walk", "run") else "stand" if kind == "slide" else "move"
    lengths = [math.dist(one, other) for one, other in pairwise(slope)]
    reached = np.cumsum([0.0, *lengths]) / sum(lengths)
    speeds_up = (rolls or kind == "slide") and not is_up
    moments = seconds * (np.sqrt(reached) if speeds_up else reached)
    tilts = not rolls and subject.noun.motion != "walk"
    legs = [Leg(slope[0], wait, gait)] if wait > 0.0 else []
    return legs + [
        Leg(end, float(last - first), gait, tilts=tilts)
        for end, first, last in zip(slope[1:], moments, moments[1:], strict=False)
    ]


def _is_round(subject: Actor) -> bool:
    return abs(subject.model.length - subject.model.height) < 0.3 * subject.model.height


def _profile(target: Actor) -> tuple[Float64Array, Float64Array]:
    """Ways along +x of the body and heights there, m, of its middle; only of its slope."""
    half = 0.49 * target.model.length
    ways = np.linspace(-half, half, _SAMPLES)
    tops = top_heights(own_parts(target, 0.0), ways, np.zeros(_SAMPLES))
    known = np.isfinite(tops)
    ways, tops = ways[known], tops[known]
    if target.noun.name == "slide":
        chute = ways > -0.5 * target.model.length + 0.32 * target.model.length
        ways, tops = ways[chute], tops[chute]
    return ways, tops


def _line_of_edges(along: Float64Array, heights: Float64Array) -> tuple[Float64Array, Float64Array]:
    """The line over the highest points: of a curved ramp its curve, of stairs their edges."""
    steps = np.linspace(along[0], along[-1], _STEPS)
    found = np.interp(steps, along, heights)
    jumps = np.abs(np.diff(heights))
    if np.sum(jumps > _LEVEL_M) >= 3 and np.sum(jumps < 0.01) > len(jumps) // 2:
        # Stairs: a straight line from the first step's edge to the last one's.
        rise = np.abs(heights[-1] - heights[0]) / max(np.sum(jumps > _LEVEL_M), 1)
        found = np.linspace(heights[0], heights[-1], _STEPS) + 0.3 * rise
    return steps, found


def _over(radius: float, line: tuple[Float64Array, Float64Array], way: float) -> float:
    """Height of the lowest point of a wheel over a way, whose rim touches the line, m."""
    if radius <= 0.0:
        return float(np.interp(way, *line))
    angles = np.linspace(-1.2, 1.2, 25)
    under = np.interp(way + radius * np.sin(angles), *line)
    return float(np.max(under + radius * np.cos(angles)) - radius)


def _find_treads(along: Float64Array, heights: Float64Array) -> list[tuple[float, float]]:
    """Middle and height of each level step, or of equal parts of a ramp."""
    cuts = np.flatnonzero(np.abs(np.diff(heights)) > _LEVEL_M) + 1
    pieces = np.split(np.arange(len(along)), cuts)
    if len(pieces) < 3:
        pieces = np.array_split(np.arange(len(along)), 5)
    return [(float(along[p].mean()), float(heights[p].mean())) for p in pieces if len(p)]


def _bounce(
    treads: list[tuple[float, float]],
    spot: Callable[[float, float], Vector],
    yaw: float,
    seconds: float,
) -> Legs:
    """Flights from step to step, over some where there are too many for the clip."""
    for stride in range(1, len(treads)):
        some = treads[::stride]
        places = [spot(way, height) for way, height in some]
        flights = [flight_s(a[2], b[2], max(a[2], b[2]) + _BOUNCE_M) for a, b in pairwise(places)]
        if sum(flights) <= 1.15 * seconds:
            break
    legs = [
        Leg(end, time, "move", is_flight=True)
        for end, time in zip(places[1:], flights, strict=True)
    ]
    step = np.array(places[-1]) - np.array(places[-2])
    last = places[-1]
    for _ in range(3):
        floor = spot(0.0, 0.0)[2]
        nxt = (last[0] + float(step[0]), last[1] + float(step[1]), floor)
        legs.append(Leg(nxt, flight_s(last[2], floor, last[2] + 0.6 * _BOUNCE_M), is_flight=True))
        last = nxt
    return Legs(places[0], yaw, tuple(legs))
