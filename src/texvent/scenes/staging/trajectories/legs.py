"""A path of legs: over ground and slopes at even speed, and through the air under gravity."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from texvent.scenes.staging.trajectories.action_trajectories import GRAVITY_M_S2
from texvent.scenes.staging.trajectories.trajectory import BodyState, Vector


@dataclass(frozen=True)
class Leg:
    """One stretch, straight over the ground."""

    end: Vector
    """Where it ends, m."""
    duration_s: float
    activity: str = "move"
    is_flight: bool = False
    """Whether gravity alone decides the height on it."""
    tumble_rad: float = 0.0
    """How far the body turns nose down on it."""
    slows: bool = False
    """Whether it comes to rest."""
    tilts: bool = False
    """Whether the body lies along the slope of its way."""


@dataclass(frozen=True)
class Legs:
    """Goes one leg after the other from t = 0, and stays at the last one's end."""

    start: Vector
    yaw: float
    """Heading until it goes somewhere."""
    legs: tuple[Leg, ...]
    radius_m: float = 0.0
    """Of what rolls; 0 = it does not."""
    pivot_m: float = 0.0
    """Height above its origin about which it turns, m."""
    turns: bool = True
    """Whether its front points where it goes."""

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        start, yaw, way, tumbled, begun = self.start, self.yaw, 0.0, 0.0, 0.0
        for leg in self.legs:
            long = math.dist(start[:2], leg.end[:2])
            if self.turns and long > 1e-6:
                yaw = math.atan2(leg.end[1] - start[1], leg.end[0] - start[0])
            if time_s < begun + leg.duration_s or leg is self.legs[-1]:
                return self._on(leg, start, (yaw, way, tumbled), time_s - begun)
            start, way, begun = leg.end, way + long, begun + leg.duration_s
            tumbled += leg.tumble_rad
        return BodyState(start, yaw)

    def _on(
        self, leg: Leg, start: Vector, before: tuple[float, float, float], elapsed_s: float
    ) -> BodyState:
        """State on a leg; `before` are heading, way and tumble at its beginning."""
        yaw, way, tumbled = before
        is_over = elapsed_s >= leg.duration_s
        time = min(max(elapsed_s, 0.0), leg.duration_s)
        share = time / leg.duration_s
        along = share * (2.0 - share) if leg.slows else share
        x, y, z = (a + along * (b - a) for a, b in zip(start, leg.end, strict=True))
        long = math.dist(start[:2], leg.end[:2])
        rise = leg.end[2] - start[2]
        if leg.is_flight:
            z += 0.5 * GRAVITY_M_S2 * time * (leg.duration_s - time)
        pitch = tumbled + share * leg.tumble_rad
        if leg.tilts and long > 1e-6:
            pitch -= math.atan2(rise, long)
        if self.radius_m > 0.0:
            pitch += (way + along * long) / self.radius_m
        middle = time - 0.5 * leg.duration_s
        return BodyState(
            (x, y, z), yaw, pitch, distance_m=way + along * long,
            speed_m_s=0.0 if is_over else long / leg.duration_s,
            activity="stand" if is_over and leg.activity == "move" else leg.activity,
            pivot_m=self.pivot_m, act_s=middle if leg.is_flight else None,
        )  # fmt: skip


def flight_s(start_m: float, end_m: float, top_m: float) -> float:
    """How long a flight takes from one height over a greatest one to another, s.

    Example:
        >>> round(flight_s(0.0, 0.0, 1.0), 2)
        0.9
    """
    up, down = top_m - np.minimum([start_m, end_m], top_m)
    return float(np.sqrt(2.0 * up / GRAVITY_M_S2) + np.sqrt(2.0 * down / GRAVITY_M_S2))
