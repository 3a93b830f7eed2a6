"""When a change that grows with a slope and a dying transient first reaches a threshold.

From now on the change is `x + S u + D (1 − e^(−ω u))`: a straight line, and what is left of the
photoreceptor's lag. This is the definition, for arrays; `crossing_time_cpu` is its compiled twin.
"""

from __future__ import annotations

from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.backend.elementary import exponential, natural_log

Float64Array: TypeAlias = NDArray[np.float64]
BoolArray: TypeAlias = NDArray[np.bool_]

NEVER = np.inf
NEGLIGIBLE = 1e-6
"""A transient below this share of the threshold is forgotten."""
LAST_STEP = 0.01
"""A step of Halley's method that is shorter, in time constants, is the last: what is left then is
in the order of its cube."""
MOST_STEPS = 60


class Course(NamedTuple):
    """How the change of some pixels goes on; all [n]."""

    change: Float64Array
    """x, now, log units."""
    slope: Float64Array
    """S, log units per µs."""
    transient: Float64Array
    """D, log units."""
    corner: Float64Array
    """ω, 1/µs."""
    room: Float64Array
    """How long this goes on, µs."""
    kept: Float64Array
    """e^(−ω room): what is left of the transient then."""

    def after(self, u: Float64Array, kept: Float64Array) -> Float64Array:
        """The change after a time, when e^(−ω u) of the transient is left."""
        return self.change + self.slope * u + self.transient * (1.0 - kept)

    def only(self, chosen: BoolArray) -> Course:
        """Some of the pixels."""
        return Course(*(column[chosen] for column in self))


def time_to_threshold(
    course: Course, on: Float64Array, off: Float64Array
) -> tuple[Float64Array, NDArray[np.uint8]]:
    """Time until the change reaches `on` or `−off`.

    Args:
        course: how it goes on.
        on: thresholds, [n], log units.
        off: thresholds, [n], log units.

    Returns:
        Times from now, µs, never longer than the room except for `NEVER`; and polarities.
    """
    wait, p = _along_line(course, on, off)
    curved = np.abs(course.transient) > NEGLIGIBLE * np.minimum(on, off)
    curved &= (course.change < on) & (-course.change < off)
    wait[curved], p[curved] = _along_curve(course.only(curved), on[curved], off[curved])
    is_over, is_under = course.change >= on, -course.change >= off
    wait[is_over | is_under] = 0.0
    p[is_over | is_under] = is_over[is_over | is_under]
    return wait, p


def _along_line(
    course: Course, on: Float64Array, off: Float64Array
) -> tuple[Float64Array, NDArray[np.uint8]]:
    target = np.where(course.slope > 0, on, -off)
    wait = np.full(on.shape, NEVER)
    np.divide(target - course.change, course.slope, out=wait, where=course.slope != 0)
    wait[wait > course.room] = NEVER
    return wait, (course.slope > 0).astype(np.uint8)


def _along_curve(
    course: Course, on: Float64Array, off: Float64Array
) -> tuple[Float64Array, NDArray[np.uint8]]:
    """The curve turns round at most once; on each of its two arcs it goes one way."""
    kick = course.corner * course.transient
    first = course.slope + kick
    turns = first * course.slope < 0
    ratio = np.divide(-kick, course.slope, out=np.ones(on.shape), where=turns)
    turn = np.where(turns, natural_log(ratio) / course.corner, NEVER)
    is_first = turn >= course.room
    stop = np.where(is_first, course.room, turn)
    kept = np.where(is_first, course.kept, 1.0 / ratio)
    level = course.after(stop, kept)
    rises = np.where(first == 0, course.slope > 0, first > 0)
    wait, p = np.full(on.shape, NEVER), rises.astype(np.uint8)
    now = np.zeros(on.shape)
    hits = _passes(level, rises, on, off)
    target = np.where(rises, on, -off)
    arc = _Arc(now, stop, now + 1.0, kept, course.change, level, target)
    wait[hits] = _solve(course.only(hits), arc.only(hits))

    rises = course.slope > 0
    last = course.after(course.room, course.kept)
    later = ~hits & ~is_first & _passes(last, rises, on, off)
    target = np.where(rises, on, -off)
    arc = _Arc(stop, course.room, kept, course.kept, level, last, target)
    wait[later], p[later] = _solve(course.only(later), arc.only(later)), rises[later]
    return wait, p


def _passes(
    change: Float64Array, rises: BoolArray, on: Float64Array, off: Float64Array
) -> BoolArray:
    return np.where(rises, change >= on, -change >= off)


class _Arc(NamedTuple):
    """Part of a course on which the change only rises or only falls, past a target; all [n]."""

    start: Float64Array
    stop: Float64Array
    kept_first: Float64Array
    """What is left of the transient at its start, as a share."""
    kept_last: Float64Array
    """What is left of it at its stop."""
    first: Float64Array
    """The change at its start."""
    last: Float64Array
    """The change at its stop."""
    target: Float64Array

    def only(self, chosen: BoolArray) -> _Arc:
        return _Arc(*(column[chosen] for column in self))


def _solve(course: Course, arc: _Arc) -> Float64Array:
    """When the change reaches the target: Halley's method.

    It starts from where the line alone, or the transient alone, would get there: whichever does
    more.
    """
    part = (arc.target - arc.first) / (arc.last - arc.first)
    line, fall = arc.stop - arc.start, arc.kept_first - arc.kept_last
    by_line = np.abs(course.slope) * line >= np.abs(course.transient) * fall
    left = np.where(by_line, 1.0, arc.kept_first - part * fall)
    u = np.where(by_line, arc.start + part * line, -natural_log(left) / course.corner)
    u = np.minimum(np.maximum(u, arc.start), arc.stop)
    busy = np.ones(u.shape, np.bool_)
    for _ in range(MOST_STEPS):
        kept = exponential(-course.corner * u)
        excess = course.after(u, kept) - arc.target
        kick = course.corner * course.transient * kept
        tangent = course.slope + kick
        newton = 2.0 * tangent * tangent
        bend = newton + excess * (course.corner * kick)
        # Where the curve bends so much that Halley's step would be more than twice Newton's.
        bend = np.where(2.0 * bend < newton, newton, bend)
        step = np.divide(2.0 * excess * tangent, bend, out=np.zeros(u.shape), where=bend > 0)
        ahead = np.minimum(np.maximum(u - step, arc.start), arc.stop)
        u = np.where(busy, ahead, u)
        busy &= np.abs(step) * course.corner > LAST_STEP
        if not busy.any():
            break
    return u
