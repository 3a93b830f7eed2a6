"""Holding, wearing, riding and pushing: where bodies are fixed, and where hands are then."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from texvent.scenes.description import Relation
from texvent.scenes.models.anchors import find_support, top_heights
from texvent.scenes.models.people.outfit import CLOTHES, list_props
from texvent.scenes.models.protocol import Pose
from texvent.scenes.models.shapes import Affine, shift
from texvent.scenes.models.tables import nouns_with, trait_value
from texvent.scenes.staging.actors import Actor, Tether, size_of
from texvent.scenes.staging.acts.acts import (
    Cast,
    held_at,
    hides_riders,
    is_person,
    scaled,
)
from texvent.scenes.staging.trajectories.action_trajectories import hover
from texvent.scenes.staging.trajectories.trajectory import (
    Attached,
    Performed,
    Trajectory,
    Vector,
    rotation,
)

Grips = tuple[tuple[str, Vector], ...]

_STYLES = (
    "held as a tool", "held upright", "held up high", "held hanging", "held as a page",
    "held as a guitar", "held by a string", "flown on a string",
)  # fmt: skip
"""Traits that say how a noun is held."""
_LARGE_M = 0.36
"""What is larger is held in both arms."""
_RAISED: Vector = (0.30, -0.24, 1.16)
"""Right hand of who holds something up, adult's body coordinates, m."""
_UP_HIGH: Vector = (0.24, -0.24, 1.55)
_RIGHT_HAND = {
    "held as a tool": _RAISED, "held upright": _RAISED, "held by a string": _RAISED,
    "held up high": _UP_HIGH, "flown on a string": _UP_HIGH,
}  # fmt: skip
_HANDS_FREE = frozenset({"stand", "move", "walk", "run", "sit", "sit on ground"})
"""Activities that leave the hands to what they hold."""
_STANDING_TORSO = 0.95
"""Height of the foot of the torso of who stands, m, of an adult."""
_KITE_YAW = 0.3 - 0.5 * math.pi - 1.0
"""Heading of a kite whose face is turned to the camera."""
_SWAY_M = 0.28
"""How far the wind takes a kite to and fro, m."""
_STRING_M = 0.008
_STRETCH = 0.60
"""From the shoulder to the palm of an arm that is nearly straight, m."""

_ROOM_SHARE = 0.42
"""Share of its length on which people sit or stand."""
_SEAT_M, _SADDLE_M = 0.42, 0.10
"""Height of the hips over the origin of who sits, or sits astride, for an adult, m."""


class Hold(NamedTuple):
    """How a thing is fixed to a body."""

    anchor: str
    """Place of the holder."""
    offset: Affine
    """[3, 4] the thing's body coordinates in the axes of that place."""
    is_upright: bool = True
    """Whether the thing stays upright."""
    grips: Grips = ()
    """Where hands are, in the holder's body coordinates, m."""


def hold(subject: Actor, target: Actor) -> tuple[Actor, Actor]:
    """Both, the thing in the hands of who holds it."""
    style, doing = choose_style(subject, target), subject.trajectory.at(0.0).activity
    way = place_in_hold(style, subject, target)
    if doing in ("sit", "sit on ground"):
        way = _lower(subject, way)
    if is_person(subject) and doing in _HANDS_FREE:
        activity = None if subject.is_mover else trait_value("held to", target.noun.name)
        path = Performed(subject.trajectory, activity, way.grips)
        subject = replace(subject, trajectory=path)
    is_flown = style == "flown on a string"
    activity = "move" if target.noun.name in nouns_with("moves in the hand") else "stand"
    held: Trajectory = held_at(
        subject, way.anchor, way.offset, is_upright=way.is_upright, activity=activity
    )
    if is_flown:
        held = hover(held, _SWAY_M)
        tether = Tether(subject, "right hand", (0.0, 0.0, 0.0), _STRING_M)
        target = replace(target, tether=tether)
    return subject, carried(target, held, subject)


def wear(subject: Actor, target: Actor) -> tuple[Actor, Actor | None]:
    """Both, the thing at its place on the body; None for clothes, which the body has on."""
    if target.noun.name in CLOTHES:
        return subject, None
    worn = trait_value("worn", target.noun.name) or {"place": "crown"}
    turn = rotation(worn.get("yaw", 0.0), worn.get("pitch", 0.0), 0.0)
    x, y, z = scaled(worn.get("at", (0.0, 0.0, 0.0)), size_of(subject.model))
    offset = np.column_stack([turn, np.array([x, y, z + target.foot_m])])
    return subject, carried(target, held_at(subject, worn["place"], offset), subject)


def carried(target: Actor, held: Trajectory, holder: Actor) -> Actor:
    """The thing on a trajectory that its holder gives it."""
    return replace(target, trajectory=held, is_mover=holder.is_mover, lead_m=0.0)


def choose_style(holder: Actor, thing: Actor) -> str:
    """How a thing is held: as the traits say, else by its size and by who holds it."""
    if not is_person(holder):
        return "mouth"
    for style in _STYLES:
        if thing.noun.name in nouns_with(style):
            return style
    return "front" if thing.size_m > _LARGE_M else "held upright"


def place_in_hold(style: str, holder: Actor, thing: Actor) -> Hold:
    """Where a thing is that is held in one way or the other, and where the hands are."""
    size = size_of(holder.model)
    if style == "front":
        return _in_both_arms(thing, size)
    if style == "held as a page":
        # Flat before the chest, its face to the holder.
        x, y, z = 0.38 * size, min(0.45 * thing.model.width, 0.22 * size), 1.12 * size
        offset = np.column_stack([rotation(0.0, -1.0, 0.0), [0.42 * size, 0.0, 1.16 * size]])
        return Hold("ground", offset, grips=_both_hands(x, y, z))
    if style == "held as a guitar":
        turn = rotation(0.0, 0.0, -1.05)
        return Hold("torso", np.column_stack([turn, size * np.array([0.20, -0.42, -0.08])]), False)
    if style == "mouth":
        offset = shift(0.35 * thing.model.length, 0.0, -thing.lift_m)
        return Hold("mouth", offset, False)
    return _in_right_hand(style, holder, thing)


def _in_right_hand(style: str, holder: Actor, thing: Actor) -> Hold:
    model, size, foot = thing.model, size_of(holder.model), thing.foot_m
    grips: Grips = ()
    if style in _RIGHT_HAND:
        grips = (("right hand", scaled(_RIGHT_HAND[style], size)),)
    if style == "held as a tool":
        return Hold("right hand", along_tool(thing), False, grips)
    if style == "flown on a string":
        # Behind who goes on, beside who stands; its face to the camera.
        turn = rotation(-holder.trajectory.at(0.0).yaw, 0.0, 0.0)
        x, y, z = size * np.array([-1.0, 0.0, 0.8] if holder.is_mover else turn @ [1.0, 0.2, 0.8])
        axes = np.column_stack([turn @ rotation(_KITE_YAW, 0.0, 0.0), [x, y, z + foot]])
        return Hold("right hand", axes, grips=grips)
    below, x = min(0.35 * model.height, 0.06), 0.0
    if style == "held hanging":
        below = model.height - 0.02
    elif style == "held by a string":
        below = 0.02
    elif model.height < 1.6 * model.length:
        x = min(0.5 * model.length, 0.06)
    if holder.trajectory.at(0.0).activity == "drink":
        below = 0.8 * model.height  # so that the rim is at the mouth
    return Hold("right hand", shift(x, 0.0, foot - below), grips=grips)


def _in_both_arms(thing: Actor, size: float) -> Hold:
    """Both arms around it; its longer side goes across."""
    model = thing.model
    is_long = model.length > 1.2 * model.width
    deep, wide = (model.width, model.length) if is_long else (model.length, model.width)
    along = 0.16 * size + 0.5 * deep
    bottom = max(1.08 * size - 0.5 * model.height, 0.75 * size)
    z = min(max(bottom + 0.15 * model.height, 0.9 * size), 1.25 * size)
    turn = rotation(0.5 * math.pi if is_long else 0.0, 0.0, 0.0)
    offset = np.column_stack([turn, [along, 0.0, bottom + thing.foot_m]])
    grips = _both_hands(min(along, 0.42 * size), min(0.5 * wide, 0.34 * size), z)
    return Hold("ground", offset, grips=grips)


def _both_hands(x: float, y: float, z: float) -> Grips:
    return (("left hand", (x, y, z)), ("right hand", (x, -y, z)))


def _lower(subject: Actor, way: Hold) -> Hold:
    """The hold of who sits: as much lower as the body is than that of who stands."""
    torso = float(subject.anchor("torso", 0.0)[2, 3] - subject.trajectory.at(0.0).position[2])
    drop = max(_STANDING_TORSO * size_of(subject.model) - torso, 0.0)
    offset = way.offset
    if way.anchor == "ground":
        offset = np.column_stack([offset[:, :3], offset[:, 3] - (0.0, 0.0, drop)])
    grips = tuple((hand, (x, y, z - drop)) for hand, (x, y, z) in way.grips)
    return way._replace(offset=offset, grips=grips)


def along_tool(thing: Actor) -> Affine:
    """The handle in the hand, the rest along what the hand points to."""
    model = thing.model
    if model.width > 2.0 * max(model.length, model.height):
        # It lies along its y.
        return np.column_stack([rotation(0.0, 0.0, 0.5 * math.pi), [0.0, 0.0, 0.36 * model.width]])
    if model.length < 2.0 * model.height:
        return shift(0.0, 0.0, thing.foot_m - 0.12 * model.height)
    side = -1.0 if thing.noun.name in nouns_with("handle at the rear") else 1.0
    turn = rotation(0.0, 0.5 * math.pi * side, 0.0)
    return np.column_stack([turn, [0.0, 0.0, 0.38 * model.length]])


def push(subject: Actor, target: Actor) -> tuple[Actor, Actor]:
    """Hands at the thing's back."""
    size, model = size_of(subject.model), target.model
    shoulder = 1.38 * size if is_person(subject) else 0.75 * subject.model.height
    height = max(min(0.85 * model.height, 0.95 * shoulder), 0.64 * shoulder)
    reach = 0.5 * subject.model.length
    if is_person(subject):
        drop = 1.34 - height / size
        reach = size * (0.10 + math.sqrt(max(_STRETCH**2 - drop**2, 0.04)))
    side = min(0.16 * size, 0.45 * model.width)
    grips = (("left hand", (reach, side, height)), ("right hand", (reach, -side, height)))
    if is_person(subject):
        subject = replace(subject, trajectory=Performed(subject.trajectory, "push along", grips))
    return subject, _along(subject, target, reach + 0.02 + 0.5 * model.length)


def _along(subject: Actor, target: Actor, along_m: float) -> Actor:
    """The thing on the ground so far ahead of who moves it."""
    offset = shift(along_m, 0.0, target.foot_m)
    path = held_at(subject, "ground", offset, is_upright=True, activity="move")
    return replace(target, trajectory=path, lead_m=subject.lead_m, is_mover=subject.is_mover)


def board(cast: Cast, relations: Sequence[Relation]) -> None:
    """Seat everybody who rides something.

    Several riders are shared out among several mounts; on one of them they sit behind each other.
    The first person on a bicycle is the one that its model brings; those in a closed vehicle are
    not seen.
    """
    crews: dict[int, list[int]] = {}
    for relation in (one for one in relations if one.kind == "ride"):
        mounts = cast.copies(relation.targets[0])
        for turn, rider in enumerate(cast.copies(relation.subject) if mounts else ()):
            at = mounts[turn % len(mounts)]
            if rider != at and not any(rider in crew for crew in crews.values()):
                crews.setdefault(at, []).append(rider)
    for at, crew in crews.items():
        for number, rider in enumerate(crew):
            _seat(cast, rider, at, number, len(crew))


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
    path: Trajectory = Attached.seated(ridden.trajectory, seat, doing)
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
