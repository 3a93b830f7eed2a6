"""What hangs and is struck: reached by hand, foot or stick, it swings away from each blow."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from texvent.scenes.models.machine_acts import STRUCK, STRUCK_SWING_S
from texvent.scenes.models.people.work.bench import Bench, choose_distance
from texvent.scenes.models.people.work.patterns import BLOWS
from texvent.scenes.models.people.work.verbs import HANDWORK, HandWork
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.hand_work.surface_points import sample_surface
from texvent.scenes.staging.acts.holding import size_of
from texvent.scenes.staging.trajectories.trajectory import BodyState, ahead

PROFILE_RAD = -0.35
"""Heading of who strikes from the left: a little towards the viewer."""
_JAB = replace(HANDWORK["punch"], pattern="jab")
_TALL_M = 1.5
"""What is higher, for an adult, is punched at chest height."""


@dataclass(frozen=True)
class Swung:
    """Stays in its place; what hangs from it swings after a blow, or after each one."""

    rest: BodyState
    first_s: float
    """Instant of the first blow, s."""
    period_s: float | None = None
    """From one blow to the next, s; None = there is one."""

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        since = time_s - self.first_s
        if since < 0.0:
            return self.rest
        if self.period_s is not None:
            since = since % self.period_s * STRUCK_SWING_S / self.period_s
        return replace(self.rest, act_s=since)


def hangs(thing: Actor) -> bool:
    """Whether it hangs at rest and swings when it is struck."""
    return STRUCK in thing.noun.acts


def choose_blow(thing: Actor, work: HandWork, size: float) -> HandWork:
    """A bag at the height of the chest is punched, whatever the verb."""
    return _JAB if thing.model.height > _TALL_M * size else work


def stand_before(
    worker: Actor, thing: Actor, work: HandWork, reach_m: float
) -> tuple[Bench, BodyState, BodyState]:
    """Where the worker reaches the thing from the left, where the worker stands, and the thing."""
    size, state = size_of(worker.model), thing.trajectory.at(0.0)
    rest = replace(state, yaw=PROFILE_RAD, activity="stand")
    thing = replace(thing, trajectory=Swung(rest, math.inf))
    surface = sample_surface(thing, 0.0)
    x, y, _ = rest.position
    spot, is_upright = surface.find_spot(
        PROFILE_RAD, (x, y), size, is_front=thing.model.height > _TALL_M * size
    )
    start = (0.0, -0.05 * size, float(spot[2]))
    half = min(surface.half_at(spot, PROFILE_RAD), 0.15)
    bench = Bench(start, is_upright, 0.0, half, size, reach_m)
    bench = replace(bench, spot=(choose_distance(work, bench), *start[1:]))
    home = ahead((float(spot[0]), float(spot[1]), 0.0), PROFILE_RAD, -bench.spot[0], 0.0)
    home = ahead(home, PROFILE_RAD + 0.5 * math.pi, -bench.spot[1], 0.0)
    return bench, BodyState(home, PROFILE_RAD), rest


def swing_by_work(rest: BodyState, work: HandWork, tempo: float) -> Swung:
    """The thing, swinging after each blow of a work."""
    first_s, period_s = BLOWS[work.pattern]
    return Swung(rest, first_s / tempo, period_s / tempo)


def swing_by_kick(
    thing: Actor, tip: Float64Array, heading: Float64Array, contact_s: float
) -> Actor:
    """The thing before a foot, swinging after the kick."""
    yaw = math.atan2(float(heading[1]), float(heading[0]))
    z = thing.trajectory.at(0.0).position[2]
    rest = BodyState((float(tip[0]), float(tip[1]), z), yaw, activity="stand")
    points = sample_surface(replace(thing, trajectory=Swung(rest, math.inf)), 0.0).points
    near = points[np.abs(points[:, 2] - tip[2]) < 0.15]
    if len(near):
        nearest = float(((near - tip) @ heading).min())
        rest = replace(rest, position=ahead(rest.position, yaw, -nearest, z))
    return replace(thing, trajectory=Swung(rest, contact_s), is_mover=True, lead_m=0.0)
