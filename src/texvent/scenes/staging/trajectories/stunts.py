"""What vehicles and small things do beyond going along: a skid round a bend, a flip in the air.

Pure, continuous functions of time; angles in radians, lengths in metres, times in seconds.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from texvent.scenes.models.machine_acts import MACHINE_ACTS
from texvent.scenes.models.protocol import Model
from texvent.scenes.models.wrapped.opening import OPENS
from texvent.scenes.staging.trajectories.action_trajectories import GRAVITY_M_S2, Climb, Hop, Sway
from texvent.scenes.staging.trajectories.manoeuvres import bend_path
from texvent.scenes.staging.trajectories.trajectory import (
    BodyState,
    Circle,
    FigureEight,
    Trajectory,
    Vector,
    ahead,
)

SLIP_RAD = 0.62
"""Angle between where a drifting car points and where it goes."""
STAYING = (
    OPENS
    | MACHINE_ACTS
    | frozenset({"stand", "sit", "lie", "sit down", "lie down", "stand up", "tug of war", "climb"})
)
"""What is done in one place, besides the acts of animals."""
WINGED = frozenset({"airplane", "propeller plane", "biplane", "fighter jet", "glider"})
"""Aircraft that do not rise straight up."""
_DRIFT_TURN_RAD = 1.3
"""Change of heading of a car that drifts, over the clip."""
_SMALL_M = 0.5
"""What is smaller turns over twice."""
SUNK = 0.8
"""Share of its height that a vessel sinks."""
ROUND_RAD, ROUND_RAD_S = 2.6, 1.3
"""Angle of the round that what goes in a circle covers in a clip at least, and the rate up to which
it turns for that."""
_FLAT = 0.62
"""Share of its length below which what is wide or high is flat."""
_TREMBLING = 4.0
"""Pace above which what sways trembles."""
_PAUSE_S = 0.35
"""Rest between two flips."""


def build_sway(model: Model, home: Vector, yaw: float, pace: float) -> Sway:
    """Leans to and fro about its foot; what trembles leans less, and turns where it lies flat."""
    least = min(model.length, model.width)
    is_flat = model.length < _FLAT * model.width or model.height < _FLAT * model.length
    lean = 0.22 if is_flat else 0.14
    if pace < _TREMBLING:
        return Sway(home, lean, 0.5 * pace, yaw)
    return Sway(home, 0.6 * lean, 0.5 * pace, yaw, model.height < _FLAT * least)


def _ease(share: float) -> float:
    """0 to 1, smooth at both ends."""
    share = min(max(share, 0.0), 1.0)
    return share * share * (3.0 - 2.0 * share)


@dataclass(frozen=True)
class Slipping:
    """Goes along a path, turned into the bend from where it goes."""

    path: Trajectory
    slip_rad: float
    """Positive = its front to the left."""
    start_s: float
    ramp_s: float = 0.5

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        state = self.path.at(time_s)
        share = _ease((time_s - self.start_s) / self.ramp_s)
        return replace(state, yaw=state.yaw + self.slip_rad * share)


@dataclass(frozen=True)
class Flip:
    """Turns over about its own length or width, in free flight or hovering, and again."""

    home: Vector
    height_m: float
    """How high it is thrown; 0 = it stays in the air."""
    pivot_m: float
    """Height of its middle above its origin."""
    yaw: float = 0.0
    turns: int = 1
    """Turns in one flight."""
    is_forward: bool = True
    """About its width, head over heels; else about its length."""
    tempo: float = 1.0
    start_s: float = 0.15

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        if self.height_m > 0.0:
            flight = 2.0 * math.sqrt(2.0 * self.height_m / GRAVITY_M_S2)
        else:
            flight = 0.9 / self.tempo
        clock = (time_s - self.start_s) % (flight + _PAUSE_S)
        into = min(clock, flight) if time_s >= self.start_s else 0.0
        share = into / flight
        lift = 4.0 * self.height_m * share * (1.0 - share)
        if self.height_m <= 0.0:
            share, lift = _ease(share), 0.4 * self.pivot_m * math.sin(math.pi * share)
        angle = 2.0 * math.pi * self.turns * share
        x, y, z = self.home
        return BodyState(
            (x, y, z + lift),
            self.yaw,
            pitch=angle if self.is_forward else 0.0,
            roll=0.0 if self.is_forward else angle,
            pivot_m=self.pivot_m if self.height_m > 0.0 else 0.0,
        )


@dataclass(frozen=True)
class Runway:
    """Along a runway and up from it at an even slope, or down onto it and along."""

    home: Vector
    """Where its wheels leave the ground, or meet it."""
    yaw: float
    speed_m_s: float
    lift_s: float
    """When they do."""
    slope: float = 0.32
    is_landing: bool = False

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        along = self.speed_m_s * (time_s - self.lift_s)
        over = -along if self.is_landing else along
        bend = 0.6 * self.speed_m_s
        if over <= 0.0:
            height, slope = 0.0, 0.0
        elif over < bend:
            height, slope = 0.5 * self.slope * over**2 / bend, self.slope * over / bend
        else:
            height, slope = self.slope * (over - 0.5 * bend), self.slope
        return BodyState(
            ahead(self.home, self.yaw, along, self.home[2] + height),
            self.yaw,
            # What lands keeps its nose up too.
            pitch=-math.atan(slope) * (0.3 if self.is_landing else 1.0),
            distance_m=self.speed_m_s * time_s,
            speed_m_s=self.speed_m_s,
        )


def build_drift(home: Vector, yaw: float, speed_m_s: float, duration_s: float) -> Trajectory:
    """Round a bend to its left, its front turned further left than it goes."""
    path = bend_path(yaw, speed_m_s, _DRIFT_TURN_RAD / (duration_s * speed_m_s), duration_s)
    x, y, _ = path.start
    path = replace(path, start=(x + home[0], y + home[1], home[2]), floor_m=home[2])
    return Slipping(path, SLIP_RAD, 0.1 * duration_s)


def build_flip(model: Model, home: Vector, yaw: float, tempo: float) -> Trajectory:
    """In the air about its length; what lies or stands is tossed up, and turns over."""
    span = max(model.length, model.width, model.height)
    if home[2] > 0.5 * model.height:
        return Flip(home, 0.0, 0.5 * span, yaw, is_forward=False, tempo=tempo)
    height = min(max(1.6 * span, 0.12), 2.5)
    is_small = span < _SMALL_M
    is_forward = is_small or model.length <= model.width
    return Flip(home, height, 0.5 * model.height, yaw, 2 if is_small else 1, is_forward)


def build_leap(
    model: Model, home: Vector, yaw: float, duration_s: float, clear_m: float
) -> Trajectory:
    """Hops along its heading so that the highest point is over its home at mid clip."""
    height = max(0.35 * model.height, 1.25 * clear_m + 0.1)
    flight = 2.0 * math.sqrt(2.0 * height / GRAVITY_M_S2)
    middle = 0.5 * duration_s
    phase = (0.5 * flight - middle) % (flight + 0.15)
    return Hop(home, height, 0.15, 2.2 * model.length, yaw, middle, phase_s=phase)


def build_lift(
    home: Vector, yaw: float, speed_m_s: float, duration_s: float, is_winged: bool, is_rising: bool
) -> Trajectory:
    """Straight up from its home or down to it; with wings, along the ground first or last."""
    if is_winged:
        lift_s = (0.3 if is_rising else 0.65) * duration_s
        return Runway(home, yaw, speed_m_s, lift_s, is_landing=not is_rising)
    if is_rising:
        return Climb(home, 0.2 * speed_m_s, 0.0, 2.0 * 0.8 * speed_m_s / duration_s)
    return Climb(home, -speed_m_s, 0.85 * duration_s, lowest_m=home[2])


def build_sinking(model: Model, home: Vector, duration_s: float) -> Trajectory:
    """Down from its home, by most of its height."""
    return Climb(home, -SUNK * model.height / duration_s, 0.0)


def build_round(
    model: Model, home: Vector, phase: float, speed_m_s: float, clips_per_s: float
) -> Circle:
    """Around its home; at a usual speed fast enough for a good part of the round to be seen.

    Args:
        model: its model, for its size.
        home: middle of the circle, m.
        phase: where it begins, rad.
        speed_m_s: its speed.
        clips_per_s: pace over the length of the clip; 0: the speed is what the prompt says.
    """
    radius = 1.3 * max(model.length, model.width)
    rate = speed_m_s / radius
    return Circle(home, radius, max(rate, min(ROUND_RAD_S, ROUND_RAD * clips_per_s)), phase)


EIGHT_S = 2.0
"""Seconds that a figure of eight takes at least."""
EIGHT = 1.6
"""Half its length, in lengths of what goes along it."""


def build_eight(
    model: Model, home: Vector, yaw: float, pace: float, duration_s: float
) -> FigureEight:
    """Along a figure of eight about its home, once in the clip or in `EIGHT_S` at a usual pace."""
    rate = 2.0 * math.pi * pace / max(duration_s, EIGHT_S)
    return FigureEight(home, EIGHT * max(model.length, model.width), yaw, rate)
