"""When a change with a constant slope and a decaying transient first reaches a threshold.

After a time u the change is `x + S u + D (1 − e^(−ω u))`: a straight line, and the decay of the
photoreceptor's lag. This is the definition, for arrays; `crossing_time_cpu` is its compiled twin.
"""

from __future__ import annotations

from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.kernels.elementary import exponential, natural_log
from texvent.simulate.physical.crossing_time import LAST_STEP, MOST_STEPS, NEGLIGIBLE, NEVER

Float64Array: TypeAlias = NDArray[np.float64]
BoolArray: TypeAlias = NDArray[np.bool_]


class ChangeCurve(NamedTuple):
    """The change of some pixels from now on; all [n]."""

    change: Float64Array
    """x, now, log units."""
    slope: Float64Array
    """S, log units per µs."""
    transient: Float64Array
    """D, log units."""
    cutoff: Float64Array
    """ω, 1/µs."""
    duration: Float64Array
    """How long this lasts, µs."""
    kept: Float64Array
    """e^(−ω duration): what is left of the transient then."""

    def after(self, u: Float64Array, kept: Float64Array) -> Float64Array:
        """The change after a time, when e^(−ω u) of the transient is left."""
        return self.change + self.slope * u + self.transient * (1.0 - kept)

    def only(self, chosen: BoolArray) -> ChangeCurve:
        """Some of the pixels."""
        return ChangeCurve(*(column[chosen] for column in self))


def time_to_threshold(
    curve: ChangeCurve, on: Float64Array, off: Float64Array
) -> tuple[Float64Array, NDArray[np.uint8]]:
    """Time until the change reaches `on` or `−off`.

    Args:
        curve: the change from now on.
        on: thresholds, [n], log units.
        off: thresholds, [n], log units.

    Returns:
        Times from now, µs, never longer than the duration except for `NEVER`; and polarities.
    """
    wait, p = _along_line(curve, on, off)
    curved = np.abs(curve.transient) > NEGLIGIBLE * np.minimum(on, off)
    curved &= (curve.change < on) & (-curve.change < off)
    wait[curved], p[curved] = _along_curve(curve.only(curved), on[curved], off[curved])
    is_over, is_under = curve.change >= on, -curve.change >= off
    wait[is_over | is_under] = 0.0
    p[is_over | is_under] = is_over[is_over | is_under]
    return wait, p


def _along_line(
    curve: ChangeCurve, on: Float64Array, off: Float64Array
) -> tuple[Float64Array, NDArray[np.uint8]]:
    target = np.where(curve.slope > 0, on, -off)
    wait = np.full(on.shape, NEVER)
    np.divide(target - curve.change, curve.slope, out=wait, where=curve.slope != 0)
    wait[wait > curve.duration] = NEVER
    return wait, (curve.slope > 0).astype(np.uint8)


def _along_curve(
    curve: ChangeCurve, on: Float64Array, off: Float64Array
) -> tuple[Float64Array, NDArray[np.uint8]]:
    """The curve has at most one extremum, and is monotonic on the arc before and after it."""
    decay_slope = curve.cutoff * curve.transient
    first = curve.slope + decay_slope
    turns = first * curve.slope < 0
    ratio = np.divide(-decay_slope, curve.slope, out=np.ones(on.shape), where=turns)
    turn = np.where(turns, natural_log(ratio) / curve.cutoff, NEVER)
    is_first = turn >= curve.duration
    stop = np.where(is_first, curve.duration, turn)
    kept = np.where(is_first, curve.kept, 1.0 / ratio)
    level = curve.after(stop, kept)
    rises = np.where(first == 0, curve.slope > 0, first > 0)
    wait, p = np.full(on.shape, NEVER), rises.astype(np.uint8)
    now = np.zeros(on.shape)
    hits = _reaches(level, rises, on, off)
    target = np.where(rises, on, -off)
    arc = _Arc(now, stop, now + 1.0, kept, curve.change, level, target)
    wait[hits] = _solve(curve.only(hits), arc.only(hits))

    rises = curve.slope > 0
    last = curve.after(curve.duration, curve.kept)
    later = ~hits & ~is_first & _reaches(last, rises, on, off)
    target = np.where(rises, on, -off)
    arc = _Arc(stop, curve.duration, kept, curve.kept, level, last, target)
    wait[later], p[later] = _solve(curve.only(later), arc.only(later)), rises[later]
    return wait, p


def _reaches(
    change: Float64Array, rises: BoolArray, on: Float64Array, off: Float64Array
) -> BoolArray:
    return np.where(rises, change >= on, -change >= off)


class _Arc(NamedTuple):
    """Part of a curve on which the change only rises or only falls, to a target; all [n]."""

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


def _solve(curve: ChangeCurve, arc: _Arc) -> Float64Array:
    """When the change reaches the target: Halley's method.

    It starts from the time at which the line alone, or the transient alone, reaches the target:
    whichever changes more.
    """
    part = (arc.target - arc.first) / (arc.last - arc.first)
    line, fall = arc.stop - arc.start, arc.kept_first - arc.kept_last
    by_line = np.abs(curve.slope) * line >= np.abs(curve.transient) * fall
    left = np.where(by_line, 1.0, arc.kept_first - part * fall)
    u = np.where(by_line, arc.start + part * line, -natural_log(left) / curve.cutoff)
    u = np.minimum(np.maximum(u, arc.start), arc.stop)
    unsolved = np.ones(u.shape, np.bool_)
    for _ in range(MOST_STEPS):
        kept = exponential(-curve.cutoff * u)
        excess = curve.after(u, kept) - arc.target
        decay_slope = curve.cutoff * curve.transient * kept
        tangent = curve.slope + decay_slope
        newton = 2.0 * tangent * tangent
        denominator = newton + excess * (curve.cutoff * decay_slope)
        # Newton's step where Halley's would be more than twice as long.
        denominator = np.where(2.0 * denominator < newton, newton, denominator)
        step = np.zeros(u.shape)
        np.divide(2.0 * excess * tangent, denominator, out=step, where=denominator > 0)
        ahead = np.minimum(np.maximum(u - step, arc.start), arc.stop)
        u = np.where(unsolved, ahead, u)
        unsolved &= np.abs(step) * curve.cutoff > LAST_STEP
        if not unsolved.any():
            break
    return u
