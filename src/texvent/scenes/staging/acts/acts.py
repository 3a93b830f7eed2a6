"""Names of the acts of one object on another, and small facts about bodies that all acts need."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from texvent.scenes.description import RIDES
from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.models.protocol import Model, Noun
from texvent.scenes.models.shapes import Affine
from texvent.scenes.models.traits import nouns_with
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.trajectories.trajectory import Vector

SINGLE = frozenset({"kick", "hit", "throw", "catch", "collide"})
"""Acts with one instant of contact."""
ACTS = SINGLE | {"hold", "carry", "wear", "push", "pull", *RIDES}
"""Relations that are acts of the subject on its first target."""


class Cast:
    """The actors by object, so that an act can replace them."""

    def __init__(self, actors: list[Actor]) -> None:
        self._actors: list[Actor | None] = list(actors)
        self.stood_in: dict[int, int] = {}
        """Object whose body a vehicle's own rider shows → position of the vehicle."""

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


def size_of(model: Model) -> float:
    """Scale of a model: 1 = the usual size."""
    return float(getattr(model, "scale", 1.0))


def lift_of(thing: Actor) -> float:
    """Height of its middle above its origin, m."""
    return 0.0 if thing.is_centred else 0.5 * thing.model.height


def foot_of(thing: Actor) -> float:
    """Height of its origin above its lowest point, m."""
    return 0.5 * thing.model.height if thing.is_centred else 0.0


def shifted(x: float, y: float, z: float) -> Affine:
    """[3, 4] a translation, m."""
    return np.column_stack([np.eye(3), np.array([x, y, z])])


def scaled(point: Vector, size: float) -> Vector:
    """A point of an adult's body on one of that size."""
    return (size * point[0], size * point[1], size * point[2])


def vector(values: Float64Array) -> Vector:
    """Three numbers of an array as a tuple of floats."""
    return (float(values[0]), float(values[1]), float(values[2]))
