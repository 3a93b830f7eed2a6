"""Where a worker's hands, tool, torso and head are while they work at a spot."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache

from texvent.scenes.models.people.posture import NECK, SHOULDER_DROP, SHOULDER_SIDE
from texvent.scenes.models.people.work.patterns import PATTERNS, Stroke
from texvent.scenes.models.people.work.tools import TOOLS
from texvent.scenes.models.people.work.verbs import HandWork
from texvent.scenes.models.shapes import Point

Grips = tuple[tuple[str, Point], ...]
TABLE_M = 0.84
"""Height of the table that small things are put on, m."""
_LOW = 0.60
"""Height of a spot, for an adult, below which one kneels, m."""
_POINTS_DOWN = 1.05
"""Height of a spot on an upright face, for an adult, below which the tool points down, m."""
_ARM_M = 0.61
"""From the shoulder to the palm of an arm that is nearly straight, m."""
_NEAREST_M, _FARTHEST_M, _STEP_M = 0.24, 1.15, 0.03
_CYCLE_S = 2.4
_SAMPLES = 12


@dataclass(frozen=True)
class Bench:
    """What is worked on, in the worker's body coordinates, m."""

    spot: Point
    is_upright: bool = False
    """Whether the surface is upright, its face to the worker; else it is level."""
    turn: float = 0.0
    """How far to the left of where the worker faces the surface lies, rad."""
    half_m: float = 0.10
    """Half of the thing's width to either side of the spot."""
    size: float = 1.0
    """Of the worker, relative to an adult."""
    reach_m: float = 0.0
    """From the right palm to the tip of the tool; 0 = the bare hand."""

    @property
    def stance(self) -> str:
        """What the legs do: "stand" or "kneel"."""
        return "kneel" if self.spot[2] < _LOW * self.size else "stand"


AT_TABLE = Bench((0.0, -0.02, TABLE_M + 0.01))
"""A table before the worker."""
AT_FRONT = Bench((0.0, -0.06, 1.20), is_upright=True)
"""A board before the worker."""
IN_HANDS = Bench((0.36, 0.0, 1.10))
"""What the left hand holds."""


@lru_cache(maxsize=64)
def usual_bench(work: HandWork) -> Bench:
    """Where a work is done that no thing is named for."""
    reach = TOOLS[work.tool].reach_m if work.tool in TOOLS else 0.0
    if work.place == "hands":
        return replace(IN_HANDS, reach_m=reach)
    bench = replace(AT_FRONT if work.side == "front" else AT_TABLE, reach_m=reach)
    return replace(bench, spot=(choose_distance(work, bench), *bench.spot[1:]))


def stroke_at(work: HandWork, bench: Bench, time_s: float) -> Stroke:
    """The hands of a work at an instant."""
    return PATTERNS[work.pattern](time_s, bench.half_m / bench.size)


def in_body(bench: Bench, offset: Point) -> Point:
    """An offset in the axes of the surface, for an adult, as one in body coordinates, m."""
    along, left, out = (bench.size * value for value in offset)
    x, y, z = (-out, left, along) if bench.is_upright else (along, left, out)
    c, s = math.cos(bench.turn), math.sin(bench.turn)
    return (c * x - s * y, s * x + c * y, z)


def list_grips(work: HandWork, bench: Bench, time_s: float) -> Grips:
    """Where hands, hips, the base of the neck, the tool and the look go: see `Pose.grips`."""
    stroke = stroke_at(work, bench, time_s)
    tip = _add(bench.spot, in_body(bench, stroke.right))
    along, left, out = stroke.tool
    if bench.is_upright and bench.spot[2] < _POINTS_DOWN * bench.size:
        along = -abs(along)
    x, y, z = in_body(replace(bench, size=1.0), (along, left, out))
    norm = math.sqrt(x * x + y * y + z * z)
    way = (x / norm, y / norm, z / norm)
    right = _add(tip, way, -bench.reach_m)
    hips, neck = _lean(bench, stroke.bow)
    grips: list[tuple[str, Point]] = [
        ("right hand", right), ("tip", _add(right, way)), ("hips", hips), ("neck", neck),
        ("gaze", bench.spot),
    ]  # fmt: skip
    if stroke.left is not None:
        grips.append(("left hand", _add(bench.spot, in_body(bench, stroke.left))))
    return tuple(grips)


def choose_distance(work: HandWork, bench: Bench) -> float:
    """The farthest place before the spot from which both hands reach all that they do, m."""
    size = bench.size
    best, least = _NEAREST_M * size, math.inf
    steps = round((_FARTHEST_M - _NEAREST_M) / _STEP_M)
    for step in range(steps, -1, -1):
        distance = (_NEAREST_M + _STEP_M * step) * size
        tried = replace(bench, spot=(distance, bench.spot[1], bench.spot[2]))
        excess = _excess(work, tried)
        if excess <= 0.0:
            return distance
        if excess < least:
            best, least = distance, excess
    return best


def _excess(work: HandWork, bench: Bench) -> float:
    """By how much the farther hand is out of reach at the worst instant, m."""
    most = -math.inf
    for number in range(_SAMPLES):
        held = dict(list_grips(work, bench, _CYCLE_S * number / _SAMPLES))
        hips, neck = held["hips"], held["neck"]
        share = (NECK - SHOULDER_DROP) / NECK
        for name, side in (("left hand", 1.0), ("right hand", -1.0)):
            if name in held:
                shoulder = tuple(a + share * (b - a) for a, b in zip(hips, neck, strict=True))
                shoulder = (shoulder[0], side * SHOULDER_SIDE * bench.size, shoulder[2])
                most = max(most, math.dist(shoulder, held[name]) - _ARM_M * bench.size)
    return most


def _lean(bench: Bench, bow: float) -> tuple[Point, Point]:
    """Hips, and the base of the neck of a torso that leans to its work."""
    size, height = bench.size, bench.spot[2] / bench.size
    if bench.stance == "kneel":
        hips = (0.0, 0.0, 0.48)
        angle = min(max(0.85 - 1.1 * height, 0.10), 0.80) + bow
    else:
        angle = min(max(1.0 * (1.08 - height), 0.04), 0.60) + bow
        hips = (-0.20 * angle, 0.0, 0.93)
    neck = (hips[0] + NECK * math.sin(angle), 0.0, hips[2] + NECK * math.cos(angle))
    return _scaled(hips, size), _scaled(neck, size)


def _add(point: Point, other: Point, share: float = 1.0) -> Point:
    x, y, z = (a + share * b for a, b in zip(point, other, strict=True))
    return (x, y, z)


def _scaled(point: Point, size: float) -> Point:
    return (size * point[0], size * point[1], size * point[2])
