"""Riders of cycles: a body bent over the handlebar, whose feet go round with the pedals."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from texvent.scenes.models.limbs import bend
from texvent.scenes.models.materials import STEEL
from texvent.scenes.models.people.figure import draw_arm, draw_head, draw_leg, draw_torso
from texvent.scenes.models.people.outfit import ADULT, dress_person
from texvent.scenes.models.people.posture import LOWER_ARM, UPPER_ARM
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import Point, point, rod

_GEAR = 0.45
"""Turns of the pedals per turn of the wheels."""
_CRANK_M = 0.17
_BESIDE_M, _SHOULDER_M, _BELOW_NECK_M = 0.09, 0.19, 0.09
"""Half the width of the hips and of the shoulders, and how far these are below the neck."""


@dataclass(frozen=True)
class Rider:
    """Where a rider touches a cycle, m: the left of hand and pedal, as the other is its mirror."""

    hips: Point
    neck: Point
    grip: Point
    crank: Point
    wheel: float
    """Radius of the wheels."""

    def upper_body(self, seed: int) -> list[ModelPart]:
        """Torso, head and arms, which stay where they are."""
        outfit = dress_person(ADULT, colour=None, seed=seed)
        parts = [
            *draw_torso(ADULT, outfit, self.hips, self.neck),
            *draw_head(ADULT, outfit, self.neck),
        ]
        for side in (1.0, -1.0):
            shoulder = (self.neck[0], side * _SHOULDER_M, self.neck[2] - _BELOW_NECK_M)
            hand = (self.grip[0], side * self.grip[1], self.grip[2] + 0.02)
            elbow = bend(shoulder, hand, UPPER_ARM, LOWER_ARM, (-0.3, side * 0.5, -1.0))
            parts += draw_arm(outfit, shoulder, elbow, hand)
        return parts

    def legs(self, seed: int, distance_m: float) -> list[ModelPart]:
        """Pedals and legs after a distance."""
        outfit = dress_person(ADULT, colour=None, seed=seed)
        turn, parts = _GEAR * distance_m / self.wheel, []
        for side, phase in ((1.0, 0.0), (-1.0, math.pi)):
            ahead, up = (_CRANK_M * wave(turn + phase) for wave in (math.sin, math.cos))
            y = side * self.crank[1]
            pedal = (self.crank[0] + ahead, y, self.crank[2] + up)
            axle = (self.crank[0], side * (self.crank[1] - 0.03), self.crank[2])
            ankle = (pedal[0] - 0.04, y, pedal[2] + 0.10)
            hip = (self.hips[0], side * _BESIDE_M, self.hips[2])
            parts += [rod(STEEL, axle, pedal, 0.018), *draw_leg(outfit, hip, ankle, pitch=0.15)]
        return parts


def read_rider(table: Mapping[str, Any]) -> Rider:
    """A rider from a noun's table.

    Raises:
        ValueError: a place is missing or no point.
    """
    wanted = ("hips", "neck", "grip", "crank")
    if set(table) != {*wanted, "wheel"}:
        raise ValueError(f"a rider has {', '.join(wanted)} and wheel, not {', '.join(table)}")
    hips, neck, grip, crank = (point(table[name]) for name in wanted)
    return Rider(hips, neck, grip, crank, float(table["wheel"]))
