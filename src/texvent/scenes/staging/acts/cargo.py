"""What is in or on something that an act moves goes with it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from texvent.scenes.description import Relation
from texvent.scenes.models.shapes import compose
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.attached import state_of
from texvent.scenes.staging.acts.cast import Cast
from texvent.scenes.staging.trajectories.trajectory import BodyState, Trajectory


@dataclass(frozen=True)
class Aboard:
    """Fixed to another body, whatever moves that."""

    carrier: Trajectory
    offset: Float64Array
    """[3, 4] its body coordinates in those of the carrier."""
    activity: str = "stand"

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        below = self.carrier.at(time_s)
        state = state_of(compose(below.to_world(), self.offset))
        return replace(state, distance_m=0.0, speed_m_s=below.speed_m_s, activity=self.activity)


def take_along(cast: Cast, relations: Sequence[Relation], before: Sequence[Actor]) -> None:
    """Fix the content of what acts have moved from its place to where it is now.

    Args:
        cast: the actors after all acts.
        relations: of the prompt; those of kind "in" and "on" say what is where.
        before: the actors as they were placed, in the order of the cast.
    """
    for relation in relations:
        if relation.kind not in ("in", "on") or relation.subject == relation.targets[0]:
            continue
        holders = cast.copies(relation.targets[0])
        for turn, at in enumerate(cast.copies(relation.subject)):
            if not holders:
                break
            holder = holders[turn % len(holders)] if len(holders) > 1 else holders[0]
            was, now = before[holder].trajectory, cast.get(holder).trajectory
            own = cast.get(at)
            if now is was or own.trajectory is not before[at].trajectory:
                continue
            state = own.trajectory.at(0.0)
            offset = compose(_inverse(was.at(0.0).to_world()), state.to_world())
            path = Aboard(now, offset, state.activity)
            cast.put(at, replace(own, trajectory=path, is_mover=cast.get(holder).is_mover))


def _inverse(to_world: Float64Array) -> Float64Array:
    turn = to_world[:, :3].T
    return np.column_stack([turn, -turn @ to_world[:, 3]])
