"""The bodies of a scene by object, while acts bind them together."""

from __future__ import annotations

from dataclasses import replace

from texvent.scenes.models.people.props import Prop
from texvent.scenes.staging.actors import Actor


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

    def props(self, number: int) -> tuple[Prop, ...]:
        """What comes with an actor's activity; nothing once it is off the scene."""
        actor = self._actors[number]
        return () if actor is None else actor.props

    def put(self, number: int, actor: Actor | None) -> None:
        """Replace an actor; None takes it off the scene."""
        self._actors[number] = actor

    def actors(self) -> list[Actor]:
        """Those that are left, numbered anew."""
        left = [actor for actor in self._actors if actor is not None]
        return [replace(actor, instance=number) for number, actor in enumerate(left, start=1)]
