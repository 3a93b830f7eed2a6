"""Pieces of scenery, and the space that they must keep clear."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from texvent.camera import PosedCamera
from texvent_scenes.models.places import Scenery
from texvent_scenes.models.protocol import Model, Pose
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.staging.actors import PlacedModel
from texvent_scenes.staging.camera.framing import image_of
from texvent_scenes.staging.camera.journey import TravelPlan
from texvent_scenes.staging.surroundings.road_line import RoadLine
from texvent_scenes.staging.tracks.track import BodyState

ASPECT = 0.75
"""Height over width of an image."""
_SIDES = np.array([[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]])
"""Corners of a box seen from above, in half extents."""


@dataclass(frozen=True)
class ViewClearance:
    """Space that scenery must keep clear."""

    cameras: Sequence[PosedCamera]
    """The camera at some instants."""
    points: Sequence[Float64Array]
    """[n, 3] what it must see at those instants, m."""
    distance_m: float
    road_half_width: float | None
    """Half width of the strip to keep free, m; None = no road."""
    road: RoadLine
    room_m: float = math.inf
    travel: TravelPlan | None = None
    """The route of a camera that travels."""
    has_shore: bool = False
    """Whether water lies to the left of the road's line."""
    clip_s: float = 2.0
    """Length of the clip, s."""


@dataclass(frozen=True)
class SceneryItem:
    """One piece of scenery; it stands still."""

    rule: Scenery
    model: Model
    position: tuple[float, float]
    yaw: float
    height_m: float = 0.0
    """Height of its origin, m."""
    instance: int = 0
    """Ground-truth id; 0 = it has none."""

    @property
    def is_flat(self) -> bool:
        """Whether others may stand on it: paint on the ground."""
        return self.rule.where == "under"

    @property
    def radius_m(self) -> float:
        """Radius of the ground it stands on."""
        return 0.5 * max(self.model.length, self.model.width)

    def share_of(self, camera: PosedCamera) -> float:
        """Share of the image that its box takes; 0 where less than half of that is inside."""
        half = np.array([0.5 * self.model.length, 0.5 * self.model.width])
        cosine, sine = math.cos(self.yaw), math.sin(self.yaw)
        feet = _SIDES * half @ np.array([[cosine, sine], [-sine, cosine]]) + self.position
        box = [[*foot, self.height_m + z] for foot in feet for z in (0.0, self.model.height)]
        seen = image_of(camera, np.array(box))
        if seen[:, 2].min() <= 0.0:
            return 0.0
        ends = np.array([seen[:, :2].min(axis=0), seen[:, :2].max(axis=0)]) / [1.0, ASPECT]
        inside = float(np.prod(np.diff(np.clip(ends, -0.5, 0.5), axis=0)))
        return inside if inside >= 0.5 * float(np.prod(np.diff(ends, axis=0))) else 0.0

    def place(self) -> PlacedModel:
        """Its parts in the world."""
        state = BodyState((*self.position, self.height_m), self.yaw, activity="stand")
        parts = self.model.parts(Pose(0.0, 0.0, 0.0, "stand"))
        if self.instance:  # a parked car has its lamps off
            parts = [replace(one, emission=0.0) if one.emission else one for one in parts]
        return PlacedModel(parts, state.to_world(), self.instance)
