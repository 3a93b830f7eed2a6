"""Two who do something together: they stand before each other, and hands meet."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from texvent.scenes.description import Relation
from texvent.scenes.models.anchors import locate
from texvent.scenes.models.people.activities import PAIR_GAPS
from texvent.scenes.models.people.timing import ease
from texvent.scenes.staging.actors import Actor, Tether
from texvent.scenes.staging.acts.attached import HeldAt
from texvent.scenes.staging.acts.cast import Cast
from texvent.scenes.staging.acts.holding import is_person, size_of
from texvent.scenes.staging.trajectories.trajectory import (
    BodyState,
    Stationary,
    Trajectory,
    Vector,
)

GIVEN_S = 1.0
_SWAY_M = {"wrestle": 0.12, "tug of war": 0.16, "box": 0.06}
"""How far two push or pull each other to and fro, m."""
_SWAY_HZ = 0.45
_TUGGING = "tug of war"
_OF_ANIMALS = ("fight", _TUGGING)
"""What two animals do before each other."""
_ROPE_SHARE, _ROPE_M = 0.22, 0.03
"""Half of the rope between two animals, in their lengths, and its radius in their heights."""
_TIED = frozenset({"at", "on", "in", "work on", "ride", "ride along", "push", "pull", "give"})
"""Relations that give their subject its heading."""
_TURNING_RAD_S = {"tango": 1.5}
_OPEN_RAD = 0.22
"""How far two who talk are turned to the viewer out of facing each other, rad."""
_OPEN = frozenset({"argue"})


@dataclass(frozen=True)
class Facing:
    """One of two who face each other about a middle, which may move or turn them."""

    middle: Vector
    yaw: float
    """Heading towards the other at the start."""
    half_m: float
    activity: str
    tempo: float = 1.0
    sway_m: float = 0.0
    """To and fro along the world's x."""
    turn_rad_s: float = 0.0
    open_rad: float = 0.0

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        angle = self.yaw + self.turn_rad_s * self.tempo * time_s
        x, y, z = self.middle
        x += self.sway_m * math.sin(2.0 * math.pi * _SWAY_HZ * self.tempo * time_s)
        place = (x - self.half_m * math.cos(angle), y - self.half_m * math.sin(angle), z)
        return BodyState(place, angle + self.open_rad, activity=self.activity, tempo=self.tempo)


@dataclass(frozen=True)
class Passed:
    """From one hand to another about `GIVEN_S`."""

    before: Trajectory
    after: Trajectory

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        share = ease(time_s, GIVEN_S - 0.15, GIVEN_S + 0.15)
        first, last = self.before.at(time_s), self.after.at(time_s)
        x, y, z = (a + share * (b - a) for a, b in zip(first.position, last.position, strict=True))
        turn = math.remainder(last.yaw - first.yaw, 2.0 * math.pi)
        return replace(first, position=(x, y, z), yaw=first.yaw + share * turn)


def face_each_other(cast: Cast, numbers: list[int]) -> None:
    """Those who do the same in their place, and what two do together, stand before each other.

    Args:
        cast: the actors; those of pairs are replaced.
        numbers: positions of the actors that no other act moves.
    """
    waiting: dict[str, int] = {}
    for number in numbers:
        actor = cast.get(number)
        path = actor.trajectory
        is_able = is_person(actor) or (
            isinstance(path, Stationary) and path.activity in _OF_ANIMALS
        )
        if not (isinstance(path, Stationary) and is_able):
            continue
        kind = path.activity if path.activity in (*PAIR_GAPS, *_OF_ANIMALS) else ""
        if not kind or kind in ("give", "receive"):
            continue
        if kind not in waiting:
            waiting[kind] = number
            continue
        first = waiting.pop(kind)
        one, other = _face(cast.get(first), actor, (kind, kind))
        if kind == _TUGGING and not is_person(one):
            other = _tied_by_mouth(other, one)
        cast.put(first, one)
        cast.put(number, other)


def look_at(cast: Cast, relations: Sequence[Relation], duration_s: float) -> None:
    """Who stays in its place turns to what it looks at, where that is at mid clip.

    Args:
        cast: the actors, as they are placed; those who look are replaced.
        relations: of the scene.
        duration_s: length of the clip, s.
    """
    tied = {one.subject for one in relations if one.kind in _TIED}
    for relation in relations:
        is_facing = relation.kind == "look at" or relation.way == "opposite"
        if not is_facing or relation.subject in tied:
            continue
        goals = [number for target in relation.targets for number in cast.copies(target)]
        if relation.targets == (relation.subject,):
            goals = goals[1:] + goals[:1]
        for turn, number in enumerate(cast.copies(relation.subject) if goals else ()):
            actor = cast.get(number)
            path = actor.trajectory
            if isinstance(path, Stationary):
                goal = cast.get(goals[turn % len(goals)]).middle(0.5 * duration_s)
                yaw = math.atan2(goal[1] - path.home[1], goal[0] - path.home[0])
                cast.put(number, replace(actor, trajectory=replace(path, yaw=yaw)))
                if relation.way == "opposite":
                    _turn_back(cast, goals[turn % len(goals)], yaw + math.pi)


_BACK_M = 0.16
"""From the middle of who leans to the back, for an adult, m."""


def lean_on(cast: Cast, relations: Sequence[Relation]) -> None:
    """Who leans against something before it has the back at it."""
    for relation in relations:
        if relation.kind != "front" or relation.way != "against":
            continue
        wall = cast.get(cast.copies(relation.targets[0])[0])
        deep = 0.5 * min(wall.model.length, wall.model.width)
        x, y, _ = wall.trajectory.at(0.0).position
        people = cast.copies(relation.subject)
        for turn, number in enumerate(people):
            actor, path = cast.get(number), cast.get(number).trajectory
            if not isinstance(path, Stationary) or path.activity != "lean":
                continue
            size = size_of(actor.model)
            aside = 0.8 * (turn - 0.5 * (len(people) - 1))
            home = (x + aside, y - deep - _BACK_M * size, path.home[2])
            cast.put(number, replace(actor, trajectory=replace(path, home=home)))


def _turn_back(cast: Cast, number: int, yaw: float) -> None:
    """Who is faced, and stays in its place, faces the other."""
    actor, path = cast.get(number), cast.get(number).trajectory
    if isinstance(path, Stationary) and actor.noun.habitat == "ground":
        cast.put(number, replace(actor, trajectory=replace(path, yaw=yaw)))


def hand_over(giver: Actor, thing: Actor, taker: Actor) -> tuple[Actor, Actor, Actor]:
    """The thing goes from the one's right hand to the other's.

    Args:
        giver: a person in its place.
        thing: what is given; a small one.
        taker: another person in its place.
    """
    ways = [one.trajectory for one in (giver, taker)]
    if not all(isinstance(way, Stationary) for way in ways):
        return giver, thing, taker
    if not (is_person(giver) and is_person(taker)):
        return giver, thing, taker
    giver, taker = _face(giver, taker, ("give", "receive"))
    lift = 0.5 * thing.model.height if thing.is_centred else 0.0
    offset = np.column_stack([np.eye(3), np.array([0.04, 0.0, lift - 0.25 * thing.model.height])])
    before, after = (HeldAt(one, "right hand", offset, is_upright=True) for one in (giver, taker))
    return giver, replace(thing, trajectory=Passed(before, after), is_mover=True), taker


def _tied_by_mouth(actor: Actor, other: Actor) -> Actor:
    """A rope from mouth to mouth."""
    x, y, z = (float(v) for v in locate(actor.model, "mouth", actor.pose(0.0))[:, 3])
    return replace(actor, tether=Tether(other, "mouth", (x, y, z), _ROPE_M * actor.model.height))


def _face(one: Actor, other: Actor, kinds: tuple[str, str]) -> tuple[Actor, Actor]:
    """Left and right of the middle between them, as they are placed; fronts to each other."""
    places = [np.array(actor.trajectory.at(0.0).position) for actor in (one, other)]
    x, y, z = (float(value) for value in 0.5 * (places[0] + places[1]))
    size = 0.5 * (size_of(one.model) + size_of(other.model))
    half = 0.5 * PAIR_GAPS.get(kinds[0], 1.0) * size
    if not is_person(one):
        half = 0.25 * (one.model.length + other.model.length) + _ROPE_SHARE * one.model.length
    is_left = places[0][0] <= places[1][0]
    pair = []
    for actor, kind, is_first in ((one, kinds[0], True), (other, kinds[1], False)):
        path = actor.trajectory
        tempo = path.tempo if isinstance(path, Stationary) else 1.0
        yaw = 0.0 if is_first == is_left else math.pi
        towards = -_OPEN_RAD if yaw == 0.0 else _OPEN_RAD
        facing = Facing(
            (x, y, z), yaw, half, kind, tempo, _SWAY_M.get(kind, 0.0) * size,
            _TURNING_RAD_S.get(kind, 0.0), towards if kind in _OPEN else 0.0,
        )  # fmt: skip
        pair.append(replace(actor, trajectory=facing, lead_m=0.0, is_mover=True))
    return pair[0], pair[1]
