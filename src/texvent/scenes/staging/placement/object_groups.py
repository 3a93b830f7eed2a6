"""All copies of one object: their positions in the group, and the room they take."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np

from texvent.scenes.description import SceneObject
from texvent.scenes.models.people.activities import HAND_NOUNS, PERSON_NOUNS
from texvent.scenes.models.protocol import Model, Noun
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import is_centred
from texvent.scenes.staging.trajectories.manoeuvres import sample_places
from texvent.scenes.staging.trajectories.motion_plan import MotionPlan
from texvent.scenes.staging.trajectories.phases import MOST_HASTE
from texvent.scenes.staging.trajectories.trajectory import Vector

GAP_M = 0.25
"""Least space between two objects, in units of the smaller one's size."""


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
    grips: tuple[tuple[str, Vector], ...] = ()
    """`Pose.grips` of those who rest on something."""
    orbits: ObjectGroup | None = None
    yaws: list[float] | None = None
    """Heading of each copy, where they differ."""
    pool_m: float | None = None
    """Radius of the circle in which it swims in a vessel, m."""
    is_stood_up: bool = False
    """Whether what lies along its x is put on its end."""
    is_on_chairs: bool = False
    """Whether each of its people sits on a chair that comes with them."""
    belt: ObjectGroup | None = None
    """The conveyor belt that carries it along."""
    laden: int = 0
    """How many things have found their place on it, where it is a dish."""
    lag: tuple[ObjectGroup, float] | None = None
    """Whose line it follows, and how far behind, m."""

    @property
    def size_m(self) -> float:
        """Largest extent of one copy."""
        model = self.models[0]
        return max(model.length, model.width, model.height)


_RESTING = frozenset({"stand", "sit", "lie", "slide"})


def rests(noun: Noun, kind: str) -> bool:
    """Whether it is on something while it does that."""
    return kind in _RESTING or kind in noun.acts


def rests_on_ground(noun: Noun, kind: str) -> bool:
    """Whether what usually flies is on the ground while it does that."""
    return noun.habitat == "air" and rests(noun, kind)


def place_copies(
    models: list[Model], plan: MotionPlan, noun: Noun, rng: np.random.Generator
) -> list[Vector]:
    """Places of the copies about the middle of their group, m, staggered so none hides another."""
    count = len(models)
    if count == 1:
        return [(0.0, 0.0, 0.0)]
    tall = max(model.height for model in models)
    along, across = _spacing(models, plan, noun)
    is_lifting = plan.motion.kind in ("rise", "sink") and noun.motion == "fly"
    is_deep = is_centred(noun) and not is_lifting and noun.name not in HAND_NOUNS
    is_deep = is_deep and not rests_on_ground(noun, plan.motion.kind)
    is_driven = noun.motion == "drive"
    is_herd = _is_herd(count, noun)
    columns = round(math.sqrt(count)) if is_herd else _count_columns(count, is_driven)
    stagger = 0.5 if is_herd else 0.3
    in_depth = plan.is_path and abs(math.sin(plan.yaw)) > 0.5 >= abs(math.cos(plan.yaw))
    offsets: list[Vector] = []
    for number in range(count):
        row, column = divmod(number, columns)
        in_row = min(columns, count - row * columns)
        a = (column - 0.5 * (in_row - 1) + stagger * (row % 2)) * along
        b = (row - 0.5 * ((count - 1) // columns)) * across
        a += float(rng.uniform(-0.12, 0.12)) * along
        stray = float(rng.uniform(-0.08, 0.08)) * across
        if not is_driven:  # vehicles keep to their lanes
            b = b + 0.6 * across * (number % 2) + stray
        up = 0.0
        if is_deep:
            up = (0.9 * (-1.0) ** number + float(rng.uniform(-0.35, 0.35))) * tall
        offsets.append((b * 1.6, a, up) if in_depth else (a, b, up))
    return offsets


_HERD, _ROWS_APART = 6, 0.75
"""From so many on animals stand close together in rows, which are so many lengths apart."""


def _is_herd(count: int, noun: Noun) -> bool:
    return count >= _HERD and noun.motion == "walk" and noun.name not in PERSON_NOUNS


_APART = 0.3
"""Space between copies of small things, in their sizes: apples do not lie half a metre apart."""


def _spacing(models: list[Model], plan: MotionPlan, noun: Noun) -> tuple[float, float]:
    """Metres from one copy to the next, along the heading and across it."""
    length = max(model.length for model in models)
    width = max(model.width for model in models)
    if plan.motion.direction in ("circle", "eight"):
        return 4.0 * max(length, width), 4.0 * max(length, width)
    if noun.motion == "drive":
        return 1.45 * length + 0.5, max(width + 0.9, 2.9)
    if noun.name in HAND_NOUNS:
        return 1.3 * width, 1.3 * width
    if plan.is_facing:
        return 1.6 * width, 0.2 * width  # in one row, as the camera sees them
    size = max(length, width)
    apart = min(0.3, _APART * size)
    across = 1.4 * width + apart + min(0.1, 0.1 * size)
    if is_centred(noun):
        return 0.8 * length + apart, across
    if _is_herd(len(models), noun):
        return length + 0.3 * apart, max(across, _ROWS_APART * length)
    return 1.2 * (length if plan.is_path else size) + apart, across


def _count_columns(count: int, is_driven: bool) -> int:
    if is_driven:
        return math.ceil(count / 2)
    return count if count <= 3 else math.ceil(math.sqrt(1.6 * count))


def half_extents_over_clip(
    models: list[Model], offsets: list[Vector], plan: MotionPlan
) -> Float64Array:
    """[3] half extents of what the group takes up over the clip, m."""
    model = models[0]
    cosine, sine = abs(math.cos(plan.yaw)), abs(math.sin(plan.yaw))
    length, width = model.length, model.width
    if plan.motion.kind in ("spin", "roll", "sway", "swing", "dance", "fall"):
        length = width = max(length, width)
    half = 0.5 * np.array(
        [cosine * length + sine * width, sine * length + cosine * width, model.height]
    )
    spread = np.abs(np.array(offsets)).max(axis=0)
    if plan.path is not None:
        half[:2] = 0.5 * max(length, width)
        places = sample_places(plan.path, plan.duration_s)
        return np.asarray(half + spread + 0.5 * np.ptp(places, axis=0))
    travel = 0.5 * plan.travel_m * np.array([cosine, sine, abs(plan.climb)])
    if plan.motion.direction == "circle":
        travel = np.array([1.3, 1.3, 0.0]) * max(model.length, model.width)
    return np.asarray(half + spread + travel)


OVERTAKEN = 0.4
"""Speed of what is overtaken, as a share of what overtakes it."""


def slow_overtaken(group: ObjectGroup, faster: ObjectGroup) -> None:
    """Let what is overtaken go the same way, slower, unless the prompt says how it goes."""
    if not (faster.plan.is_path and group.plan.is_path):
        return
    motion = group.plan.motion
    if motion.direction is None and motion.speed_m_s is None:
        speed = OVERTAKEN * faster.plan.speed_m_s
        group.plan = replace(group.plan, yaw=faster.plan.yaw, speed_m_s=speed)
        group.half = half_extents_over_clip(group.models, group.offsets, group.plan)


LEAST_THROUGH_M_S = 1.4
"""Speed at which who flies through a gate is seen before it and behind it."""


def go_all_through(group: ObjectGroup) -> None:
    """Let what hovers slowly go through something within the clip, unless its speed is said."""
    plan = group.plan
    is_said = plan.motion.speed_m_s is not None or plan.motion.pace != 1.0
    if plan.is_path and not is_said and plan.speed_m_s < LEAST_THROUGH_M_S:
        group.plan = replace(plan, speed_m_s=LEAST_THROUGH_M_S)
        group.half = half_extents_over_clip(group.models, group.offsets, group.plan)


def hurry_leader(leader: ObjectGroup, follower: ObjectGroup) -> None:
    """Let what is followed be as fast as its follower, unless the prompt says how fast."""
    motion, speed = leader.plan.motion, follower.plan.speed_m_s
    is_said = motion.speed_m_s is not None or motion.pace != 1.0
    if leader.plan.path is None and not is_said and leader.plan.speed_m_s < speed:
        leader.plan = replace(leader.plan, speed_m_s=speed)
        leader.half = half_extents_over_clip(leader.models, leader.offsets, leader.plan)


def hurry_past(group: ObjectGroup, half_m: float) -> bool:
    """Let what passes behind something be seen on both sides of it; whether it can be so fast.

    Args:
        group: what goes from side to side.
        half_m: half the width of what hides it.
    """
    plan, own = group.plan, group.models[0].length
    is_free = plan.is_path and len(group.models) == 1 and plan.motion.speed_m_s is None
    if not is_free or abs(math.cos(plan.yaw)) < 0.5:
        return False
    speed = (2.0 * half_m + 1.2 * own) / plan.duration_s
    if speed > MOST_HASTE * plan.speed_m_s:
        return False
    group.plan = replace(plan, speed_m_s=max(speed, plan.speed_m_s))
    group.half = half_extents_over_clip(group.models, group.offsets, group.plan)
    return True


def part_in_midst(group: ObjectGroup, room_m: float) -> None:
    """Set the copies of a group in two rows, left and right of a gap of twice that room."""
    count, model = len(group.models), group.models[0]
    if count < 2:
        return
    across = 1.3 * max(model.length, model.width)
    group.offsets = []
    for number in range(count):
        row, side = number // 2, -1.0 if number % 2 == 0 else 1.0
        rows = (count + 1 - number % 2) // 2
        aside = side * (room_m + 0.5 * max(model.length, model.width))
        group.offsets.append((aside, (row - 0.5 * (rows - 1)) * across, 0.0))
    group.half = half_extents_over_clip(group.models, group.offsets, group.plan)


def overlap(centre: Float64Array, group: ObjectGroup, other: ObjectGroup) -> bool:
    """Whether a group with its middle at `centre` would overlap with another at any time."""
    gap = GAP_M * min(group.size_m, other.size_m)
    apart = np.abs(centre - other.centre) - (group.half + other.half)
    if group.noun.habitat == other.noun.habitat:
        return bool(np.all(apart[:2] < gap) and apart[2] < gap)
    low_a, low_b = _vertical(centre, group), _vertical(other.centre, other)
    above = low_a[0] > low_b[1] or low_b[0] > low_a[1]
    return bool(np.all(apart[:2] < gap) and not above)


def _vertical(centre: Float64Array, group: ObjectGroup) -> tuple[float, float]:
    """Lowest and highest point of a group, m."""
    height = 2.0 * float(group.half[2])
    low = float(centre[2]) - (0.5 * height if is_centred(group.noun) else 0.0)
    return low, low + height


def unturn(offset: Float64Array, yaw: float) -> Vector:
    """An offset in the world as a body of that heading sees it, m."""
    cosine, sine = math.cos(yaw), math.sin(yaw)
    x, y, z = offset
    return (float(x * cosine + y * sine), float(y * cosine - x * sine), float(z))
