"""Stated distances between things that stand on the same thing: they hold there as on the ground.

On a support a thing is beside, behind or before another along that side of it that leads most in
this direction, so that what stands on a narrow bench at an angle to the camera stays on it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

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

    @property
    def long(self) -> int:
        """Number of its longer side."""
        return int(np.argmax(self.sides))


def _frame_of(target: ObjectGroup, support: Support) -> _Frame:
    body = target.models[0]
    sides = np.subtract(support.high, support.low)
    if sides.max() <= 0.0:  # a ridge
        sides[int(body.width > body.length)] = 0.8 * max(body.width, body.length)
    middle = target.to_world(*support.middle, 0.0)[:2]
    return _Frame(target.noun.name, middle, _axes(target), sides)


@dataclass(frozen=True)
class Spacing:
    """All things on a support, some of them at stated distances from each other."""

    groups: Mapping[int, ObjectGroup]
    """Index → things on the support, in their order, each about (0, 0)."""
    links: tuple[IndexedRelation, ...]
    """Distances between them."""
    fixed: Mapping[int, Float64Array]
    """Index → place [2] of those that a position, or something elsewhere, decides, m."""

    def place(
        self, index: int, target: ObjectGroup, support: Support
    ) -> tuple[Float64Array, float]:
        """[2] from the middle of the support to that of a thing, world axes; length of all, m.

        Raises:
            NoRoomError: they do not fit.
        """
        frame = _frame_of(target, support)
        fixed = {n: frame.axes @ (place - frame.middle) for n, place in self.fixed.items()}
        blocks = [self._join(block, frame.axes) for block in self._blocks()]
        self._line_up([one for one in blocks if not fixed.keys() & one.keys()], frame)
        for block in (one for one in blocks if fixed.keys() & one.keys()):
            known = min(fixed.keys() & block.keys())
            _shift(block, fixed[known] - block[known])
        places = {n: place for block in blocks for n, place in block.items()}
        self._check(places, fixed, frame)
        low, high = self._extent(places, frame)
        return np.asarray(frame.axes.T @ places[index]), float((high - low)[frame.long])

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
        size = max(body.length, body.width)
        half[frame.long] += 0.7 * (len(group.models) - 1) * size
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
            is_said = n not in fixed or float(np.hypot(*(fixed[n] - place))) < _EXACT_M
            reach = np.minimum(self._half(n, frame), 0.5 * frame.sides)
            if not is_said or float((np.abs(place) + reach - 0.5 * frame.sides).max()) > _EXACT_M:
                raise NoRoomError(
                    f"the {self.groups[n].noun.name} would be beside the {frame.name}, which has "
                    f"room for {frame.sides[0]:.2f} by {frame.sides[1]:.2f} m"
                )
        for one in self.links:
            pair = one.subject, one.targets[0]
            off = places[pair[0]] - places[pair[1]]
            if float(np.hypot(*(off - _step(one, frame.axes)))) > _EXACT_M:
                raise NoRoomError("other distances on the same thing leave it no place")
            if float(np.hypot(*off)) < sum(_radius(self.groups[n]) for n in pair) - _EXACT_M:
                first, second = (self.groups[n].noun.name for n in pair)
                raise NoRoomError(f"the {first} and the {second} would go through each other")


def _radius(group: ObjectGroup) -> float:
    """Half of the shorter side of one body, m: nearer to its middle nothing else is."""
    body = group.models[0]
    radius = 0.5 * min(body.length, body.width)
    return min(radius, _PERSON_M) if group.noun.name in PERSON_NOUNS else radius


def _shift(block: dict[int, Float64Array], by: Float64Array) -> None:
    block.update({n: place + by for n, place in block.items()})


def _axes(target: ObjectGroup) -> Float64Array:
    """[2, 2] x and y of a support's body, world coordinates."""
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
    """Relations with a distance."""
    return (one for one in description.relations if one.distance_m is not None)


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
    is_tied = False
    for one in known:
        pair = one.subject, one.targets[0]
        for sign, own, other in ((1.0, *pair), (-1.0, *pair[::-1])):
            if own in members and other not in members and other in placed and own not in fixed:
                step = sign * (one.distance_m or 0.0) * np.array(SIDES[one.kind])
                fixed[own], is_tied = placed[other].middle[:2] + step, True
    if not links and not is_tied:
        return None
    # Those that are placed are turned already: all are taken as they come.
    return Spacing({n: build(n) for n in members}, tuple(links), fixed)


def list_unkept(
    description: SceneDescription, groups: Mapping[int, ObjectGroup]
) -> Iterator[tuple[IndexedRelation, str]]:
    """Relations whose distance placed objects do not have, and why."""
    for one in list_distances(description):
        pair = one.subject, one.targets[0]
        if any(n not in groups or description.objects[n].position_m for n in pair):
            continue
        off = (groups[pair[0]].middle - groups[pair[1]].middle)[:2]
        wanted = (one.distance_m or 0.0) * np.array(SIDES[one.kind])
        bearers = [bearer_of(description, n) for n in pair]
        if bearers[0] is not None and bearers[0] == bearers[1]:
            axes = _axes(groups[bearers[0][1][0]])
            off, wanted = axes @ off, _step(one, axes)
            off = np.where(
                wanted == 0.0, 0.0, off
            )  # people lean back as far as their legs let them
        is_kept = float(np.hypot(*(off - wanted))) < _EXACT_M
        if not is_kept:
            yield one, "other relations and positions decide where both are"
