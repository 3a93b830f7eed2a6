"""Motions of props in their place: tossed up and caught, sent off one by one, turning.

They are fields of a prop of `data/activities.toml`; lengths in m, times in s.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from texvent_scenes.models.protocol import ModelPart, between
from texvent_scenes.models.shapes import Affine, affine, moved, turn_about

Parts = Sequence[ModelPart]
_GRAVITY_M_S2, _UNSEEN = 9.81, 1e-3
"""Gravity, m/s²; share of its size at which a copy is not seen."""


@dataclass(frozen=True)
class Toss:
    """Free flight up from its place and back into it, once in each cycle."""

    hz: float
    up: float
    """Greatest height, m."""
    turns: float = 0.0
    """Turns about an axis through `centre` in each flight."""
    centre: tuple[float, float, float] = (0.0, 0.0, 0.0)
    start: float = 0.0
    """Instant of the cycle at which it leaves, as a share."""
    axis: str = "y"

    def place(self, parts: Parts, time_s: float) -> list[ModelPart]:
        """The parts at that instant."""
        flown_s = math.sqrt(8.0 * self.up / _GRAVITY_M_S2)
        into = min(((time_s * self.hz - self.start) % 1.0) / self.hz, flown_s)
        height = 0.5 * _GRAVITY_M_S2 * into * (flown_s - into)
        turn = turn_about(self.axis, 2.0 * math.pi * self.turns * into / flown_s, self.centre)
        turn[2, 3] += height
        return moved(parts, turn)


@dataclass(frozen=True)
class Emission:
    """Copies that leave its place one after the other, each for a while in flight."""

    hz: float
    lasts_s: float
    speed: tuple[float, float, float]
    """Forward, left and up, m/s."""
    spread: float = 0.0
    """Most departure of each from that speed, m/s."""
    gravity: float = 0.0
    """Share of gravity."""
    drag: float = 0.0
    """Share of the speed that is lost, 1/s."""
    start_s: float = 0.0
    """Instant at which one leaves."""
    grows_s: float = 0.0
    """Time in which each grows to its size."""

    def place(self, parts: Parts, time_s: float) -> list[ModelPart]:
        """All copies in flight at that instant."""
        count, found = max(round(self.hz * self.lasts_s), 1), list[ModelPart]()
        for number in range(count):
            cycle, age_s = divmod(time_s - self.start_s + number / self.hz, count / self.hz)
            is_gone, age_s = age_s > self.lasts_s, age_s if age_s <= self.lasts_s else 0.0
            seed = int(number + count * cycle)
            gone_s = -math.expm1(-self.drag * age_s) / self.drag if self.drag else age_s
            x, y, z = (
                (one + self.spread * between(seed, axis, -1.0, 1.0)) * gone_s
                for axis, one in zip("xyz", self.speed, strict=True)
            )
            size = min(age_s / self.grows_s, 1.0) if self.grows_s else 1.0
            size = _UNSEEN if is_gone else max(size, _UNSEEN)
            fallen = 0.5 * self.gravity * _GRAVITY_M_S2 * age_s**2
            away = np.array([x, y, z - fallen]) + (1.0 - size) * parts[0].to_body[:, 3]
            found += moved(parts, affine(size * np.eye(3), away))
        return found


@dataclass(frozen=True)
class Turning:
    """Turns about an axis of its place."""

    hz: float
    axis: str = "y"
    centre: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def place(self, parts: Parts, time_s: float) -> list[ModelPart]:
        """The parts at that instant."""
        turn: Affine = turn_about(self.axis, 2.0 * math.pi * self.hz * time_s, self.centre)
        return moved(parts, turn)


PropMotion: TypeAlias = Toss | Emission | Turning
PROP_MOTIONS: Mapping[str, Callable[..., PropMotion]] = {
    "toss": Toss, "emit": Emission, "turn": Turning,
}  # fmt: skip
"""Field of a prop → its motion."""


def read_motion(row: Mapping[str, Any]) -> PropMotion | None:
    """The motion of a prop; None = it stays as its place has it."""
    for name, motion in PROP_MOTIONS.items():
        if name in row:
            fields = {
                key: tuple(one) if isinstance(one, list) else one for key, one in row[name].items()
            }
            return motion(**fields)
    return None
