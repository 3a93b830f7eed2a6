"""How limbs move: gait cycles without sliding feet, and elbows and knees between two points."""

from __future__ import annotations

import math
from dataclasses import dataclass

from texvent.scenes.models.shapes import Point


@dataclass(frozen=True)
class Gait:
    """A cycle of steps as a function of the distance travelled."""

    stride: float
    """Distance of one whole cycle, m."""
    duty: float
    """Share of the cycle that a foot stays on the ground."""
    lift: float
    """Height of a foot in mid-swing, m."""


def foot_path(gait: Gait, distance: float, offset: float, amount: float) -> tuple[float, float]:
    """Where a foot is, relative to the point on the ground below its hip.

    On the ground the foot moves back exactly as fast as the body moves forward, so it does not
    slide; then it swings forward in an arc.

    Args:
        gait: the cycle.
        distance: distance travelled, m.
        offset: share of a cycle by which this foot is ahead.
        amount: 0 = stands still .. 1 = full steps.

    Returns:
        Its x and its height, m.
    """
    phase = (distance / gait.stride + offset) % 1.0
    half_step = 0.5 * gait.duty * gait.stride
    if phase < gait.duty:
        return amount * (half_step - phase * gait.stride), 0.0
    swing = (phase - gait.duty) / (1.0 - gait.duty)
    eased = swing * swing * (3.0 - 2.0 * swing)
    rise = math.sin(math.pi * swing)
    return amount * half_step * (2.0 * eased - 1.0), amount * gait.lift * rise * rise


def step_amount(activity: str, speed: float, full_speed: float) -> float:
    """How fully a body steps: 0 while it stands or sits, 1 from `full_speed` (m/s) on."""
    if activity in ("stand", "sit", "lie"):
        return 0.0
    share = min(1.0, max(0.0, speed / full_speed))
    return share * share * (3.0 - 2.0 * share)


def bend(start: Point, end: Point, upper: float, lower: float, towards: Point) -> Point:
    """The knee or elbow between two points.

    Args:
        start: hip or shoulder, m.
        end: ankle or wrist, m.
        upper: length of thigh or upper arm, m.
        lower: length of shin or forearm, m.
        towards: direction in which the joint points (need not be a unit vector).

    Returns:
        The joint. If the two lengths cannot meet, the joint lies on the straight line.
    """
    span = (end[0] - start[0], end[1] - start[1], end[2] - start[2])
    reach = max(math.sqrt(sum(v * v for v in span)), 1e-9)
    along = (span[0] / reach, span[1] / reach, span[2] / reach)
    near = (reach * reach + upper * upper - lower * lower) / (2.0 * reach)
    near = min(max(near, -upper), reach)
    out = math.sqrt(max(upper * upper - near * near, 0.0))
    slope = sum(a * t for a, t in zip(along, towards, strict=True))
    side = [t - slope * a for a, t in zip(along, towards, strict=True)]
    norm = max(math.sqrt(sum(v * v for v in side)), 1e-9)
    x, y, z = (s + near * a + out * v / norm for s, a, v in zip(start, along, side, strict=True))
    return (x, y, z)
