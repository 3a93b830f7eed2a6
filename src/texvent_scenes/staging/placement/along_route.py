"""Placement of objects along the route of a camera that travels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from texvent_scenes.models.protocol import Model, ModelPart, Pose
from texvent_scenes.models.shapes import moved
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.staging.actors import is_centred
from texvent_scenes.staging.camera.journey import NORTH, TravelPlan
from texvent_scenes.staging.placement.object_groups import ObjectGroup
from texvent_scenes.staging.tracks.track import centred

_SEEN = 1.8
"""Distance ahead, as a multiple of that aside, from which on a thing is in the picture."""
_GAP_M = 1.5
_MOUTHS = {"near": (-3.0, 0.0, 0.9), "centre": (0.0, 0.55, 2.5)}
"""Placement of a passage that the camera comes out of or goes into → where it begins, m and share
of the route, and where it ends, share of the route."""
_OPEN, _BY_THE_WALL_M = 0.17, 1.3
"""Half of what is open of the width of a passage; least room between its wall and the camera, m."""
_SIDES, _LANE_GAP_M = {"left": -1.0, "right": 1.0}, 1.7
"""Sides on which others come past a camera, and how far from it they do, m."""
_BRAKING_M = 4.0
"""Further ahead of what changes its speed, m."""
_AHEAD_M = 7.0
"""From the camera to what moves in front of it."""


_GAP_AHEAD_M, _OUT_OF_M, _KERB_M = 3.0, 1.6, 0.2
"""Distance from the end of the route to the gap of a row, its width, and distance from the edge of
the road to those who are parked, m."""


class Lengthened:
    """A model that is longer than it is by itself: a tunnel."""

    def __init__(self, model: Model, length_m: float) -> None:
        self._model = model
        self._share = max(length_m / model.length, 1.0)
        self.length, self.width, self.height = self._share * model.length, model.width, model.height

    def parts(self, pose: Pose) -> Sequence[ModelPart]:
        """Its parts, drawn out along its length."""
        return moved(self._model.parts(pose), np.diag([self._share, 1.0, 1.0, 1.0])[:3])


class RoutePlacer:
    """Gives each object its place beside the route, ahead on it, or across it."""

    def __init__(self, travel: TravelPlan, duration_s: float, bodies: int) -> None:
        """For a route, the length of the clip, s, and how many bodies there are in all."""
        self._travel = travel
        self._duration_s = duration_s
        self._bodies = bodies
        self._taken = {1.0: 0.0, -1.0: 0.0}
        """Side (1 = right) → how far along it is taken, m."""
        self._beyond_m = 0.0
        """Length beyond the end of the route that is taken."""

    def place(self, group: ObjectGroup, height: float, *, is_goal: bool) -> Float64Array:
        """[3] middle of a group, m, whose copies are placed and turned along the route."""
        plan, travel = group.plan, self._travel
        crosses = plan.is_path and plan.motion.direction in ("left", "right", "across")
        is_led = plan.path is not None and group.noun.motion == "drive"  # it brakes
        if (plan.is_path or is_led) and not crosses and group.noun.habitat != "fixed":
            return self._place_on_the_way(group, height)
        is_passage = group.noun.name in nouns_with("passage")
        if not (is_goal or crosses or is_passage or group.scene_object.placement == "lane"):
            return self._place_beside(group, height)
        along, aside = 0.6 * travel.length_m, 0.0
        if is_passage and group.noun.name in nouns_with("fits who goes through"):  # over the road
            room_m = max(_OPEN * group.models[0].width - _BY_THE_WALL_M, 0.0)
            aside = min(max(float(travel.road.offset[0]), -room_m), room_m)
        mouths = _MOUTHS.get(group.scene_object.placement or "") if is_passage else None
        if mouths is not None:
            start = mouths[0] + mouths[1] * travel.length_m
            stop = mouths[2] * travel.length_m
            group.models = [Lengthened(one, stop - start) for one in group.models]
            along = 0.5 * (start + stop)
        if is_goal or not is_passage:
            # Just beyond the end of the route, where the camera does not come.
            along = travel.length_m + self._beyond_m + 3.0 + 0.9 * group.size_m
            self._beyond_m += 2.0 * float(group.half[1]) + 0.5
        if not crosses:
            group.plan = replace(plan, yaw=-NORTH if is_goal else NORTH)
        return np.array([*travel.point(along, aside), height])

    def _place_on_the_way(self, group: ObjectGroup, height: float) -> Float64Array:
        """Ahead of the camera or towards it: vehicles in lanes, others beside the road or aloft."""
        travel, plan = self._travel, group.plan
        length = max(model.length for model in group.models)
        width = max(model.width for model in group.models)
        walks = group.noun.habitat == "ground" and group.noun.motion != "drive"
        is_oncoming = plan.motion.direction == "towards" or (
            plan.motion.direction is None and (walks or len(group.models) > 1)
        )
        speed, ahead, aside = plan.speed_m_s, _AHEAD_M + 0.5 * length, 0.0
        if walks:
            aside = travel.clear(1.0) + 0.5 * width + 0.4
            ahead = _SEEN * aside
        elif is_oncoming:
            aside, ahead = -max(0.67 * travel.clear(-1.0), 0.5 * width + 1.5), length
        elif plan.motion.speed_m_s is None and travel.speed_m_s > 0.0:
            speed, own = travel.speed_m_s * plan.motion.pace, plan.speed_m_s
            side = _SIDES.get(group.scene_object.placement or "", 0.0)
            if side and plan.motion.direction == "away" and max(speed, own) > travel.speed_m_s:
                speed = max(speed, own)
                # It comes from beside the camera, on its other lane or off the road.
                aside = side * (0.5 * width + _LANE_GAP_M)
                ahead = 0.5 * ((speed - travel.speed_m_s) * self._duration_s - length)
        if is_centred(group.noun):
            aside, ahead = 0.0, 1.0 + 3.0 * max(length, width)
            height = travel.journey.height_m - travel.journey.pitch_rad * ahead
        if is_oncoming:
            ahead += 0.25 * (travel.speed_m_s + speed) * self._duration_s
        yaw = -NORTH if is_oncoming else NORTH
        path = plan.path
        if path is not None:
            path = centred(replace(path, start=(0.0, 0.0, 0.0), yaw=yaw), self._duration_s)
        ahead += 0.0 if path is None else _BRAKING_M
        group.plan = replace(plan, yaw=yaw, speed_m_s=speed, gesture=None, path=path)
        spacing = 1.6 * length + 2.0
        group.offsets = [(0.0, number * spacing, 0.0) for number in range(len(group.models))]
        group.fit()
        return np.array([*travel.point(0.5 * travel.length_m + ahead, aside), height])

    def park(self, group: ObjectGroup, height: float) -> Float64Array:
        """Copies in a row on the right, with a gap from which others come before the camera."""
        travel, side = self._travel, 1.0
        aside = travel.clear(side) + 0.5 * max(model.width for model in group.models) + _KERB_M
        along = travel.length_m + _GAP_AHEAD_M - group.models[0].length
        places = []
        for number, model in enumerate(group.models):
            places.append(travel.point(along + 0.5 * model.length, side * aside))
            along += model.length + (_OUT_OF_M if number == 0 else 0.5 * _OUT_OF_M)
        self._taken[side] = along
        middle = np.mean(places, axis=0)
        group.offsets = [(float(x), float(y), 0.0) for x, y in np.array(places) - middle]
        group.plan = replace(group.plan, yaw=NORTH)
        group.fit()
        return np.array([*middle, height])

    def _place_beside(self, group: ObjectGroup, height: float) -> Float64Array:
        """Each copy on the next free place of the emptier side."""
        travel, is_square = self._travel, group.noun.motion == "drive"
        places = []
        for model in group.models:
            side = min(self._taken, key=lambda s: self._taken[s])
            half = 0.5 * (model.width if is_square else max(model.length, model.width))
            aside = travel.clear(side) + half + (0.2 if is_square else 0.5)
            aside *= 0.5 if group.noun.habitat == "air" else 1.0
            # Seen from the beginning of the route, and for most of the clip.
            share = 0.4 if travel.speed_m_s >= 0.0 else 0.9
            step = max(model.length, model.width) + _GAP_M
            spread = (0.7 * travel.length_m + 6.0) / max(0.5 * self._bodies, 1.0)
            first = _SEEN * aside + share * travel.length_m
            along = max(self._taken[side], first) + 0.5 * step
            places.append(travel.point(along, side * aside))
            self._taken[side] = along + max(0.5 * step, spread - 0.5 * step)
        spots = np.array(places)
        middle = spots.mean(axis=0)
        group.offsets = [(float(x), float(y), 0.0) for x, y in spots - middle]
        if is_square and group.plan.path is None:
            group.plan = replace(group.plan, yaw=NORTH)
        group.fit()
        return np.array([*middle, height])
