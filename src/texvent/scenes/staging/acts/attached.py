"""Trajectories of bodies on other bodies: fixed to a hand, to the board of a swing."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from texvent.scenes.models.protocol import Model, Pose
from texvent.scenes.models.shapes import Affine, compose
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.trajectories.trajectory import (
    BodyState,
    Trajectory,
    Vector,
    rotation,
    state_of,
)


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


_UPRIGHT = 0.7
"""Least z of a part's third axis for its axes to be those of what is on it."""


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
