"""Where things stand: relations become positions, and no two things share a place."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from texvent.generate.procedural.description import Relation, SceneDescription, Thing
from texvent.generate.procedural.model import Model, Noun, Part
from texvent.generate.procedural.models.table import AFLOAT
from texvent.generate.procedural.primitives import Float64Array, Shape
from texvent.generate.procedural.staging.actors import Actor, seeded
from texvent.generate.procedural.staging.motion import Circle, Riding, Swing, Trajectory, Vector
from texvent.generate.procedural.staging.trajectories import (
    PEOPLE,
    Course,
    choose_trajectory,
    decide_course,
)

GAP_M = 0.25
"""Least space between two things, in units of the smaller one's size."""
MAX_ACTORS = 60
"""Most bodies on the stage; later copies are left out."""
ON_TARGET = frozenset({"on", "above", "around", "under", "between", "follow"})
"""Relations in which the subject's place follows from the target's; in the others the target's
follows from the subject's."""
SCENIC = frozenset({"surround", "among"})
"""Relations whose targets stand around as scenery; `scenery` places them."""


@dataclass
class Group:
    """All copies of one thing, and the room they take."""

    index: int
    thing: Thing
    noun: Noun
    models: list[Model]
    course: Course
    slots: list[Vector]
    """Places of the copies relative to the group's middle, m."""
    half: Float64Array
    """[3] half extents of the room taken over the whole clip, m."""
    centre: Float64Array = field(default_factory=lambda: np.zeros(3))
    carrier: Group | None = None
    orbits: Group | None = None

    @property
    def size_m(self) -> float:
        """Largest extent of one copy."""
        model = self.models[0]
        return max(model.length, model.width, model.height)


class Stage:
    """Places groups one after the other, each where the prompt wants it or close to it."""

    def __init__(
        self,
        description: SceneDescription,
        nouns: Mapping[str, Noun],
        *,
        seed: int,
        duration_s: float,
        level_m: Mapping[str, float],
    ) -> None:
        self._description = description
        self._nouns = nouns
        self._seed = seed
        self._duration_s = duration_s
        self._level_m = level_m
        """Height of the origin of what lives in the air and in the water, in own sizes."""
        self.groups: dict[int, Group] = {}

    def place_all(self) -> list[Actor]:
        """Every copy of every thing that is no scenery, with its trajectory."""
        scenic = {
            target
            for relation in self._description.relations
            if relation.kind in SCENIC
            for target in relation.targets
        }
        order = [i for i in range(len(self._description.things)) if i not in scenic]
        for index in order:
            self._place(index, frozenset())
        actors: list[Actor] = []
        for index in order:
            actors.extend(self._populate(self.groups[index], len(actors)))
        return actors[:MAX_ACTORS]

    def build_group(self, index: int) -> Group:
        """A thing's copies in formation about (0, 0)."""
        thing = self._description.things[index]
        noun = self._nouns[thing.noun]
        rng = seeded(self._seed, "thing", index, thing.noun)
        colour = thing.paint.rgb if thing.paint is not None else None
        models = [
            noun.build(colour=colour, scale=thing.scale, seed=int(rng.integers(2**31)))
            for _ in range(thing.count)
        ]
        motion = thing.motion
        if motion is None:
            raise ValueError(f"the motion of {thing.noun} is not decided")
        course = decide_course(motion, noun, models[0], self._duration_s, rng)
        slots = _arrange(models, course, noun, rng)
        return Group(index, thing, noun, models, course, slots, _room(models, slots, course))

    def _place(self, index: int, waiting: frozenset[int]) -> None:
        """Place a thing, after the things its place depends on."""
        if index in self.groups or index in waiting:
            return
        group = self.build_group(index)
        related = [r for r in self._description.relations if r.subject == index]
        for relation in related:
            if relation.kind in ON_TARGET:
                for target in relation.targets:
                    self._place(target, waiting | {index})
        wanted, slide = self._wish(group, related)
        self._align(group, related)
        group.centre = self._find_room(group, wanted, slide)
        self.groups[index] = group

    def _align(self, group: Group, related: list[Relation]) -> None:
        """Let a follower, a companion and a passer-by go the same way as the other."""
        for relation in self._description.relations:
            partner = None
            if relation.subject == group.index and relation.kind == "follow":
                partner = self.groups.get(relation.targets[0])
            elif group.index in relation.targets and relation.kind == "with":
                partner = self.groups.get(relation.subject)
            if partner is not None and partner.course.is_path and group.course.is_path:
                course = partner.course
                group.course = Course(
                    group.course.motion, course.yaw, course.speed_m_s, course.duration_s
                )
                group.half = _room(group.models, group.slots, group.course)

    def _wish(self, group: Group, related: list[Relation]) -> tuple[Float64Array, Float64Array]:
        """Where the prompt wants a group, and which way it may be moved from there."""
        height = self._height(group)
        for relation in related:
            targets = [self.groups[t] for t in relation.targets if t in self.groups]
            if relation.kind in ON_TARGET and targets:
                return _place_on_targets(group, relation.kind, targets, height)
        for relation in self._description.relations:
            if group.index in relation.targets and relation.subject in self.groups:
                subject = self.groups[relation.subject]
                return _place_by_subject(group, relation.kind, subject, height)
        offset = {"left": -2.0, "right": 2.0}.get(group.thing.side or "", 0.0) * group.size_m
        offset += self._spread_apart(group) + self._stagger(group)
        depth = {"far": 2.2 * group.size_m + 6.0, "near": -1.2 * group.size_m}
        wanted = np.array([offset, depth.get(group.thing.side or "", 0.0), height])
        if group.course.is_path or group.noun.habitat in ("air", "water"):
            # Smaller things go nearer to the camera, so that none hides behind a larger one.
            larger = any(other.size_m > group.size_m for other in self.groups.values())
            return wanted, np.array([0.0, -1.0 if larger else 1.0, 0.0])
        return wanted, np.array([1.0, 0.35, 0.0])

    def _spread_apart(self, group: Group) -> float:
        """Metres to the side that leave room for what is to stand between this and another."""
        for relation in self._description.relations:
            if relation.kind == "between" and len(relation.targets) > 1:
                if group.index not in relation.targets:
                    continue
                middle = self.build_group(relation.subject)
                side = -1.0 if relation.targets.index(group.index) == 0 else 1.0
                return float(side * (group.half[0] + middle.half[0] + 0.4))
        return 0.0

    def _stagger(self, group: Group) -> float:
        """Metres along the path between things that go side by side, so that both are seen."""
        others = [other for other in self.groups.values() if other.course.is_path]
        if not others or not group.course.is_path or abs(math.cos(group.course.yaw)) < 0.5:
            return 0.0
        side = -1.0 if len(others) % 2 else 1.0
        return side * 0.35 * (others[0].models[0].length + group.models[0].length)

    def _height(self, group: Group) -> float:
        """Height of the group's origin, m."""
        kind = group.course.motion.kind
        if group.noun.name in self._level_m:
            return self._level_m[group.noun.name] * group.models[0].height
        level = self._level_m.get(group.noun.habitat, 0.0)
        if level == 0.0 and kind == "fly":
            level = self._level_m.get("air", 0.0)
        if level == 0.0 and kind == "swing":
            return max(0.5 * group.size_m, 0.6)
        if level == 0.0 and kind == "orbit":
            return 0.0
        return level * max(group.size_m, 1.0)

    def _find_room(self, group: Group, wanted: Float64Array, slide: Float64Array) -> Float64Array:
        """The wanted place, or the nearest free one along `slide`, alternating sides."""
        if not slide.any():
            return wanted
        step = 0.25 * float(np.max(group.half[:2])) + 0.1
        for attempt in range(400):
            reach = step * ((attempt + 1) // 2) * (1.0 if attempt % 2 else -1.0)
            if slide[0] == 0.0:
                reach = step * attempt
            centre = wanted + reach * slide
            if not any(_overlaps(centre, group, other) for other in self.groups.values()):
                return centre
        return wanted + 400 * step * np.abs(slide)

    def _populate(self, group: Group, before: int) -> list[Actor]:
        """The copies of a group on their trajectories."""
        rng = seeded(self._seed, "lead", group.index, group.noun.name)
        actors = []
        for number, (model, slot) in enumerate(zip(group.models, group.slots, strict=True)):
            home = group.centre + np.array(slot)
            trajectory = self._choose(group, model, (home[0], home[1], home[2]), number, rng)
            actors.append(
                Actor(
                    group.index, group.noun, model, trajectory, group.course.motion.is_moving,
                    before + number + 1, float(rng.uniform(0.0, 1.0)) if number else 0.0,
                    _hang(trajectory, model),
                )
            )  # fmt: skip
        return actors

    def _choose(
        self, group: Group, model: Model, home: Vector, number: int, rng: np.random.Generator
    ) -> Trajectory:
        if group.orbits is not None:
            return _orbit(group, group.orbits, number, self._duration_s)
        if group.carrier is not None:
            carrier = self._choose(group.carrier, group.carrier.models[0], _tuple(group.carrier), 0,
                                   seeded(self._seed, "lead", group.carrier.index,
                                          group.carrier.noun.name))  # fmt: skip
            offset = np.array(home) - group.carrier.centre
            turned = _unturn(offset, group.carrier.course.yaw)
            return Riding(carrier, turned, activity="sit")
        return choose_trajectory(group.course, model, home, rng)


def _hang(trajectory: Trajectory, model: Model) -> tuple[Part, ...]:
    """The rope of what swings, m in body coordinates."""
    if not isinstance(trajectory, Swing):
        return ()
    low, high = 0.9 * model.height, trajectory.length_m
    to_body = np.array(
        [
            [0.012 + 0.004 * model.height, 0.0, 0.0, 0.0],
            [0.0, 0.012 + 0.004 * model.height, 0.0, 0.0],
            [0.0, 0.0, 0.5 * (high - low), 0.5 * (high + low)],
        ]
    )
    return (Part(Shape.CYLINDER, to_body, (0.25, 0.2, 0.14)),)


def _tuple(group: Group) -> Vector:
    x, y, z = group.centre
    return (float(x), float(y), float(z))


def _unturn(offset: Float64Array, yaw: float) -> Vector:
    cosine, sine = math.cos(yaw), math.sin(yaw)
    x, y, z = offset
    return (float(x * cosine + y * sine), float(y * cosine - x * sine), float(z))


def _orbit(group: Group, around: Group, number: int, duration_s: float) -> Trajectory:
    """Circles around another thing, evenly spread."""
    model = group.models[number]
    radius = float(np.max(around.half[:2])) + 0.9 * group.size_m + 0.1 * around.size_m
    rate = 2.0 * math.pi / max(duration_s, 2.0) * group.course.motion.pace
    if group.course.motion.direction == "right":
        rate = -rate
    phase = 2.0 * math.pi * number / len(group.models)
    x, y, _ = around.centre
    height = float(group.centre[2])
    activity = "run" if group.course.motion.kind == "run" else "move"
    lean = 0.3 if group.noun.habitat == "air" and model.length > model.height else 0.0
    return Circle((float(x), float(y), height), radius, rate, phase, activity, lean)


def _arrange(
    models: list[Model], course: Course, noun: Noun, rng: np.random.Generator
) -> list[Vector]:
    """Places of the copies about the middle of their group, m, staggered so none hides another."""
    count = len(models)
    if count == 1:
        return [(0.0, 0.0, 0.0)]
    length = max(model.length for model in models)
    width = max(model.width for model in models)
    tall = max(model.height for model in models)
    is_deep = noun.habitat in ("air", "water") and noun.name not in AFLOAT
    along = (0.8 if is_deep else 1.2) * length + 0.3
    across = 1.4 * width + 0.4
    if not course.is_path and not is_deep:
        along = 1.2 * max(length, width) + 0.3
    if noun.motion == "drive":
        along, across = 1.45 * length + 0.5, max(width + 0.9, 2.9)
    if course.motion.direction == "circle":
        along = across = 4.0 * max(length, width)
    columns = count if count <= 3 else math.ceil(math.sqrt(1.6 * count))
    if noun.motion == "drive":
        columns = math.ceil(count / 2)
    cosine, sine = (abs(math.cos(course.yaw)) > 0.5), (abs(math.sin(course.yaw)) > 0.5)
    slots: list[Vector] = []
    for number in range(count):
        row, column = divmod(number, columns)
        in_row = min(columns, count - row * columns)
        a = (column - 0.5 * (in_row - 1) + 0.3 * (row % 2)) * along
        b = (row - 0.5 * ((count - 1) // columns)) * across + (0.6 * across * (number % 2))
        a += float(rng.uniform(-0.12, 0.12)) * along
        b += float(rng.uniform(-0.08, 0.08)) * across
        if noun.motion == "drive":
            b = (row - 0.5 * ((count - 1) // columns)) * across
        up = 0.0
        if is_deep:
            up = (0.9 * (-1.0) ** number + float(rng.uniform(-0.35, 0.35))) * tall
        slots.append((a, b, up) if cosine or not sine else (b * 1.6, a, up))
    return slots


def _room(models: list[Model], slots: list[Vector], course: Course) -> Float64Array:
    """[3] half extents of what the group takes up over the clip, m."""
    model = models[0]
    cosine, sine = abs(math.cos(course.yaw)), abs(math.sin(course.yaw))
    length, width = model.length, model.width
    if course.motion.kind in ("spin", "roll", "sway", "swing", "dance", "fall"):
        length = width = max(length, width)
    half = 0.5 * np.array(
        [cosine * length + sine * width, sine * length + cosine * width, model.height]
    )
    spread = np.abs(np.array(slots)).max(axis=0)
    travel = 0.5 * course.travel_m * np.array([cosine, sine, abs(course.climb)])
    if course.motion.direction == "circle":
        travel = np.array([1.3, 1.3, 0.0]) * max(model.length, model.width)
    return np.asarray(half + spread + travel)


def _overlaps(centre: Float64Array, group: Group, other: Group) -> bool:
    gap = GAP_M * min(group.size_m, other.size_m)
    apart = np.abs(centre - other.centre) - (group.half + other.half)
    if group.noun.habitat == other.noun.habitat:
        return bool(np.all(apart[:2] < gap) and apart[2] < gap)
    low_a, low_b = _vertical(centre, group), _vertical(other.centre, other)
    above = low_a[0] > low_b[1] or low_b[0] > low_a[1]
    return bool(np.all(apart[:2] < gap) and not above)


def _vertical(centre: Float64Array, group: Group) -> tuple[float, float]:
    """Lowest and highest point of a group, m."""
    height = 2.0 * float(group.half[2])
    low = float(centre[2]) - (0.5 * height if group.noun.habitat in ("air", "water") else 0.0)
    return low, low + height


def _place_on_targets(
    group: Group, kind: str, targets: list[Group], height: float
) -> tuple[Float64Array, Float64Array]:
    """A subject's place with respect to things that stand already."""
    target = targets[0]
    top = target.models[0].height * (0.5 if target.noun.habitat in ("air", "water") else 1.0)
    lift = 0.5 * group.models[0].height if group.noun.habitat in ("air", "water") else 0.0
    still = np.zeros(3)
    if kind == "around":
        group.orbits = target
        level = target.centre[2] if group.noun.habitat != "air" else target.centre[2] + 0.8 * top
        return np.array([target.centre[0], target.centre[1], max(level, 0.0)]), still
    if kind == "on":
        if target.course.motion.is_moving:
            group.carrier = target
        seat = _seat_height(target, group) + lift
        _sit_in_row(group, target)
        return target.centre + np.array([0.0, 0.0, seat]), still
    if kind == "above":
        clear = top + 0.7 * group.models[0].height + 0.3
        return target.centre + np.array([0.0, 0.0, max(clear + lift, height)]), still
    if kind == "under":
        return target.centre * [1.0, 1.0, 0.0] + [0.0, -0.9, height], np.array([0.0, -1.0, 0.0])
    if kind == "between":
        middle = np.mean([other.centre for other in targets], axis=0)
        if len(targets) == 1 and len(target.slots) > 1:
            middle = target.centre
        return np.array([middle[0], middle[1], height]), np.array([0.0, -1.0, 0.0])
    behind = target.half[:2] + group.half[:2]
    heading = np.array([math.cos(target.course.yaw), math.sin(target.course.yaw)])
    reach = 0.5 * (target.models[0].length + group.models[0].length)
    wanted = target.centre[:2] - heading * min(1.6 * reach + 0.4, float(behind.max()) + reach)
    group.half = 0.5 * np.array(
        [group.models[0].length, group.models[0].width, group.models[0].height]
    )
    return np.array([*wanted, height]), still


def _sit_in_row(group: Group, target: Group) -> None:
    """Spread what is on a thing along its longer side, facing as it faces."""
    body, count = target.models[0], len(group.slots)
    is_wide = body.width > body.length
    room = 0.8 * max(body.width, body.length) / count
    spacing = min(room, 1.3 * max(group.models[0].width, group.models[0].length))
    yaw = target.course.yaw + (0.5 * math.pi if is_wide else 0.0)
    group.slots = [
        (a * math.cos(yaw), a * math.sin(yaw), 0.0)
        for a in (spacing * (number - 0.5 * (count - 1)) for number in range(count))
    ]
    if group.course.motion.kind in ("sit", "stand") and group.noun.name in PEOPLE:
        group.course = replace(group.course, yaw=target.course.yaw)
    group.half = _room(group.models, group.slots, group.course)


def _seat_height(target: Group, group: Group) -> float:
    """Height above the target's origin at which the thing on it has its own origin, m."""
    is_sitting = group.course.motion.kind in ("sit", "drive", "sail") or group.carrier is not None
    shares = _SADDLES if is_sitting and group.noun.name in PEOPLE else _TOPS
    share = shares.get(target.noun.name, 1.0)
    return (share - (0.5 if target.noun.habitat == "air" else 0.0)) * target.models[0].height


_TOPS = {"chair": 0.5, "sofa": 0.5, "bed": 0.5, "bench": 0.5, "boat": 0.35, "horse": 0.62,
         "sailboat": 0.15, "bridge": 0.338}  # fmt: skip
"""Share of a thing's height at which others lie on it; 1 where nothing is said."""
_SADDLES = {"chair": 0.02, "sofa": 0.02, "bench": 0.02, "bed": 0.05, "horse": 0.40, "boat": 0.2,
            "elephant": 0.78, "sailboat": 0.1, "zebra": 0.40, "cow": 0.6}  # fmt: skip
"""The same for people who sit: their origin is under their feet."""


def _place_by_subject(
    group: Group, kind: str, subject: Group, height: float
) -> tuple[Float64Array, Float64Array]:
    """A target's place with respect to the subject that the prompt relates to it."""
    clear = subject.half + group.half + GAP_M * min(subject.size_m, group.size_m)
    sideways = abs(math.cos(subject.course.yaw)) > 0.5 or not subject.course.is_path
    here = subject.centre * [1.0, 1.0, 0.0] + [0.0, 0.0, height]
    away, along = np.array([0.0, 1.0, 0.0]), np.array([1.0, 0.0, 0.0])
    if kind == "with" and subject.course.is_path and sideways:
        ahead = 0.55 * (subject.models[0].length + group.models[0].length) + 0.2
        return _shift(here, ahead * math.cos(subject.course.yaw), clear[1] + 0.1), away
    if kind in ("past", "beside", "with") and subject.course.is_path and sideways:
        return _shift(here, 0.0, clear[1] + 0.3), away
    if kind == "past" or (subject.course.is_path and kind == "beside"):
        return _shift(here, clear[0] + 0.3, 0.0), along
    if kind == "behind":
        return _shift(here, -0.55 * clear[0], -clear[1]), -away
    if kind == "front":
        return _shift(here, 0.0, clear[1]), away
    if kind == "left of":
        return _shift(here, clear[0], 0.0), along
    if kind == "right of":
        return _shift(here, -clear[0], 0.0), -along
    if kind == "towards":
        yaw = subject.course.yaw
        return _shift(here, clear[0] * math.cos(yaw), clear[1] * math.sin(yaw)), away
    return _shift(here, clear[0], 0.0), along


def _shift(place: Float64Array, x: float, y: float) -> Float64Array:
    return np.asarray(place + np.array([x, y, 0.0]))
