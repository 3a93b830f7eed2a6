"""Stated distances between things that stand on the same thing: they hold there as on the ground.

On a support a thing is beside, behind or before another along that side of it that leads most in
this direction, so that what stands on a narrow bench at an angle to the camera stays on it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from texvent_scenes.description import IndexedRelation, SceneDescription
from texvent_scenes.models.activities import PERSON_NOUNS
from texvent_scenes.models.anchors import Support
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.staging.placement.object_groups import ObjectGroup

SIDES = {"left of": (-1.0, 0.0), "right of": (1.0, 0.0), "behind": (0.0, 1.0),
         "front": (0.0, -1.0), "beside": (1.0, 0.0)}  # fmt: skip
"""Relation with a distance → where its subject is, seen from the target, on the ground."""
RESTING = ("on", "in")
"""Relations to what bears a thing."""
_EXACT_M = 1e-4
_PERSON_M = 0.25
"""Half of the room of a person on something."""


class Spot(NamedTuple):
    """Place of a thing among others on a support."""

    place: Float64Array
    """[2] from the middle of the support, world axes, m."""
    length_m: float
    """Length of all things together along the longer side."""
    ends_m: tuple[float, float]
    """By how much all may go along the support, back and ahead, m."""


class NoRoomError(Exception):
    """A distance for which there is no room; its text says why."""


@dataclass(frozen=True)
class _Frame:
    """A support: its axes, and the room on it."""

    name: str
    middle: Float64Array
    """[2] world, m."""
    axes: Float64Array
    """[2, 2] x and y of its body, world coordinates."""
    sides: Float64Array
    """[2] extents along them, m."""
    body: Float64Array
    """[2] extents of the whole thing, m."""

    @property
    def long(self) -> int:
        """Number of its longer side."""
        return int(np.argmax(self.sides))


def _frame_of(target: ObjectGroup, support: Support) -> _Frame:
    body = target.models[0]
    sides = np.subtract(support.high, support.low)
    if sides.max() <= 0.0:  # a ridge
        sides[int(body.width > body.length)] = 0.8 * max(body.width, body.length)
    if target.plan.motion.kind == "spin":
        sides[:] = sides.min()
    middle = target.to_world(*support.middle, 0.0)[:2]
    return _Frame(
        target.noun.name, middle, _axes(target), sides, np.array([body.length, body.width])
    )


@dataclass(frozen=True)
class Spacing:
    """All things on a support, some of them at stated distances from each other."""

    groups: Mapping[int, ObjectGroup]
    """Index → things on the support, in their order, each about (0, 0)."""
    links: tuple[IndexedRelation, ...]
    """Distances between them."""
    fixed: Mapping[int, Float64Array]
    """Index → place [2] of those that a position, or something elsewhere, decides, m."""
    tied: frozenset[int] = frozenset()
    """Those of which something elsewhere does."""

    def place(self, index: int, target: ObjectGroup, support: Support) -> Spot:
        """Place of a thing: where it is at time 0 if the scene states any of them.

        Raises:
            NoRoomError: they do not fit.
        """
        frame = _frame_of(target, support)
        middle = frame.middle + target.lag_m
        fixed = {n: frame.axes @ (place - middle) for n, place in self.fixed.items()}
        blocks = [self._join(block, frame.axes) for block in self._blocks()]
        bound = [one for one in blocks if fixed.keys() & one.keys()]
        for block in bound:
            known = min(fixed.keys() & block.keys())
            _shift(block, fixed[known] - block[known])
        self._make_way(bound, [one for one in blocks if not fixed.keys() & one.keys()], frame)
        places = {n: place for block in blocks for n, place in block.items()}
        self._check(places, fixed, frame)
        low, high = self._extent(places, frame)
        ends = -0.5 * frame.sides[0] - low[0], 0.5 * frame.sides[0] - high[0]
        return Spot(
            np.asarray(frame.axes.T @ places[index]), float((high - low)[frame.long]),
            (min(float(ends[0]), 0.0), max(float(ends[1]), 0.0)),
        )  # fmt: skip

    def _make_way(
        self, bound: Sequence[dict[int, Float64Array]], free: Sequence[dict[int, Float64Array]],
        frame: _Frame,
    ) -> None:  # fmt: skip
        """Put free blocks where bound ones leave room: each into the middle of the largest gap."""
        self._line_up(free, frame)
        taken = [self._extent(one, frame) for one in bound]
        for block in free:
            low, high = self._extent(block, frame)
            if any((low < far).all() and (high > near).all() for near, far in taken):
                half = 0.5 * float(frame.sides[frame.long])
                spans = sorted((float(near[frame.long]), float(far[frame.long]))
                               for near, far in taken)  # fmt: skip
                gaps = pairwise([(-half, -half), *spans, (half, half)])
                left, right = max(((one[1], other[0]) for one, other in gaps),
                                  key=lambda gap: gap[1] - gap[0])  # fmt: skip
                shift = np.zeros(2)
                shift[frame.long] = 0.5 * (left + right - (low + high)[frame.long])
                _shift(block, shift)
            taken.append(self._extent(block, frame))

    def _line_up(self, blocks: Sequence[dict[int, Float64Array]], frame: _Frame) -> None:
        """Put blocks one after the other along the longer side, at even gaps."""
        extents = [self._extent(one, frame) for one in blocks]
        room, long = float(frame.sides[frame.long]), frame.long
        needed = sum(float((high - low)[long]) for low, high in extents)
        if needed > room + _EXACT_M:
            raise NoRoomError(
                f"there is room for {room:.2f} m on the {frame.name}, and {needed:.2f} m are needed"
            )
        gap = (room - needed) / max(len(blocks), 1)
        at = 0.5 * (gap - room)
        for block, (low, high) in zip(blocks, extents, strict=True):
            shift = -0.5 * (low + high)
            shift[long] = at - low[long]
            at += float((high - low)[long]) + gap
            _shift(block, shift)

    def _blocks(self) -> list[list[int]]:
        """Things that distances join, each block in the order of its first."""
        blocks = [[index] for index in self.groups]
        for one in self.links:
            first, other = (next(block for block in blocks if index in block)
                            for index in (one.subject, one.targets[0]))  # fmt: skip
            if first is not other:
                first += other
                blocks.remove(other)
        return sorted(blocks, key=min)

    def _join(self, block: Sequence[int], axes: Float64Array) -> dict[int, Float64Array]:
        """Places of the things of a block about that of its first, axes of the support."""
        found = {block[0]: np.zeros(2)}
        for _ in block:
            for one in self.links:
                step = _step(one, axes)
                subject, target = one.subject, one.targets[0]
                if target in found and subject not in found:
                    found[subject] = found[target] + step
                elif subject in found and target not in found:
                    found[target] = found[subject] - step
        return found

    def _half(self, index: int, frame: _Frame) -> Float64Array:
        """[2] half the extent of a thing, with its copies, axes of the support, m."""
        group = self.groups[index]
        body = group.models[0]
        turn = frame.axes @ np.array([math.cos(group.plan.yaw), math.sin(group.plan.yaw)])
        along, across = abs(turn)
        half = 0.5 * np.array([along * body.length + across * body.width,
                               across * body.length + along * body.width])  # fmt: skip
        if group.noun.name in PERSON_NOUNS:
            half = np.minimum(half, _PERSON_M)
        half[frame.long] += _row(group)
        return np.asarray(half)

    def _extent(
        self, block: Mapping[int, Float64Array], frame: _Frame
    ) -> tuple[Float64Array, Float64Array]:
        """Least and greatest corner of a block."""
        halves = {n: self._half(n, frame) for n in block}
        low = np.min([place - halves[n] for n, place in block.items()], axis=0)
        high = np.max([place + halves[n] for n, place in block.items()], axis=0)
        return low, high

    def _check(
        self, places: Mapping[int, Float64Array], fixed: Mapping[int, Float64Array], frame: _Frame
    ) -> None:
        """Refuse distances that contradict each other, places beside the support, and overlap."""
        for n, place in places.items():
            if n in fixed and float(np.hypot(*(fixed[n] - place))) > _EXACT_M:
                raise NoRoomError("position_m has them elsewhere")
            reach = np.minimum(self._half(n, frame), 0.5 * frame.sides)
            is_derived = n not in fixed or n in self.tied
            if is_derived and float((np.abs(place) + reach - 0.5 * frame.sides).max()) > _EXACT_M:
                raise NoRoomError(
                    f"the {self.groups[n].noun.name} would be beside the {frame.name}, which has "
                    f"room for {frame.sides[0]:.2f} by {frame.sides[1]:.2f} m"
                )
        for one in self.links:
            pair = one.subject, one.targets[0]
            off = places[pair[0]] - places[pair[1]]
            if float(np.hypot(*(off - _step(one, frame.axes)))) > _EXACT_M:
                raise NoRoomError("other distances on the same thing leave it no place")
            is_along = int(np.argmax(np.abs(off))) == frame.long
            groups = [self.groups[n] for n in pair]
            least_m = sum(_radius(group) + _row(group) * is_along for group in groups)
            if float(np.hypot(*off)) < least_m - _EXACT_M:
                first, second = (group.noun.name for group in groups)
                raise NoRoomError(f"the {first} and the {second} would go through each other")


def _radius(group: ObjectGroup) -> float:
    """Half of the shorter side of one body, m: nearer to its middle nothing else is."""
    body = group.models[0]
    radius = 0.5 * min(body.length, body.width)
    return min(radius, _PERSON_M) if group.noun.name in PERSON_NOUNS else radius


def _row(group: ObjectGroup) -> float:
    """From the middle of a row of copies to that of its last one, m."""
    body = group.models[0]
    return 0.7 * (len(group.models) - 1) * max(body.length, body.width)


def _shift(block: dict[int, Float64Array], by: Float64Array) -> None:
    block.update({n: place + by for n, place in block.items()})


def _axes(target: ObjectGroup) -> Float64Array:
    """[2, 2] x and y of a support's body, world coordinates; those of the world if it spins."""
    if target.plan.motion.kind == "spin":
        return np.eye(2)
    cosine, sine = math.cos(target.plan.yaw), math.sin(target.plan.yaw)
    return np.array([[cosine, sine], [-sine, cosine]])


def _step(relation: IndexedRelation, axes: Float64Array) -> Float64Array:
    """[2] from the target of a relation to its subject, along one side of the support, m."""
    way = axes @ np.array(SIDES[relation.kind])
    step = np.zeros(2)
    side = int(np.argmax(np.abs(way)))
    step[side] = math.copysign(relation.distance_m or 0.0, way[side])
    return step


def list_distances(description: SceneDescription) -> Iterator[IndexedRelation]:
    """Relations beside another thing with a distance."""
    return (one for one in description.relations
            if one.distance_m is not None and one.kind in SIDES)  # fmt: skip


def bearer_of(description: SceneDescription, index: int) -> tuple[str, tuple[int, ...]] | None:
    """Relation by which an object rests on others, and these."""
    return next(((one.kind, one.targets) for one in description.relations
                 if one.subject == index and one.kind in RESTING), None)  # fmt: skip


def list_awaited(description: SceneDescription, index: int) -> Iterator[int]:
    """Things on others at a distance from which something stands that nothing bears."""
    if bearer_of(description, index) is not None or description.objects[index].position_m:
        return
    for one in list_distances(description):
        pair = (one.subject, one.targets[0])
        for own, other in (pair, pair[::-1]):
            if own == index and bearer_of(description, other) is not None:
                yield other


def plan_spacing(
    description: SceneDescription,
    neighbours: Sequence[int],
    placed: Mapping[int, ObjectGroup],
    build: Callable[[int], ObjectGroup],
) -> Spacing | None:
    """The distances of things that rest on the same one; None where none is said."""
    members = dict.fromkeys(neighbours)
    known = [one for one in list_distances(description)
             if {one.subject, one.targets[0]} & members.keys()]  # fmt: skip
    links = [one for one in known if {one.subject, one.targets[0]} <= members.keys()]
    fixed = {n: np.array(said, dtype=np.float64) for n in members
             if (said := description.objects[n].position_m) is not None}  # fmt: skip
    tied = set[int]()
    for one in known:
        pair = one.subject, one.targets[0]
        for sign, own, other in ((1.0, *pair), (-1.0, *pair[::-1])):
            if own in members and other not in members and other in placed and own not in fixed:
                step = sign * (one.distance_m or 0.0) * np.array(SIDES[one.kind])
                fixed[own] = placed[other].begin + step
                tied.add(own)
    if not links and not fixed:
        return None
    # Those that are placed are turned already: all are taken as they come.
    return Spacing({n: build(n) for n in members}, tuple(links), fixed, frozenset(tied))


def list_unkept(
    description: SceneDescription, groups: Mapping[int, ObjectGroup]
) -> Iterator[tuple[IndexedRelation, str]]:
    """Relations whose distance placed objects do not have, and why."""
    for one in list_distances(description):
        pair = one.subject, one.targets[0]
        if any(n not in groups for n in pair):
            continue
        stated = sum(description.objects[n].position_m is not None for n in pair)
        off = groups[pair[0]].begin - groups[pair[1]].begin
        wanted = (one.distance_m or 0.0) * np.array(SIDES[one.kind])
        if one.kind == "beside" and off[0] < 0.0:
            wanted = -wanted
        bearers = [bearer_of(description, n) for n in pair]
        if bearers[0] is not None and bearers[0] == bearers[1]:
            axes = _axes(groups[bearers[0][1][0]])
            off, wanted = axes @ off, _step(one, axes)
            off = np.where(
                wanted == 0.0, 0.0, off
            )  # people lean back as far as their legs let them
        is_kept = float(np.hypot(*(off - wanted))) < _EXACT_M
        if not is_kept:
            x, y = (round(float(value), 3) + 0.0 for value in off)
            why = "other relations and positions decide where both are"
            yield one, f"position_m puts them ({x:g}, {y:g}) m apart" if stated == 2 else why


def list_beside(
    description: SceneDescription, groups: Mapping[int, ObjectGroup]
) -> Iterator[tuple[int, str]]:
    """Things with a stated position that is beside what they are on or in, and why."""
    for n, group in groups.items():
        if description.objects[n].position_m is None or group.bearer is None:
            continue
        target, support = group.bearer
        frame = _frame_of(target, support)
        off = frame.axes @ (group.begin - frame.middle - target.lag_m)
        room = np.maximum(0.5 * frame.sides, 0.25 * frame.body) + _EXACT_M
        if (np.abs(off) > room).any():
            low, high = (frame.middle + target.lag_m + sign * np.abs(frame.axes.T @ room)
                         for sign in (-1.0, 1.0))  # fmt: skip
            ends = (f"({x:.2f}, {y:.2f})" for x, y in (low, high))
            yield n, f"which is beside the {frame.name}: that has room from {' to '.join(ends)} m"


def borne_places(description: SceneDescription, index: int) -> list[tuple[float, float]]:
    """Stated positions of the things that an object bears, and of who rides it, m."""
    borne = dict.fromkeys(one.subject for one in description.relations
                          if one.kind in (*RESTING, "ride") and index in one.targets)  # fmt: skip
    places = (description.objects[n].position_m for n in borne)
    return [one for one in places if one is not None]


def is_measured(description: SceneDescription, index: int) -> bool:
    """Whether things on an object have positions or distances in metres."""
    on_it = {n for n in range(len(description.objects))
             if index in (bearer_of(description, n) or ("", ()))[1]}  # fmt: skip
    apart = (one for one in list_distances(description)
             if {one.subject, one.targets[0]} <= on_it)  # fmt: skip
    return bool(borne_places(description, index)) or any(apart)
