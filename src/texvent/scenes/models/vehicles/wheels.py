"""Wheels that roll without slipping, with spokes that show the turning."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from texvent.scenes.models.articulated_model import ArticulatedModel
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
    return [part for wheel in wheels for part in rolled(_disc_wheel(wheel), wheel, distance)]


def spoked_wheels(wheels: Iterable[Wheel], distance: float) -> list[ModelPart]:
    """Thin discs that look like rims with spokes, for cycles, turned by a distance, m."""
    return [part for wheel in wheels for part in rolled(_cycle_wheel(wheel), wheel, distance)]


def wheeled_model(
    rigid: Sequence[ModelPart], wheels: Sequence[Wheel], scale: float
) -> ArticulatedModel:
    """A vehicle of which only the wheels turn."""
    return ArticulatedModel(
        rigid,
        scale=scale,
        articulate=lambda pose: car_wheels(wheels, pose.distance_m),
        is_wheeled=True,
    )


def rolled(parts: Sequence[ModelPart], wheel: Wheel, distance: float) -> list[ModelPart]:
    """Parts drawn around the origin, turned about y and brought to the wheel's centre.

    The point of contact stands still on the ground: angle = distance / radius.
    """
    motion = compose(shift(*wheel.centre), turn_y(distance / wheel.radius))
    return moved(parts, motion)


def _disc_wheel(wheel: Wheel) -> list[ModelPart]:
    radius, width = wheel.radius, wheel.width
    half = 0.5 * width
    gap = 0.16 * radius
    return [
        rod(RUBBER, (0.0, -half, 0.0), (0.0, half, 0.0), radius),
        rod(CHROME, (0.0, -half - 0.01, 0.0), (0.0, half + 0.01, 0.0), 0.64 * radius),
        box(DARK, (0.0, 0.0, 0.0), (1.26 * radius, width + 0.04, gap)),
        box(DARK, (0.0, 0.0, 0.0), (gap, width + 0.04, 1.26 * radius)),
    ]


def _cycle_wheel(wheel: Wheel) -> list[ModelPart]:
    """A tyre, the air between its spokes, and a dark cross."""
    radius, width = wheel.radius, wheel.width
    half = 0.5 * width
    spoke = 0.03 * radius + 0.006
    air = Material((0.30, 0.31, 0.32))
    return [
        rod(RUBBER, (0.0, -half, 0.0), (0.0, half, 0.0), radius),
        rod(air, (0.0, -half - 0.002, 0.0), (0.0, half + 0.002, 0.0), 0.86 * radius),
        box(DARK, (0.0, 0.0, 0.0), (1.72 * radius, width + 0.01, 2.0 * spoke)),
        box(DARK, (0.0, 0.0, 0.0), (2.0 * spoke, width + 0.01, 1.72 * radius)),
    ]
