"""Who works on something: hands, or a tool, at its surface, as in "washes a car"."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from texvent.scenes.models.people.props import Prop, hand_tool, table
from texvent.scenes.models.people.work.bench import (
    TABLE_M,
    Bench,
    choose_distance,
    in_body,
    list_grips,
    stroke_at,
    usual_bench,
)
from texvent.scenes.models.people.work.tools import TOOLS
from texvent.scenes.models.people.work.verbs import HANDWORK, HandWork
from texvent.scenes.models.wrapped.opening import OPENS
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.hand_work.enlarged import Enlarged
from texvent.scenes.staging.acts.hand_work.hanging import (
    choose_blow,
    hangs,
    stand_before,
    swing_by_work,
)
from texvent.scenes.staging.acts.hand_work.surface_points import sample_surface
from texvent.scenes.staging.acts.holding import is_person, size_of
from texvent.scenes.staging.trajectories.trajectory import (
    BodyState,
    Stationary,
    Trajectory,
    Vector,
    ahead,
    rotation,
)

SMALL_M = 0.75
"""What is smaller comes onto a table, or into the hands."""
_WIDE_M = 1.25
"""What is wider in the picture is worked on at its front, or from behind a table."""
_TALL_M = 1.2
"""What is higher, for an adult, is worked on at its upright face."""
_TOWARDS_VIEWER = 0.35
"""Turn of who works in profile towards the camera, so that both hands are seen, rad."""
_TURN = 1.1
"""Turn of who works before a wide thing out of facing it, so that hands are seen, rad."""
_LEAST_SIZE_M, _MOST_LARGER = 0.34, 1.7
"""What is worked on at a table is enlarged to that size, by at most this factor."""
_WAIST_M = 0.60
"""What is below need not be in the picture where a person works on a small thing, m."""
_ROOM = 0.75
"""Share of its height that a worker takes along a wide thing."""
_LOW_M = 0.5
"""What is lower, for an adult, is knelt at; if it is no longer than a bed it is put on a table."""
_SMALL_ANIMAL_M = 1.5
_CLEAR_M = 0.20
"""From the middle of a body to what it stands or kneels before, m."""
_TOOL_M = 0.9
"""Longest thing that is worked with, m."""
_LONG = 1.25
"""What is that much longer than wide turns its front to who works on it."""
_BLOWS = frozenset({"strike", "punch"})
"""Patterns of blows."""
_BAR_M, _LONG_BAR_M = 0.4, 3.0
"""Greatest width and length of a plank or a pole that is worked on at a table, m."""
_EDGE_M = 0.26
"""From the near edge of a table to the middle of what is worked on."""


@dataclass(frozen=True)
class WorkingAt:
    """Stays in its place; hands, tool, torso and head follow a work."""

    home: Vector
    yaw: float
    work: HandWork
    bench: Bench
    tempo: float = 1.0

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        grips = list_grips(self.work, self.bench, self.tempo * time_s)
        return BodyState(self.home, self.yaw, activity=self.bench.stance, grips=grips)


@dataclass(frozen=True)
class Handled:
    """Moved by the hands that work on it."""

    rest: BodyState
    worker: WorkingAt

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        worker = self.worker
        stroke = stroke_at(worker.work, worker.bench, worker.tempo * time_s)
        shift = rotation(worker.yaw, 0.0, 0.0) @ np.array(in_body(worker.bench, stroke.thing))
        x, y, z = (a + float(b) for a, b in zip(self.rest.position, shift, strict=True))
        return replace(self.rest, position=(x, y, z))


def find_work(actor: Actor) -> HandWork | None:
    """The hand work that a person does in one place; None if it is none."""
    path = actor.trajectory
    if not isinstance(path, Stationary) or not is_person(actor):
        return None
    return HANDWORK.get(path.activity)


def work_at(
    subject: Actor, target: Actor, place: int = 0, crew: int = 1, tool: Actor | None = None,
    support: Actor | None = None,
) -> tuple[Actor, Actor]:  # fmt: skip
    """The worker at the thing, and the thing within reach of the hands.

    Args:
        subject: a person who stays and works; others are left where they are.
        target: a thing that stays.
        place: number of the worker, from 0, of those who work on the thing.
        crew: how many they are.
        tool: what the prompt says is used.
        support: what the thing is on.
    """
    work = find_work(subject)
    goes = target.is_mover and target.trajectory.at(0.0).activity not in OPENS
    if work is None or goes or not isinstance(target.trajectory, Stationary):
        return subject, target
    path = subject.trajectory
    tempo = path.tempo if isinstance(path, Stationary) else 1.0
    subject = replace(subject, props=_choose_props(work, tool), lead_m=0.0, is_mover=True)
    size = size_of(subject.model)
    if hangs(target) and work.pattern in _BLOWS:
        return _strike_hanging(subject, target, (work, tool, tempo))
    reach = _reach_of(work, tool)
    living = target.noun.motion in ("walk", "run", "jump", "swim", "paddle", "fly")
    lies_free = support is None and target.trajectory.home[2] < 0.4
    is_low = target.model.height < _LOW_M * size and target.size_m < 2.0 * SMALL_M * size
    is_small = target.size_m < SMALL_M * size and target.model.height < _LOW_M * size
    is_small |= (is_low or _is_bar(target)) and work.place == "table"
    if is_small and not living and lies_free and work.place != "there":
        return _at_own_table(subject, target, (work, reach, tempo), size)
    if support is not None:
        target = _to_edge(target, support)
    if support is None:
        target = _face_worker(target, is_living=living, is_front=work.side == "front")
    stand = _stand_at(subject, target, support, (work, reach, tempo), (place, crew))
    return stand


def _is_bar(target: Actor) -> bool:
    """Whether it is a plank or a pole, which two trestles or a table carry."""
    _, across, along = sorted((target.model.length, target.model.width, target.model.height))
    return across < _BAR_M and along < _LONG_BAR_M


def _strike_hanging(
    subject: Actor, target: Actor, how: tuple[HandWork, Actor | None, float]
) -> tuple[Actor, Actor]:
    """Blow after blow at what hangs, which swings."""
    work, tool, tempo = how
    if tool is None:
        work = choose_blow(target, work, size_of(subject.model))
    subject = replace(subject, props=_choose_props(work, tool))
    bench, stand, rest = stand_before(subject, target, work, _reach_of(work, tool))
    worker = WorkingAt(stand.position, stand.yaw, work, bench, tempo)
    target = replace(target, trajectory=swing_by_work(rest, work, tempo), is_mover=True)
    return replace(subject, trajectory=worker), target


def _choose_props(work: HandWork, tool: Actor | None) -> tuple[Prop, ...]:
    if tool is not None or work.tool not in TOOLS:
        return ()
    return (hand_tool(work.tool),)


def _reach_of(work: HandWork, tool: Actor | None) -> float:
    """From the palm to the tip of what is held, m."""
    if tool is None:
        return TOOLS[work.tool].reach_m if work.tool in TOOLS else 0.0
    model = tool.model
    return 0.86 * model.length if model.length > 2.0 * model.height else 0.5 * model.height


def _at_own_table(
    subject: Actor, target: Actor, how: tuple[HandWork, float, float], size: float
) -> tuple[Actor, Actor]:
    """A small thing on a table that is put there, or in the left hand; the worker in profile."""
    work, reach, tempo = how
    x, y, _ = target.trajectory.at(0.0).position
    lift = 0.5 * target.model.height if target.is_centred else 0.0
    larger = min(max(_LEAST_SIZE_M * size / target.size_m, 1.0), _MOST_LARGER)
    target = replace(target, model=Enlarged(target.model, larger))
    subject = replace(subject, waist_m=_WAIST_M * size)
    own = min(0.5 * target.model.width, 0.3)
    if work.place == "hands":
        bench = replace(usual_bench(work), size=size, reach_m=reach, half_m=own)
        bench = replace(bench, spot=(0.36 * size, 0.0, 1.10 * size))
        bottom = bench.spot[2] - 0.5 * target.model.height
    else:
        bottom = TABLE_M * size
        top = bottom + 0.85 * target.model.height
        bench = Bench((0.0, 0.0, top), half_m=own, size=size, reach_m=reach)
        bench = replace(bench, spot=(choose_distance(work, bench), 0.0, top))
        near = bench.spot[0] - _EDGE_M - 0.5 * min(target.model.length, 0.4)
        subject = replace(subject, props=(*subject.props, table(max(near, 0.22), bottom)))
    yaw = -_TOWARDS_VIEWER
    home = ahead((x, y, 0.0), yaw, -bench.spot[0], 0.0)
    worker = WorkingAt(home, yaw, work, bench, tempo)
    # The longer side of the thing lies across the worker.
    turned = yaw + (0.5 * math.pi if target.model.length > target.model.width else 0.0)
    doing = target.trajectory.at(0.0).activity
    rest = BodyState((x, y, bottom + lift), turned, activity=doing)
    return _put(subject, target, worker, rest)


def _put(subject: Actor, target: Actor, worker: WorkingAt, rest: BodyState) -> tuple[Actor, Actor]:
    """Both on their trajectories; what the hands move goes along."""
    strokes = [stroke_at(worker.work, worker.bench, 0.1 * k).thing for k in range(12)]
    path: Trajectory
    if any(any(one) for one in strokes):
        path = Handled(rest, worker)
        target = replace(target, is_mover=True)
    else:
        path = Stationary(rest.position, rest.yaw, rest.activity)
    return replace(subject, trajectory=worker), replace(target, trajectory=path)


def _to_edge(target: Actor, support: Actor) -> Actor:
    """What lies on something, nearer to its edge behind or to the left, where a person works."""
    surface = sample_surface(support, 0.0)
    low, high = surface.points.min(axis=0), surface.points.max(axis=0)
    path = target.trajectory
    if not isinstance(path, Stationary):
        return target
    x, y, z = path.home
    if high[0] - low[0] > _WIDE_M:
        y = max(y, float(high[1]) - _EDGE_M)
    else:
        x = min(x, float(low[0]) + _EDGE_M)
    return replace(target, trajectory=replace(path, home=(x, y, z)))


def _face_worker(target: Actor, *, is_living: bool, is_front: bool) -> Actor:
    """An animal or a car turns to who comes from the left, a door to the viewer."""
    path, model = target.trajectory, target.model
    if not isinstance(path, Stationary):
        return target
    if is_living or (model.length > _LONG * model.width and not is_front):
        return replace(target, trajectory=replace(path, yaw=math.pi + _profile(target)))
    if is_front or model.width > 2.0 * model.length:
        return replace(target, trajectory=replace(path, yaw=-0.5 * math.pi))
    return replace(target, trajectory=replace(path, yaw=-_TOWARDS_VIEWER))


def _profile(target: Actor) -> float:
    """Heading of who works at a thing from the left: before a large one, behind a small one."""
    return -_TOWARDS_VIEWER if target.size_m < _SMALL_ANIMAL_M else 0.2


def _stand_at(
    subject: Actor,
    target: Actor,
    support: Actor | None,
    how: tuple[HandWork, float, float],
    team: tuple[int, int],
) -> tuple[Actor, Actor]:
    """The worker at the left of a thing, behind a wide table, or before a wide wall."""
    work, reach, tempo = how
    place, crew = team
    surface = sample_surface(target, 0.0)
    whole = surface if support is None else surface.joined(sample_surface(support, 0.0))
    low, high = whole.points.min(axis=0), whole.points.max(axis=0)
    size = size_of(subject.model)
    is_wide = high[0] - low[0] > _WIDE_M
    is_flat = high[1] - low[1] < 0.45 * (high[0] - low[0])
    is_tall = high[2] > _TALL_M * size
    middle = surface.points.min(axis=0)[:2] * 0.5 + surface.points.max(axis=0)[:2] * 0.5
    along = (place - 0.5 * (crew - 1)) * _ROOM * size if is_wide else 0.0
    is_front = work.side == "front"
    if target.trajectory.at(0.0).activity in OPENS:
        # At the free edge, so that the leaf is seen.
        along = -0.5 * target.model.width
    elif is_front:
        along = (place - 0.5 * (crew - 1)) * _ROOM * size
    if is_front or (is_flat and is_tall):
        facing = 0.5 * math.pi
        yaw = facing - _TURN
    elif is_wide and not is_tall and (is_flat or support is not None):
        facing = -0.5 * math.pi
        yaw = facing + (0.15 if high[2] > _LOW_M * size else _TURN)
    else:
        turn = _profile(target)
        yaw = facing = turn if place % 2 == 0 else math.pi - turn
        along = 0.0
    spot, is_upright = surface.find_spot(
        facing, (float(middle[0]) + along, float(middle[1])), size, is_front=is_front
    )
    aside = 0.12 if yaw != facing else -0.05
    start = (0.0, aside * size, float(spot[2]))
    bench = Bench(start, is_upright, facing - yaw, surface.half_at(spot, facing), size, reach)
    least = whole.nearest(facing, spot, size) + _CLEAR_M * size
    distance = choose_distance(work, bench)
    if yaw == facing:
        distance = max(distance, least)
    bench = replace(bench, spot=(distance, start[1], start[2]))
    heading = np.array([math.cos(yaw), math.sin(yaw)])
    left = np.array([-heading[1], heading[0]])
    ground = spot[:2] - bench.spot[0] * heading - bench.spot[1] * left
    home = (float(ground[0]), float(ground[1]), 0.0)
    rest = target.trajectory.at(0.0)
    return _put(subject, target, WorkingAt(home, yaw, work, bench, tempo), rest)


def before_mouth(animal: Actor, thing: Actor) -> Actor:
    """What an animal eats, drinks from or sniffs at, where its mouth is."""
    path = thing.trajectory
    if not isinstance(path, Stationary):
        return thing
    times = np.linspace(0.0, 1.0, 9)
    mouths = [animal.anchor("mouth", float(t))[:, 3] for t in times]
    x, y, _ = min(mouths, key=lambda spot: float(spot[2]))
    ahead_m = 0.25 * thing.model.length
    yaw = animal.trajectory.at(0.0).yaw
    home = ahead((float(x), float(y), 0.0), yaw, ahead_m, path.home[2])
    return replace(thing, trajectory=replace(path, home=home))


def shortened(tool: Actor) -> Actor:
    """A branch or a pole, as long as can be worked with."""
    share = min(_TOOL_M / max(tool.model.length, tool.model.height), 1.0)
    return replace(tool, model=Enlarged(tool.model, share)) if share < 1.0 else tool


def moved_with(content: Actor, before: Actor, after: Actor) -> Actor:
    """What is in a thing that has been moved."""
    path = content.trajectory
    if not isinstance(path, Stationary):
        return content
    ways = zip(before.trajectory.at(0.0).position, after.trajectory.at(0.0).position, strict=True)
    x, y, z = (a + now - then for a, (then, now) in zip(path.home, ways, strict=True))
    return replace(content, trajectory=replace(path, home=(x, y, z)))


def tool_tip(worker: Actor, time_s: float) -> Float64Array:
    """[2, 3] palm, and tip of what is held, in the world, m."""
    path = worker.trajectory
    axes = worker.anchor("right hand", time_s)
    reach = path.bench.reach_m if isinstance(path, WorkingAt) else 0.0
    return np.array([axes[:, 3], axes[:, 3] + reach * axes[:, 2]])
