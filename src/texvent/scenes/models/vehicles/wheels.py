"""Wheels that roll without slipping, with spokes that show the turning."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from texvent.scenes.models.materials import CHROME, DARK, RUBBER, Material
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import (
    Point,
    box,
    compose,
    moved,
    rod,
    shift,
    turn_y,
)


@dataclass(frozen=True)
class Wheel:
    """Where a wheel sits, and its size."""

    centre: Point
    radius: float
    width: float


def car_wheels(wheels: Iterable[Wheel], distance: float) -> list[ModelPart]:
    """Tyres with a bright rim that a dark cross divides, turned by a distance travelled, m."""
    turned: list[ModelPart] = []
    for wheel in wheels:
        turned += rolled(_disc_wheel(wheel.radius, wheel.width), wheel, distance)
    return turned


def spoked_wheels(
    wheels: Iterable[Wheel], distance: float, *, rim: Material = RUBBER
) -> list[ModelPart]:
    """Thin discs that look like rims with spokes, for cycles, turned by a distance, m."""
    turned: list[ModelPart] = []
    for wheel in wheels:
        turned += rolled(_cycle_wheel(wheel.radius, wheel.width, rim), wheel, distance)
    return turned


def rolled(parts: Sequence[ModelPart], wheel: Wheel, distance: float) -> list[ModelPart]:
    """Parts drawn around the origin, turned about y and brought to the wheel's centre.

    The point of contact stands still on the ground: angle = distance / radius.
    """
    motion = compose(shift(*wheel.centre), turn_y(distance / wheel.radius))
    return moved(parts, motion)


def _disc_wheel(radius: float, width: float) -> list[ModelPart]:
    half = 0.5 * width
    gap = 0.16 * radius
    return [
        rod(RUBBER, (0.0, -half, 0.0), (0.0, half, 0.0), radius),
        rod(CHROME, (0.0, -half - 0.01, 0.0), (0.0, half + 0.01, 0.0), 0.64 * radius),
        box(DARK, (0.0, 0.0, 0.0), (1.26 * radius, width + 0.04, gap)),
        box(DARK, (0.0, 0.0, 0.0), (gap, width + 0.04, 1.26 * radius)),
    ]


def _cycle_wheel(radius: float, width: float, rim: Material) -> list[ModelPart]:
    """A rim of twelve straight pieces would cost too much: a tyre's outline of six bars."""
    half = 0.5 * width
    spoke = 0.03 * radius + 0.006
    air = Material((0.30, 0.31, 0.32))
    return [
        rod(rim, (0.0, -half, 0.0), (0.0, half, 0.0), radius),
        rod(air, (0.0, -half - 0.002, 0.0), (0.0, half + 0.002, 0.0), 0.86 * radius),
        box(DARK, (0.0, 0.0, 0.0), (1.72 * radius, width + 0.01, 2.0 * spoke)),
        box(DARK, (0.0, 0.0, 0.0), (2.0 * spoke, width + 0.01, 1.72 * radius)),
    ]
