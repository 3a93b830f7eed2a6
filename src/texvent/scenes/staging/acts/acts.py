"""Names of the acts of one object on another, bodies fixed to others, and facts about bodies."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.models.protocol import Noun
from texvent.scenes.models.shapes import Affine
from texvent.scenes.models.tables import nouns_with
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.trajectories.trajectory import (
    Attached,
    Trajectory,
    Vector,
    rotation,
)

SINGLE = frozenset({"kick", "throw", "collide"})
"""Acts with one instant of contact."""
ACTS = SINGLE | {"hold", "wear", "push", "ride"}
"""Relations that are acts of the subject on its first target."""


class Cast:
    """The actors by object, so that an act can replace them."""

    def __init__(self, actors: list[Actor]) -> None:
        self._actors: list[Actor | None] = list(actors)

    def copies(self, index: int) -> list[int]:
        """Positions of the copies of an object."""
        return [
            number
            for number, actor in enumerate(self._actors)
            if actor is not None and actor.object_index == index
        ]

    def get(self, number: int) -> Actor:
        """The actor at a position."""
        actor = self._actors[number]
        if actor is None:
            raise KeyError(number)
        return actor

    def put(self, number: int, actor: Actor | None) -> None:
        """Replace an actor; None takes it off the scene."""
        self._actors[number] = actor

    def actors(self) -> list[Actor]:
        """Those that are left, numbered anew."""
        left = [actor for actor in self._actors if actor is not None]
        return [replace(actor, instance=number) for number, actor in enumerate(left, start=1)]


def hides_riders(noun: Noun) -> bool:
    """Whether it is a closed vehicle."""
    return noun.habitat != "fixed" and noun.name in nouns_with("closed")


def is_person(actor: Actor) -> bool:
    """Whether it has hands."""
    return actor.noun.name in PERSON_NOUNS


def scaled(point: Vector, size: float) -> Vector:
    """A point of an adult's body on one of that size."""
    return (size * point[0], size * point[1], size * point[2])


def moving(actor: Actor, path: Trajectory) -> Actor:
    """The actor on another trajectory, with nothing in its hands."""
    return replace(actor, trajectory=path, is_mover=True, lead_m=0.0, props=())


def held_at(
    holder: Actor, anchor: str, offset: Affine, *, is_upright: bool = False, activity: str = "stand"
) -> Attached:
    """A trajectory fixed to a named place of a body: `offset` [3, 4] are axes at that place.

    What is upright faces as its holder does.
    """
    axes = partial(_upright, holder, anchor) if is_upright else partial(holder.anchor, anchor)
    return Attached(holder.trajectory, axes, offset, activity)


def _upright(holder: Actor, anchor: str, time_s: float) -> Float64Array:
    yaw = holder.trajectory.at(time_s).yaw
    return np.column_stack([rotation(yaw, 0.0, 0.0), holder.anchor(anchor, time_s)[:, 3]])
