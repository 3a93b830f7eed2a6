"""All copies of one object: the room that they take, alone and beside other objects."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np

from texvent.scenes.description import STANDING, SceneObject
from texvent.scenes.models.protocol import Model, Noun, Pose
from texvent.scenes.models.shapes import bounds
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import is_centred
from texvent.scenes.staging.trajectories.motion_plan import MotionPlan
from texvent.scenes.staging.trajectories.steered_path import sample_places
from texvent.scenes.staging.trajectories.trajectory import Vector

GAP_M = 0.25
"""Least space between two objects, in units of the smaller one's size."""
OVERTAKEN = 0.4
"""Speed of what is overtaken, as a share of what overtakes it."""
_CIRCLE = 1.3
"""Radius of a circle, in sizes of who goes along it."""
_TURNING = ("spin", "roll", "sway", "swing", "dance", "fall")
"""Motions that need the same room at all sides."""


@dataclass
class ObjectGroup:
    """All copies of one object, and the room they take."""

    index: int
    scene_object: SceneObject
    noun: Noun
    models: list[Model]
    plan: MotionPlan
    offsets: list[Vector]
    """Places of the copies relative to the group's middle, m."""
    half: Float64Array
    """[3] half extents of the room taken over the whole clip, m."""
    centre: Float64Array = field(default_factory=lambda: np.zeros(3))
    clear_m: float = 0.0
    """Height of what it jumps over, m."""
    carrier: ObjectGroup | None = None
    carried_on: int | None = None
    """Index of the part of the carrier's model that it is on, where that part moves."""
    orbits: ObjectGroup | None = None
    yaws: list[float] | None = None
    """Heading of each copy, where they differ."""
    on_chairs: bool = False
    """Whether each of its people sits on a chair that comes with them."""
    lag: tuple[ObjectGroup, float] | None = None
    """Whose line it follows, and how far behind, m."""

    @property
    def size_m(self) -> float:
        """Largest extent of one copy."""
        model = self.models[0]
        return max(model.length, model.width, model.height)

    @property
    def top_m(self) -> float:
        """Height of its top above its origin."""
        return self.models[0].height * (0.5 if is_centred(self.noun) else 1.0)

    @property
    def origin_m(self) -> float:
        """Height of its origin above what it rests on."""
        if not is_centred(self.noun):
            return 0.0
        return -float(bounds(self.models[0].parts(Pose(0.0, 0.0, 0.0, "sit")))[0][2])

    def fit(self) -> None:
        """Work out the room that it takes, after its plan or its copies' places have changed."""
        self.half = half_extents_over_clip(self.models, self.offsets, self.plan)

    def half_at_rest(self) -> Float64Array:
        """[3] half extents of all copies where they stand, without their way, m."""
        plan = replace(self.plan, motion=STANDING, path=None)
        return half_extents_over_clip(self.models, self.offsets, plan)

    def go(self, **changes: float) -> None:
        """Change heading (`yaw`) and speed (`speed_m_s`)."""
        self.plan = replace(self.plan, **changes)  # type: ignore[arg-type]
        self.fit()


def half_extents_over_clip(
    models: list[Model], offsets: list[Vector], plan: MotionPlan
) -> Float64Array:
    """[3] half extents of what a group takes up over the clip, m."""
    model = models[0]
    cosine, sine = abs(math.cos(plan.yaw)), abs(math.sin(plan.yaw))
    length, width = model.length, model.width
    size = max(length, width)
    if plan.motion.kind in _TURNING:
        length = width = size
    half = 0.5 * np.array(
        [cosine * length + sine * width, sine * length + cosine * width, model.height]
    )
    spread = np.abs(np.array(offsets)).max(axis=0)
    if plan.path is not None:
        half[:2] = 0.5 * size
        places = sample_places(plan.path, plan.duration_s)
        return np.asarray(half + spread + 0.5 * np.ptp(places, axis=0))
    travel = 0.5 * plan.travel_m * np.array([cosine, sine, abs(plan.climb)])
    if plan.motion.direction == "circle":
        travel = _CIRCLE * size * np.array([1.0, 1.0, 0.0])
    return np.asarray(half + spread + travel)


def overlap(centre: Float64Array, group: ObjectGroup, other: ObjectGroup) -> bool:
    """Whether a group with its middle at `centre` would overlap with another at any time."""
    gap = GAP_M * min(group.size_m, other.size_m)
    apart = np.abs(centre - other.centre)[:2] - (group.half + other.half)[:2]
    (low, high), (other_low, other_high) = _vertical(centre, group), _vertical(other.centre, other)
    above = gap if group.noun.habitat == other.noun.habitat else 0.0
    return bool(np.all(apart < gap)) and max(low - other_high, other_low - high) < above


def _vertical(centre: Float64Array, group: ObjectGroup) -> tuple[float, float]:
    """Lowest and highest point of a group, m."""
    height = 2.0 * float(group.half[2])
    low = float(centre[2]) - (0.5 * height if is_centred(group.noun) else 0.0)
    return low, low + height


def match_pace(group: ObjectGroup, partner: ObjectGroup, kind: str) -> None:
    """Give a companion the heading and speed of its partner, where both go somewhere.

    What follows goes behind the partner, which is placed already; what is overtaken or passed goes
    the same way, slower, unless the scene says how it goes.
    """
    if not (partner.plan.is_path and group.plan.is_path):
        return
    motion = group.plan.motion
    if kind in ("follow", "with"):
        if kind == "follow" and partner.plan.motion.speed_m_s is None:
            partner.go(speed_m_s=max(partner.plan.speed_m_s, group.plan.speed_m_s))
        group.plan = replace(partner.plan, motion=motion)
        group.fit()
    elif motion.direction is None and motion.speed_m_s is None:
        group.go(yaw=partner.plan.yaw, speed_m_s=OVERTAKEN * partner.plan.speed_m_s)
