"""Names of the acts of one object on another, bodies fixed to others, and facts about bodies."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.models.protocol import Model, Noun, Pose
from texvent.scenes.models.shapes import Affine, compose, shift
from texvent.scenes.models.tables import nouns_with
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.trajectories.trajectory import (
    Attached,
    Trajectory,
    Vector,
    rotation,
)

SINGLE = frozenset({"kick", "hit", "throw", "catch", "collide"})
"""Acts with one instant of contact."""
ACTS = SINGLE | {"hold", "carry", "wear", "push", "ride"}
"""Relations that are acts of the subject on its first target."""
_UPRIGHT = 0.7
"""Least z of a part's third axis for its axes to be those of what is on it."""


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


def on_part(carrier: Trajectory, model: Model, part: int, place: Vector, activity: str) -> Attached:
    """A trajectory fixed to a part that moves in another body: the board of a swing.

    `part` is its index in the model, `place` in the carrier's body coordinates at time 0, m.
    """
    axes = partial(_part_axes, carrier, model, part, np.array(place))
    return Attached(carrier, axes, shift(), activity)


def _part_axes(
    carrier: Trajectory, model: Model, part: int, place: Float64Array, time_s: float
) -> Affine:
    first, now = (_part_of(carrier, model, part, time) for time in (0.0, time_s))
    turn = now[:, :3] @ np.linalg.inv(first[:, :3])
    # A board's own axes say how far it is tipped; those of a rod say nothing of up.
    own = now[:, :3] / np.linalg.norm(now[:, :3], axis=0)
    tipped = own if own[2, 2] > _UPRIGHT else turn
    axes = np.column_stack([tipped, now[:, 3] + turn @ (place - first[:, 3])])
    return compose(carrier.at(time_s).to_world(), axes)


def _part_of(carrier: Trajectory, model: Model, part: int, time_s: float) -> Affine:
    """[3, 4] the part's map to the carrier's body coordinates."""
    state = carrier.at(time_s)
    pose = Pose(state.tempo * time_s, state.distance_m, state.speed_m_s, state.activity)
    return np.asarray(model.parts(pose)[part].to_body)
