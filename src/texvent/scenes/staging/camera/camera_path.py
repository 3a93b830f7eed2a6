"""The camera as a function of time: a position plus moves that add up."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from texvent.scenes.description import CameraMove
from texvent.scenes.scene import Camera, Float64Array
from texvent.scenes.staging.camera.framing import Framing, direction, look_at
from texvent.scenes.staging.trajectories.trajectory import Trajectory

PAN_RAD = 0.36
"""Turn of a pan over the clip."""
TILT_RAD = 0.24
ORBIT_RAD = 1.0
ZOOM = 1.7
"""Focal length at the near end over the far end."""
DOLLY = 1.6
"""Distance at the far end over the near end."""
SHAKE_RAD = 0.006
LOWEST_M = 0.25
"""The camera stays at least this high above the ground."""

_SIGN = {"left": -1.0, "right": 1.0, "up": 1.0, "down": -1.0, "in": 1.0, "out": -1.0}


@dataclass(frozen=True)
class CameraPath:
    """Camera moves over a clip; a pure, smooth function of time."""

    framing: Framing
    moves: tuple[CameraMove, ...]
    duration_s: float
    followed: Trajectory | None = None
    """What a "follow" keeps in place in the image."""
    follows_height: bool = True
    """Whether it also rises and falls with what it follows."""
    has_floor: bool = True
    """Whether there is ground to stay above."""
    room_m: float = math.inf
    """Half the side of the room it must stay in, m."""

    def at(self, time_s: float) -> Camera:
        """The camera at that instant."""
        share = time_s / self.duration_s
        framing = self.framing
        azimuth, distance, focal = framing.azimuth, framing.distance_m, framing.focal
        slide, turn = np.zeros(3), np.zeros(2)
        for move in self.moves:
            amount = move.pace * _SIGN.get(move.direction or "right", 1.0)
            if move.kind == "orbit":
                azimuth += ORBIT_RAD * amount * (share - 0.5)
            elif move.kind == "zoom":
                focal *= _ramp(ZOOM, share, amount)
            elif move.kind == "dolly":
                distance /= _ramp(DOLLY, share, amount)
            else:
                slide = slide + self._slide(move, amount, share, time_s)
                turn = turn + _turn(move, amount, share, time_s)
        offset = distance * direction(azimuth, framing.elevation)
        position = self._keep_inside(framing.target + offset + slide)
        target = framing.target + slide
        target = position + _turned(target - position, *turn)
        return look_at(position, target, focal)

    def _slide(self, move: CameraMove, amount: float, share: float, time_s: float) -> Float64Array:
        """Metres by which camera and target move together."""
        if move.kind == "follow" and self.followed is not None:
            now, start = self.followed.at(time_s).position, self.followed.at(0.0).position
            rises = 1.0 if self.follows_height else 0.0
            return np.asarray(np.subtract(now, start) * np.array([1.0, 1.0, rises]))
        width = self.framing.distance_m / self.framing.focal
        if move.kind == "truck":
            right = np.array([math.cos(self.framing.azimuth), math.sin(self.framing.azimuth), 0])
            return np.asarray(0.4 * width * amount * (share - 0.5) * right)
        if move.kind == "pedestal":
            return np.array([0.0, 0.0, 0.3 * width * amount * (share - 0.5)])
        return np.zeros(3)

    def _keep_inside(self, position: Float64Array) -> Float64Array:
        position = np.asarray(position, dtype=np.float64)
        if self.has_floor:
            position[2] = max(position[2], LOWEST_M)
        if math.isfinite(self.room_m):
            wall = self.room_m - 0.4
            position[:2] = np.clip(position[:2], -wall, wall)
            position[2] = min(position[2], 0.6 * self.room_m - 0.3)
        return position


def _ramp(factor: float, share: float, amount: float) -> float:
    """1 at the near end of a zoom or dolly, 1 / factor^pace at the far end."""
    steps = abs(amount) * ((share - 1.0) if amount > 0.0 else -share)
    return float(factor**steps)


def _turn(move: CameraMove, amount: float, share: float, time_s: float) -> Float64Array:
    """Angles to the right and up, radians."""
    if move.kind == "pan":
        return np.array([PAN_RAD * amount * (share - 0.5), 0.0])
    if move.kind == "tilt":
        return np.array([0.0, TILT_RAD * amount * (share - 0.5)])
    if move.kind == "handheld":
        wave = 2.0 * math.pi * time_s
        right = math.sin(1.1 * wave) + 0.6 * math.sin(2.7 * wave + 1.0)
        up = math.sin(1.4 * wave + 2.0) + 0.5 * math.sin(3.3 * wave)
        return SHAKE_RAD * move.pace * np.array([right, up])
    return np.zeros(2)


def _turned(forward: Float64Array, right: float, up: float) -> Float64Array:
    """The vector turned to the right about the vertical, then up."""
    cosine, sine = math.cos(right), math.sin(right)
    x, y, z = forward
    x, y = x * cosine + y * sine, y * cosine - x * sine
    flat = math.hypot(x, y)
    angle = math.atan2(z, flat) + up
    length = math.hypot(flat, z)
    scale = length * math.cos(angle) / max(flat, 1e-9)
    return np.array([x * scale, y * scale, length * math.sin(angle)])
