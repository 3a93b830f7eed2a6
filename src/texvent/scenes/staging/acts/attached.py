"""Trajectories of what is held, pushed, thrown and caught: exact, and continuous in time."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from texvent.scenes.models.protocol import Model, Pose
from texvent.scenes.models.shapes import Affine, compose
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.trajectories.action_trajectories import GRAVITY_M_S2, Bounce
from texvent.scenes.staging.trajectories.trajectory import (
    BodyState,
    Trajectory,
    Vector,
    ahead,
    rotation,
)


def state_of(to_world: Float64Array) -> BodyState:
    """The state whose map from body to world this is ([3, 4], a rotation and an offset)."""
    pitch = math.asin(min(max(-float(to_world[2, 0]), -1.0), 1.0))
    yaw = math.atan2(float(to_world[1, 0]), float(to_world[0, 0]))
    roll = math.atan2(float(to_world[2, 1]), float(to_world[2, 2]))
    x, y, z = (float(value) for value in to_world[:, 3])
    return BodyState((x, y, z), yaw, pitch, roll, activity="stand")


@dataclass(frozen=True)
class HeldAt:
    """Fixed to a named place of another body."""

    holder: Actor
    anchor: str
    offset: Affine
    """[3, 4] its body coordinates in the axes of that place."""
    is_upright: bool = False
    """Whether it stays upright, facing as its holder does."""
    activity: str = "stand"
    turns: bool = True
    """Whether its axes turn with its holder, where it is upright."""

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        axes = self.holder.anchor(self.anchor, time_s)
        holder = self.holder.trajectory.at(time_s)
        if self.is_upright:
            yaw = holder.yaw if self.turns else 0.0
            axes = np.column_stack([rotation(yaw, 0.0, 0.0), axes[:, 3]])
        state = state_of(compose(axes, self.offset))
        return replace(
            state,
            distance_m=holder.distance_m,
            speed_m_s=holder.speed_m_s,
            activity=self.activity,
        )


@dataclass(frozen=True)
class Swaying:
    """To and fro in the wind about where another trajectory has it, as a kite."""

    path: Trajectory
    aside_m: float = 0.28
    up_m: float = 0.14
    roll_rad: float = 0.30

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        state = self.path.at(time_s)
        x, y, z = state.position
        side, rise = math.sin(2.6 * time_s), math.sin(4.1 * time_s + 0.7)
        place = (x + self.aside_m * side, y, z + self.up_m * rise)
        return replace(state, position=place, roll=state.roll + self.roll_rad * side)


_UPRIGHT = 0.7
"""Least z of a part's third axis for its axes to be those of what is on it."""


@dataclass(frozen=True)
class OnPart:
    """At a fixed place of a part that moves in another body: the board of a swing."""

    carrier: Trajectory
    model: Model
    part: int
    """Index into the model's parts."""
    place: Vector
    """In the carrier's body coordinates when the clip begins, m."""
    activity: str = "sit"

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        first, now = self._part(0.0), self._part(time_s)
        turn = now[:, :3] @ np.linalg.inv(first[:, :3])
        x, y, z = now[:, 3] + turn @ (np.array(self.place) - first[:, 3])
        # A board's own axes say how far it is tipped; those of a rod say nothing of up.
        axes = now[:, :3] / np.linalg.norm(now[:, :3], axis=0)
        tipped = axes if axes[2, 2] > _UPRIGHT else turn
        placed = compose(self.carrier.at(time_s).to_world(), np.column_stack([tipped, [x, y, z]]))
        return replace(state_of(placed), activity=self.activity)

    def _part(self, time_s: float) -> Affine:
        """[3, 4] the part's map to the carrier's body coordinates."""
        state = self.carrier.at(time_s)
        pose = Pose(state.tempo * time_s, state.distance_m, state.speed_m_s, state.activity)
        return np.asarray(self.model.parts(pose)[self.part].to_body)


@dataclass(frozen=True)
class OnEnd:
    """Put on its end, as a pencil in a cup."""

    path: Trajectory
    lean_rad: float = 0.0

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        return replace(self.path.at(time_s), pitch=self.lean_rad - 0.5 * math.pi)


@dataclass(frozen=True)
class MovedAlong:
    """On the ground at a fixed place before or behind a body that pushes or pulls it."""

    leader: Trajectory
    along_m: float
    floor_m: float
    activity: str = "move"

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        state = self.leader.at(time_s)
        return BodyState(
            ahead(state.position, state.yaw, self.along_m, self.floor_m),
            state.yaw,
            distance_m=state.distance_m,
            speed_m_s=state.speed_m_s,
            activity=self.activity,
        )


@dataclass(frozen=True)
class Performed:
    """Another trajectory whose body does something in particular meanwhile."""

    path: Trajectory
    activity: str | None = None
    """None = what the path says."""
    grips: tuple[tuple[str, Vector], ...] = ()
    contact_s: float | None = None
    """Instant of contact of a single act, s."""

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        state = self.path.at(time_s)
        return replace(
            state,
            activity=self.activity or state.activity,
            grips=self.grips + state.grips,
            act_s=state.act_s if self.contact_s is None else time_s - self.contact_s,
        )


STOP_BEFORE_S = 0.25
"""A run-up ends that long before the kick."""
_SLOWING_S = 0.5
_RUN_UP_M_S = 1.7


@dataclass(frozen=True)
class RunUp:
    """Walks up to its home, slows down and stands; the standing foot is under it then."""

    home: Vector
    yaw: float
    stop_s: float
    end_distance_m: float
    """Distance covered at the end, which decides where in their cycle the legs are."""

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        left = max(self.stop_s - time_s, 0.0)
        if left < _SLOWING_S:
            behind = 0.5 * _RUN_UP_M_S / _SLOWING_S * left**2
        else:
            behind = _RUN_UP_M_S * (left - 0.5 * _SLOWING_S)
        return BodyState(
            ahead(self.home, self.yaw, -behind, self.home[2]),
            self.yaw,
            distance_m=self.end_distance_m - behind,
            speed_m_s=_RUN_UP_M_S,
        )


@dataclass(frozen=True)
class Switched:
    """One trajectory up to an instant, another from then on."""

    before: Trajectory
    after: Trajectory
    at_s: float

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        return (self.before if time_s < self.at_s else self.after).at(time_s)


@dataclass(frozen=True)
class FreeFlight:
    """Free flight from where it was let go, with bounces; it keeps turning as it does then."""

    start: BodyState
    """Where and how it was let go."""
    start_s: float
    velocity_m_s: Vector
    pivot_m: float
    """Height of its middle above its origin, m."""
    rest_m: float
    """Height of its middle when it lies on the ground, m."""
    tumble_rad_s: float = 0.0

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        elapsed = max(time_s - self.start_s, 0.0)
        middle = middle_of(self.start, self.pivot_m)
        along = math.hypot(self.velocity_m_s[0], self.velocity_m_s[1])
        fall = Bounce(
            (0.0, 0.0, max(float(middle[2]), self.rest_m)), self.rest_m, self.velocity_m_s[2],
            restitution=0.55,
        )  # fmt: skip
        x = float(middle[0]) + elapsed * self.velocity_m_s[0]
        y = float(middle[1]) + elapsed * self.velocity_m_s[1]
        state = replace(
            self.start,
            pitch=self.start.pitch + self.tumble_rad_s * elapsed,
            distance_m=self.start.distance_m + along * elapsed,
        )
        return with_middle(state, (x, y, self.rest_m + fall.height_m(elapsed)), self.pivot_m)


@dataclass(frozen=True)
class Arc:
    """Free flight between two places at two instants, with no drag."""

    start: Vector
    """Middle at `start_s`, m."""
    end: BodyState
    """State at `end_s`."""
    start_s: float
    end_s: float
    pivot_m: float
    turns: float = 0.0
    """Whole turns about its side axis on the way."""
    begin: BodyState | None = None
    """Orientation at the start; None = as at the end."""

    def velocity(self) -> Vector:
        """Velocity at the start, m/s."""
        span = self.end_s - self.start_s
        goal = middle_of(self.end, self.pivot_m)
        x, y, z = ((float(b) - a) / span for a, b in zip(self.start, goal, strict=True))
        return (x, y, z + 0.5 * GRAVITY_M_S2 * span)

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        elapsed = time_s - self.start_s
        x, y, z = self.velocity()
        middle = (
            self.start[0] + x * elapsed,
            self.start[1] + y * elapsed,
            self.start[2] + z * elapsed - 0.5 * GRAVITY_M_S2 * elapsed**2,
        )
        share = elapsed / (self.end_s - self.start_s)
        first = self.begin or self.end
        angles = {
            name: getattr(first, name)
            + share * math.remainder(getattr(self.end, name) - getattr(first, name), 2.0 * math.pi)
            for name in ("yaw", "pitch", "roll")
        }
        angles["pitch"] += 2.0 * math.pi * self.turns * share
        return with_middle(replace(self.end, **angles), middle, self.pivot_m)


def middle_of(state: BodyState, pivot_m: float) -> Float64Array:
    """[3] world position of the point `pivot_m` above a body's origin."""
    return np.asarray(state.to_world() @ np.array([0.0, 0.0, pivot_m, 1.0]))


def with_middle(state: BodyState, middle: Vector, pivot_m: float) -> BodyState:
    """The same orientation, moved so that the point `pivot_m` above the origin is at `middle`."""
    turn = rotation(state.yaw, state.pitch, state.roll)
    x, y, z = np.array(middle) - turn @ np.array([0.0, 0.0, pivot_m])
    return replace(state, position=(float(x), float(y), float(z)), pivot_m=0.0)
