"""Names of the acts of one object on another, bodies fixed to others, and facts about bodies."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from texvent.scenes.description import RIDES
from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.models.protocol import Model, Noun, Pose
from texvent.scenes.models.shapes import Affine, compose
from texvent.scenes.models.traits import nouns_with
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.trajectories.trajectory import (
    BodyState,
    Trajectory,
    Vector,
    rotation,
    state_of,
)

SINGLE = frozenset({"kick", "hit", "throw", "catch", "collide"})
"""Acts with one instant of contact."""
ACTS = SINGLE | {"hold", "carry", "wear", "push", "pull", *RIDES}
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


def size_of(model: Model) -> float:
    """Scale of a model: 1 = the usual size."""
    return float(getattr(model, "scale", 1.0))


def scaled(point: Vector, size: float) -> Vector:
    """A point of an adult's body on one of that size."""
    return (size * point[0], size * point[1], size * point[2])


def vector(values: Float64Array) -> Vector:
    """Three numbers of an array as a tuple of floats."""
    return (float(values[0]), float(values[1]), float(values[2]))


def moving(actor: Actor, path: Trajectory) -> Actor:
    """The actor on another trajectory, with nothing in its hands."""
    return replace(actor, trajectory=path, is_mover=True, lead_m=0.0, props=())


@dataclass(frozen=True)
class HeldAt:
    """Fixed to a named place of another body."""

    holder: Actor
    anchor: str
    offset: Affine
    """[3, 4] its body coordinates in the axes of that place."""
    is_upright: bool = False
    """Whether it stays upright, facing as its holder does."""
    activity: str = "stand"
    turns: bool = True
    """Whether its axes turn with its holder, where it is upright."""

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        axes = self.holder.anchor(self.anchor, time_s)
        holder = self.holder.trajectory.at(time_s)
        if self.is_upright:
            yaw = holder.yaw if self.turns else 0.0
            axes = np.column_stack([rotation(yaw, 0.0, 0.0), axes[:, 3]])
        state = state_of(compose(axes, self.offset))
        return replace(
            state,
            distance_m=holder.distance_m,
            speed_m_s=holder.speed_m_s,
            activity=self.activity,
        )


@dataclass(frozen=True)
class OnPart:
    """At a fixed place of a part that moves in another body: the board of a swing."""

    carrier: Trajectory
    model: Model
    part: int
    """Index into the model's parts."""
    place: Vector
    """In the carrier's body coordinates when the clip begins, m."""
    activity: str = "sit"

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        first, now = self._part(0.0), self._part(time_s)
        turn = now[:, :3] @ np.linalg.inv(first[:, :3])
        x, y, z = now[:, 3] + turn @ (np.array(self.place) - first[:, 3])
        # A board's own axes say how far it is tipped; those of a rod say nothing of up.
        axes = now[:, :3] / np.linalg.norm(now[:, :3], axis=0)
        tipped = axes if axes[2, 2] > _UPRIGHT else turn
        placed = compose(self.carrier.at(time_s).to_world(), np.column_stack([tipped, [x, y, z]]))
        return replace(state_of(placed), activity=self.activity)

    def _part(self, time_s: float) -> Affine:
        """[3, 4] the part's map to the carrier's body coordinates."""
        state = self.carrier.at(time_s)
        pose = Pose(state.tempo * time_s, state.distance_m, state.speed_m_s, state.activity)
        return np.asarray(self.model.parts(pose)[self.part].to_body)


@dataclass(frozen=True)
class Performed:
    """Another trajectory whose body does something in particular meanwhile."""

    path: Trajectory
    activity: str | None = None
    """None = what the path says."""
    grips: tuple[tuple[str, Vector], ...] = ()
    contact_s: float | None = None
    """Instant of contact of a single act, s."""

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        state = self.path.at(time_s)
        return replace(
            state,
            activity=self.activity or state.activity,
            grips=self.grips + state.grips,
            act_s=state.act_s if self.contact_s is None else time_s - self.contact_s,
        )
