"""Approaches of bridges: embankments at both ends, as long as the way of who goes over."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from texvent_scenes.models.anchors import Support
from texvent_scenes.models.materials import Material, made_of
from texvent_scenes.models.protocol import Model, ModelPart, Pose
from texvent_scenes.models.shapes import part, placed_upright, plank
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.rendered_scene import Shape, Texture
from texvent_scenes.staging.placement.object_groups import ObjectGroup
from texvent_scenes.staging.placement.zones import zone_of

_EARTH = made_of(Texture.SOIL, (0.13, 0.13, 0.05))
_WALL = made_of(Texture.CONCRETE, (0.42, 0.41, 0.39))
_WAY: dict[str, Material] = {
    "road": made_of(Texture.ASPHALT, (0.05, 0.05, 0.052)),
    "rails": made_of(Texture.SOIL, (0.26, 0.24, 0.22)),
}
_STEEL = Material((0.3, 0.3, 0.31))
_ROOM_M, _SLOPE, _TOP_M, _WALL_M, _GAUGE_M = 1.5, 1.6, 0.12, 0.6, 0.75
"""Room beyond the last of the way; run over rise of the banks; thickness of the way and of the
walls that hold the bridge; half the gauge of rails: m."""
_SQUARE = 0.1
"""Sine of the angle between a bridge and a way along it."""


def lead_over(group: ObjectGroup, target: ObjectGroup, support: Support) -> None:
    """Turn a group and its bridge the same way, and lengthen that by banks as far as it goes."""
    is_bridge = target.noun.name in nouns_with("has approaches") and len(target.models) == 1
    if not is_bridge or target.plan.motion.is_moving or not group.plan.is_path:
        return
    body = target.models[0]
    turn = group.plan.yaw - target.plan.yaw
    if abs(math.sin(turn)) > _SQUARE:
        if isinstance(body, ApproachedModel) or target.scene_object.heading_deg is not None:
            back = math.pi if math.cos(turn) < 0.0 else 0.0
            group.plan = replace(group.plan, yaw=target.plan.yaw + back)
        else:
            target.plan = replace(target.plan, yaw=group.plan.yaw)
    along = np.array([math.cos(target.plan.yaw), math.sin(target.plan.yaw)])
    aside_m = float(np.abs(np.array(group.offsets)[:, :2] @ along).max())
    half_m = 0.5 * (group.plan.travel_m + group.models[0].length) + aside_m + _ROOM_M
    if half_m > 0.5 * body.length:
        inner = body.inner if isinstance(body, ApproachedModel) else body
        zone = zone_of(group.noun)
        target.models = [ApproachedModel(inner, half_m, support.height, zone)]
    target.fit()


class ApproachedModel:
    """A bridge with banks at both ends, the way on them level with its own."""

    def __init__(self, inner: Model, half_m: float, level_m: float, zone: str) -> None:
        self.inner = inner
        self.length, self.width, self.height = 2.0 * half_m, inner.width, inner.height
        self._banks = _draw_banks(inner, half_m, level_m, zone)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name == "inner":  # not yet set, as in a copy that is being made
            raise AttributeError(name)
        return getattr(self.inner, name)

    def parts(self, pose: Pose) -> Sequence[ModelPart]:
        """The parts of the bridge, and of its banks."""
        return [*self.inner.parts(pose), *self._banks]


def _draw_banks(inner: Model, half_m: float, level_m: float, zone: str) -> list[ModelPart]:
    """Walls, banks with slopes at their sides and their far ends, and the way on top of them."""
    first, wide = 0.5 * inner.length, 0.5 * inner.width
    low, run = level_m - _TOP_M, _SLOPE * level_m
    found = []
    for side in (-1.0, 1.0):
        middle, long = side * 0.5 * (first + half_m), half_m - first
        found += [
            _box(_WALL, (side * first, 0.0, 0.5 * low), (_WALL_M, 2.0 * wide, low)),
            _box(_EARTH, (middle, 0.0, 0.5 * low), (long, 2.0 * wide, low)),
            _box(_WAY.get(zone, _WAY["road"]), (middle, 0.0, level_m - 0.5 * _TOP_M),
                 (long, 1.9 * wide, _TOP_M)),
            _slope((side * half_m, 0.0, low), (side * run, 0.0), (0.0, 2.0 * wide, 0.0)),
            *(_slope((middle, way * wide, low), (0.0, way * run), (long, 0.0, 0.0))
              for way in (-1.0, 1.0)),
        ]  # fmt: skip
    if zone == "rails":
        found += [_box(_STEEL, (0.0, way * _GAUGE_M, level_m), (2.0 * half_m, 0.09, 0.14))
                  for way in (-1.0, 1.0)]  # fmt: skip
    return found


def _box(
    material: Material, centre: tuple[float, float, float], size: tuple[float, float, float]
) -> ModelPart:
    return part(Shape.BOX, material, placed_upright(centre, size))


def _slope(
    top: tuple[float, float, float], run: tuple[float, float], across: tuple[float, float, float]
) -> ModelPart:
    """A slope of earth from an edge down to the ground."""
    x, y, _ = top
    return plank(_EARTH, top, (x + run[0], y + run[1], 0.0), chord=across,
                 thickness=(0.0, 0.0, 0.3))  # fmt: skip
