"""Placement of objects: relations become positions, and no two objects overlap."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from texvent.errors import ConfigError
from texvent_scenes.description import IndexedRelation, SceneDescription, label_of
from texvent_scenes.models.activities import PERSON_NOUNS
from texvent_scenes.models.protocol import Model, Noun
from texvent_scenes.models.shapes import point
from texvent_scenes.models.tables import nouns_with, trait_value
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.spec.data import WAYS
from texvent_scenes.staging.actors import Actor, lowest_point, seeded, size_of
from texvent_scenes.staging.camera.journey import TravelPlan
from texvent_scenes.staging.interactions.perform import perform_acts
from texvent_scenes.staging.interactions.settling import settle_motions
from texvent_scenes.staging.placement.along_route import RoutePlacer
from texvent_scenes.staging.placement.apart import (
    RESTING,
    NoRoomError,
    borne_places,
    list_awaited,
    list_unkept,
    plan_spacing,
)
from texvent_scenes.staging.placement.group_building import GroupBuilder
from texvent_scenes.staging.placement.heights import Heights
from texvent_scenes.staging.placement.kept_places import refuse_beside, refuse_moved
from texvent_scenes.staging.placement.object_groups import (
    Goal,
    ObjectGroup,
    choose_props,
    join_way,
    match_pace,
    overlap,
    part_in_midst,
)
from texvent_scenes.staging.placement.relations import (
    INVERSE,
    ON_TARGET,
    leads_between,
    place_at_distance,
    place_by_subject,
    place_on_targets,
)
from texvent_scenes.staging.placement.rows import stands
from texvent_scenes.staging.placement.ways import has_fault, lead
from texvent_scenes.staging.placement.zones import list_orphans
from texvent_scenes.staging.tracks.choose_track import (
    choose_track,
    orbit,
)
from texvent_scenes.staging.tracks.keys import Vector
from texvent_scenes.staging.tracks.leaning import keep_up
from texvent_scenes.staging.tracks.motion_plan import (
    raised,
)
from texvent_scenes.staging.tracks.phases import haste_of
from texvent_scenes.staging.tracks.track import Track, lifted, seated

_MUCH_LARGER = 1.3
"""Beside what is so many times larger, a thing stands nearer to the camera, else further away."""
_NEARER = 0.35
"""Approach for each metre to the side."""
_PASSED = 1.2
"""Room between what is passed one after the other, in their half extents."""
_PACE = 0.4
"""From what a person goes round to the person, in sizes."""
_ATTEMPTS = 400
_SIDES = {"left": -1.0, "right": 1.0}


class ObjectPlacer:
    """Places groups one after the other, each where the scene wants it or close to it."""

    def __init__(
        self,
        description: SceneDescription,
        nouns: Mapping[str, Noun],
        *,
        seed: int,
        duration_s: float,
        level_m: Mapping[str, float],
        travel: TravelPlan | None = None,
    ) -> None:
        self._description = settle_motions(description, nouns, seed)
        builder = GroupBuilder(
            self._description, nouns, seed=seed, duration_s=duration_s, is_trip=travel is not None
        )
        self.build_group = builder.build
        """An object's copies in formation about (0, 0), by its index."""
        self._heights = Heights(self._description, nouns, level_m, self.build_group)
        self._seed = seed
        self._duration_s = duration_s
        self._level_m = level_m
        """Height of the origin of what lives in the air and in the water, in own sizes."""
        self.groups: dict[int, ObjectGroup] = {}
        self.orphans = frozenset(list_orphans(self._description))
        self.not_shown: list[str] = []
        """Objects that have no place, and why."""
        self.notes = builder.notes
        """Sizes that are not the usual ones, and why."""
        self._why_apart = ""
        self._travel = travel
        bodies = sum(scene_object.count for scene_object in description.objects)
        self._along = None if travel is None else RoutePlacer(travel, duration_s, bodies)

    def place_all(self) -> list[Actor]:
        """Every copy of every object, with its track."""
        objects = self._description.objects
        # Objects with positions in metres are placed first; others make way.
        self.not_shown = [
            f"the {label_of(self._description, n)} ({self._why_left_out(objects[n].noun)})"
            for n in sorted(self.orphans)
        ]
        for index in sorted(range(len(objects)), key=lambda one: objects[one].position_m is None):
            if index not in self.orphans:
                self._place(index, frozenset())
        refuse_beside(self._description, self.groups)
        for one, why in list_unkept(self._description, self.groups):
            self._tell_distance(one, why)
        actors: list[Actor] = []
        for index in sorted(self.groups):
            actors.extend(self._populate(self.groups[index], len(actors)))
        acting = perform_acts(self._description, actors, self._duration_s)
        refuse_moved(self._description, actors, acting)
        return acting

    @staticmethod
    def _why_left_out(noun: str) -> str:
        if noun in nouns_with("larger than a room"):
            return "it is larger than the room: say another place, or smoke, steam or dust"
        return "nobody has it and nothing carries it: say who or where"

    def _place(self, index: int, waiting: frozenset[int]) -> None:
        """Place an object, after the objects its place depends on."""
        if index in self.groups or index in waiting:
            return
        group = self.build_group(index)
        related = [r for r in self._description.relations if r.subject == index]
        for relation in related:
            for target in relation.targets if relation.kind in ON_TARGET else ():
                self._place(target, waiting | {index})
        for other in list_awaited(self._description, index):
            self._place(other, waiting | {index})
        join_way(group, self.groups.values())
        goal = self._choose_goal(group, related)
        self._match_paces(group)
        if borne := borne_places(self._description, index):  # it is below what it bears
            group.begins = np.mean([np.min(borne, axis=0), np.max(borne, axis=0)], axis=0)
        group.centre = self._find_free_position(group, goal)
        group.gather()
        self._start_where_said(group)
        if group.stops_s is not None and group.bearer is not None:
            belt = label_of(self._description, group.bearer[0].index)
            self.notes.append(f"what is on the {belt} comes to its end at {group.stops_s:.2g} s "
                              "and rests there; the belt runs on")  # fmt: skip
        self.groups[index] = group

    def _start_where_said(self, group: ObjectGroup) -> None:
        """Move a group so that it starts at the place and height of the scene, m.

        A position is that of its first copy, other metres are to the middle of all.
        """
        said, height_m = group.scene_object, group.scene_object.height_m
        first = group.centre + np.array(group.offsets[0])
        rng = seeded(self._seed, "lead", group.index, group.noun.name)
        start = self._choose(group, group.models[0], point(first), 0, rng).at(0.0)
        group.lag_m = np.subtract(start.position[:2], first[:2])
        if group.plan.motion.kind == "spin" and group.plan.spin_axis == "yaw":
            # What is on it is placed, and measured, as it is turned at first.
            group.plan = replace(group.plan, yaw=start.yaw)
        if said.position_m is not None:
            group.centre[:2] += np.subtract(said.position_m, start.position[:2])
        elif group.begins is not None:
            group.centre[:2] += group.begins - group.begin
        if height_m is None:
            return
        lift = height_m - lowest_point(group.models[0]) - float(start.position[2])
        if group.plan.start_m is None:
            group.centre[2] += lift
        else:  # it comes down to where it is, which may be a table
            group.plan = raised(group.plan, lift)

    def _match_paces(self, group: ObjectGroup) -> None:
        """Give a follower, a companion or what is overtaken the pace of its partner."""
        for one in self._description.relations:
            is_follower = one.kind == "follow" and one.subject == group.index
            is_led = (
                one.kind in ("with", "beside", "overtake", "past") and group.index in one.targets
            )
            partner = self.groups.get(one.targets[0] if is_follower else one.subject)
            if partner is not None and (is_follower or is_led):
                match_pace(group, partner, one.kind)

    def _choose_goal(self, group: ObjectGroup, related: Sequence[IndexedRelation]) -> Goal:
        """Goal of a group in the scene."""
        height = self._heights.of(group)
        for relation in related:
            targets = [self.groups[t] for t in relation.targets if t in self.groups]
            if relation.kind in WAYS and targets:
                if not has_fault(group, relation.kind, targets[0]):
                    way = lead(group, relation.kind, targets[0], self._pushed_m(group.index))
                    return Goal(way, np.zeros(3))
            elif relation.kind in ON_TARGET and targets:
                return self._rest(group, relation, targets, height)
        for relation in sorted(related, key=lambda one: one.distance_m is None):
            if relation.kind in INVERSE and relation.targets[0] in self.groups:
                target = self.groups[relation.targets[0]]
                goal = place_by_subject(group, INVERSE[relation.kind], target, height)
                return place_at_distance(goal, group, relation, target, 1.0)
        for relation in sorted(self._description.relations, key=lambda one: one.distance_m is None):
            if group.index in relation.targets and relation.subject in self.groups:
                subject = self.groups[relation.subject]
                goal = place_by_subject(group, relation.kind, subject, height)
                goal = self._one_after_another(goal, group, subject, relation)
                return place_at_distance(goal, group, relation, subject, -1.0)
        if self._along is not None:
            return Goal(self._place_along(self._along, group, height), np.zeros(3))
        return self._choose_free_goal(group, height)

    def _place_along(self, along: RoutePlacer, group: ObjectGroup, height: float) -> Float64Array:
        """[3] a place along the route of the camera; those between whom others come in one row."""
        scene = self._description
        apart = [one.targets for one in scene.relations if one.kind == "between"]
        if len(group.models) > 1 and (group.index,) in apart:
            return along.park(group, height)
        is_goal = scene.index(scene.camera.target) == group.index
        return along.place(group, height, is_goal=is_goal)

    def _rest(
        self, group: ObjectGroup, relation: IndexedRelation, targets: Sequence[ObjectGroup],
        height: float,
    ) -> Goal:  # fmt: skip
        """Goal of a group on its targets, at stated distances from what is there too."""
        shared = self._list_sharing(relation)
        if relation.kind == "follow" and relation.distance_m is not None:
            ahead = targets[0].to_world(relation.distance_m, 0.0, 0.0) - targets[0].centre
            group.begins = targets[0].begin - ahead[:2]
        if relation.kind in RESTING:
            group.spacing = plan_spacing(self._description, shared, self.groups, self.build_group)
        try:
            return place_on_targets(group, relation.kind, targets, height, shared)
        except NoRoomError as error:
            self._why_apart = str(error)
        group.spacing = None
        return place_on_targets(group, relation.kind, targets, height, shared)

    def _tell_distance(self, relation: IndexedRelation, why: str) -> None:
        """Refuse a distance of a file that cannot be kept; of a sentence it is not shown.

        Raises:
            ConfigError: it is that of a file.
        """
        scene, subject = self._description, relation.subject
        why = self._why_apart or why
        if scene.is_sentence:
            noun, other = (label_of(scene, n) for n in (subject, relation.targets[0]))
            distance = f"{relation.distance_m:g} m {relation.kind} the {other}"
            self.not_shown.append(f"the {noun} {distance} ({why})")
            return
        own = [one for one in scene.relations if one.subject == subject]
        where = f"objects[{subject}].relations[{own.index(relation)}].distance_m"
        raise ConfigError(
            f"{where} is {relation.distance_m:g}, which cannot be kept: {why}; give another one, "
            "or leave it out"
        )

    def _pushed_m(self, index: int) -> float:
        """Length of what an object pushes before it, m."""
        pushed = [one.targets[0] for one in self._description.relations
                  if one.kind == "push" and one.subject == index]  # fmt: skip
        return sum(self.build_group(n).models[0].length for n in pushed)

    def _one_after_another(
        self, goal: Goal, group: ObjectGroup, subject: ObjectGroup, relation: IndexedRelation
    ) -> Goal:
        """The goal of one of several that something goes past: along the way, at either end."""
        number = relation.targets.index(group.index)
        first = self.groups.get(relation.targets[0])
        if relation.kind != "past" or first is None or number == 0:
            return goal
        apart = _PASSED * float(np.max(first.half[:2]) + np.max(group.half[:2])) * (number + 1) / 2
        side = apart if number % 2 else -apart
        along = np.array([math.cos(subject.plan.yaw), math.sin(subject.plan.yaw), 0.0])
        return goal._replace(position=goal.position + side * along)

    def _list_sharing(self, relation: IndexedRelation) -> list[int]:
        """Index of each copy that has the same relation to the same objects."""
        return [
            other.subject
            for other in self._description.relations
            if other.kind == relation.kind and other.targets == relation.targets
            for _ in range(self._description.objects[other.subject].count)
        ]

    def _choose_free_goal(self, group: ObjectGroup, height: float) -> Goal:
        """In the middle, or at the side of the image that the scene says."""
        side = group.scene_object.placement or ""
        offset = _SIDES.get(side, 0.0) * 2.0 * group.size_m
        offset += self._spread_apart(group) + self._stagger(group)
        depth = {"far": 2.2 * group.size_m + 6.0, "near": -1.2 * group.size_m}.get(side, 0.0)
        wanted = np.array([offset, depth, height])
        sizes = [other.size_m for other in self.groups.values()]
        if group.plan.is_path or group.noun.habitat in ("air", "water"):
            # Smaller objects go nearer to the camera, so that none hides behind a larger one.
            is_smaller = group.size_m < max(sizes, default=0.0)
            return Goal(wanted, np.array([0.0, -1.0 if is_smaller else 1.0, 0.0]))
        is_smaller = _MUCH_LARGER * group.size_m < max(sizes, default=0.0)
        return Goal(wanted, np.array([1.0, -_NEARER if is_smaller else _NEARER, 0.0]))

    def _spread_apart(self, group: ObjectGroup) -> float:
        """Metres to the side that leave room for what is to stand between this and another.

        Between the copies of one object the room is in their midst.
        """
        for relation in self._description.relations:
            if relation.kind != "between" or group.index not in relation.targets:
                continue
            subject = self.build_group(relation.subject)
            reach = subject.size_m if leads_between(subject) else float(subject.half[0])
            room = reach + 0.4
            if len(relation.targets) > 1:
                side = -1.0 if relation.targets.index(group.index) == 0 else 1.0
                return side * (float(group.half[0]) + room)
            part_in_midst(group, room)
        return 0.0

    def _stagger(self, group: ObjectGroup) -> float:
        """Metres along the path between objects that go side by side, so that both are seen."""
        others = [other for other in self.groups.values() if other.plan.is_path]
        if not others or not group.plan.is_path or abs(math.cos(group.plan.yaw)) < 0.5:
            return 0.0
        side = -1.0 if len(others) % 2 else 1.0
        return side * 0.35 * (others[0].models[0].length + group.models[0].length)

    def _find_free_position(self, group: ObjectGroup, goal: Goal) -> Float64Array:
        """The goal, or the nearest free position along its slide, alternating sides.

        The steps are small between small things, which stand close together.
        """
        wanted, slide = goal
        if not slide.any():
            return wanted
        largest = max([group.size_m, *(other.size_m for other in self.groups.values())])
        step = 0.25 * float(np.max(group.half[:2])) + min(0.1, 0.1 * largest)
        for attempt in range(_ATTEMPTS):
            reach = step * ((attempt + 1) // 2) * (1.0 if attempt % 2 else -1.0)
            if slide[0] == 0.0:
                reach = step * attempt
            # To either side, but always nearer or always further away.
            centre = wanted + np.array([reach, abs(reach), reach]) * slide
            if not any(overlap(centre, group, other) for other in self.groups.values()):
                return np.asarray(centre)
        return wanted + _ATTEMPTS * step * np.abs(slide)

    def _populate(self, group: ObjectGroup, before: int) -> list[Actor]:
        """The copies of a group on their tracks."""
        rng = seeded(self._seed, "lead", group.index, group.noun.name)
        actors = []
        said = (group.plan.motion, *group.scene_object.motions[1:])
        for number, (model, offset) in enumerate(zip(group.models, group.offsets, strict=True)):
            x, y, z = group.centre + np.array(offset)
            props = choose_props(self._description, group)
            track = self._choose(group, model, (x, y, z), number, rng)
            track = lifted(track, max((one.thickness_m for one in props), default=0.0))
            actors.append(
                Actor(
                    group.index, group.noun, model, track,
                    any(motion.is_moving for motion in said),
                    before + number + 1, float(rng.uniform(0.0, 1.0)) if number else 0.0,
                    props,
                    label=label_of(self._description, group.index),
                    goes_across=any(one.direction == "across" for one in said),
                    haste=haste_of(group.noun, said[0]),
                )
            )  # fmt: skip
        return actors

    def _choose(
        self, group: ObjectGroup, model: Model, home: Vector, number: int, rng: np.random.Generator
    ) -> Track:
        """The track of a copy that is at `home` in the middle of the clip."""
        if group.orbits is not None:
            x, y, _ = group.orbits.centre
            reach = group.orbits.reach_below(group.top_m) + 0.9 * group.size_m
            reach += 0.1 * group.orbits.size_m
            if group.noun.name in PERSON_NOUNS:  # close round it, and so far round
                reach = group.orbits.reach_below(group.top_m) + _PACE * group.size_m
            ring = trait_value("circled on", group.orbits.noun.name)
            if ring is not None:
                reach = ring * size_of(group.orbits.models[0])
            reach = group.ring_m if group.ring_m is not None else reach
            home = (float(x), float(y), float(group.centre[2]))
            return orbit(group.plan, home, reach, number / len(group.models))
        if group.carrier is not None:
            return self._ride_on(group, group.carrier, home)
        plan = group.plan if group.yaws is None else replace(group.plan, yaw=group.yaws[number])
        track = choose_track(plan, model, home, rng)
        return keep_up(track, model) if stands(group, model, home[2], self._level_m) else track

    def _ride_on(self, group: ObjectGroup, below: ObjectGroup, home: Vector) -> Track:
        """On what carries it, which moves as a whole."""
        rng = seeded(self._seed, "lead", below.index, below.noun.name)
        carrier = self._choose(below, below.models[0], point(below.centre), 0, rng)
        (x, y, z), yaw = np.array(home) - below.centre, below.plan.yaw
        cosine, sine = math.cos(yaw), math.sin(yaw)
        place = (x * cosine + y * sine, y * cosine - x * sine, z)
        return seated(carrier, place, group.plan.gesture or "sit")
