"""Placement check: bodies that stand on nothing, sink, go through others or are in a wrong zone.

Boxes at a few instants decide. What flies, swims or falls, is held, or is put at a place in metres
needs no support.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from texvent_scenes.checks.clip.relations import Violation
from texvent_scenes.description import STANDING, SceneDescription
from texvent_scenes.models.activities import PERSON_NOUNS
from texvent_scenes.models.anchors import has_rim
from texvent_scenes.models.nouns import AFLOAT
from texvent_scenes.models.places import PlaceModel
from texvent_scenes.models.shapes import bounds, moved
from texvent_scenes.models.tables import nouns_with, trait_value
from texvent_scenes.rendered_scene import (
    Environment,
    Float64Array,
    Ground,
)
from texvent_scenes.spec.data import ACTED, WAYS
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.placement.zones import zone_of
from texvent_scenes.staging.surroundings.environment import lies_ashore
from texvent_scenes.staging.surroundings.road_line import RoadLine
from texvent_scenes.staging.surroundings.threads import is_still

_FREE = frozenset({"fly", "glide", "hover", "float", "rise", "sink", "fall", "jump", "bounce",
                   "swing", "throw", "orbit", "swim", "surf", "sail", "paddle", "row", "hang",
                   "topple", "dive", "spin", "sway", "climb", "grow", "shrink",
                   "plunge"})  # fmt: skip
"""Motions that need no support."""
_AIRBORNE = frozenset({"fly", "glide", "hover", "float", "rise", "sink", "orbit", "dive"})
"""Motions in which what has a fixed place on the ground hangs in the air."""
_HEAVY_M = 1.0
"""Size from which on it is too heavy for that: no yo-yo."""
_IN_HAND = frozenset({"hold", "wear", "act on"})
_SHARED = ACTED | WAYS | _IN_HAND | {"on", "in", "at", "under", "ride", "through", "with", "from",
                                     "follow"}  # fmt: skip
"""Relations in which two bodies may touch."""
_ROOM_M, _ROOM = 0.06, 0.08
"""Gap below a body that is no gap: metres, and share of its height on top of that."""
_LAID, _TILTED, _FLAT = ("lie", "topple"), 0.7, 1.1
"""Motions that end in a body on its side; most cosine of its axis against the vertical then; height
over width of what lies as it stands."""
_SLIM, _CENTRAL = 0.2, 0.25
"""Half of the middle of a body that no larger one may have a part in, and of its foot that
something must be below, in extents of its box."""
_PER_S, _FINE_STEPS = 8, 4
"""Instants per second at which it is looked where bodies are, and steps between two of them at
which near ones are looked at."""
_LEAST_INSTANTS = 2
"""Instants at which a fault is one."""
_LONG, _END = 1.5, 0.35
"""Length of a vehicle, in widths, from which on its ends need a support, not its middle; and from
its middle to these, in lengths."""
_CROSSING = 0.7
"""Least share of the way of one who crosses a road that leads across it."""
_CORD_M = 0.5
"""Most from the top of a lamp that swings to the ceiling above it, m; one that is still has a cord
to it."""
_SHALLOW_M = 0.4
"""From an edge of a road or of water to what is beyond it."""


def find_misplaced(
    description: SceneDescription,
    place: PlaceModel,
    surroundings: Environment,
    actors: Sequence[Actor],
    times: Sequence[float],
) -> Iterator[Violation]:
    """Bodies that are where they cannot be; words that say so are not shown.

    Args:
        description: the scene.
        place: its ground and road.
        surroundings: where that road or the water is.
        actors: bodies of its objects.
        times: instants, s.
    """
    bodies = _Bodies(description, actors, times)
    x, y = map(float, surroundings.road_offset)
    crossings = tuple(map(tuple, surroundings.road_crossings))
    line = RoadLine(surroundings.road_angle, (x, y), crossings)
    half_m = float(surroundings.road_half_width) if place.ground is not Ground.LAKE else 0.0
    for number, one in enumerate(actors):
        lost = [*bodies.list_unborne(number, place)]
        is_free = description.objects[one.object_index].placement == "lane"
        is_free |= any(one.object_index in (each.subject, *each.targets) if each.kind in WAYS
                       else each.subject == one.object_index and each.kind == "between"
                       for each in description.relations)  # fmt: skip
        lost += [*_list_wrong_element(number, one, place, bodies)]
        if not (lost or is_free) and bodies.needs_support(number):
            lost += _list_strays(one, place, line, half_m, times) if bodies.is_alone(number) else []
        hangs = one.noun.name in nouns_with("hangs from a ceiling")
        is_loose = math.isinf(surroundings.ceiling_m) or not is_still(one, times[-1])
        if hangs and is_loose and one.corners(0.0)[:, 2].max() < surroundings.ceiling_m - _CORD_M:
            lost.append(Violation("support", "", "hanging from nothing"))
        for kind, value, text in lost:
            yield Violation(kind, value, f"the {one.name} {text}")
        for relation in description.relations if lost else ():
            if relation.subject == one.object_index and relation.kind in ("on", "above"):
                yield Violation("relation", relation.kind, "")
    yield from bodies.find_intersections()
    for one in actors:
        last = (description.objects[one.object_index].motions or (STANDING,))[-1]
        if last.kind in _LAID and not _is_laid(one, last.kind, times):
            yield Violation("motion", last.kind, f"the {one.name} on its side")


def _list_wrong_element(
    number: int, one: Actor, place: PlaceModel, bodies: _Bodies
) -> Iterator[Violation]:
    """Faults of boats on land, and of land bodies that stand on water."""
    if is_stranded(one, place) and bodies.is_alone(number) and not bodies.is_bound(number):
        yield Violation("zone", "", "on land")
    is_dry = place.ground is Ground.SEA and one.noun.habitat == "ground"
    if is_dry and bodies.needs_support(number) and bodies.is_alone(number):
        yield Violation("zone", "", "on land: it is on the water")


def _is_laid(one: Actor, kind: str, times: Sequence[float]) -> bool:
    """Whether a body has fallen over or lies in the end, not upright on its foot or its wheels."""
    turn, corners = one.track.at(times[-1]).to_world()[:, :3], one.corners(times[-1])
    low, high = corners.min(axis=0), corners.max(axis=0)
    is_tilted = turn[2, 2] < _TILTED
    if kind == "topple":
        longest = int(np.argmax([one.model.length, one.model.width, one.model.height]))
        return bool(is_tilted and abs(turn[2, longest]) < _TILTED)
    if lies_ashore(one.noun, kind):
        return True
    is_vehicle = one.noun.motion in ("drive", "roll", "sail") and one.noun.habitat != "fixed"
    is_flat = (high - low)[2] <= _FLAT * (high - low)[:2].max()
    is_round = one.noun.motion == "roll" and one.model.height <= 1.1 * one.model.width
    return bool(is_tilted or is_round or (is_flat and not is_vehicle))


def is_stranded(one: Actor, place: PlaceModel) -> bool:
    """Whether what floats or swims is where no water is."""
    has_water = place.has_surface or place.ground in (Ground.UNDERWATER, Ground.NONE)
    is_open = not (place.is_room or place.is_backdrop)
    if lies_ashore(one.noun, one.track.at(0.0).activity):
        return False
    is_wet = one.noun.habitat == "water" or one.noun.name in AFLOAT
    return is_wet and is_open and not has_water and one.noun.motion not in ("walk", "crawl")


def _list_strays(
    one: Actor, place: PlaceModel, line: RoadLine, half_m: float, times: Sequence[float]
) -> Iterator[Violation]:
    """Faults of a body on the road, on its way over it, or in the water beside a shore."""
    corners = np.array([one.corners(time)[:, :2] for time in times])
    feet = line.across(corners.reshape(-1, 2)).reshape(len(times), -1).mean(axis=1)
    if place.has_road and zone_of(one.noun) == "pavement":
        gone = np.linalg.norm(one.middle(times[-1])[:2] - one.middle(times[0])[:2])
        is_beside = np.ptp(feet) < _CROSSING * gone or np.abs(feet).min() > half_m
        if one.goes_across and is_beside:
            yield Violation("direction", "across", "crossing the road")
        elif not one.goes_across and (np.abs(feet) < half_m - _SHALLOW_M).all():
            yield Violation("zone", "", "on the road")
    is_driving = zone_of(one.noun) == "road" and not one.track.is_resting
    off_m = line.distance(corners.mean(axis=1)) - half_m
    if place.has_road and is_driving and (off_m > _SHALLOW_M).any():
        yield Violation("zone", "", "driving on the road: it is beside it")
    if place.has_shore and one.noun.habitat == "ground" and one.noun.speed_m_s > 0.0:
        far_m = half_m or math.inf
        if ((feet > _SHALLOW_M - half_m) & (feet < far_m - _SHALLOW_M)).all():
            yield Violation("zone", "", "in the water")


def find_meeting(one: Actor, other: Actor, duration_s: float) -> float | None:
    """First instant at which the middle of one of two bodies is in the other, s; None: never.

    They are looked at where their ways come near each other.
    """
    times = np.linspace(0.0, duration_s, max(int(_PER_S * duration_s), 2) + 1)
    ways = [np.array([body.track.at(float(at)).position[:2] for at in times])
            for body in (one, other)]  # fmt: skip
    off = ways[1] - ways[0]
    steps = np.diff(off, axis=0)
    shares = -(off[:-1] * steps).sum(axis=1) / np.maximum((steps**2).sum(axis=1), 1e-12)
    nearest = off[:-1] + np.clip(shares, 0.0, 1.0)[:, None] * steps
    is_near = np.linalg.norm(nearest, axis=1) < 0.5 * (one.size_m + other.size_m)
    if (one.track.is_resting and other.track.is_resting) and is_near.any():
        is_near[1:] = False
    small, large = sorted((one, other), key=lambda body: body.size_m)
    for number in np.flatnonzero(is_near):
        for at in np.linspace(times[number], times[number + 1], _FINE_STEPS + 1):
            if _is_through(small, large, float(at)):
                return float(at)
    return None


def _is_through(small: Actor, large: Actor, time_s: float) -> bool:
    """Whether the middle of a body is in a part of a larger one."""
    corners = small.corners(time_s)
    low, high = corners.min(axis=0), corners.max(axis=0)
    middle, slim = 0.5 * (low + high), _SLIM * (high - low)
    box = large.corners(time_s)
    if (middle - slim > box.max(axis=0)).any() or (middle + slim < box.min(axis=0)).any():
        return False
    shapes = large.place(time_s)
    parts = np.array([bounds([part]) for part in moved(shapes.parts, shapes.to_world)])
    return bool(((parts[:, 0] < middle + slim) & (parts[:, 1] > middle - slim)).all(axis=1).any())


class _Bodies:
    """Boxes of actors and of their parts at the instants."""

    def __init__(
        self, description: SceneDescription, actors: Sequence[Actor], times: Sequence[float]
    ) -> None:
        self._description, self._actors, self._times = description, actors, times
        corners = np.array([[one.corners(time) for time in times] for one in actors])
        corners = corners.reshape(len(actors), len(times), 8, 3)
        self._low, self._high = corners.min(axis=2), corners.max(axis=2)
        self._parts: dict[tuple[int, int], Float64Array] = {}
        self._bound: Mapping[int, set[int]] = {n: {n} for n in range(len(description.objects))}
        for one in description.relations:
            for target in one.targets if one.kind in _SHARED else ():
                self._bound[one.subject].add(target)
                self._bound[target].add(one.subject)

    def needs_support(self, number: int) -> bool:
        """Whether a body rests on the ground or on another one."""
        one, said = (
            self._actors[number],
            self._description.objects[self._actors[number].object_index],
        )
        does = {motion.kind for motion in said.motions} | {one.noun.motion}
        acts = {relation.kind for relation in self._description.relations
                if one.object_index in relation.targets}  # fmt: skip
        acts |= {relation.kind for relation in self._description.relations
                 if one.object_index == relation.subject and relation.kind == "catch"}  # fmt: skip
        is_put = said.position_m is not None or said.height_m is not None
        is_drawn = one.noun.name in nouns_with("flat pattern") | nouns_with("flat picture")
        is_fixed = one.noun.habitat == "fixed" and one.size_m >= _HEAVY_M and not is_drawn
        free = _FREE - _AIRBORNE if is_fixed else _FREE
        is_free = is_drawn and any(motion.direction == "diagonal" for motion in said.motions)
        riders = [
            relation.subject
            for relation in self._description.relations
            if relation.kind in ("on", "ride") and one.object_index in relation.targets
        ]
        if trait_value("ridden", one.noun.name) == "on a board":  # it jumps with who is on it
            does |= {motion.kind for n in riders for motion in self._description.objects[n].motions}
        is_free |= bool(does & free) or bool(acts & (_IN_HAND | ACTED) - {"push", "pull"})
        is_body = one.noun.speed_m_s > 0.0 or one.noun.is_working or one.noun.habitat == "fixed"
        is_body &= one.noun.name not in nouns_with("may hang")
        is_mark = any(
            relation.kind == "on" and relation.subject == one.object_index
            and {one.noun.name, self._description.objects[relation.targets[0]].noun}
            <= nouns_with("flat pattern")
            for relation in self._description.relations
        )  # fmt: skip
        is_above = any(relation.kind == "above" and relation.subject == one.object_index
                       for relation in self._description.relations)  # fmt: skip
        return (
            one.noun.habitat in ("ground", "fixed") and one.track.anchor is None
            and not (is_put or is_free or is_mark) and (is_body or not is_above)
            and one.noun.name not in nouns_with("hangs from a ceiling")
        )  # fmt: skip

    def _list_parts(self, number: int, at: int) -> Float64Array:
        """[k, 2, 3] boxes around its parts at an instant, m."""
        if (number, at) not in self._parts:
            shapes = self._actors[number].place(self._times[at])
            parts = [bounds([part]) for part in moved(shapes.parts, shapes.to_world)]
            self._parts[number, at] = np.array(parts).reshape(-1, 2, 3)
        return self._parts[number, at]

    def _meets(self, low: Float64Array, high: Float64Array, number: int, at: int) -> bool:
        """Whether a part of a body is in a box at an instant."""
        if (low > self._high[number, at]).any() or (high < self._low[number, at]).any():
            return False
        parts = self._list_parts(number, at)
        return bool(((parts[:, 0] < high) & (parts[:, 1] > low)).all(axis=1).any())

    def _is_borne(self, number: int, at: int) -> bool:
        """Whether another body is below the middle of its foot, of a train below its ends."""
        low, high = self._low[number, at], self._high[number, at]
        middle, size = 0.5 * (low + high), high - low
        one = self._actors[number]
        if zone_of(one.noun) in ("road", "rails") and size[:2].max() > _LONG * size[:2].min():
            out = _END * size * (size == size[:2].max())
            ends = ((middle + way * out, 0.1 * size) for way in (-1.0, 1.0))
            return all(self._is_borne_at(number, at, *each) for each in ends)
        return self._is_borne_at(number, at, middle, size)

    def _is_borne_at(self, number: int, at: int, middle: Float64Array, size: Float64Array) -> bool:
        """Whether another body is below a place of its foot, about which it is so large."""
        low, tall = self._low[number, at], self._high[number, at, 2] - self._low[number, at, 2]
        foot = np.array([*(middle - _CENTRAL * size)[:2], low[2] - _ROOM_M - _ROOM * tall])
        top = np.array([*(middle + _CENTRAL * size)[:2], low[2] + 0.6 * tall])
        return any(
            self._meets(foot, top, other, at)
            for other, body in enumerate(self._actors)
            if other != number and body.track.anchor is None  # it may carry that one
        )

    def is_bound(self, number: int) -> bool:
        """Whether a relation says where it is."""
        index = self._actors[number].object_index
        is_put = self._description.objects[index].position_m is not None
        return is_put or self._bound[index] != {index}

    def is_alone(self, number: int) -> bool:
        """Whether nothing else bears it."""
        return not any(self._is_borne(number, at) for at in range(len(self._times)))

    def list_unborne(self, number: int, place: PlaceModel) -> Iterator[Violation]:
        """Faults of a body that hangs in the air or is under the ground."""
        index = self._actors[number].object_index
        is_dropped = any(one.kind == "into" and one.subject == index
                         and has_rim(self._description.objects[one.targets[0]].noun)
                         for one in self._description.relations)  # fmt: skip
        if place.ground in (Ground.NONE, Ground.UNDERWATER) or is_dropped:
            return
        if self.needs_support(number) and self._hangs(number):
            yield Violation("support", "", "above the ground with nothing below it")
        if place.ground is not Ground.SEA and not place.has_shore and self._sinks(number):
            yield Violation("support", "", "partly under the ground")

    def _hangs(self, number: int) -> bool:
        """Whether nothing is below it at some instants."""
        tall = self._high[number, :, 2] - self._low[number, :, 2]
        gaps: NDArray[np.bool_] = self._low[number, :, 2] > _ROOM_M + _ROOM * tall
        if self._actors[number].noun.name in PERSON_NOUNS and not gaps.all():
            return False  # it jumps
        return (
            sum(not self._is_borne(number, int(at)) for at in np.flatnonzero(gaps))
            >= _LEAST_INSTANTS
        )

    def _sinks(self, number: int) -> bool:
        """Whether a part of it is under the ground at some instants."""
        one = self._actors[number]
        if one.noun.habitat == "water" or one.track.anchor is not None:
            return False
        least = -_ROOM_M - _ROOM * (self._high[number, :, 2] - self._low[number, :, 2])
        low = np.flatnonzero(self._low[number, :, 2] < least)  # its box may lean out of its shape
        under = [one.lowest_m(self._times[int(at)]) < least[at] for at in low]
        return bool(sum(under) >= _LEAST_INSTANTS)

    def find_intersections(self) -> Iterator[Violation]:
        """Pairs of bodies, of which the middle of one is in the other.

        Those of stated places may meet for an instant, which the line names.
        """
        objects = self._description.objects
        is_put = [objects[one.object_index].position_m is not None for one in self._actors]
        alone = [n for n, one in enumerate(self._actors) if one.track.anchor is None]
        for first, second in itertools.combinations(alone, 2):
            one, other = self._actors[first], self._actors[second]
            is_shared = other.object_index in self._bound[one.object_index] - {one.object_index}
            if is_shared or {one.noun.name, other.noun.name} & nouns_with("passage"):
                continue
            pair = f"the {one.name} and the {other.name} apart: one goes through the other"
            if is_put[first] or is_put[second]:
                met_s = find_meeting(one, other, self._times[-1])
                if met_s is not None:
                    yield Violation("support", "", f"{pair} at {met_s:.2g} s")
                continue
            met = sum(self._cross(first, second, at) for at in range(len(self._times)))
            if met >= _LEAST_INSTANTS:
                yield Violation("support", "", pair)

    def _cross(self, first: int, second: int, at: int) -> bool:
        """Whether the middle of the smaller one is in a part of the other one."""
        small, large = sorted((first, second), key=lambda one: self._actors[one].size_m)
        low, high = self._low[small, at], self._high[small, at]
        middle, slim = 0.5 * (low + high), _SLIM * (high - low)
        return self._meets(middle - slim, middle + slim, large, at)
