"""The camera as a function of time: a place, or a journey, plus moves that add up."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from texvent.scenes.description import CameraMove
from texvent.scenes.scene import Camera, Float64Array
from texvent.scenes.staging.camera.framing import Framing, direction, look_at
from texvent.scenes.staging.camera.moves import MoveChannels
from texvent.scenes.staging.trajectories.steered_path import SteeredPath
from texvent.scenes.staging.trajectories.trajectory import Trajectory

PAN_RAD = 0.36
"""Turn of a pan over the clip."""
TILT_RAD = 0.24
ROLL_RAD = 0.7
DUTCH_RAD = 0.3
"""Roll of a camera in a Dutch angle, over all of the clip."""
ORBIT_RAD = 1.0
CRANE_RAD = 0.5
"""Change of the angle under which a crane looks at its subject."""
ZOOM = 1.7
"""Focal length at the near end over the far end."""
DOLLY = 1.6
"""Distance at the far end over the near end."""
DOLLY_ZOOM = 2.2
"""The same for a dolly zoom."""
SHAKE_RAD = 0.015
ALL_AXES = "all axes"
"""Direction of a handheld camera that moves in all six degrees of freedom."""
ROAM_SHARE = 4.0
"""How much further than one that is held still that one turns."""
ROAM_WIDTHS = 0.08
"""How far it goes aside, in widths of the picture."""
STEP_M = 0.02
"""Amplitude of the bob of a camera that walks."""
LOWEST_M = 0.25
"""The camera stays at least this high above the ground."""
MOST_PITCH_RAD = 1.5


@dataclass(frozen=True)
class Journey:
    """A camera that travels: ego-motion along a route."""

    route: SteeredPath
    """Where it is and heads, at the height of the ground."""
    height_m: float
    """Of the camera."""
    pitch_rad: float
    """Below the horizon."""
    step_m: float = 0.0
    """Length of a step, m; 0 = it rolls or flies."""


@dataclass(frozen=True)
class CameraPath:
    """Camera moves over a clip; a pure, smooth function of time."""

    framing: Framing
    moves: tuple[CameraMove, ...]
    duration_s: float
    followed: Trajectory | None = None
    """What a "follow" or "orbit" keeps in place in the image."""
    follows_height: bool = True
    """Whether it also rises and falls with what it follows."""
    has_floor: bool = True
    """Whether there is ground to stay above."""
    room_m: float = math.inf
    """Half the side of the room it must stay in, m."""
    journey: Journey | None = None
    """The route of what travels."""
    subject_corners: Callable[[float], Float64Array] | None = None
    """[8, 3] box of the subject, m, whose size a dolly zoom keeps."""

    @cached_property
    def _channels(self) -> MoveChannels:
        return MoveChannels(self.moves, self.duration_s)

    def at(self, time_s: float) -> Camera:
        """The camera at that instant."""
        if self.journey is not None:
            camera = self._travel(self.journey, time_s)
        else:
            camera = self._watch(time_s)
        slant = DUTCH_RAD if any(move.kind == "dutch" for move in self.moves) else 0.0
        slant += ROAM_SHARE * SHAKE_RAD * self._roam * 3.0 * math.sin(5.5 * time_s + 0.5)
        return _rolled(camera, slant + ROLL_RAD * self._channels.centred("roll", time_s))

    @cached_property
    def _roam(self) -> float:
        """Pace of a camera that moves in all six degrees of freedom; 0 = it does not."""
        return sum(move.pace for move in self.moves if move.direction == ALL_AXES)

    def _watch(self, time_s: float) -> Camera:
        """A camera that looks at its subject."""
        framing, moved, near = self.framing, self._channels.centred, self._channels.below_most
        azimuth = framing.azimuth + ORBIT_RAD * moved("orbit", time_s)
        azimuth += self._turn_with_subject(time_s)
        elevation = framing.elevation + CRANE_RAD * moved("crane", time_s)
        elevation = min(max(elevation, -MOST_PITCH_RAD), MOST_PITCH_RAD)
        distance = framing.distance_m * DOLLY ** -near("dolly", time_s)
        distance *= DOLLY_ZOOM ** -near("dolly zoom", time_s)
        focal = framing.focal * ZOOM ** near("zoom", time_s)
        slide = self._slide(time_s)
        target = framing.target + slide
        position = self._keep_inside(target + distance * direction(azimuth, elevation))
        focal *= self._hold_size(target, position, time_s)
        target = position + _turned(target - position, *self._turn(time_s))
        return look_at(position, target, focal)

    def _travel(self, journey: Journey, time_s: float) -> Camera:
        """A camera that moves along its route and looks where it heads."""
        moved, near = self._channels.centred, self._channels.below_most
        state = journey.route.at(time_s)
        x, y, z = state.position
        bob = 0.0
        if journey.step_m > 0.0:
            bob = STEP_M * math.sin(2.0 * math.pi * state.distance_m / journey.step_m)
        height = z + journey.height_m + bob
        width = 0.4 * journey.height_m
        height += width * (moved("pedestal", time_s) + moved("crane", time_s))
        position = self._keep_inside(np.array([x, y, height]))
        flat = math.cos(journey.pitch_rad)
        forward = np.array(
            [flat * math.cos(state.yaw), flat * math.sin(state.yaw), -math.sin(journey.pitch_rad)]
        )
        target = position + _turned(forward, *self._turn(time_s))
        focal = self.framing.focal * ZOOM ** near("zoom", time_s)
        return _rolled(look_at(position, target, focal), -state.roll)

    def _turn_with_subject(self, time_s: float) -> float:
        """How far a camera behind or in front of its subject has gone round with it."""
        is_tied = any(
            move.kind == "follow" and move.direction in ("behind", "front") for move in self.moves
        )
        if not is_tied or self.followed is None:
            return 0.0
        return self.followed.at(time_s).yaw - self.followed.at(0.0).yaw

    def _slide(self, time_s: float) -> Float64Array:
        """Metres by which camera and target move together."""
        slide, moved = np.zeros(3), self._channels.centred
        if self.followed is not None and any(m.kind in ("follow", "orbit") for m in self.moves):
            now, start = self.followed.at(time_s).position, self.followed.at(0.0).position
            rises = 1.0 if self.follows_height else 0.0
            share_of_way = share_followed(self.moves)
            slide += share_of_way * np.subtract(now, start) * np.array([1.0, 1.0, rises])
        width = self.framing.distance_m / self.framing.focal
        azimuth = self.framing.azimuth
        right = np.array([math.cos(azimuth), math.sin(azimuth), 0.0])
        slide += 0.4 * width * moved("truck", time_s) * right
        slide[2] += 0.3 * width * moved("pedestal", time_s)
        roam = ROAM_WIDTHS * width * self._roam
        slide += roam * math.sin(4.9 * time_s) * right
        slide += roam * math.sin(3.7 * time_s + 1.0) * np.array([-right[1], right[0], 0.0])
        slide[2] += 0.7 * roam * math.sin(6.1 * time_s + 2.0)
        return slide

    def _hold_size(self, target: Float64Array, position: Float64Array, time_s: float) -> float:
        """Factor on the focal length that keeps the subject's size in a dolly zoom."""
        if not self._channels.has("dolly zoom") or self.subject_corners is None:
            return 1.0
        corners = self.subject_corners(time_s)
        offset = position - target
        distance = float(np.linalg.norm(offset))
        near = target + offset * (self.framing.distance_m / max(distance, 1e-9))
        return _extent(corners, near, target) / _extent(corners, position, target)

    def _turn(self, time_s: float) -> tuple[float, float]:
        """Angles to the right and up, radians."""
        right = PAN_RAD * self._channels.centred("pan", time_s)
        up = TILT_RAD * self._channels.centred("tilt", time_s)
        for move in self.moves:
            if move.kind == "handheld":
                wave = 2.0 * math.pi * time_s
                shake = SHAKE_RAD * move.pace
                shake *= ROAM_SHARE if move.direction == ALL_AXES else 1.0
                right += shake * (math.sin(1.1 * wave) + 0.6 * math.sin(2.7 * wave + 1.0))
                up += shake * (math.sin(1.4 * wave + 2.0) + 0.5 * math.sin(3.3 * wave))
        return right, up

    def in_room(self, points: Float64Array, times: Float64Array) -> CameraPath:
        """The path in a room that holds the camera at all times, s, and points [n, 3], m."""
        places = np.array([self.at(float(time)).position for time in times])
        reach = float(np.max(np.abs(places[:, :2])))
        spread = float(np.max(np.abs(points[:, :2])))
        height = float(np.max(points[:, 2])) / 0.6
        above = (float(np.max(places[:, 2])) + 0.35) / 0.6
        return replace(self, room_m=max(reach + 0.6, spread + 0.8, height + 0.5, above, 3.5))

    def _keep_inside(self, position: Float64Array) -> Float64Array:
        position = np.asarray(position, dtype=np.float64)
        if self.has_floor:
            position[2] = max(position[2], min(LOWEST_M, 0.4 * self.framing.distance_m))
        if math.isfinite(self.room_m):
            wall = self.room_m - 0.4
            position[:2] = np.clip(position[:2], -wall, wall)
            position[2] = min(position[2], 0.6 * self.room_m - 0.3)
        return position


def share_followed(moves: Sequence[CameraMove]) -> float:
    """Share of the subject's way that a camera which follows it goes along."""
    return next((m.pace for m in moves if m.kind == "follow" and m.direction == "slower"), 1.0)


def _extent(corners: Float64Array, position: Float64Array, target: Float64Array) -> float:
    """Largest extent of a box in the image at focal length 1, image widths."""
    camera = look_at(position, target, 1.0)
    seen = (corners - position) @ camera.rotation.T
    image = seen[:, :2] / np.maximum(seen[:, 2:], 0.1)
    return float(np.ptp(image, axis=0).max())


def _rolled(camera: Camera, angle: float) -> Camera:
    """The camera turned about its optical axis; positive = clockwise seen from behind it."""
    if angle == 0.0:
        return camera
    cosine, sine = math.cos(angle), math.sin(angle)
    right, down, forward = camera.rotation
    axes = np.stack([cosine * right + sine * down, cosine * down - sine * right, forward])
    return Camera(camera.position, axes, camera.focal)


def _turned(forward: Float64Array, right: float, up: float) -> Float64Array:
    """The vector turned to the right about the vertical, then up."""
    cosine, sine = math.cos(right), math.sin(right)
    x, y, z = forward
    x, y = x * cosine + y * sine, y * cosine - x * sine
    flat = math.hypot(x, y)
    angle = min(max(math.atan2(z, flat) + up, -MOST_PITCH_RAD), MOST_PITCH_RAD)
    length = math.hypot(flat, z)
    scale = length * math.cos(angle) / max(flat, 1e-9)
    return np.array([x * scale, y * scale, length * math.sin(angle)])
