"""People at a table or desk: on chairs around it, turned to it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from texvent.scenes.models.objects.furniture import NOUNS as FURNITURE
from texvent.scenes.models.people.activities import DONE_SEATED, SEATED
from texvent.scenes.models.people.posture import SEAT
from texvent.scenes.models.people.props import Prop
from texvent.scenes.models.protocol import Model, Pose
from texvent.scenes.models.shapes import moved
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.placement.object_groups import ObjectGroup
from texvent.scenes.staging.trajectories.trajectory import Vector

WIDE_M = 0.7
"""Room for one at a side, m."""
_KNEES_M = 0.28
"""From the edge of the top to the middle of who sits there, m."""
_STANDING_M = 0.35
_CHAIR_SEAT_M = 0.46
_BACK_M = 0.03


def place_at(group: ObjectGroup, target: ObjectGroup, neighbours: Sequence[int]) -> Float64Array:
    """Put people at a table: first at its ends and its far side, the camera's side last.

    Args:
        group: the people; they sit unless what they do is done standing.
        target: the table, or several that they share out.
        neighbours: indices of all objects at the table, one for each copy.

    Returns:
        [3] the middle of the group, m.
    """
    doing = _sit_doing(group)
    scale = float(getattr(group.models[0], "scale", 1.0))
    count, tables = len(group.models), len(target.offsets)
    first = neighbours.index(group.index)
    whole = math.ceil(len(neighbours) / tables)
    edge_m, lift = (_STANDING_M, 0.0) if doing is None else (_KNEES_M, _lift(scale))
    places = list_places(target.models[0], target.plan.yaw, whole, edge_m * scale)
    group.offsets, group.yaws = [], []
    for number in range(first, first + count):
        x, y, z = target.offsets[number % tables] if tables > 1 else (0.0, 0.0, 0.0)
        right, away, yaw = places[number // tables % len(places)]
        group.offsets.append((x + right, y + away, z + lift))
        group.yaws.append(yaw)
    if doing is not None:
        group.plan = replace(group.plan, gesture=doing, path=None)
        group.is_on_chairs = True
    reach = np.abs(np.array(group.offsets)).max(axis=0) + 0.4 * scale
    group.half = np.array([reach[0], reach[1], 0.5 * group.models[0].height])
    return np.array([target.centre[0], target.centre[1], 0.0])


def _sit_doing(group: ObjectGroup) -> str | None:
    """What people on chairs do there; None: they stand.

    Who sits keeps to the chair, whatever comes next.
    """
    said = (group.scene_object.motion, *group.scene_object.then)
    kinds = [one.kind for one in said if one is not None and one.kind != "stand"]
    done = [kind for kind in kinds if kind in DONE_SEATED]
    if kinds and not done and not {"sit", "sit down"} & set(kinds):
        return None
    return SEATED + done[-1] if done else "sit"


def _lift(scale: float) -> float:
    """How much higher than an adult's feet those of a child are on the same chair, m."""
    return SEAT * (1.0 - min(scale, 1.0))


def list_places(
    table: Model, yaw: float, count: int, edge_m: float
) -> list[tuple[float, float, float]]:
    """Metres to the right and away from the table's middle, and the heading, of so many people.

    Two sit at its ends and see each other; one alone sits behind it and faces the camera.

    Args:
        table: its model.
        yaw: its heading.
        count: people at it.
        edge_m: from its edge to the middle of who is there, m.
    """
    cosine, sine = math.cos(yaw), math.sin(yaw)
    sides = []
    for x, y, long in (
        (0.5 * table.length, 0.0, table.width), (-0.5 * table.length, 0.0, table.width),
        (0.0, 0.5 * table.width, table.length), (0.0, -0.5 * table.width, table.length),
    ):  # fmt: skip
        out = np.array([x * cosine - y * sine, x * sine + y * cosine])
        sides.append((out, long))
    sides.sort(key=lambda side: -float(side[0][1]))
    (far, wide), *ends, (near, _) = sides
    if abs(far[1]) < abs(far[0]):  # seen askew: the far corner's side
        ends = sides[1:3]
    most = max(1, int(wide / WIDE_M))
    ends = sorted(ends, key=lambda side: float(side[0][0]))
    if count == 1:
        shares = [(far, wide, 1)]
    elif count == 2:
        shares = [(*end, 1) for end in ends]
    else:
        behind = min(most, count - 2)
        before = max(0, count - 2 - behind)
        shares = [(*ends[0], 1), (far, wide, behind), (*ends[1], 1), (near, wide, before)]
    found = []
    for out, long, number in shares:
        ahead = -out / np.linalg.norm(out)
        along = np.array([-ahead[1], ahead[0]])
        # Who sits on the camera's side leaves the middle free.
        widest = 1.2 if out is near else WIDE_M
        step = min(widest, long / max(number, 1))
        for one in range(number):
            spot = out - edge_m * ahead + step * (one - 0.5 * (number - 1)) * along
            found.append((float(spot[0]), float(spot[1]), math.atan2(ahead[1], ahead[0])))
    return found


def draw_chair(scale: float) -> Prop:
    """The chair under who sits at a table; `scale` is the body's, relative to an adult."""
    chair = next(noun for noun in FURNITURE if noun.name == "chair")
    model = chair.build(colour=None, scale=max(scale, 1.0) * SEAT / _CHAIR_SEAT_M, seed=0)
    parts = model.parts(Pose(0.0, 0.0, 0.0, "stand"))
    axes = np.column_stack([np.eye(3), np.array([-_BACK_M * scale, 0.0, -_lift(scale)])])
    placed = moved(parts, axes)
    return Prop("ground", lambda _: placed)


def turned_to(place: Vector, yaw: float, goal: Float64Array) -> bool:
    """Whether a heading leads to a ground point, within 60 degrees."""
    way = goal[:2] - np.array(place[:2])
    ahead = np.array([math.cos(yaw), math.sin(yaw)])
    return bool(way @ ahead > 0.5 * float(np.linalg.norm(way)))


_AT_TABLE_M = 0.4
"""From who is at a table that is added to its edge, m."""
_LOW, _LOW_M = frozenset({"sit", "kneel", "crouch", "squat", "lie"}), 1.5


def set_before(group: ObjectGroup, person: ObjectGroup, height: float) -> Float64Array:
    """Where a table stands that is added: before a person, and to the side of who is low."""
    is_low = person.plan.motion.kind in _LOW or person.models[0].height < _LOW_M
    aside = float(group.half[0]) if is_low else 0.0
    x, y, _ = person.centre
    return np.array([x + aside, y - _AT_TABLE_M - group.half[1], height])
