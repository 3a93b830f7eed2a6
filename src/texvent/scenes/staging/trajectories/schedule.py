"""When each of several motions happens."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from texvent.scenes.description import STANDING, ObjectMotion


@dataclass(frozen=True)
class Phase:
    """One motion and when it happens, s."""

    motion: ObjectMotion
    start_s: float
    end_s: float

    @property
    def duration_s(self) -> float:
        """Length of the phase, s."""
        return self.end_s - self.start_s


def schedule(motions: Sequence[ObjectMotion], duration_s: float) -> list[Phase]:
    """When each motion happens: where the prompt says so, else in even shares of the time.

    Motions that would begin at the end of the clip or later are left out.
    """
    motions = list(motions)
    if motions[0].start_s:
        motions.insert(0, STANDING)
    known = [motion.start_s for motion in motions]
    starts = [0.0]
    for number in range(1, len(motions)):
        start = known[number]
        if start is None:
            later = next((n for n in range(number, len(known)) if known[n] is not None), len(known))
            after = known[later] if later < len(known) else duration_s
            start = starts[-1] + max((after or 0.0) - starts[-1], 0.0) / (later - number + 1)
        starts.append(max(start, starts[-1]))
    starts.append(duration_s)
    times = [min(start, duration_s) for start in starts]
    shown = [
        Phase(motion, begin, max(end, begin))
        for motion, begin, end in zip(motions, times, times[1:], strict=False)
    ]
    return [phase for phase in shown if phase.duration_s > 1e-6 * duration_s]


def left_out(motions: Sequence[ObjectMotion], duration_s: float) -> list[ObjectMotion]:
    """Motions that would begin when the clip is over."""
    return [m for m in motions if m.start_s is not None and m.start_s >= duration_s]
