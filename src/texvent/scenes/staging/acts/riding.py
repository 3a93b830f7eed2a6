"""Who rides what, and where seat, hands and feet are then."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from texvent.scenes.description import RIDES, Relation
from texvent.scenes.models.people.props import list_props
from texvent.scenes.models.protocol import Pose
from texvent.scenes.models.support_surface import find_support, top_heights
from texvent.scenes.models.traits import trait_value
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.acts import (
    Cast,
    Performed,
    hides_riders,
    is_person,
    scaled,
    size_of,
)
from texvent.scenes.staging.acts.holding import Grips
from texvent.scenes.staging.trajectories.trajectory import Riding, Trajectory, Vector

_ROOM_SHARE = 0.42
"""Share of its length on which people sit or stand."""
_SEAT_M, _SADDLE_M = 0.42, 0.10
"""Height of the hips over the origin of who sits, or sits astride, for an adult, m."""


def board(cast: Cast, relations: Sequence[Relation]) -> None:
    """Seat everybody who rides something.

    Several riders are shared out among several mounts; on one of them they sit behind each other.
    The first person on a bicycle is the one that its model brings; those in a closed vehicle are
    not seen.
    """
    crews: dict[int, list[int | None]] = {}
    seated: set[int] = set()
    for relation in (one for kind in RIDES for one in relations if one.kind == kind):
        mounts = cast.copies(relation.targets[0])
        for turn, rider in enumerate(cast.copies(relation.subject) if mounts else ()):
            at = mounts[turn % len(mounts)]
            crew = crews.setdefault(at, [])
            if relation.kind == "ride along" and not crew and style_of(cast.get(at)) == "built-in":
                crew.append(None)
            if rider != at and rider not in seated:
                crew.append(rider)
                seated.add(rider)
    for at, crew in crews.items():
        for number, one in enumerate(crew):
            if one is not None:
                _seat(cast, one, at, number, len(crew))


def _seat(cast: Cast, rider: int, at: int, number: int, crew: int) -> None:
    subject, ridden = cast.get(rider), cast.get(at)
    is_own = number == 0 and is_person(subject) and style_of(ridden) == "built-in"
    if is_own or hides_riders(ridden.noun):
        cast.put(rider, None)
    elif number < count_seats(ridden):
        cast.put(rider, mount(subject, ridden, number, crew))


def style_of(ridden: Actor) -> str:
    """How something is ridden; most is sat on."""
    return trait_value("ridden", ridden.noun.name) or "sat on"


def count_seats(ridden: Actor) -> int:
    """How many people it carries, the one who comes with its model among them."""
    seats = trait_value("seats", ridden.noun.name)
    if seats is not None:
        return len(seats)
    apart_m = trait_value("posture of riders", style_of(ridden))["apart"]
    return max(1, int(_ROOM_SHARE * ridden.model.length / apart_m))


def mount(rider: Actor, ridden: Actor, number: int = 0, crew: int = 1) -> Actor:
    """The rider, on what it rides.

    Args:
        rider: who rides.
        ridden: what it rides.
        number: of its seat, from 0; the first one is for who steers.
        crew: how many are on it.
    """
    style, size = style_of(ridden), size_of(rider.model)
    posture = trait_value("posture of riders", style)
    doing, props = "sit", rider.props
    grips: Grips = ()
    if not is_person(rider):
        seat: Vector = (0.0, 0.0, find_support(ridden.model).height + rider.foot_m)
    elif trait_value("seats", ridden.noun.name) is not None:
        seat, grips = _on_seat(ridden, size, number)
    else:
        behind = 0.5 * (min(crew, count_seats(ridden)) - 1) - number
        support, doing = find_support(ridden.model), posture["does"]
        x, y = support.middle
        seat = (x + behind * posture["apart"], y, support.height + posture["up"] * size)
        props = list_props(doing) if style == "paddled" and ridden.is_mover else ()
        if style == "astride":
            seat, grips = _astride_back(ridden, size, behind * posture["apart"])
        elif style == "at a bar":
            x, z = 0.42 * ridden.model.length, 0.9 * ridden.model.height
            seat = (-0.08, 0.0, 0.1 * ridden.model.height)
            grips = (("left hand", (x, 0.2, z)), ("right hand", (x, -0.2, z)))
    path: Trajectory = Riding(ridden.trajectory, seat, doing)
    if grips:
        path = Performed(path, None, grips)
    return replace(rider, trajectory=path, is_mover=ridden.is_mover, lead_m=0.0, props=props)


def _on_seat(ridden: Actor, size: float, number: int) -> tuple[Vector, Grips]:
    """In a seat of the vehicle, or on the saddle behind who steers."""
    name = ridden.noun.name
    x, y, z = scaled(trait_value("seats", name)[number], size_of(ridden.model))
    feet = trait_value("feet from the seat", name)
    if feet is None:
        return (x, y, z - _SEAT_M * size), ()
    return (x, y, z - _SADDLE_M * size), _astride(feet[0], feet[1], size)


def _astride_back(ridden: Actor, size: float, along_m: float) -> tuple[Vector, Grips]:
    """On the back, a leg on each side, hands ahead."""
    model = ridden.model
    parts = model.parts(Pose(0.0, 0.0, 0.0, "stand"))
    back = float(top_heights(parts, np.array([along_m]), np.array([0.0]))[0])
    if not np.isfinite(back):
        back = 0.5 * model.height
    across = np.linspace(0.0, 0.5 * model.width, 24)
    inside = across[top_heights(parts, np.zeros_like(across), across) > 0.6 * back]
    half = float(inside.max()) if inside.size else 0.2
    side = min(half + 0.07 * size, 0.45 * size)
    drop = -0.66 * size if half < 0.45 * size else -0.35 * size
    return (along_m, 0.0, back), _astride(side, drop, size)


def _astride(side: float, drop: float, size: float) -> Grips:
    """Hips, feet and hands of who has a leg on each side."""
    return (
        ("hips", (0.0, 0.0, 0.10 * size)),
        ("left foot", (0.14 * size, side, drop)),
        ("right foot", (0.14 * size, -side, drop)),
        ("left hand", (0.40 * size, 0.10 * size, 0.30 * size)),
        ("right hand", (0.40 * size, -0.10 * size, 0.30 * size)),
    )
