"""Who pushes, pulls or leads something: both move together."""

from __future__ import annotations

import math
from dataclasses import replace

from texvent.scenes.staging.actors import Actor, Tether
from texvent.scenes.staging.acts.acts import foot_of, is_person, shifted, size_of
from texvent.scenes.staging.acts.attached import HeldAt, Performed
from texvent.scenes.staging.acts.holding import Grips

_HITCH_M = 0.5
"""Between a vehicle and what it tows."""
_STRETCH = 0.60
"""From the shoulder to the palm of an arm that is nearly straight, m."""


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
    subject = _performing(subject, "push along", grips)
    return subject, _along(subject, target, reach + 0.02 + 0.5 * model.length)


def pull(subject: Actor, target: Actor) -> tuple[Actor, Actor]:
    """A rope from the hand, or from the rear of a vehicle, to the thing's front."""
    size, model = size_of(subject.model), target.model
    behind = 0.9 * size
    if subject.noun.motion == "drive":
        behind = 0.5 * subject.model.length + _HITCH_M
    hand = (-0.34 * size, -0.20 * size, 0.92 * size)
    subject = _performing(subject, "pull along", (("right hand", hand),))
    end = (0.5 * model.length, 0.0, 0.5 * model.height - foot_of(target))
    target = _along(subject, target, -(behind + 0.5 * model.length))
    return subject, replace(target, tether=Tether(subject, "right hand", end, 0.025))


def lead(subject: Actor, target: Actor) -> tuple[Actor, Actor]:
    """An animal on a leash before who walks it."""
    size, model = size_of(subject.model), target.model
    hand = (0.30 * size, -0.12 * size, size)
    subject = _performing(subject, None, (("right hand", hand),))
    neck = (0.30 * model.length, 0.0, 0.78 * model.height)
    target = _along(subject, target, 0.50 * size + 0.5 * model.length, "walk")
    return subject, replace(target, tether=Tether(subject, "right hand", neck, 0.014))


def _performing(subject: Actor, activity: str | None, grips: Grips) -> Actor:
    if not is_person(subject):
        return subject
    return replace(subject, trajectory=Performed(subject.trajectory, activity, grips))


def _along(subject: Actor, target: Actor, along_m: float, activity: str = "move") -> Actor:
    """The thing on the ground so far ahead of who moves it."""
    offset = shifted(along_m, 0.0, foot_of(target))
    path = HeldAt(subject, "ground", offset, is_upright=True, activity=activity)
    return replace(target, trajectory=path, lead_m=subject.lead_m, is_mover=subject.is_mover)
