"""Where things stand: relations become positions, and no two things share a place."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from texvent.scenes.description import STANDING, Relation, SceneDescription
from texvent.scenes.model import Model, Noun, Part
from texvent.scenes.primitives import Float64Array, Shape
from texvent.scenes.staging.actors import Actor, seeded
from texvent.scenes.staging.acts import Swing
from texvent.scenes.staging.formation import (
    Group,
    arrange_copies,
    measure_room,
    overlap,
)
from texvent.scenes.staging.motion import Circle, Riding, Trajectory, Vector
from texvent.scenes.staging.relations import place_by_subject, place_on_targets
from texvent.scenes.staging.trajectories import (
    Course,
    choose_trajectory,
    decide_course,
)

ON_TARGET = frozenset({"on", "above", "around", "under", "between", "follow"})
"""Relations in which the subject's place follows from the target's; in the others the target's
follows from the subject's."""
SCENIC = frozenset({"surround", "among"})
"""Relations whose targets stand around as scenery; `scenery` places them."""


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
        return actors

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
        course = decide_course(thing.motion or STANDING, noun, models[0], self._duration_s, rng)
        slots = arrange_copies(models, course, noun, rng)
        return Group(index, thing, noun, models, course, slots, measure_room(models, slots, course))

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
        group.centre = self._findmeasure_room(group, wanted, slide)
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
                group.half = measure_room(group.models, group.slots, group.course)

    def _wish(self, group: Group, related: list[Relation]) -> tuple[Float64Array, Float64Array]:
        """Where the prompt wants a group, and which way it may be moved from there."""
        height = self._height(group)
        for relation in related:
            targets = [self.groups[t] for t in relation.targets if t in self.groups]
            if relation.kind in ON_TARGET and targets:
                shared = [
                    other.subject
                    for other in self._description.relations
                    if other.kind == "on" and other.targets == relation.targets
                ]
                return place_on_targets(group, relation.kind, targets, height, shared)
        for relation in self._description.relations:
            if group.index in relation.targets and relation.subject in self.groups:
                subject = self.groups[relation.subject]
                return place_by_subject(group, relation.kind, subject, height)
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
        flies = group.noun.habitat == "air" or kind == "fly"
        clear = self._level_m.get("clear", 0.0) if flies else 0.0
        return level * max(group.size_m, 1.0) + clear

    def _findmeasure_room(
        self, group: Group, wanted: Float64Array, slide: Float64Array
    ) -> Float64Array:
        """The wanted place, or the nearest free one along `slide`, alternating sides."""
        if not slide.any():
            return wanted
        step = 0.25 * float(np.max(group.half[:2])) + 0.1
        for attempt in range(400):
            reach = step * ((attempt + 1) // 2) * (1.0 if attempt % 2 else -1.0)
            if slide[0] == 0.0:
                reach = step * attempt
            centre = wanted + reach * slide
            if not any(overlap(centre, group, other) for other in self.groups.values()):
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
        return choose_trajectory(group.course, model, home, rng, clear_m=group.clear_m)


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
