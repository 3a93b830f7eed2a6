"""Camera moves as sums over time: how far the camera has panned, risen or zoomed at an instant."""

from __future__ import annotations

import math
from functools import cached_property

from texvent.scenes.description import CameraMove

EASE = 0.2
"""Share of a move in which it starts or stops, where it does so within the clip."""
USUAL_S = 2.0
"""Length of a move that goes its usual way; shorter ones go less far."""
_STEPS = 64
"""Steps of the clip in which the range of a move is found."""
_SIGNS = {
    "left": -1.0, "right": 1.0, "up": 1.0, "down": -1.0, "in": 1.0, "out": -1.0,
    "clockwise": 1.0, "counter-clockwise": -1.0,
}  # fmt: skip


class MoveChannels:
    """Progress of all moves of a shot; each a smooth function of time.

    Moves with times of their own keep to them; others of one phase happen together, and phases
    follow each other and share the clip evenly.
    """

    def __init__(self, moves: tuple[CameraMove, ...], duration_s: float = USUAL_S) -> None:
        self.moves = moves
        self._duration_s = duration_s
        self._phases = 1 + max((move.phase for move in moves if not move.is_timed), default=0)

    def has(self, kind: str) -> bool:
        """Whether a kind of move is among them."""
        return any(move.kind == kind for move in self.moves)

    def centred(self, kind: str, time_s: float) -> float:
        """Sum of the moves of a kind, in usual amounts, about the middle of its range.

        0 where there is no such move.
        """
        low, high = self._ranges.get(kind, (0.0, 0.0))
        return self._sum(kind, time_s) - 0.5 * (low + high)

    def below_most(self, kind: str, time_s: float) -> float:
        """The same, 0 where it is largest and negative elsewhere: zoom and dolly."""
        return self._sum(kind, time_s) - self._ranges.get(kind, (0.0, 0.0))[1]

    def span_s(self, move: CameraMove) -> tuple[float, float]:
        """When a move starts and stops, s."""
        if not move.is_timed:
            share = self._duration_s / self._phases
            return move.phase * share, (move.phase + 1) * share
        start = move.start_s or 0.0
        stop = self._duration_s if move.stop_s is None else move.stop_s
        return start, max(stop, start + 1e-3)

    def _sum(self, kind: str, time_s: float) -> float:
        return sum(self._reach(move, time_s) for move in self.moves if move.kind == kind)

    def _reach(self, move: CameraMove, time_s: float) -> float:
        """How far one move has gone, in usual amounts."""
        start, stop = self.span_s(move)
        has_start, has_end = start > 0.0, stop < (1.0 - 1e-9) * self._duration_s
        amount = min(max(math.sqrt((stop - start) / USUAL_S), 0.5), 1.3)
        amount *= move.pace * _SIGNS.get(move.direction or "right", 1.0)
        share = (time_s - start) / (stop - start)
        return amount * _eased(share, has_start=has_start, has_end=has_end)

    @cached_property
    def _ranges(self) -> dict[str, tuple[float, float]]:
        """Kind → least and most of its sum over the clip."""
        times = {self._duration_s * step / _STEPS for step in range(_STEPS + 1)}
        for move in self.moves:
            times.update(min(time, self._duration_s) for time in self.span_s(move))
        sums = {move.kind: [self._sum(move.kind, time) for time in times] for move in self.moves}
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
