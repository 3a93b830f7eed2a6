"""Where objects stand along the route of a camera that travels."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import is_centred
from texvent.scenes.staging.camera.journey import TravelPlan
from texvent.scenes.staging.placement.object_groups import ObjectGroup, half_extents_over_clip
from texvent.scenes.staging.placement.spatial_relations import GATES
from texvent.scenes.staging.trajectories.motion_plan import MotionPlan

_SEEN = 1.8
"""What stands aside is in the picture from this many times as far ahead."""
_GAP_M = 1.5
_BEFORE_M = 2.5
"""What the camera keeps clear of what is in its lane, m."""
_AHEAD_M = 7.0
"""From the camera to what moves in front of it."""


class RoutePlacer:
    """Gives each object its place beside the route, ahead on it, or across it."""

    def __init__(self, travel: TravelPlan, duration_s: float, bodies: int) -> None:
        """Plan for a route.

        Args:
            travel: the route.
            duration_s: length of the clip, s.
            bodies: how many bodies there are in all.
        """
        self._travel = travel
        self._duration_s = duration_s
        self._bodies = bodies
        self._taken = {1.0: 0.0, -1.0: 0.0}
        """Side (1 = right) → how far along it is taken, m."""
        self._crossed_m = 0.0

    def place(self, group: ObjectGroup, height: float, *, is_goal: bool) -> Float64Array:
        """Place the copies of a group, and turn them as the route runs there.

        Args:
            group: the object; its offsets, heading and extents change.
            height: of its origin, m.
            is_goal: whether the camera heads for it.

        Returns:
            [3] middle of the group, m.
        """
        if is_goal or group.noun.name in GATES:
            return self._place_ahead(group, height, is_goal=is_goal)
        if group.scene_object.side == "lane" and not group.plan.is_path:
            return self._place_in_lane(group, height)
        if group.plan.is_path and group.plan.motion.direction in ("left", "right", "across"):
            return self._place_across(group, height)
        if group.plan.is_path and is_centred(group.noun):
            return self._place_in_front(group)
        if group.plan.is_path and group.noun.habitat != "fixed":
            return self._place_on_the_way(group, height)
        return self._place_beside(group, height)

    def _place_ahead(self, group: ObjectGroup, height: float, *, is_goal: bool) -> Float64Array:
        size = group.size_m
        travel = self._travel
        along = travel.length_m + 3.0 + 0.9 * size if is_goal else 0.6 * travel.length_m
        x, y, heading = travel.point(along, 0.0)
        self._turn(group, heading if not is_goal else heading + math.pi)
        return np.array([x, y, height])

    def _place_across(self, group: ObjectGroup, height: float) -> Float64Array:
        """Crosses the route just beyond its end."""
        along = self._travel.length_m + 4.0 + 0.6 * group.models[0].width + self._next(group)
        x, y, _ = self._travel.point(along, 0.0)
        return np.array([x, y, height])

    def _place_in_lane(self, group: ObjectGroup, height: float) -> Float64Array:
        """On the roadway, where the camera comes to the end of its way before it."""
        deep = float(max(group.half[:2]))
        along = self._travel.length_m + _BEFORE_M + 1.5 * deep + self._next(group)
        x, y, _ = self._travel.point(along, 0.0)
        return np.array([x, y, height])

    def _next(self, group: ObjectGroup) -> float:
        """Metres by which what crosses keeps clear of what crossed before."""
        before = self._crossed_m
        self._crossed_m += 2.0 * float(group.half[1]) + 0.5
        return before + float(group.half[1])

    def _place_in_front(self, group: ObjectGroup) -> Float64Array:
        """What flies or swims goes along ahead of the camera, or comes towards it."""
        travel, plan = self._travel, group.plan
        x, y, heading = travel.point(0.5 * travel.length_m, 0.0)
        oncoming = plan.motion.direction == "towards"
        speed = plan.speed_m_s if oncoming else max(abs(travel.speed_m_s), 0.1)
        group.plan = replace(plan, yaw=heading + (math.pi if oncoming else 0.0), speed_m_s=speed)
        size = max(max(model.length, model.width) for model in group.models)
        ahead = 1.0 + 3.0 * size
        if oncoming:
            ahead += 0.5 * (abs(travel.speed_m_s) + speed) * self._duration_s
        offsets = []
        for number in range(len(group.models)):
            aside = (-1.0) ** number * 0.75 * size * ((number + 1) // 2) + 0.3 * size
            along, up = 0.9 * size * (number % 3), 0.4 * size * ((number + 1) % 3 - 1)
            offsets.append((
                along * math.cos(heading) + aside * math.sin(heading),
                along * math.sin(heading) - aside * math.cos(heading),
                up,
            ))  # fmt: skip
        group.offsets = offsets
        group.half = half_extents_over_clip(group.models, group.offsets, group.plan)
        height = travel.journey.height_m - travel.journey.pitch_rad * ahead
        return np.array([x + ahead * math.cos(heading), y + ahead * math.sin(heading), height])

    def _place_on_the_way(self, group: ObjectGroup, height: float) -> Float64Array:
        """Vehicles in their lanes, the rest beside the road; the same way or the other."""
        travel, plan = self._travel, group.plan
        is_driven = group.noun.motion == "drive" or group.noun.habitat in ("air", "water")
        oncoming = plan.motion.direction == "towards"
        if plan.motion.direction is None:
            oncoming = len(group.models) > 1 or not is_driven
        middle = 0.5 * travel.length_m
        x, y, heading = travel.point(middle, 0.0)
        own = travel.speed_m_s
        speed = plan.speed_m_s
        if not oncoming and is_driven and plan.motion.speed_m_s is None and own > 0.0:
            speed = own * plan.motion.pace
        plan = MotionPlan(plan.motion, heading + (math.pi if oncoming else 0.0), speed,
                          plan.duration_s, plan.path)  # fmt: skip
        group.plan = plan
        length = max(model.length for model in group.models)
        width = max(model.width for model in group.models)
        ahead, lane = _AHEAD_M + 0.5 * length, 0.0
        if not is_driven:
            lane = travel.clear(1.0) + 0.5 * width + 0.4
            ahead = _SEEN * lane
        elif oncoming:
            lane = -max(0.67 * travel.clear(-1.0), 0.5 * width + 1.5)
            ahead = length
        if oncoming:
            ahead += 0.25 * (own + speed) * self._duration_s
        spacing = 1.6 * length + 2.0
        group.offsets = [
            (
                number * spacing * math.cos(heading) + lane * math.sin(heading),
                number * spacing * math.sin(heading) - lane * math.cos(heading),
                0.0,
            )
            for number in range(len(group.models))
        ]
        group.half = half_extents_over_clip(group.models, group.offsets, plan)
        return np.array([x + ahead * math.cos(heading), y + ahead * math.sin(heading), height])

    def _place_beside(self, group: ObjectGroup, height: float) -> Float64Array:
        """Each copy on the next free place of the emptier side."""
        travel = self._travel
        places = []
        for model in group.models:
            side = min(self._taken, key=lambda s: self._taken[s])
            is_square = group.noun.motion == "drive"
            half = 0.5 * (model.width if is_square else max(model.length, model.width))
            aside = travel.clear(side) + half + (0.2 if is_square else 0.5)
            if group.noun.habitat == "air":
                aside *= 0.5
            # Seen from the beginning of the route, and for most of the clip.
            share = 0.4 if travel.speed_m_s >= 0.0 else 0.9
            first = _SEEN * aside + share * travel.length_m
            step = max(model.length, model.width) + _GAP_M
            spread = (0.7 * travel.length_m + 6.0) / max(0.5 * self._bodies, 1.0)
            along = max(self._taken[side], first) + 0.5 * step
            places.append(travel.point(along, side * aside))
            self._taken[side] = along + max(0.5 * step, spread - 0.5 * step)
        spots = np.array([place[:2] for place in places])
        middle = spots.mean(axis=0)
        group.offsets = [(float(x), float(y), 0.0) for x, y in spots - middle]
        if group.noun.motion == "drive" and group.plan.path is None:
            self._turn(group, places[0][2])
        group.half = half_extents_over_clip(group.models, group.offsets, group.plan)
        return np.array([*middle, height])

    def _turn(self, group: ObjectGroup, heading: float) -> None:
        plan = group.plan
        group.plan = MotionPlan(plan.motion, heading, plan.speed_m_s, plan.duration_s, plan.path)


def push_aside(group: ObjectGroup, travel: TravelPlan) -> None:
    """Move what stands in the way of the camera to the side of the route."""
    is_low = group.centre[2] - (0.5 * group.models[0].height if is_centred(group.noun) else 0.0)
    top = is_low + group.models[0].height
    if top < 0.3 * travel.journey.height_m or is_low > travel.journey.height_m + 0.5:
        return
    alongs = np.linspace(0.0, travel.length_m + 1.0, 60)
    lines = np.array([travel.point(float(along), 0.0) for along in alongs])
    offsets = group.centre[:2] - lines[:, :2]
    nearest = int(np.argmin(np.hypot(*offsets.T)))
    heading = lines[nearest, 2]
    right = np.array([math.sin(heading), -math.cos(heading)])
    side = 1.0 if float(offsets[nearest] @ right) >= 0.0 else -1.0
    needed = travel.clear(side) + float(max(group.half[:2]))
    if np.hypot(*offsets[nearest]) < needed:
        group.centre[:2] = lines[nearest, :2] + side * needed * right
