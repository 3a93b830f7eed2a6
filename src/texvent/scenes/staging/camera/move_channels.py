"""Camera moves as sums over time: how far the camera has panned, risen or zoomed at an instant."""

from __future__ import annotations

import math
from functools import cached_property

from texvent.scenes.description import CameraMove

EASE = 0.2
"""Share of a phase in which a move starts or stops, where it does so within the clip."""
USUAL_S = 2.0
"""Length of a phase in which a move goes its usual way; shorter ones go less far."""
SIGNS = {
    "left": -1.0, "right": 1.0, "up": 1.0, "down": -1.0, "in": 1.0, "out": -1.0,
    "clockwise": 1.0, "counter-clockwise": -1.0,
}  # fmt: skip


class MoveChannels:
    """Progress of all moves of a shot; each a smooth function of the share of the clip."""

    def __init__(self, moves: tuple[CameraMove, ...], duration_s: float = USUAL_S) -> None:
        self.moves = moves
        self._last = max((move.phase for move in moves), default=0)
        spell = duration_s / (self._last + 1) / USUAL_S
        self._amount = min(max(math.sqrt(spell), 0.5), 1.3)

    def has(self, kind: str) -> bool:
        """Whether a kind of move is among them."""
        return any(move.kind == kind for move in self.moves)

    def centred(self, kind: str, share: float) -> float:
        """Sum of the moves of a kind, in usual amounts, about the middle of its range."""
        low, high = self._ranges[kind]
        return self._sum(kind, share) - 0.5 * (low + high)

    def below_most(self, kind: str, share: float) -> float:
        """The same, 0 where it is largest and negative elsewhere: zoom and dolly."""
        return self._sum(kind, share) - self._ranges[kind][1]

    def progress(self, phase: int, share: float) -> float:
        """0 before a phase, 1 after it; eases where the phase begins or ends within the clip."""
        count = self._last + 1
        u = share * count - phase
        return _eased(u, has_start=phase > 0, has_end=phase < self._last)

    def _sum(self, kind: str, share: float) -> float:
        return self._amount * sum(
            move.pace * SIGNS.get(move.direction or "right", 1.0) * self.progress(move.phase, share)
            for move in self.moves
            if move.kind == kind
        )

    @cached_property
    def _ranges(self) -> dict[str, tuple[float, float]]:
        """Kind → least and most of its sum; moves are monotonous within a phase."""
        edges = [number / (self._last + 1) for number in range(self._last + 2)]
        sums = {move.kind: [self._sum(move.kind, share) for share in edges] for move in self.moves}
        return {kind: (min(values), max(values)) for kind, values in sums.items()}


def _eased(u: float, *, has_start: bool, has_end: bool) -> float:
    """Progress 0..1 over 0 <= u <= 1; goes on evenly outside where it does not ease."""
    rise = EASE if has_start else 0.0
    fall = EASE if has_end else 0.0
    rate = 1.0 / (1.0 - 0.5 * (rise + fall))
    if u <= 0.0:
        return 0.0 if has_start else rate * u
    if u >= 1.0:
        return 1.0 if has_end else 1.0 + rate * (u - 1.0)
    if u < rise:
        return rate * rise * _area(u / rise)
    if u > 1.0 - fall:
        return 1.0 - rate * fall * _area((1.0 - u) / fall)
    return rate * (u - 0.5 * rise)


def _area(v: float) -> float:
    """Integral of 3v² - 2v³ from 0."""
    return v * v * v - 0.5 * v**4
