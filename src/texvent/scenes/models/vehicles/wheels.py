"""Wheels that roll without slipping, with spokes that show the turning."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.materials import CHROME, DARK, RUBBER, Material
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import (
    Point,
    box,
    compose,
    limb,
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


def spoked_wheels(wheels: Iterable[Wheel], distance: float, *, is_open: bool) -> list[ModelPart]:
    """Wheels of a cycle, turned by a distance travelled, m.

    Open ones have many parts; others are thin discs that look like rims with spokes.
    """
    draw = _open_wheel if is_open else _cycle_wheel
    return [part for wheel in wheels for part in rolled(draw(wheel), wheel, distance)]


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


_RIM_PIECES, _SPOKES = 16, 5


def _open_wheel(wheel: Wheel) -> list[ModelPart]:
    """A tyre and its rim, thin spokes and a hub; one sees through between them."""
    radius, half = wheel.radius, 0.5 * wheel.width
    around = [2.0 * math.pi * k / _RIM_PIECES for k in range(_RIM_PIECES + 1)]

    def hoop(skin: Material, far: float, thick: float, wide: float) -> list[ModelPart]:
        spots = [(far * math.cos(a), 0.0, far * math.sin(a)) for a in around]
        return [
            limb(skin, start, end, thick, side_radius=wide)
            for start, end in itertools.pairwise(spots)
        ]

    spokes = [math.pi * k / _SPOKES for k in range(_SPOKES)]
    thin, reach = 0.014 * radius + 0.002, 0.90 * radius
    return [
        *hoop(RUBBER, 0.94 * radius, 0.06 * radius, half),
        rod(DARK, (0.0, -half, 0.0), (0.0, half, 0.0), 0.12 * radius),
        *(rod(CHROME, (-reach * math.cos(a), 0.0, -reach * math.sin(a)),
              (reach * math.cos(a), 0.0, reach * math.sin(a)), thin) for a in spokes),
    ]  # fmt: skip


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
