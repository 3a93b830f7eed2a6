"""Ways along, onto and down what bears a body: a belt, a table, a fence, a ramp."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from texvent_scenes.models.activities import ON_GROUND, PERSON_NOUNS, TRAVELLING
from texvent_scenes.models.anchors import Support
from texvent_scenes.models.tables import nouns_with, trait_value
from texvent_scenes.staging.actors import size_of
from texvent_scenes.staging.placement.object_groups import ObjectGroup
from texvent_scenes.staging.tracks.keys import GRAVITY_M_S2, Key, flight_s
from texvent_scenes.staging.tracks.motion_plan import MotionPlan
from texvent_scenes.staging.tracks.phases import (
    PATH_KINDS,
    Phase,
    activity_of,
    paces_of_work,
    usual_speed,
)
from texvent_scenes.staging.tracks.track import Track, centred

_LEAST_HOP_M = 0.25
"""Height of a leap above what it leads onto, for small bodies, m."""
_MOST_RUN_UP_M_S = 4.0
"""Most usual speed of a run-up."""
_RUN_IN = 0.6
"""Distance that what jumps into something keeps from it more than what jumps onto it, in its own
lengths."""
_LEAST_GOING_S = 0.1
"""Time on a surface of which a body stops at the edge; on a shorter one nothing goes."""
_HOPS, _HOP_UP = 3, 0.45
"""Hops of what bounces down a slope; height of each above its beginning, by the way down."""
_ROLLING, _STEPS = 5.0 / 7.0, 8
"""Share of the acceleration down a slope of what rolls there, a full sphere; keys of such a way."""


def go_down(group: ObjectGroup, target: ObjectGroup) -> None:
    """Have what goes on a ramp go down it, at the speed that is said or let go from rest."""
    plan, (length, height, foot) = group.plan, trait_value("slope", target.noun.name)
    scale = size_of(target.models[0])
    length, height, foot = scale * length, scale * height, scale * foot
    way_m, said_m_s = math.hypot(length, height), plan.motion.speed_m_s
    if said_m_s is None and plan.motion.kind in TRAVELLING:
        said_m_s = plan.speed_m_s
        plan = replace(plan, motion=replace(plan.motion, speed_m_s=said_m_s))
    is_person = group.noun.name in PERSON_NOUNS
    is_seated = is_person and target.noun.name in nouns_with("slid down")
    if is_seated and plan.motion.speed_m_s == said_m_s and group.scene_object.motion is not None:
        said = group.scene_object.motion.speed_m_s
        plan, said_m_s = replace(plan, motion=replace(plan.motion, speed_m_s=said)), said
    keys = [Key(plan.duration_s, activity="stand")]
    treads = trait_value("treads", target.noun.name) if plan.motion.kind == "bounce" else None
    first = (0.5 / treads, 1.0 / (treads + 1)) if treads else (0.0, 0.0)  # the first step
    if plan.motion.kind == "bounce":
        keys = _list_hops(length, height * (1.0 - first[1]), said_m_s)
    elif said_m_s != 0.0:
        keys = _list_keys(plan, length / way_m, -height / way_m, way_m)
    if is_seated:  # it comes to rest where it lands
        keys = [replace(key, activity=ON_GROUND["sit"]) for key in keys]
        keys[-1] = replace(keys[-1], speed_m_s=0.0, ramp_s=min(0.4, keys[-1].duration_s))
    yaw = target.plan.yaw
    top = foot - length + first[0] * length
    start = (top * math.cos(yaw), top * math.sin(yaw), height * (1.0 - first[1]))
    path = Track(
        start, yaw, tuple(keys), floor_m=0.0, radius_m=plan.radius_m,
        is_upright=is_person,
    )  # fmt: skip
    group.plan = replace(plan, yaw=yaw, path=path)
    apart_m = 1.2 * max(one.width for one in group.models)
    count = len(group.models)
    if count > 1 and count * apart_m <= target.models[0].width:  # side by side
        sides = [(n - 0.5 * (count - 1)) * apart_m for n in range(count)]
        group.offsets = [(-one * math.sin(yaw), one * math.cos(yaw), 0.0) for one in sides]
    group.fit()


def _list_hops(length: float, height: float, said_m_s: float | None) -> list[Key]:
    """Keys of equal hops down a slope, each higher than it begins; then on over the ground."""
    far, drop = length / _HOPS, height / _HOPS
    up_m = max(_HOP_UP * drop, 0.02)
    flown_s = math.sqrt(2.0 * up_m / GRAVITY_M_S2) + math.sqrt(2.0 * (up_m + drop) / GRAVITY_M_S2)
    flown_s = far / said_m_s if said_m_s else flown_s
    hop_m = GRAVITY_M_S2 * flown_s**2 / 8.0
    hop = Key(flown_s, far / flown_s, 0.0, -drop / flown_s, 0.0, "move", hop_m)
    last_m = 0.5 * hop_m
    on_s = flight_s(last_m)
    after = Key(on_s, 0.4 * far / flown_s, ramp_s=0.0, hop_m=last_m)
    rest = Key(1.0, 0.0, ramp_s=0.5)
    return [Key(0.0, far / flown_s, 0.0, -drop / flown_s), *[hop] * _HOPS, after, rest]


def _list_keys(plan: MotionPlan, along: float, down: float, way_m: float) -> list[Key]:
    """Keys of a way down a slope and on over the ground; `along` and `down` are its direction."""
    said_m_s, activity = plan.motion.speed_m_s, activity_of(plan.motion.kind)
    rate = -GRAVITY_M_S2 * down * (_ROLLING if plan.motion.kind == "roll" else 1.0)
    spent_s = way_m / said_m_s if said_m_s else math.sqrt(2.0 * way_m / rate)
    step_s, first = spent_s / _STEPS, said_m_s or 0.0
    keys = [Key(0.0, along * first, 0.0, down * first)]
    for number in range(1, _STEPS + 1):
        speed = said_m_s or rate * step_s * number
        keys.append(Key(step_s, along * speed, 0.0, down * speed, step_s, activity))
    last = said_m_s or rate * spent_s
    keys.append(Key(max(plan.duration_s - spent_s, 0.1), last, ramp_s=0.02, activity=activity))
    return keys


def _approach(group: ObjectGroup, target: ObjectGroup) -> tuple[float, float]:
    """Heading over the shorter side of a target, away from the camera; metres to its middle."""
    body, yaw = target.models[0], target.plan.yaw
    yaw += 0.0 if body.length <= body.width else 0.5 * math.pi
    yaw += math.pi if math.sin(yaw) < 0.0 else 0.0
    return yaw, 0.5 * min(body.length, body.width) + 0.6 * group.models[0].length


def is_leap(group: ObjectGroup) -> bool:
    """Whether what is on or in something comes there by a jump, and stays."""
    return [one.kind for one in group.scene_object.motions] == ["jump", "stand"]


def leap_up(
    group: ObjectGroup, target: ObjectGroup, height: float, rim_m: float | None = None
) -> None:
    """Have what jumps onto something leap from the ground before it, and stay there.

    Args:
        group: who jumps.
        target: the thing.
        height: of the place where it lands above the foot of the thing, m.
        rim_m: height of the rim over which it goes into the thing, m; None: it has none.
    """
    (yaw, far), wait_s = _approach(group, target), 0.3 * group.plan.duration_s
    clear_m = max(0.4 * group.models[0].height, _LEAST_HOP_M)
    flown_s = 0.5 * (flight_s(height + clear_m) + flight_s(clear_m))  # up, and down to it
    hop_m = GRAVITY_M_S2 * flown_s**2 / 8.0
    if rim_m is not None:  # its front is above the rim when it gets there
        long_m = group.models[0].length
        far += _RUN_IN * long_m
        share = (_RUN_IN + 0.1) * long_m / far
        hop_m = max(hop_m, (rim_m - height * share) / (4.0 * share * (1.0 - share)))
        flown_s = flight_s(hop_m)
    leap = Key(flown_s, far / flown_s, 0.0, height / flown_s, 0.0, "jump", hop_m)
    rest_s = max(group.plan.duration_s - wait_s - flown_s, 0.1)
    keys = (Key(wait_s, ramp_s=0.0, activity="stand"), leap,
            Key(rest_s, ramp_s=0.0, activity="stand"))  # fmt: skip
    start = (-far * math.cos(yaw), -far * math.sin(yaw), -height)
    path = Track(start, yaw, keys, floor_m=-height)
    group.plan = replace(group.plan, yaw=yaw, path=path, gesture=None)


def leap_over(group: ObjectGroup, target: ObjectGroup) -> None:
    """Have what jumps over something run up, clear it at mid clip, and run on."""
    yaw, far = _approach(group, target)
    hop_m = target.top_m + max(0.2 * group.models[0].height, _LEAST_HOP_M)
    flown_s = min(flight_s(hop_m), 0.8 * group.plan.duration_s)
    kind = "run" if group.noun.motion == "walk" else group.noun.motion
    said = [one.kind for one in group.scene_object.motions if one.kind in PATH_KINDS]
    kind = said[0] if said else kind  # "skates and jumps over a bench"
    speed = max(2.0 * far / flown_s, min(usual_speed(group.noun, kind), _MOST_RUN_UP_M_S))
    run_s = 0.5 * (group.plan.duration_s - flown_s)
    run = Key(run_s, speed, ramp_s=0.0, activity=activity_of(kind))
    leap = replace(run, duration_s=flown_s, hop_m=hop_m, activity="jump")
    keys = (Key(0.0, speed), run, leap, run)
    back_m = 0.5 * speed * group.plan.duration_s
    path = Track((-back_m * math.cos(yaw), -back_m * math.sin(yaw), 0.0), yaw, keys, floor_m=0.0)
    group.plan = replace(group.plan, yaw=yaw, path=path, gesture=None)
    group.fit()


def carried_way(target: ObjectGroup) -> list[tuple[float, float]]:
    """Durations, s, of a belt in turn, and its speeds, m/s; empty for what does not run."""
    usual_m_s, duration_s = trait_value("belt speed", target.noun.name), target.plan.duration_s
    motions = target.scene_object.motions or (target.plan.motion,)
    if usual_m_s is None or not {one.kind for one in motions} <= {"work", "stand"}:
        return []
    whole_m_s = usual_m_s * size_of(target.models[0])
    paces = paces_of_work(motions, target.models[0], duration_s)
    steps = [(span_s, whole_m_s * pace) for one in paces for span_s, pace in _list_steps(*one)]
    return steps if any(speed for _, speed in steps) else []


def carry_along(group: ObjectGroup, target: ObjectGroup, support: Support) -> None:
    """Have things on a belt that runs go along with it, up to its end."""
    steps = carried_way(target)
    if not steps:
        return
    group.carrier, way = None, math.copysign(1.0, next(speed for _, speed in steps if speed))
    taken = group.models[0].length if group.row_m is None else group.row_m
    room = max(support.high[0] - support.low[0] - taken, 0.0)
    ends = group.ends_m if group.ends_m is None or way > 0.0 else tuple(-x for x in group.ends_m)
    keys = _list_carried([(span_s, way * speed) for span_s, speed in steps], room, ends)
    group.stops_s = _find_end(steps, keys)
    path = Track((0.0, 0.0, 0.0), target.plan.yaw + (math.pi if way < 0.0 else 0.0), keys)
    slide = replace(group.plan.motion, kind="slide")
    path = centred(path, target.plan.duration_s)
    group.plan = replace(group.plan, motion=slide, yaw=path.yaw, path=path, is_facing=False)


def _list_steps(phase: Phase, pace: float, end: float) -> list[tuple[float, float]]:
    """Durations and mean paces of a phase of work: one of a steady one."""
    count = 1 if pace == end else _STEPS
    middles = ((number + 0.5) / count for number in range(count))
    return [(phase.duration_s / count, pace + (end - pace) * one) for one in middles]


def _list_carried(
    steps: Sequence[tuple[float, float]], room_m: float, ends_m: Sequence[float] | None
) -> tuple[Key, ...]:
    """Keys of what lies on a belt, up to where the way that it takes is as long as there is room.

    `steps` are durations, s, and speeds, m/s; `ends_m` the ends of the way, where they are known.
    """
    keys = [Key(0.0, steps[0][1], activity="stand")]
    at = low = high = 0.0
    for span_s, speed in steps:
        least, most = (high - room_m, low + room_m) if ends_m is None else sorted(ends_m)
        left_m = most - at if speed > 0.0 else at - least
        going_s = min(span_s, max(left_m, 0.0) / abs(speed)) if speed else 0.0
        at += speed * going_s
        low, high = min(low, at), max(high, at)
        if going_s > 0.0:
            keys.append(Key(going_s, speed, ramp_s=0.0, activity="stand"))
        if going_s < span_s:
            keys.append(Key(span_s - going_s, ramp_s=0.0, activity="stand"))
    return tuple(keys)


def _find_end(steps: Sequence[tuple[float, float]], keys: Sequence[Key]) -> float | None:
    """Time from which on things rest on a belt that runs, up to its last move at least, s."""
    last_s = sum(span_s for span_s, _ in steps)
    runs_s = max(sum(span_s for span_s, _ in steps[: n + 1])
                 for n, (_, speed) in enumerate(steps) if speed)  # fmt: skip
    rests_s = last_s
    for key in reversed(keys):
        if key.speed_m_s or not key.duration_s:
            break
        rests_s -= key.duration_s
    return rests_s if runs_s - rests_s > _LEAST_GOING_S else None


def stop_at_edge(group: ObjectGroup, target: ObjectGroup, support: Support) -> None:
    """Have what goes along a table cross it once and stay there, where the clip is longer."""
    plan, own = group.plan, group.models[0]
    turn = plan.yaw - target.plan.yaw
    sides = (support.high[0] - support.low[0], support.high[1] - support.low[1])
    shares = abs(math.cos(turn)), abs(math.sin(turn))
    ways = [float(side) / max(share, 1e-6) for side, share in zip(sides, shares, strict=True)]
    going_s = (min(ways) - own.length) / max(plan.speed_m_s, 1e-6)
    if target.noun.name in nouns_with("way") or not _LEAST_GOING_S < going_s < plan.duration_s:
        return
    going = Key(going_s, plan.speed_m_s, activity=activity_of(plan.motion.kind))
    keys = (replace(going, duration_s=0.0), going,
            Key(plan.duration_s - going_s, ramp_s=0.05, activity="stand"))  # fmt: skip
    path = Track(
        (0.0, 0.0, 0.0), plan.yaw, keys, radius_m=plan.radius_m, is_facing=plan.is_facing
    )  # fmt: skip
    group.plan = replace(plan, path=centred(path, plan.duration_s))
