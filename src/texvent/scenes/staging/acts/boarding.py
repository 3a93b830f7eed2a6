"""Who sits where: the riders, drivers and passengers of everything that is ridden."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from texvent.scenes.description import RIDES, Relation
from texvent.scenes.models.machine_acts import LIFT
from texvent.scenes.models.protocol import Model, Pose
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.attached import HeldAt, OnPart
from texvent.scenes.staging.acts.cast import Cast
from texvent.scenes.staging.acts.holding import GARMENTS, HOLDS, is_person, size_of
from texvent.scenes.staging.acts.riding import LOADS, MOUNTS, mount
from texvent.scenes.staging.trajectories.trajectory import Trajectory, Vector, rotation


def board(cast: Cast, relations: Sequence[Relation]) -> None:
    """Seat everybody who rides something.

    Several riders are shared out among several mounts; on one of them they sit behind each other.
    Each sits on one, the first that is named.
    The first person on a bicycle or a motorcycle is the one that its model brings.
    """
    crews: dict[int, list[int | None]] = {}
    rides = [one for kind in RIDES for one in relations if one.kind == kind]
    for relation in rides:
        mounts = cast.copies(relation.targets[0])
        riders = cast.copies(relation.subject) if mounts else []
        for turn, rider in enumerate(riders):
            at = mounts[turn % len(mounts)]
            crew = crews.setdefault(at, [])
            if relation.kind == "ride along" and not crew and _has_own_rider(cast, at):
                crew.append(None)
            if rider != at and rider not in crew:
                crew.append(rider)
    seated: set[int] = set()
    for at, seats in crews.items():
        for seat, one in enumerate(seats):
            if one is not None and one not in seated:
                seated.add(one)
                _seat(cast, one, at, seat, len(seats))


def _has_own_rider(cast: Cast, at: int) -> bool:
    mount_ = MOUNTS.get(cast.get(at).noun.name)
    return mount_ is not None and mount_.style == "built-in"


STOWED = frozenset({"hold", "carry", "wear"})
"""Acts of a rider that a vehicle's model shows, by which the vehicle has the thing."""


def stow(cast: Cast, relation: Relation, at: int) -> None:
    """Give what a vehicle's own rider has its place: on the carrier, on the back, in the hand."""
    vehicle = cast.get(at)
    for number in cast.copies(relation.targets[0])[:1]:
        thing = cast.get(number)
        if thing.noun.name in GARMENTS:
            cast.put(number, None)
            continue
        scale = size_of(vehicle.model)
        place = _place_of(relation.kind, thing, vehicle.noun.name)
        x, y, z = (scale * value for value in place.at)
        lift = 0.5 * thing.model.height if thing.is_centred else 0.0
        turn = rotation(place.yaw, place.pitch, 0.0)
        offset = np.column_stack([turn, np.array([x, y, z + lift])])
        path: Trajectory = HeldAt(vehicle, "ground", offset)
        if vehicle.trajectory.at(0.0).activity == LIFT:
            forks = _find_raised(vehicle.model)
            path = OnPart(vehicle.trajectory, vehicle.model, forks, (x, y, z + lift), "stand")
        cast.put(
            number,
            replace(thing, trajectory=path, is_mover=vehicle.is_mover, lead_m=0.0, extras=()),
        )


def _find_raised(model: Model) -> int:
    """The first part that goes up where a load is lifted."""
    low, high = (model.parts(Pose(time_s, 0.0, 0.0, LIFT)) for time_s in (0.0, 2.0))
    rises = (b.to_body[2, 3] > a.to_body[2, 3] for a, b in zip(low, high, strict=True))
    return next((number for number, one in enumerate(rises) if one), 0)


def load(cast: Cast, relations: Sequence[Relation]) -> None:
    """As in "a bicycle with a basket": the vehicle carries it along."""
    for relation in relations:
        vehicles = cast.copies(relation.subject)
        things = cast.copies(relation.targets[0])
        if relation.kind != "with" or not vehicles or not things:
            continue
        name, thing = cast.get(vehicles[0]).noun.name, cast.get(things[0])
        most = _LOAD_ON_FORKS_M if name == "forklift" else _LOAD_M
        is_load = thing.noun.motion == "stand" and thing.size_m < most
        if is_load and (name in LOADS or name in _ON_RACK):
            stow(cast, relation, vehicles[0])


_LOAD_M = 1.0
_LOAD_ON_FORKS_M = 1.8


class _Stowage(NamedTuple):
    """Where something is on a vehicle with its own rider, m and radians."""

    at: Vector
    pitch: float = 0.0
    yaw: float = 0.0


_ON_BACK = {"bicycle": _Stowage((-0.26, 0.0, 1.02), 0.60, math.pi),
            "motorcycle": _Stowage((-0.42, 0.0, 0.88), 0.55, math.pi)}  # fmt: skip
_ON_HEAD = {"bicycle": (0.15, 0.0, 1.66), "motorcycle": (0.13, 0.0, 1.64)}
_IN_HAND = {"bicycle": (0.40, -0.26, 1.04), "motorcycle": (0.34, -0.34, 1.04)}
_ON_CARRIER = {"bicycle": (0.66, 0.0, 0.74), "motorcycle": (-0.88, 0.0, 0.86)}
_ON_RACK = {"bicycle": (-0.62, 0.0, 0.80), "motorcycle": (-0.88, 0.0, 0.86)}


def is_stowed(cast: Cast, relation: Relation) -> bool:
    """Whether the vehicle has what its rider is said to have; a driver holds small things."""
    if relation.kind not in STOWED or relation.subject not in cast.stood_in:
        return False
    if not cast.copies(relation.subject):
        return True
    things = [cast.get(number).noun.name for number in cast.copies(relation.targets[0])]
    return relation.kind != "wear" and all(
        name not in HOLDS or HOLDS[name].style == "hanging" for name in things
    )


def _place_of(kind: str, thing: Actor, vehicle: str) -> _Stowage:
    """Worn on the back or the head, small in the hand, else on a carrier: a basket in front."""
    name = thing.noun.name
    if vehicle in LOADS:
        return _Stowage(LOADS[vehicle])
    if name == "backpack":
        # Its own front is at the wearer's back.
        return _ON_BACK[vehicle]
    if kind == "wear":
        return _Stowage(_ON_HEAD[vehicle])
    if name in HOLDS and HOLDS[name].style in ("tool", "upright", "string", "kite", "page"):
        return _Stowage(_IN_HAND[vehicle])
    return _Stowage((_ON_CARRIER if name in _IN_FRONT else _ON_RACK)[vehicle])


_IN_FRONT = frozenset({"basket", "bag", "handbag", "flower", "bouquet", "shopping bag"})


def _seat(cast: Cast, rider: int, at: int, seat: int, crew: int) -> None:
    subject = cast.get(rider)
    if seat == 0 and is_person(subject) and _has_own_rider(cast, at):
        cast.stood_in[subject.object_index] = at
        cast.put(rider, None)
        return
    if cast.get(at).noun.name in LOADS:
        cast.stood_in[subject.object_index] = at
    cast.put(rider, mount(subject, cast.get(at), seat, crew))
