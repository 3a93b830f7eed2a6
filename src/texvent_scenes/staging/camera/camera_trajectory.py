"""The camera as a function of time: a static pose, or a route, plus channels that add up."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from texvent.camera import PosedCamera
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.spec.scene import CameraMove
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.camera.framing import Framing, direction, look_at
from texvent_scenes.staging.trajectories.steered_path import SteeredPath
from texvent_scenes.staging.trajectories.trajectory import Trajectory

PAN_RAD, TILT_RAD, ROLL_RAD = 0.36, 0.24, 0.7
"""Turns over the clip."""
ORBIT_RAD = 1.0
"""Change of azimuth around the subject."""
ZOOM, DOLLY = 1.7, 1.6
"""Focal length at the near end over the far end; distance at the far end over the near end."""
TRUCK_WIDTHS, PEDESTAL_WIDTHS = 0.4, 0.3
"""Displacements aside and up, in widths of the picture at the subject."""
SHAKE_RAD = 0.015
ALL_AXES = "all axes"
"""Direction of a handheld camera that moves in all six degrees of freedom."""
ROAM_SHARE, ROAM_WIDTHS = 4.0, 0.08
"""Turns of that camera relative to those of one that is held still, and its excursion aside."""
_ROAM_RAD_S = np.array([4.9, 3.7, 6.1])
"""Angular frequencies of its displacement aside, along and up."""
_HIGH_WIDTHS = 1.3
"""Width of the picture of a camera that travels, in heights above the ground."""
LOWEST_M = 0.25
"""The camera stays at least this high above the ground."""
MOST_PITCH_RAD = 1.5
USUAL_S = 2.0
"""Length of a move that goes its usual way; shorter ones go less far."""
_STEPS = 64
"""Steps of the clip in which the range of a move is found."""
_NEGATIVE = ("left", "down", "out", "counter-clockwise")


class MoveChannels:
    """Progress of all moves of a shot; each a smooth function of time.

    Moves of one phase happen together; phases follow each other and share the clip evenly.
    """

    def __init__(self, moves: tuple[CameraMove, ...], duration_s: float = USUAL_S) -> None:
        self.moves = moves
        self._duration_s = duration_s
        self._phases = 1 + max((move.phase for move in moves), default=0)

    def centred(self, kind: str, time_s: float) -> float:
        """Sum of the moves of a kind, in usual amounts, about the middle of its range."""
        low, high = self._ranges.get(kind, (0.0, 0.0))
        return self._sum(kind, time_s) - 0.5 * (low + high)

    def below_most(self, kind: str, time_s: float) -> float:
        """The same, 0 where it is largest and negative elsewhere: zoom and dolly."""
        return self._sum(kind, time_s) - self._ranges.get(kind, (0.0, 0.0))[1]

    def _sum(self, kind: str, time_s: float) -> float:
        return sum(self._reach(move, time_s) for move in self.moves if move.kind == kind)

    def _reach(self, move: CameraMove, time_s: float) -> float:
        """Progress of one move, in usual amounts."""
        span = self._duration_s / self._phases
        amount = min(max(math.sqrt(span / USUAL_S), 0.5), 1.3) * move.pace
        amount *= -1.0 if move.direction in _NEGATIVE else 1.0
        return amount * min(max(time_s / span - move.phase, 0.0), 1.0)

    @cached_property
    def _ranges(self) -> dict[str, tuple[float, float]]:
        """Kind → least and most of its sum over the clip."""
        times = [self._duration_s * step / _STEPS for step in range(_STEPS + 1)]
        sums = {move.kind: [self._sum(move.kind, time) for time in times] for move in self.moves}
        return {kind: (min(values), max(values)) for kind, values in sums.items()}


@dataclass(frozen=True)
class Journey:
    """A camera that travels: ego-motion along a route."""

    route: SteeredPath
    """Position and heading on the ground."""
    height_m: float
    pitch_rad: float
    """Pitch below the horizon."""


@dataclass(frozen=True)
class Tie:
    """The motion that a camera which follows or orbits its subject shares with it."""

    trajectory: Trajectory
    """Trajectory of the subject."""
    rises: bool = True
    """Whether it also rises and falls with it."""

    @classmethod
    def of(cls, moves: Sequence[CameraMove], subject: Actor) -> Tie | None:
        """The tie that moves make; None where the camera or its subject stays."""
        is_tied = any(move.kind in ("follow", "orbit") for move in moves)
        if not is_tied or not subject.is_mover:
            return None
        return cls(subject.trajectory, subject.noun.habitat != "ground")

    def displacement(self, time_s: float) -> Float64Array:
        """[3] by which the camera has gone along since the start, m."""
        now, start = self.trajectory.at(time_s).position, self.trajectory.at(0.0).position
        return np.subtract(now, start) * [1.0, 1.0, float(self.rises)]

    def relative(self, points: Float64Array, time_s: float) -> Float64Array:
        """Points [n, 3], m, as the camera sees them, at the place of the start."""
        return np.asarray(points - self.displacement(time_s))


@dataclass(frozen=True)
class CameraTrajectory:
    """Camera moves over a clip; a pure, smooth function of time."""

    framing: Framing
    moves: tuple[CameraMove, ...]
    duration_s: float
    tie: Tie | None = None
    """Tie to the object that a "follow" or "orbit" keeps in place in the image."""
    has_floor: bool = True
    """Whether there is ground to stay above."""
    room_m: float = math.inf
    """Half the side of the room it must stay in, m."""
    journey: Journey | None = None
    """The route of what travels."""

    @cached_property
    def _channels(self) -> MoveChannels:
        return MoveChannels(self.moves, self.duration_s)

    @cached_property
    def _roam(self) -> float:
        """Pace of a camera that moves in all six degrees of freedom; 0 = it does not."""
        return sum(move.pace for move in self.moves if move.direction == ALL_AXES)

    def at(self, time_s: float) -> PosedCamera:
        """The camera at that instant."""
        if self.journey is not None:
            start, target, roll = _ride(self.journey, time_s)
            slide = self._slide(time_s, _HIGH_WIDTHS * self.journey.height_m)
            position = self._keep_inside(start + slide)
            ahead = target - start
        else:
            (start, target), roll = self._stand(time_s), 0.0
            slide = self._slide(time_s, self.framing.distance_m / self.framing.focal)
            position = self._keep_inside(start + slide)
            ahead = target + slide - position
        near = self._channels.below_most
        focal = self.framing.focal * ZOOM ** near("zoom", time_s)
        camera = look_at(position, position + _turned(ahead, *self._turn(time_s)), focal)
        return _rolled(camera, roll + self._roll(time_s))

    def _stand(self, time_s: float) -> tuple[Float64Array, Float64Array]:
        """Position and target of a camera that looks at its subject, m."""
        framing, moved, near = self.framing, self._channels.centred, self._channels.below_most
        azimuth = framing.azimuth + ORBIT_RAD * moved("orbit", time_s)
        distance = framing.distance_m * DOLLY ** -near("dolly", time_s)
        target = framing.target
        if self.tie is not None:
            target = target + self.tie.displacement(time_s)
        return target + distance * direction(azimuth, framing.elevation), target

    def _slide(self, time_s: float, width_m: float) -> Float64Array:
        """Metres by which camera and target move together; `width_m` of the picture."""
        moved, azimuth = self._channels.centred, self.framing.azimuth
        right = np.array([math.cos(azimuth), math.sin(azimuth), 0.0])
        ahead = np.array([-right[1], right[0], 0.0])
        roam = ROAM_WIDTHS * self._roam * np.sin(_ROAM_RAD_S * time_s + [0.0, 1.0, 2.0])
        rise = PEDESTAL_WIDTHS * moved("pedestal", time_s)
        said = np.array([TRUCK_WIDTHS * moved("truck", time_s), 0.0, rise])
        aside, along, up = roam + said
        return np.asarray(width_m * (aside * right + along * ahead + [0.0, 0.0, up]))

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

    def _roll(self, time_s: float) -> float:
        """Turn about the optical axis, radians."""
        slant = ROAM_SHARE * SHAKE_RAD * self._roam * 3.0 * math.sin(5.5 * time_s + 0.5)
        return slant + ROLL_RAD * self._channels.centred("roll", time_s)

    def in_room(self, points: Float64Array, times: Float64Array) -> CameraTrajectory:
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


def _ride(journey: Journey, time_s: float) -> tuple[Float64Array, Float64Array, float]:
    """Position and target of a camera that looks where it heads, m, and how it rolls, rad."""
    state = journey.route.at(time_s)
    x, y, z = state.position
    position = np.array([x, y, z + journey.height_m])
    return position, position - direction(state.yaw - 0.5 * math.pi, journey.pitch_rad), -state.roll


def _rolled(camera: PosedCamera, angle: float) -> PosedCamera:
    """The camera turned about its optical axis; positive = clockwise seen from behind it."""
    if angle == 0.0:
        return camera
    cosine, sine = math.cos(angle), math.sin(angle)
    right, down, forward = camera.rotation
    axes = np.stack([cosine * right + sine * down, cosine * down - sine * right, forward])
    return PosedCamera(camera.position, axes, camera.focal)


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
