"""A four-legged body that walks, runs, sits, lies and eats, its feet not sliding."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import Any

import numpy as np

from texvent_scenes.models.animals.activities import STANDING, activity_stance, lowered
from texvent_scenes.models.animals.anatomy import (
    NOSE,
    bob,
    draw_leg,
    draw_neck_and_head,
    draw_tail,
    draw_torso,
    droop,
    lying_drop,
    offset,
    sit_drop,
    tail_lift,
    tip,
)
from texvent_scenes.models.animals.build import (
    Build,
    Coat,
    paint_coat,
    placed_marks,
    read_build,
)
from texvent_scenes.models.limbs import Gait, foot_path, step_amount
from texvent_scenes.models.protocol import ModelPart, Pose, fraction
from texvent_scenes.models.shapes import Affine, ArticulatedModel, Point, moved, shift
from texvent_scenes.rendered_scene import Colour


def build_quadruped(
    table: Mapping[str, Any],
    is_centred: bool,
    *,
    colour: Colour | None,
    scale: float,
    seed: int,
) -> ArticulatedModel:
    """Make a four-legged animal from its table; `colour` is its coat."""
    body = _Body(
        read_build(table), paint_coat(table, colour=colour, seed=seed), fraction(seed, "step")
    )
    return ArticulatedModel(
        [],
        scale=scale * table.get("size", 1.0),
        articulate=body.parts,
        is_centred=is_centred,
        anchor=body.anchor,
    )


@dataclass(frozen=True)
class _Body:
    """One animal at its usual size."""

    build: Build
    coat: Coat
    start: float
    """Phase at which its cycle of steps begins, cycles."""

    def parts(self, pose: Pose) -> list[ModelPart]:
        """Trunk, neck, head, tail, marks and legs.

        "run" takes longer bounds, "sit" lowers the hind quarters, "lie" the whole trunk.
        """
        build, coat = self.build, self.coat
        runs = pose.activity == "run" or build.hop > 0.0
        gait = self._gait(runs)
        amount = step_amount(pose.activity, pose.speed_m_s, 0.25 * self._stride)
        distance = pose.distance_m + self.start * gait.stride
        turn = 2.0 * math.pi * distance / gait.stride
        sits, lies = lowered(pose.activity, pose.time_s)
        stance = activity_stance(pose.activity, pose.time_s)
        rise = amount * bob(build, turn, runs) + lies * lying_drop(build) - sits * sit_drop(build)
        wag = math.sin(2.0 * math.pi * (0.9 * pose.time_s + self.start))
        swings = (amount * math.sin(turn), wag)
        parts = [
            *draw_torso(build, coat),
            *draw_neck_and_head(build, coat, swings, stance, droop(build, sits, lies)),
        ]
        before_tail = len(parts)
        tail = wag if stance is STANDING else stance.wag
        parts += draw_tail(build, coat, tail, tail_lift(build, stance, sits, lies))
        body = tip(build, stance, sits)
        parts = moved(moved([*parts, *self._marks], body), shift(z=rise))
        if sits > 0.0:
            parts[before_tail:] = _above_ground(parts[before_tail:])
        for index in range(4):
            step = foot_path(gait, distance, offset(index, runs), amount)
            parts += draw_leg(build, coat, index, (step, rise, sits), body)
        return parts

    def anchor(self, name: str, pose: Pose) -> Affine | None:
        """Axes at "mouth", "neck", "crown", "face" and "head"."""
        head = len(draw_torso(self.build, self.coat)) + 2
        if name in _ON_SKULL:
            skull = self.parts(pose)[head].to_body
            turn = skull[:, :3] / np.linalg.norm(skull[:, :3], axis=0)
            return np.column_stack([turn, skull @ np.array([*_ON_SKULL[name], 1.0])])
        if name not in ("mouth", "neck"):
            return None
        at, ahead = (head + NOSE, 0.1 * self.build.head[0]) if name == "mouth" else (head - 1, 0.0)
        middle = self.parts(pose)[at].to_body[:, 3]
        return np.column_stack([np.eye(3), middle + np.array([ahead, 0.0, 0.0])])

    @property
    def _stride(self) -> float:
        return self.build.stride if self.build.stride > 0.0 else 1.5 * self.build.shoulder

    def _gait(self, runs: bool) -> Gait:
        if runs:
            return Gait(1.6 * self._stride, 0.36, 0.22 * self.build.shoulder)
        return Gait(self._stride, 0.62, 0.10 * self.build.shoulder)

    @cached_property
    def _marks(self) -> list[ModelPart]:
        middle = (0.0, 0.0, self.build.shoulder - 0.5 * self.build.body_size[2])
        return placed_marks(self.coat.marks, middle, self.build.body_size)


_ON_SKULL: Mapping[str, Point] = MappingProxyType(
    {"crown": (-0.05, 0.0, 0.86), "face": (0.90, 0.0, 0.36), "head": (0.0, 0.0, 0.0)}
)
"""Places on the head, in half extents of the skull."""


def _above_ground(parts: Sequence[ModelPart]) -> list[ModelPart]:
    """Parts, each lifted until it is not below the ground: tails of who sits lie on it."""
    lows = [part.to_body[2, 3] - np.linalg.norm(part.to_body[2, :3]) for part in parts]
    return [
        part if low >= 0.0 else moved([part], shift(z=-float(low)))[0]
        for part, low in zip(parts, lows, strict=True)
    ]
