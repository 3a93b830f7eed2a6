"""Ways that lead to, into, out of, off, up or down a placed object.

Each gives the group a path of keys with respect to the object, which stays where it is. So the
relation holds by geometry: the way ends before the object, inside it, on the ground, or higher.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from texvent_scenes.models.activities import ON_GROUND, PERSON_NOUNS
from texvent_scenes.models.anchors import find_rim, find_support
from texvent_scenes.models.materials import Material
from texvent_scenes.models.protocol import Model, ModelPart, Pose
from texvent_scenes.models.shapes import (
    compose,
    moved,
    part,
    placed_upright,
    shift,
    turn_about,
)
from texvent_scenes.models.tables import nouns_with, trait_value
from texvent_scenes.rendered_scene import Float64Array, Shape
from texvent_scenes.staging.actors import size_of
from texvent_scenes.staging.placement.along_surface import go_down
from texvent_scenes.staging.placement.object_groups import ObjectGroup
from texvent_scenes.staging.placement.rims import fits, go_through
from texvent_scenes.staging.placement.rows import line_up
from texvent_scenes.staging.tracks.flight_keys import DULL, QUARTER
from texvent_scenes.staging.tracks.keys import GRAVITY_M_S2, Key, flight_s
from texvent_scenes.staging.tracks.phases import GOING, YAWS, activity_of, speeds_of, usual_speed
from texvent_scenes.staging.tracks.track import Track, centred

_GOING_SHARE, _BRAKING_M_S2 = 0.85, 6.0
"""Share of the clip after which who arrives somewhere is there; how fast it brakes."""
_INSIDE_M = 0.3
"""From the opening to the rear of who has gone in."""
_ASLANT, _INTO_PICTURE = 0.45, 0.7
"""Angles to the picture of the side from which one climbs and of the way through a passage, rad."""
_ARM_M, _LEAST_M = 0.2, 0.3
"""From what a person climbs to the person; least height climbed, m."""
_CLIMB_M_S = 4.0 / GRAVITY_M_S2
"""Usual speed of climbing: of 4 W per kg, which a person keeps up for some minutes (D. R. Wilkie
1960, Ergonomics 3), all lifts the body."""
_STEP_OFF_M_S, _HOP_M = 0.8, 0.15
"""Speed over an edge; height of a leap off it, m."""
_DARK, _LEAF = Material((0.01, 0.01, 0.012)), Material((0.3, 0.15, 0.06))


def has_fault(group: ObjectGroup, kind: str, target: ObjectGroup) -> bool:
    """Whether there is no such way: the target goes off or has none, or more is said of the way."""
    later = {one.kind for one in group.scene_object.motions[1:]} & (GOING | {"jump", "fall"})
    noun, is_led = target.noun.name, target.plan.is_path or target.plan.path is not None
    rim = find_rim(noun, target.models[0]) if kind == "into" else None
    is_open = rim is not None and fits(group.models[0], rim)
    is_closed = kind in ("into", "out of") and find_opening(noun, target.models[0]) is None
    is_closed &= not is_open
    rows = (trait_value("slope", noun), trait_value("climbed", noun))
    is_flat = kind in ("up", "down") and rows == (None, None)
    is_bound = is_led or is_closed or is_flat
    return bool(later) or is_bound or group.plan.motion.kind in ("orbit", "spin")


def lead(group: ObjectGroup, kind: str, target: ObjectGroup, ahead_m: float) -> Float64Array:
    """[3] the middle of a group that goes a way of `WAYS`; its plan has the path then.

    `ahead_m` is the length of what it pushes, m.
    """
    opening = find_opening(target.noun.name, target.models[0])
    rim = find_rim(target.noun.name, target.models[0])
    if kind == "into" and opening is None and rim is not None:
        return go_through(group, target, rim)
    if kind in ("into", "out of") and opening is not None:
        return _pass_opening(group, target, opening, is_in=kind == "into")
    if kind == "to":
        return _arrive(group, target, ahead_m)
    if kind == "off":
        return _leave_top(group, target)
    if trait_value("slope", target.noun.name) is not None:
        plan, noun = group.plan, group.noun
        if plan.motion.kind == "climb":  # the stairs: on foot
            walk = replace(plan.motion, kind=noun.motion)
            group.plan = replace(plan, motion=walk, speed_m_s=usual_speed(noun, noun.motion))
        if kind == "up":
            return _go_up(group, target)
        go_down(group, target)
        return target.to_world(0.0, 0.0, group.origin_m)
    return _climb(group, target, is_up=kind == "up")


def _deep_m(group: ObjectGroup) -> float:
    """Extent of a body along its way, m: people's arms do not count."""
    model = group.models[0]
    return 0.3 * model.height if group.noun.name in PERSON_NOUNS else model.length


def _reach_m(target: ObjectGroup, yaw: float) -> float:
    """From the middle of a target to its edge along a heading, m."""
    body, turn = target.models[0], yaw - target.plan.yaw
    cosine, sine = max(abs(math.cos(turn)), 1e-6), max(abs(math.sin(turn)), 1e-6)
    return 0.5 * min(body.length / cosine, body.width / sine)


def _put(
    group: ObjectGroup, target: ObjectGroup, yaw: float, along_m: float, height_m: float,
    keys: Sequence[Key], aside_m: float = 0.0, *, edge_m: float = 0.0,
) -> Float64Array:  # fmt: skip
    """The middle of a way that begins `along_m` of a heading from the middle of the target."""
    if group.plan.motion.kind == "reverse":  # its rear first
        yaw, along_m, aside_m = yaw + math.pi, -along_m, -aside_m
        keys = [replace(key, speed_m_s=-key.speed_m_s) for key in keys]
    cosine, sine = math.cos(yaw), math.sin(yaw)
    start = (along_m * cosine - aside_m * sine, along_m * sine + aside_m * cosine, height_m)
    path = Track(
        start, yaw, tuple(keys), usual_speed_m_s=group.plan.speed_m_s, floor_m=0.0,
        is_upright=group.noun.name in PERSON_NOUNS, edge_m=edge_m,
    )  # fmt: skip
    placed = centred(path, group.plan.duration_s)
    group.plan = replace(group.plan, yaw=yaw, path=placed, gesture=None)
    group.fit()
    shift = np.subtract(start, placed.start)
    return np.asarray(np.array([*target.centre[:2], 0.0]) + shift + [0.0, 0.0, group.origin_m])


def _line_up(group: ObjectGroup, yaw: float, behind_m: float, above_m: float) -> None:
    """Put each copy so far behind the one before it, or above it: an opening is for one."""
    x, y = -behind_m * math.cos(yaw), -behind_m * math.sin(yaw)
    group.offsets = [(n * x, n * y, n * above_m) for n in range(len(group.models))]


def _rest_keys(group: ObjectGroup, span_s: float, ramp_s: float) -> list[Key]:
    """Rest at the end of a way, and what is done there."""
    said = [one.kind for one in group.scene_object.motions[1:]] or ["stand"]
    kinds = [ON_GROUND.get(one, one) for one in said]
    return [Key(span_s / len(kinds), ramp_s=ramp_s, activity=kind) for kind in kinds]


def _speed(group: ObjectGroup) -> float:
    """Speed on the way, m/s: what drives comes to its end as slowly as it turns."""
    plan = group.plan
    is_driven = plan.motion.kind == "drive" and plan.motion.speed_m_s is None
    return min(plan.speed_m_s, usual_speed(group.noun, "turn")) if is_driven else plan.speed_m_s


def _go_and_stop(group: ObjectGroup) -> tuple[list[Key], float]:
    """Keys of a way on the level that ends at rest, and its length, m."""
    plan, activity, speed_m_s = group.plan, activity_of(group.plan.motion.kind), _speed(group)
    going_s = _GOING_SHARE * plan.duration_s
    ramp_s = min(max(0.25, speed_m_s / _BRAKING_M_S2), 0.6 * going_s)
    first = Key(0.0, speed_m_s, activity=activity)
    keys = [first, replace(first, duration_s=going_s - ramp_s),
            Key(ramp_s, 0.0, ramp_s=ramp_s, activity=activity)]  # fmt: skip
    rest = _rest_keys(group, plan.duration_s - going_s, 0.01)
    return [*keys, *rest], speed_m_s * (going_s - 0.5 * ramp_s)


def _arrive(group: ObjectGroup, target: ObjectGroup, ahead_m: float) -> Float64Array:
    """Straight to what is before it then: to its front, or to the side where it comes from."""
    own_m, plan = _deep_m(group), group.plan
    opening = find_opening(target.noun.name, target.models[0])
    yaw = YAWS.get(plan.motion.direction or "", plan.yaw)
    if opening is not None and target.noun.habitat == "fixed":
        yaw = target.plan.yaw + opening.turn
    elif abs(math.cos(yaw)) < 0.5 and plan.motion.direction is None:
        yaw = 0.0
    keys, way_m = _go_and_stop(group)
    gap = min(0.1 + 0.15 * own_m, 1.5) + ahead_m
    before_m = _reach_m(target, yaw) + 0.5 * own_m + gap
    return _put(group, target, yaw, -before_m - way_m, 0.0, keys)


def _pass_opening(
    group: ObjectGroup, target: ObjectGroup, opening: Opening, *, is_in: bool
) -> Float64Array:
    """Straight through an opening, up to where its rear is inside; or from there."""
    own, plan = group.models[0], group.plan
    (x, y, turn, *_), is_passage = opening, target.noun.name in nouns_with("passage")
    if is_passage and target.scene_object.heading_deg is None:
        yaw = _INTO_PICTURE if math.cos(plan.yaw) > 0.0 else math.pi - _INTO_PICTURE
        target.plan = replace(target.plan, yaw=yaw - turn)
        target.fit()
    elif math.sin(target.plan.yaw + turn) < 0.0:  # the side that the camera sees
        y, turn = -y, -turn
    if target.noun.name in nouns_with("closed"):
        seen = opening._replace(y=y, turn=turn)
        target.models = [OpenedModel(one, seen) for one in target.models]
    heading = target.plan.yaw + turn
    along = x * math.cos(turn) + y * math.sin(turn)
    aside = y * math.cos(turn) - x * math.sin(turn)
    step_m = _deep_m(group) + _INSIDE_M
    inside = 0.5 * _deep_m(group) + _INSIDE_M + step_m * (len(group.models) - 1) * is_in
    _line_up(group, heading + (0.0 if is_in else math.pi), step_m, 0.0)
    speed, activity = plan.speed_m_s, activity_of(plan.motion.kind)
    keys, way_m = _go_and_stop(group)
    if is_passage:
        way_m = speed * plan.duration_s
        keys = [Key(0.0, speed), Key(plan.duration_s, speed, activity=activity)]
    if is_in:
        if opening.is_low(own) and group.noun.name in PERSON_NOUNS:
            keys = [*keys[:2], *(replace(key, activity="crouch") for key in keys[2:])]
        return _put(group, target, heading, along + inside - way_m, 0.0, keys, aside)
    wait_s = 0.12 * plan.duration_s
    keys = [Key(wait_s, activity=activity), Key(plan.duration_s - wait_s, speed, activity=activity)]
    return _put(group, target, heading + math.pi, -along - inside, 0.0, keys, -aside)


def _leave_top(group: ObjectGroup, target: ObjectGroup) -> Float64Array:
    """From on top over the nearer edge to the ground: leaping, rising, or falling on its side."""
    own, plan, body = group.models[0], group.plan, target.models[0]
    support, duration_s = find_support(body), group.plan.duration_s
    if len(group.models) > 1 and plan.motion.kind != "fall":
        line_up(group, target, support, [group.index] * len(group.models))
        group.fit()
    if plan.motion.kind == "rise":
        return target.to_world(*support.middle, support.height + group.origin_m)
    is_falling = plan.motion.kind == "fall"
    is_along = abs(math.cos(target.plan.yaw)) > 0.7 if is_falling else body.length <= body.width
    yaw = target.plan.yaw + (0.0 if is_along else QUARTER)
    yaw += math.pi if math.cos(yaw) < 0.0 else 0.0
    half = 0.5 * (body.length if is_along else body.width)
    wait_s, height = 0.2 * duration_s, support.height
    if is_falling:
        on_m = max(half - 0.6 * own.length, 0.0)
        going_s = (half - on_m + 0.1 * own.length) / _STEP_OFF_M_S
        flight = Key(duration_s, _STEP_OFF_M_S, restitution=DULL, activity="stand",
                     pitch_rad=QUARTER, ramp_s=0.5)  # fmt: skip
        slide = Key(going_s, _STEP_OFF_M_S, ramp_s=0.05, activity="stand")
        keys = [Key(wait_s, activity="stand"), slide, replace(flight, duration_s=0.7),
                replace(flight, speed_m_s=0.0, ramp_s=0.2)]  # fmt: skip
        return _put(group, target, yaw, on_m, height, keys, edge_m=0.5 * own.length)
    far = half + 0.8 * own.length + 0.2
    flown_s = 0.5 * (flight_s(_HOP_M) + flight_s(_HOP_M + height))
    hop_m = 9.81 * flown_s**2 / 8.0
    leap = Key(flown_s, far / flown_s, 0.0, -height / flown_s, 0.0, "jump", hop_m)
    keys = [Key(wait_s, ramp_s=0.0, activity="stand"), leap,
            *_rest_keys(group, max(duration_s - wait_s - flown_s, 0.1), 0.0)]  # fmt: skip
    return _put(group, target, yaw, 0.0, height, keys)


def _go_up(group: ObjectGroup, target: ObjectGroup) -> Float64Array:
    """Up a slope, on whose middle it is at mid clip; it stops at the top."""
    plan, scale = group.plan, size_of(target.models[0])
    length, height, foot = (scale * one for one in trait_value("slope", target.noun.name))
    if target.scene_object.heading_deg is None and abs(math.sin(target.plan.yaw)) > 0.5:
        target.plan = replace(target.plan, yaw=_ASLANT)
        target.fit()
    way_m, speed, duration_s = math.hypot(length, height), plan.speed_m_s, plan.duration_s
    going_m = speed * duration_s
    before_m, on_m = max(0.6 * (going_m - way_m), 0.0), min(way_m, going_m)
    first_m = 0.5 * (way_m - on_m)
    along, up = length / way_m, height / way_m
    go = Key(on_m / speed, along * speed, 0.0, up * speed, 0.0, activity_of(plan.motion.kind))
    level = replace(go, duration_s=before_m / speed, speed_m_s=speed, climb_m_s=0.0)
    begin = replace(level if before_m else go, duration_s=0.0)
    rest_s = max(duration_s - (before_m + on_m) / speed, 0.01)
    keys = [begin, *([level] if before_m else []), go, *_rest_keys(group, rest_s, 0.01)]
    start = first_m * along - before_m - foot
    return _put(group, target, target.plan.yaw + math.pi, start, first_m * up, keys)


def _climb(group: ObjectGroup, target: ObjectGroup, *, is_up: bool) -> Float64Array:
    """Up or down what is steep, facing it; the climber is seen from the side."""
    plan, own, scale = group.plan, group.models[0], size_of(target.models[0])
    out, lean = trait_value("climbed", target.noun.name)
    is_person = group.noun.name in PERSON_NOUNS
    if target.scene_object.heading_deg is None:
        side = -_ASLANT if math.cos(plan.yaw) < 0.0 else math.pi + _ASLANT
        target.plan = replace(target.plan, yaw=side)
        target.fit()
    speed = plan.motion.speed_m_s
    if speed is None:
        speed = plan.motion.pace * speeds_of(group.noun).get("climb", _CLIMB_M_S)
    low = 0.0 if is_person else 0.5 * own.length
    below_m = 0.75 * own.height if is_person else own.length
    top = max(target.models[0].height - below_m, low + _LEAST_M)
    risen = min(speed * plan.duration_s, top - low)
    pitch = 0.0 if is_person else -QUARTER
    sign = 1.0 if is_up else -1.0
    span_s = risen / speed if speed > 0.0 else plan.duration_s
    key = Key(span_s, sign * lean * speed, 0.0, sign * speed, 0.0, "climb", pitch_rad=pitch)
    rest = Key(max(plan.duration_s - key.duration_s, 0.01), ramp_s=0.0, activity="stand",
               pitch_rad=pitch)  # fmt: skip
    away = scale * out + (_ARM_M * size_of(own) if is_person else 0.0)
    begin = low if is_up else low + risen
    keys = [replace(key, duration_s=0.0), key, rest]
    yaw, tall = target.plan.yaw + math.pi, own.height if is_person else own.length
    _line_up(group, yaw, -lean * tall, tall)
    return _put(group, target, yaw, lean * (begin - low) - away, begin, keys)


class Opening(NamedTuple):
    """An opening of a model, body coordinates, m."""

    x: float
    y: float
    turn: float
    """Heading of who goes in, rad."""
    width: float
    height: float

    def is_low(self, model: Model) -> bool:
        """Whether a body must bend to go through."""
        return self.height < model.height


def find_opening(noun: str, model: Model) -> Opening | None:
    """The opening of a noun; a closed vehicle has a door at its side."""
    row, scale = trait_value("opening", noun), size_of(model)
    if row is not None:
        x, y, turn, width, height = row
        return Opening(scale * x, scale * y, math.radians(turn), scale * width, scale * height)
    if noun not in nouns_with("closed"):
        return None
    high = min(0.93 * model.height, 2.1 * scale)
    return Opening(0.04 * model.length, 0.505 * model.width, -QUARTER, 0.9 * scale, high)


class OpenedModel:
    """A model with a door that stands open: dark inside, its leaf turned out."""

    def __init__(self, model: Model, opening: Opening) -> None:
        self._model, self._opening = model, opening
        self.length, self.width, self.height = model.length, model.width, model.height

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):  # not yet set, as in a copy that is being made
            raise AttributeError(name)
        return getattr(self._model, name)

    def parts(self, pose: Pose) -> Sequence[ModelPart]:
        """Its parts, and those of the opening."""
        x, y, turn, width, height = self._opening
        at = compose(shift(x, y), turn_about("z", turn + math.pi))
        middle, low = 0.5 * height, 0.1 * height
        dark = placed_upright((0.02, 0.0, middle), (0.06, width, height - low))
        leaf = placed_upright((0.5 * width, 0.5 * width, middle), (width, 0.05, height - low))
        parts = self._model.parts(pose)
        paint = replace(_LEAF, colour=_LEAF.colour if turn == math.pi else parts[0].colour)
        own = [part(Shape.BOX, _DARK, dark), part(Shape.BOX, paint, leaf)]
        return [*parts, *moved(own, at)]
