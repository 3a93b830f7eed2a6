"""The line of a road on the ground: straight or a circular arc, with roads that cross it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from texvent.scenes.scene import Float64Array


@dataclass(frozen=True)
class RoadLine:
    """Centre lines of the roads of a scene; lengths in metres, angles in radians."""

    angle: float = 0.0
    """Direction at `offset`, from x towards y."""
    offset: tuple[float, float] = (0.0, 0.0)
    """A point (x, y) on the main road's centre line."""
    curvature: float = 0.0
    """1/m; positive bends to the left of `angle`; 0 = straight."""
    crossings: tuple[tuple[float, float, float], ...] = ()
    """Straight roads that cross the main one: a point (x, y) on the centre line, and direction."""

    def at(self, along_m: float) -> tuple[float, float, float]:
        """Point (x, y) and direction of the main road at that arc length from `offset`."""
        x, y = self.offset
        turn = self.curvature * along_m
        if abs(turn) < 1e-9:
            return (
                x + along_m * math.cos(self.angle),
                y + along_m * math.sin(self.angle),
                self.angle,
            )
        heading = self.angle + turn
        x += (math.sin(heading) - math.sin(self.angle)) / self.curvature
        y -= (math.cos(heading) - math.cos(self.angle)) / self.curvature
        return x, y, heading

    def across(self, spot: Float64Array) -> float:
        """Metres from the main road's line to a ground point [2], positive on its left."""
        if self.curvature == 0.0:
            x, y = spot[0] - self.offset[0], spot[1] - self.offset[1]
            return float(y * math.cos(self.angle) - x * math.sin(self.angle))
        radius = 1.0 / self.curvature
        centre = (
            self.offset[0] - radius * math.sin(self.angle),
            self.offset[1] + radius * math.cos(self.angle),
        )
        gap = abs(radius) - math.hypot(spot[0] - centre[0], spot[1] - centre[1])
        return math.copysign(1.0, radius) * gap

    def distance(self, points: Float64Array) -> Float64Array:
        """[n] metres from each ground point [n, 2] to the nearest centre line."""
        points = np.asarray(points, dtype=np.float64)
        distances = [self._distance_from_main(points)]
        for x, y, angle in self.crossings:
            distances.append(_distance_from_straight(points, x, y, angle))
        return np.asarray(np.min(distances, axis=0))

    def _distance_from_main(self, points: Float64Array) -> Float64Array:
        if self.curvature == 0.0:
            return _distance_from_straight(points, *self.offset, self.angle)
        radius = 1.0 / self.curvature
        centre = np.array(self.offset) + radius * np.array(
            [-math.sin(self.angle), math.cos(self.angle)]
        )
        return np.asarray(np.abs(np.hypot(*(points - centre).T) - abs(radius)))


def _distance_from_straight(points: Float64Array, x: float, y: float, angle: float) -> Float64Array:
    across = (points[:, 1] - y) * math.cos(angle) - (points[:, 0] - x) * math.sin(angle)
    return np.asarray(np.abs(across))
