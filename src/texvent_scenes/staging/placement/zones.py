"""Zones: road, pavement and rails, and who may stand where.

Things that nothing binds are moved to where their kind may be: what drives to its lane, opposite
ways in opposite lanes; what else is on the ground off the road and the rails, unless it crosses.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import replace

import numpy as np

from texvent_scenes.description import SceneDescription
from texvent_scenes.models.activities import PERSON_NOUNS
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.people.outfit import list_props
from texvent_scenes.models.places import PlaceModel, is_room
from texvent_scenes.models.protocol import Noun
from texvent_scenes.models.tables import nouns_with, trait_value
from texvent_scenes.rendered_scene import Float64Array, Ground
from texvent_scenes.spec.data import ACTED, WAYS
from texvent_scenes.spec.scene import SceneObject
from texvent_scenes.staging.actors import Actor, is_centred
from texvent_scenes.staging.surroundings.environment import is_afloat
from texvent_scenes.staging.surroundings.road_line import RoadLine, find_road
from texvent_scenes.staging.tracks.phases import PATH_KINDS

_CLEAR_M, _RAILS_M = 0.6, 1.3
"""From the edge of a road or of rails to what stands beside it; half the width of rails."""
_PARALLEL, _CROSSING = 0.35, 0.5
"""Sines of the angle to the road below which something goes along it, and above which it crosses.
"""
_SHORE_M = 1.2
"""From who stands at the shore to what floats."""
_INSTANTS = 9
_CARRYING = frozenset(
    {"on", "in", "hold", "wear", "act on", "ride", "towards", "from", "away from", *ACTED,
     "through", "around", *WAYS}
)  # fmt: skip
"""Relations that hang on how a body is turned."""
_ON_TOP = PATH_KINDS | {"stand", "sit", "sit down", "stand up", "lie", "jump", "climb", "spin"}
"""Motions of a person for which a thing is stood or sat upon."""
_LOOSE = frozenset({"beside", "front", "behind", "left of", "right of", "past", "towards", "with",
                    "away from", "at"})  # fmt: skip
"""Relations that hold as well where one of the two is moved to its zone."""


def zone_of(noun: Noun) -> str:
    """Zone of a noun on the ground: "road", "rails", "pavement", or "any" where it is free."""
    said = trait_value("zone", noun.name)
    if said is not None:
        return str(said)
    if noun.habitat not in ("ground", "fixed"):
        return "any"
    return "road" if noun.motion == "drive" else "pavement"


def are_driven(*nouns: str) -> bool:
    """Whether all are vehicles of the road."""
    return all(one in NOUNS and zone_of(NOUNS[one]) == "road" for one in nouns)


def hangs_on(noun: str, target: str) -> bool:
    """Whether what is on another thing hangs on its face, as a clock does on a wall."""
    return noun in nouns_with("hangs on a wall") and target in nouns_with("only a background")


def is_before_face(who: SceneObject, what: SceneObject) -> bool:
    """Whether a person does something at the face of a thing, such as a board, not on top of it."""
    does = {motion.kind for motion in who.motions}
    is_person = who.noun in PERSON_NOUNS and what.noun in nouns_with("upright")
    return is_person and bool(does) and not does & _ON_TOP


def list_orphans(description: SceneDescription) -> Iterator[int]:
    """Objects that a room has no place for, or that a person would hold or wear.

    Of the latter the scene says nothing more.
    """
    objects, place = description.objects, description.place.name
    for number, one in enumerate(objects if place is not None and is_room(place) else ()):
        if one.noun in nouns_with("larger than a room"):
            yield number
    bound = {n for one in description.relations if one.kind != "with"
             for n in (one.subject, *one.targets)}  # fmt: skip
    bound |= {n for n in (description.index(description.camera.target),) if n is not None}
    if not any(one.noun in PERSON_NOUNS | nouns_with("person on a vehicle") for one in objects):
        return
    kinds = {motion.kind for one in objects for motion in one.motions}
    used = {noun for kind in kinds for prop in list_props(kind) if prop.is_own
            for noun in prop.nouns}  # fmt: skip
    for number, one in enumerate(objects):
        rests = {motion.kind for motion in one.motions} <= {"stand"}
        is_placed = one.position_m is not None or one.height_m is not None
        is_loose = one.noun in nouns_with("in hand or on something") and number not in bound
        is_loose &= one.noun not in used  # the scarf that is knitted
        if is_loose and rests and not is_placed and one.placement is None:
            yield number


def keep_to_zones(
    description: SceneDescription, place: PlaceModel, actors: Sequence[Actor], duration_s: float
) -> list[Actor]:
    """The actors, those that nothing binds moved to where they may be."""
    relations, said = description.relations, description.objects
    fixed = {
        number for number, one in enumerate(actors)
        if one.track.anchor is not None or said[one.object_index].position_m is not None
    }  # fmt: skip
    carried = {n for one in relations if one.kind in _CARRYING for n in (one.subject, *one.targets)}
    units = _list_units(description, actors)
    work = _Zones(
        list(actors), [unit for unit in units if fixed.isdisjoint(unit)],
        [n for n, one in enumerate(actors) if n not in fixed and one.object_index not in carried],
        {n for one in relations for n in (one.subject, *one.targets)}, duration_s,
    )  # fmt: skip
    if place.ground not in (Ground.NONE, Ground.UNDERWATER):
        work.keep_above_ground(n for n in range(len(actors)) if n not in fixed)
    if any(zone_of(one.noun) == "rails" for one in actors):
        work.clear_rails()
    if place.has_shore:
        work.keep_ashore(place.road_m if place.ground is Ground.RIVER else 0.0)
    if place.has_road and any(zone_of(one.noun) == "road" or one.goes_across for one in actors):
        work.use_lanes(0.5 * place.road_m, find_road(description, place, work.actors, 0.0))
        held = [n for unit in units if not fixed.isdisjoint(unit) for n in unit]
        work.clear_of(held, find_road(description, place, work.actors, 0.0), place.road_m)
        road = find_road(description, place, work.actors, 0.0)
        work.lead_across(road)
        work.clear_strip(road, place.road_m)
    return work.actors


def _list_units(description: SceneDescription, actors: Sequence[Actor]) -> list[list[int]]:
    """Numbers of the actors that relations hold together."""
    unit = list(range(len(description.objects)))
    zones = {one.object_index: "across" if one.goes_across else zone_of(one.noun) for one in actors}
    for one in description.relations:
        for target in one.targets:
            both = {zones.get(target), zones.get(one.subject)}
            is_near = one.kind in _LOOSE and one.distance_m is None
            if is_near and len(both) > 1 and both & {"pavement", "across"}:
                continue
            old, new = unit[target], unit[one.subject]
            unit = [new if each == old else each for each in unit]
    alone = {n for n in unit if unit.count(n) == 1}
    groups: dict[tuple[int, int], list[int]] = {}
    for number, actor in enumerate(actors):
        own = unit[actor.object_index]
        # Copies of one object that nothing binds stand each by themselves.
        groups.setdefault((own, number if own in alone else -1), []).append(number)
    return list(groups.values())


def _beyond(taken: list[tuple[float, float]], low: float, high: float) -> float:
    """Metres to where an interval meets none that is taken, which it then is too."""
    step = 0.0
    for begin, end in sorted(taken):
        if low + step < end + 0.3 and high + step > begin - 0.3:
            step = end + 0.3 - low
    taken.append((low + step, high + step))
    return step


def _keeps_afloat(one: Actor) -> bool:
    """Whether it is no body on land: it floats, swims or flies."""
    return is_afloat(one) or one.noun.habitat not in ("ground", "fixed")


class _Zones:
    """Moves actors, one kind after the other."""

    def __init__(
        self,
        actors: list[Actor],
        units: Sequence[list[int]],
        turned: Sequence[int],
        related: Collection[int],
        duration_s: float,
    ) -> None:
        self.actors, self._units, self._turned, self._related = actors, units, turned, related
        self._free = {unit[0] for unit in units if len(unit) == 1}
        self._times = np.linspace(0.0, duration_s, _INSTANTS)

    def _zone(self, number: int) -> str:
        return zone_of(self.actors[number].noun)

    def _move(self, number: int, shift: Float64Array, yaw: float | None = None) -> None:
        """Move the track of an actor over the ground, m, and turn it at rest."""
        one = self.actors[number]
        x, y, z = one.track.start
        track = replace(one.track, start=(x + float(shift[0]), y + float(shift[1]), z))
        track = track if yaw is None else replace(track, yaw=yaw)
        self.actors[number] = replace(one, track=track)

    def clear_rails(self) -> None:
        """Others stand off the line of the first train."""
        train = next(one for one in self.actors if zone_of(one.noun) == "rails")
        x, y, _ = train.middle(0.0)
        self.clear_strip(RoadLine(train.track.at(0.0).yaw, (float(x), float(y))), _RAILS_M)

    def use_lanes(self, lane_m: float, road: RoadLine) -> None:
        """The other lane takes oncoming traffic, and objects at rest while others drive.

        Those that go the same way do so one behind the other.
        """
        drivers = [n for n in self._turned if self._zone(n) == "road"]
        goers = [n for n in drivers if self.actors[n].is_mover]
        first = next(iter(goers), next(iter(drivers), None))
        if first is None:
            return
        angle = self.actors[first].track.at(0.0).yaw if first in goers else 0.0
        if first not in goers:
            is_back = math.cos(self.actors[first].track.yaw - road.angle) < 0.0
            angle = road.angle + (math.pi if is_back else 0.0)
        home = self.actors[first].middle(0.0)
        line = RoadLine(angle, (float(home[0]), float(home[1])))
        ends = {1.0: self._ends_m(first, line, 1.0)[0]}
        for number in drivers:
            one = self.actors[number]
            turn = one.track.at(0.0).yaw - angle
            is_bound = number not in self._free or number == first
            if not one.is_mover and one.track.is_resting:
                if not is_bound and goers:
                    turn = math.pi
                elif number in self._free and any(each.goes_across for each in self.actors):
                    self._wait(number, road, lane_m)
                    continue
                yaw = angle if math.cos(turn) >= 0.0 else angle + math.pi
                self._move(number, np.zeros(2), yaw)
            elif abs(math.sin(turn)) > _PARALLEL or one.track.terms:
                continue
            if not is_bound and (one.is_mover or math.cos(turn) < 0.0):
                self._line_up(number, line, lane_m, math.copysign(1.0, math.cos(turn)), ends)
        self._keep_on_road([] if goers else drivers, lane_m, road)

    def _keep_on_road(self, drivers: Sequence[int], lane_m: float, road: RoadLine) -> None:
        """Vehicles at rest stand on the edge of the road at most, one behind the other."""
        along = np.array([math.cos(road.angle), math.sin(road.angle)])
        taken: dict[float, list[tuple[float, float]]] = {-1.0: [], 1.0: []}
        resting = [n for n in drivers if not self.actors[n].is_mover]
        for number in resting:
            one = self.actors[number]
            limit = max(2.0 * lane_m - 0.5 * one.model.width, 0.0)
            across = float(road.across(np.array([one.middle(0.0)[:2]]))[0])
            shift = math.copysign(min(abs(across), limit), across) - across
            rear, front = self._ends_m(number, road, 1.0)
            step = _beyond(taken[math.copysign(1.0, across)], float(rear[0]), float(front[0]))
            self._move(number, shift * np.array([-along[1], along[0]]) + step * along)

    def _line_up(
        self,
        number: int,
        line: RoadLine,
        lane_m: float,
        way: float,
        ends: dict[float, Float64Array],
    ) -> None:
        """Move a vehicle to its lane, behind those that go the same way.

        Args:
            number: of the actor.
            line: the middle of the first lane.
            lane_m: half the width of a lane.
            way: 1 along the line, -1 against it.
            ends: way → rear end of the last one, m along the way, [instants]; this one's is put in.
        """
        one = self.actors[number]
        rear, front = self._ends_m(number, line, way)
        step = min(float((ends[way] - front).min()) - 2.0 * _CLEAR_M, 0.0) if way in ends else 0.0
        across = float(line.across(np.array([one.middle(0.0)[:2]]))[0])
        shift = lane_m - way * lane_m - across
        along = np.array([math.cos(line.angle), math.sin(line.angle)])
        self._move(number, shift * np.array([-along[1], along[0]]) + step * way * along)
        ends[way] = rear + step

    def _ends_m(self, number: int, line: RoadLine, way: float) -> tuple[Float64Array, Float64Array]:
        """Rear and front end of an actor, m along a way of a line: two times [instants]."""
        along = way * np.array([math.cos(line.angle), math.sin(line.angle)])
        places = [self.actors[number].corners(time)[:, :2] @ along for time in self._times]
        return np.min(places, axis=1), np.max(places, axis=1)

    def _wait(self, number: int, road: RoadLine, lane_m: float) -> None:
        """A vehicle at rest waits for those who cross, facing them, behind others that wait."""
        crossers = [one for one in self.actors if one.goes_across]
        away = road.angle + (0.0 if math.sin(road.angle) >= 0.0 else math.pi)
        along = np.array([math.cos(away), math.sin(away)])
        waiting = [one for one in self.actors[:number] if self._rests_on_road(one)]
        ways = [one.middle(time)[:2] for one in (*crossers, *waiting) for time in self._times]
        ends = [0.5 * one.size_m for one in waiting]
        one = self.actors[number]
        ahead_m = max(float((way - road.offset) @ along) for way in ways) + sum(ends[-1:])
        goal = np.array(road.offset) + lane_m * np.array([-along[1], along[0]])
        goal += (ahead_m + 0.5 * one.size_m + 2.0 * _CLEAR_M) * along
        self._move(number, goal - one.middle(0.0)[:2], away + math.pi)

    @staticmethod
    def _rests_on_road(one: Actor) -> bool:
        return zone_of(one.noun) == "road" and not one.is_mover

    def clear_strip(self, line: RoadLine, half_m: float) -> None:
        """Things that belong beside a road or rails stand there, on the far side."""
        left = np.array([-math.sin(line.angle), math.cos(line.angle)])
        along = np.array([math.cos(line.angle), math.sin(line.angle)])
        taken: list[tuple[float, float]] = []
        for unit in self._units:
            members = [self.actors[number] for number in unit]
            is_beside = all(self._zone(number) == "pavement" for number in unit)
            if not is_beside or any(self._crosses(one, line) for one in members):
                continue
            corners = np.vstack(
                [one.corners(time)[:, :2] for one in members for time in self._times]
            )
            across = line.across(corners)
            if across.min() >= half_m or across.max() <= -half_m:
                continue
            side = math.copysign(1.0, left[1]) if abs(left[1]) > 0.1 else 1.0
            mean = float(across.mean())
            if members[0].object_index in self._related and abs(mean) > 0.4 * half_m:
                side = math.copysign(1.0, mean)
            edge = across.min() if side > 0.0 else across.max()
            shift = (side * (half_m + _CLEAR_M) - float(edge)) * left
            places = (corners - line.offset) @ along
            low, high = float(places.min()), float(places.max())
            step = _beyond(taken, low, high)
            for number in unit:
                self._move(number, shift + step * along)

    def clear_of(self, held: Sequence[int], line: RoadLine, half_m: float) -> None:
        """Traffic, and the road with it, passes beyond who is on foot and holds something."""
        left = np.array([-math.sin(line.angle), math.cos(line.angle)])
        side = math.copysign(1.0, left[1]) if abs(left[1]) > 0.1 else 1.0
        drivers = [n for n in range(len(self.actors)) if self._zone(n) == "road"]
        feet = [
            side * line.across(self.actors[n].corners(time)[:, :2])
            for n in held for time in self._times
            if self._zone(n) == "pavement" and not self._crosses(self.actors[n], line)
        ]  # fmt: skip
        movable = {number for unit in self._units for number in unit}
        far_m = max((float(one.max()) for one in feet), default=-math.inf)
        near_m = min((float(one.min()) for one in feet), default=math.inf)
        if not movable.issuperset(drivers) or far_m <= -half_m or near_m >= half_m:
            return
        for number in drivers:
            self._move(number, side * (far_m + half_m + _CLEAR_M) * left)

    def keep_above_ground(self, numbers: Iterable[int]) -> None:
        """Flights that begin and end no lower than on the ground."""
        for number in numbers:
            one = self.actors[number]
            lows = [one.lowest_m(time) for time in self._times] if is_centred(one.noun) else [0.0]
            if min(lows) < -_CLEAR_M and one.noun.habitat == "air":
                x, y, z = one.track.start
                track = replace(one.track, start=(x, y, z - min(lows)))
                self.actors[number] = replace(one, track=track)

    def keep_ashore(self, half_m: float) -> None:
        """Bodies on the ground, put on the near side of all that floats or swims."""
        afloat = [one for one in self.actors if is_afloat(one)]
        if not afloat:
            return
        edge = min(float(one.corners(0.0)[:, 1].min()) for one in afloat) - half_m - _SHORE_M
        for unit in self._units:
            members = [self.actors[number] for number in unit]
            is_on_foot = any(one.noun.habitat == "ground" for one in members)
            if is_on_foot and not any(map(_keeps_afloat, members)):
                corners = np.vstack([one.corners(time) for one in members for time in self._times])
                far = float(corners[:, 1].max())
                for number in unit if far > edge else ():
                    self._move(number, np.array([0.0, edge - far]))

    def lead_across(self, line: RoadLine) -> None:
        """Those who cross do so at right angles, beyond where vehicles come."""
        along = np.array([math.cos(line.angle), math.sin(line.angle)])
        driven = [one for one in self.actors if zone_of(one.noun) == "road"]
        if not any(one.is_mover for one in driven):
            return
        corners = np.vstack([one.corners(time)[:, :2] for one in driven for time in self._times])
        free_m = float(((corners - line.offset) @ along).max()) + _CLEAR_M
        for number in sorted(self._free):
            one, middle_s = self.actors[number], 0.5 * float(self._times[-1])
            if self._zone(number) != "pavement" or not one.goes_across or one.track.terms:
                continue
            free_m += 0.5 * one.size_m
            turned = replace(one.track, yaw=line.angle + math.copysign(0.5 * math.pi, along[0]))
            self.actors[number] = replace(one, track=turned)
            goal = np.array(line.offset) + free_m * along
            self._move(number, goal - np.array(turned.at(middle_s).position[:2]))
            free_m += 0.5 * one.size_m + _CLEAR_M

    def _crosses(self, one: Actor, line: RoadLine) -> bool:
        """Whether it goes across the line."""
        if one.goes_across:
            return True
        gone = one.middle(float(self._times[-1]))[:2] - one.middle(0.0)[:2]
        way = float(np.hypot(*gone))
        turn = math.atan2(gone[1], gone[0]) - line.angle
        return way > 0.5 and abs(math.sin(turn)) > _CROSSING
