"""Kick, throw, catch and hit: when bodies meet, and where the thing flies before and after."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from texvent.scenes.models.people.activities import ACTIVITIES
from texvent.scenes.models.people.person import RUN_UP
from texvent.scenes.models.people.props import PROPS
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.attached import (
    STOP_BEFORE_S,
    Arc,
    FreeFlight,
    HeldAt,
    Performed,
    RunUp,
    Switched,
    middle_of,
    with_middle,
)
from texvent.scenes.staging.acts.hand_work.hanging import hangs, swing_by_kick
from texvent.scenes.staging.acts.holding import along_tool, is_person, size_of
from texvent.scenes.staging.trajectories.action_trajectories import Hop
from texvent.scenes.staging.trajectories.trajectory import (
    BodyState,
    Stationary,
    Trajectory,
    Vector,
)

FLIGHT_M = 2.4
"""Most metres that a thing flies in the rest of the clip, so that the camera can show it."""
_REACH_S = 0.85
"""Longest flight towards who catches or hits, s."""


def contact_time(duration_s: float, share: float = 0.45) -> float:
    """When the bodies meet, s."""
    return min(max(share * duration_s, 0.3), 1.1)


def kick(subject: Actor, thing: Actor, duration_s: float) -> tuple[Actor, Actor]:
    """A run-up, the foot meets the thing, the thing flies."""
    contact_s = contact_time(duration_s)
    home = subject.trajectory.at(0.0)
    yaw, heading = home.yaw, heading_of(home.yaw)
    if is_person(subject):
        # The standing foot is in the middle of its stance, the other one in the air.
        stride = RUN_UP.stride * size_of(subject.model)
        path: Trajectory = RunUp(
            home.position, yaw, contact_s - STOP_BEFORE_S, stride * (40.0 + 0.05)
        )
        path = Performed(path, "kick", contact_s=contact_s)
    else:
        path = Stationary(home.position, yaw, "stand")
    subject = replace(subject, trajectory=path, lead_m=0.0, is_mover=True, props=())
    tip = subject.anchor("right foot", contact_s)[:, 3]
    if hangs(thing):
        return subject, swing_by_kick(thing, tip, heading, contact_s)
    radius, rest = 0.5 * thing.model.length, _pivot(thing)
    inset = 0.0
    if abs(thing.model.length - thing.model.height) < 0.1 * radius:
        inset = radius - math.sqrt(max(radius**2 - (radius - min(tip[2], radius)) ** 2, 0.0))
    middle = np.array([tip[0], tip[1], home.position[2] + rest]) + (radius - inset) * heading
    speed = _speed(duration_s - contact_s)
    start = with_middle(BodyState((0.0, 0.0, 0.0), yaw), vector(middle), lift_of(thing))
    flight = FreeFlight(
        start, contact_s, vector(speed * heading + [0.0, 0.0, 0.45 * speed]), lift_of(thing),
        home.position[2] + rest, speed / max(rest, 0.05),
    )  # fmt: skip
    return subject, replace(thing, trajectory=flight, is_mover=True, lead_m=0.0)


def throw(
    subject: Actor, thing: Actor, catcher: Actor | None, duration_s: float
) -> tuple[Actor, Actor, Actor | None]:
    """Let go in the middle of the swing; it flies off, or to who catches it."""
    release_s = contact_time(duration_s, 0.35)
    home = subject.trajectory.at(0.0)
    path = Performed(Stationary(home.position, home.yaw), "throw", contact_s=release_s)
    subject = replace(subject, trajectory=path, lead_m=0.0, is_mover=True, props=())
    anchor = "right hand" if is_person(subject) else "mouth"
    held = HeldAt(subject, anchor, _in_palm(thing))
    start = held.at(release_s)
    heading = heading_of(home.yaw)
    rest = home.position[2] + _pivot(thing)
    if catcher is None:
        speed = _speed(duration_s - release_s)
        flight: Trajectory = FreeFlight(
            start, release_s, vector(speed * heading + [0.0, 0.0, 0.35 * speed]),
            lift_of(thing), rest, 6.0,
        )  # fmt: skip
        path_of_thing: Trajectory = Switched(held, flight, release_s)
        return subject, replace(thing, trajectory=path_of_thing, is_mover=True, lead_m=0.0), None
    catch_s = min(release_s + _REACH_S, release_s + 0.75 * (duration_s - release_s))
    gap = 1.2 + 2.6 * (catch_s - release_s) + 0.5 * catcher.model.length
    catcher = _stand_and_catch(catcher, vector(np.array(home.position) + gap * heading),
                               home.yaw + math.pi, catch_s)  # fmt: skip
    caught = _held_by_catcher(catcher, thing)
    arc = Arc(vector(middle_of(start, lift_of(thing))), caught.at(catch_s), release_s, catch_s,
              lift_of(thing), 1.0, start)  # fmt: skip
    whole = Switched(Switched(held, arc, release_s), caught, catch_s)
    return subject, replace(thing, trajectory=whole, is_mover=True, lead_m=0.0), catcher


def catch(subject: Actor, thing: Actor, duration_s: float) -> tuple[Actor, Actor]:
    """The thing comes flying from ahead and stays in the hands or in the mouth."""
    catch_s = contact_time(duration_s, 0.55)
    home = subject.trajectory.at(0.0)
    subject = _stand_and_catch(subject, home.position, home.yaw, catch_s)
    caught = _held_by_catcher(subject, thing)
    end = caught.at(catch_s)
    start = middle_of(end, lift_of(thing)) + (0.8 + 1.8 * catch_s) * heading_of(home.yaw)
    arc = Arc(vector(start - np.array([0.0, 0.0, 0.2])), end, 0.0, catch_s, lift_of(thing), 1.0)
    whole = Switched(arc, caught, catch_s)
    return subject, replace(thing, trajectory=whole, is_mover=True, lead_m=0.0)


@dataclass(frozen=True)
class Swing:
    """How something is struck."""

    activity: str
    side: float
    """Where the ball flies: 0 = ahead of the body, 1 = to its left."""
    is_teed: bool = False
    """Whether the ball lies on the ground."""


_SWINGS = {
    "racket": Swing("swing racket", 0.0),
    "bat": Swing("swing bat", 1.0),
    "club": Swing("swing club", 1.0, is_teed=True),
}
_SWING_OF_TOOL = {
    "tennis racket": "racket", "badminton racket": "racket", "ping-pong paddle": "racket",
    "golf club": "club", "hockey stick": "club", "baseball bat": "bat", "cricket bat": "bat",
}  # fmt: skip
TOOLS = frozenset(_SWING_OF_TOOL)
"""Nouns that balls are hit with."""
_SWING_OF_BALL = {"tennis ball": "racket", "shuttlecock": "racket", "golf ball": "club"}


def hit(
    subject: Actor, thing: Actor, tool: Actor | None, duration_s: float
) -> tuple[Actor, Actor, Actor | None]:
    """The thing arrives where bat, racket or club sweep through, and flies away."""
    name = _SWING_OF_BALL.get(thing.noun.name, "bat")
    if tool is not None:
        name = _SWING_OF_TOOL.get(tool.noun.name, "bat")
    swing = _SWINGS[name]
    contact_s = contact_time(duration_s, 0.5)
    home = subject.trajectory.at(0.0)
    # Who swings to the left turns so that the ball still flies where the body was to face.
    yaw = home.yaw - 0.5 * math.pi * swing.side
    path = Performed(Stationary(home.position, yaw), swing.activity, contact_s=contact_s)
    props = () if tool is not None else PROPS[swing.activity]
    subject = replace(subject, trajectory=path, lead_m=0.0, is_mover=True, props=props)
    axes = subject.anchor("right hand", contact_s)
    spot = axes[:, 3] + ACTIVITIES[swing.activity].reach_m * axes[:, 2]
    heading, rest = heading_of(home.yaw), home.position[2] + _pivot(thing)
    spot = spot + (0.5 * thing.model.length + 0.02) * heading
    spot[2] = rest if swing.is_teed else max(float(spot[2]), rest)
    start = with_middle(BodyState((0.0, 0.0, 0.0), home.yaw), vector(spot), lift_of(thing))
    speed = _speed(duration_s - contact_s)
    flight: Trajectory = FreeFlight(
        start, contact_s, vector(speed * heading + [0.0, 0.0, 0.45 * speed]), lift_of(thing),
        rest, 8.0,
    )  # fmt: skip
    if not swing.is_teed:
        far = spot + (1.0 + 1.6 * contact_s) * heading
        arc = Arc(vector(far), start, 0.0, contact_s, lift_of(thing), -1.0)
        flight = Switched(arc, flight, contact_s)
    if tool is not None:
        held = HeldAt(subject, "right hand", along_tool(tool, 0.0))
        tool = replace(tool, trajectory=held, lead_m=0.0, is_mover=True)
    return subject, replace(thing, trajectory=flight, is_mover=True, lead_m=0.0), tool


def _stand_and_catch(catcher: Actor, home: Vector, yaw: float, catch_s: float) -> Actor:
    """Who catches, facing the thing; an animal jumps for it."""
    if is_person(catcher):
        path: Trajectory = Performed(Stationary(home, yaw), "catch", contact_s=catch_s)
    else:
        path = _Leap(Hop(home, 0.4 * catcher.model.height, 0.0, 0.0, yaw), catch_s)
    return replace(catcher, trajectory=path, lead_m=0.0, is_mover=True, props=())


@dataclass(frozen=True)
class _Leap:
    """One jump whose highest point comes at an instant."""

    hop: Hop
    top_s: float

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        half = math.sqrt(2.0 * self.hop.height_m / 9.81)
        into = min(max(time_s - self.top_s + half, 0.0), 2.0 * half - 1e-9)
        return replace(self.hop.at(into), activity="stand", speed_m_s=0.0)


def _held_by_catcher(catcher: Actor, thing: Actor) -> HeldAt:
    if is_person(catcher):
        low = 0.0 if thing.is_centred else -0.5 * thing.model.height
        offset = np.column_stack([np.eye(3), np.array([0.4 * thing.model.length, 0.0, low])])
        return HeldAt(catcher, "hands", offset)
    low = 0.0 if thing.is_centred else -0.5 * thing.model.height
    offset = np.column_stack([np.eye(3), np.array([0.35 * thing.model.length, 0.0, low])])
    return HeldAt(catcher, "mouth", offset)


def _in_palm(thing: Actor) -> Float64Array:
    """A thing in the right hand: its middle beyond the palm."""
    low = 0.0 if thing.is_centred else -0.5 * thing.model.height
    reach = 0.5 * min(thing.model.length, thing.model.width) + 0.03
    return np.column_stack([np.eye(3), np.array([reach, 0.0, low])])


def _pivot(thing: Actor) -> float:
    """Height of its middle when it lies on the ground, m."""
    return 0.5 * thing.model.height


def lift_of(thing: Actor) -> float:
    """Height of its middle above its origin, m."""
    return 0.0 if thing.is_centred else 0.5 * thing.model.height


def _speed(rest_s: float) -> float:
    return min(max(FLIGHT_M / max(rest_s, 0.1), 1.5), 7.0)


def heading_of(yaw: float) -> Float64Array:
    """The unit vector on the ground towards `yaw` (rad)."""
    return np.array([math.cos(yaw), math.sin(yaw), 0.0])


def vector(values: Float64Array) -> Vector:
    """Three numbers of an array as a tuple of floats."""
    return (float(values[0]), float(values[1]), float(values[2]))
