"""What a person holds, wears, or has on the head, a shoulder, the back or the lap."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np

from texvent.scenes.models.animals.four_legged.clothing import (
    has_fitting_head,
    share_of_head,
    wears_on_trunk,
)
from texvent.scenes.models.shapes import Affine
from texvent.scenes.staging.actors import Actor, Tether
from texvent.scenes.staging.acts.attached import HeldAt, MovedAlong, Performed, Swaying
from texvent.scenes.staging.acts.hand_work.enlarged import Enlarged
from texvent.scenes.staging.acts.hand_work.working import WorkingAt
from texvent.scenes.staging.acts.holding import (
    GARMENTS,
    WORN,
    Grips,
    Hold,
    Wear,
    choose_hold,
    is_person,
    offset_of_worn,
    place_in_hold,
    size_of,
)
from texvent.scenes.staging.trajectories.trajectory import Trajectory, Vector


@dataclass(frozen=True)
class BodyPlace:
    """Where something is on a person, or on an animal."""

    anchor: str
    """Place of the body."""
    shift: Vector
    """From there to the foot of the thing's middle, m, for an adult."""
    is_behind: bool = False
    """Whether it hangs behind: half its length farther back."""


ON_BODY: Mapping[str, BodyPlace] = MappingProxyType(
    {
        "on head": BodyPlace("crown", (-0.03, 0.0, -0.01)),
        "on shoulder": BodyPlace("neck", (0.0, -0.23, -0.17)),
        "on back": BodyPlace("torso", (-0.13, 0.0, 0.02), is_behind=True),
        "on lap": BodyPlace("seat", (0.28, 0.0, 0.20)),
    }
)
"""Relation kind → place."""
_BAGS = frozenset({"bag", "handbag", "shopping bag", "guitar case"})
"""What hangs from the shoulder by a strap."""
_STRAP_M = 0.25
_AT_HEAD: Vector = (0.05, -0.24, 1.80)
"""Right hand of who steadies something on the head, adult's body coordinates, m."""


def put_on_body(kind: str, subject: Actor, target: Actor) -> tuple[Actor, Actor]:
    """The body with a hand at the thing where it needs one, and the thing in its place."""
    place, size = ON_BODY[kind], size_of(subject.model)
    x, y, z = (size * value for value in place.shift)
    if kind == "on shoulder" and math.cos(subject.trajectory.at(0.0).yaw) < 0.0:
        # The shoulder on the viewer's side.
        y = -y
    if kind == "on shoulder" and target.noun.name in _BAGS:
        z -= _STRAP_M * size + target.model.height
    if place.is_behind:
        x -= 0.10 * size if is_person(target) else 0.5 * target.model.length
    lift = 0.5 * target.model.height if target.is_centred else 0.0
    activity = "stand"
    if is_person(target):
        activity, z = "sit", z - 0.42 * size_of(target.model)
    offset = np.column_stack([np.eye(3), np.array([x, y, z + lift])])
    held = HeldAt(subject, place.anchor, offset, is_upright=True, activity=activity)
    if kind == "on head" and is_person(subject) and target.model.height < 0.9:
        hand = (size * _AT_HEAD[0], size * _AT_HEAD[1], size * _AT_HEAD[2])
        path = Performed(subject.trajectory, None, (("right hand", hand),))
        subject = replace(subject, trajectory=path)
    target = replace(target, trajectory=held, is_mover=subject.is_mover, lead_m=0.0, extras=())
    return subject, target


def wear(subject: Actor, target: Actor) -> tuple[Actor, Actor | None]:
    """Both, the thing at its place on the body; None for clothes, which the body has on."""
    if target.noun.name in GARMENTS and (is_person(subject) or subject.noun.motion == "drive"):
        return subject, None  # who rides a bicycle is of its model, in clothes of that
    if wears_on_trunk(subject.noun, target.noun.name):
        return subject, None
    place = WORN.get(target.noun.name, Wear("crown"))
    if place.place in ("foot", "hand"):
        side = "left" if target.instance % 2 else "right"
        place = replace(place, place=f"{side} {place.place}")
    if place.place in _AT_ANIMALS_HEAD and has_fitting_head(subject.noun):
        share = _LARGER * share_of_head(subject.model)
        target = replace(target, model=Enlarged(target.model, share))
        x, y, z = place.shift
        factor = share / size_of(subject.model)
        place = replace(place, shift=(factor * x, factor * y, factor * z))
    held = HeldAt(subject, place.place, offset_of_worn(place, subject, target))
    return subject, _carried(target, held, subject)


_LARGER = 1.25
"""How much larger than it fits what an animal has on its head is, so that it is seen."""
_AT_ANIMALS_HEAD = frozenset({"crown", "face", "head", "neck"})


def lead(subject: Actor, target: Actor) -> tuple[Actor, Actor]:
    """Both, an animal on a leash before who walks it."""
    size, model = size_of(subject.model), target.model
    floor = target.trajectory.at(0.0).position[2]
    along = 0.50 * size + 0.5 * model.length
    path = MovedAlong(subject.trajectory, along, floor, "walk")
    hand = (0.30 * size, -0.12 * size, 1.0 * size)
    subject = replace(
        subject, trajectory=Performed(subject.trajectory, None, (("right hand", hand),))
    )
    neck = (0.30 * model.length, 0.0, 0.78 * model.height)
    target = replace(target, trajectory=path, lead_m=subject.lead_m, is_mover=subject.is_mover,
                     tether=Tether(subject, "right hand", neck, 0.014))  # fmt: skip
    return subject, target


_HANDS_FREE = frozenset({"stand", "move", "walk", "run", "sit", "sit on ground"})
"""Activities that leave the hands to what they hold."""


def hold(subject: Actor, target: Actor) -> tuple[Actor, Actor]:
    """Both, the thing in the hands of who holds it."""
    works = isinstance(subject.trajectory, WorkingAt)
    way: Hold = Hold("tool") if works else choose_hold(subject, target)
    anchor, offset, is_upright, grips = place_in_hold(way, subject, target)
    doing = subject.trajectory.at(0.0).activity
    busy = works or doing not in _HANDS_FREE
    if doing in _SITS:
        offset, grips = _lower(subject, anchor, offset, grips)
    if is_person(subject) and not busy and grips:
        subject = replace(subject, trajectory=Performed(subject.trajectory, None, grips))
    if is_person(subject) and not busy and way.activity and not subject.is_mover:
        subject = replace(subject, trajectory=Performed(subject.trajectory, way.activity))
    is_kite = way.style == "kite"
    activity = "move" if is_kite or target.noun.name == "umbrella" else "stand"
    held = HeldAt(subject, anchor, offset, is_upright, activity, turns=not is_kite)
    target = _carried(target, Swaying(held) if is_kite else held, subject)
    if is_kite:
        target = replace(target, tether=Tether(subject, "right hand", (0.0, 0.0, 0.0), 0.008))
    return subject, target


_SITS = ("sit", "sit on ground")
_STANDING_TORSO = 0.95
"""Height of the foot of the torso of who stands, m, of an adult."""


def _lower(subject: Actor, anchor: str, offset: Affine, grips: Grips) -> tuple[Affine, Grips]:
    """Offset and grips of who sits, as much lower as the body is than that of who stands."""
    torso = float(subject.anchor("torso", 0.0)[2, 3] - subject.trajectory.at(0.0).position[2])
    drop = max(_STANDING_TORSO * size_of(subject.model) - torso, 0.0)
    if anchor == "ground":
        offset = np.column_stack([offset[:, :3], offset[:, 3] - (0.0, 0.0, drop)])
    return offset, tuple((hand, (x, y, z - drop)) for hand, (x, y, z) in grips)


def _carried(target: Actor, held: Trajectory, holder: Actor) -> Actor:
    return replace(target, trajectory=held, is_mover=holder.is_mover, lead_m=0.0, extras=())
