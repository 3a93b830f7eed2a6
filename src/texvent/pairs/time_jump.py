"""Gaps between frames far beyond the usual step: a clock was set, or recordings were joined.

A simulator fills the time between two frames with noise, for a day of it millions of events.
Slide shows and time-lapse videos have long steps, but regular ones; screen recorders and cameras
with motion detection stop for a while.
"""

from __future__ import annotations

import itertools
from collections import deque
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple, Protocol, TypeVar

import numpy as np

from texvent.errors import InputError, warn
from texvent.frames import MICROSECONDS

SHORTEST_US = 10 * MICROSECONDS
"""Shorter gaps are pauses."""
RATIO = 100
"""Jumps are at least this many usual steps long."""
LONGEST_US = 3600 * MICROSECONDS
"""Pauses of an hour and more are not simulated."""
MOST_STEPS = 101
"""The usual step is the median of this many before a gap."""


def is_jump(step_us: int, others_us: Sequence[int]) -> bool:
    """Whether a step is far longer than others, or far too long where there is no other."""
    if not others_us:
        return step_us >= LONGEST_US
    return step_us >= SHORTEST_US and step_us >= RATIO * float(np.median(others_us))


class Timed(Protocol):
    """A frame, or its time alone."""

    @property
    def t_us(self) -> int:
        """Time, µs."""
        ...


class FrameTime(NamedTuple):
    """The time of a frame without its pixels."""

    t_us: int


AnyTimed = TypeVar("AnyTimed", bound=Timed)


def check_times(times_us: Iterable[int]) -> None:
    """Refuse or warn of jumps, as `watch_steps`, before any frame is read."""
    for _ in watch_steps(map(FrameTime, times_us), is_live=False):
        pass


def watch_steps(frames: Iterable[AnyTimed], *, is_live: bool) -> Iterator[AnyTimed]:
    """The frames as they come; a jump is said before anything is made of it.

    Args:
        frames: in order of time.
        is_live: whether they come when they come; then no frame is read ahead, and a long first
            step counts as a jump, though it may be the usual one.

    Raises:
        InputError: a jump of an hour or more.

    Warns:
        TexventWarning: a shorter one.
    """
    steps: deque[int] = deque(maxlen=MOST_STEPS)
    source = iter(frames)
    last: AnyTimed | None = None
    while (frame := next(source, None)) is not None:
        if last is not None:
            step = frame.t_us - last.t_us
            others: Sequence[int] = steps
            if not steps and step >= SHORTEST_US and not is_live:
                # The first step has nothing before it to be compared with.
                following = list(itertools.islice(source, 1))
                source = itertools.chain(following, source)
                others = [one.t_us - frame.t_us for one in following]
            if is_jump(step, others):
                _say(last.t_us, step)
            else:
                steps.append(step)
        last = frame
        yield frame


def _say(before_us: int, step_us: int) -> None:
    at, seconds = before_us / MICROSECONDS, step_us / MICROSECONDS
    what = f"after {at:,.6g} s the next frame is {seconds:,.6g} s later, far beyond the usual step"
    if step_us < LONGEST_US:
        warn(f"{what}; noise fills the pause")
        return
    raise InputError(
        f"{what}, and noise would fill {seconds / 3600:,.1f} hours; times are µs: convert them, "
        "give frames a rate (`fps`), or simulate the parts one by one (`start`, `stop`; of an "
        "event camera `reset()`)"
    )
