"""Times at which changes first reach a threshold, as Triton functions; see `..crossing_time`."""

from __future__ import annotations

import triton
import triton.language as tl

from texvent.simulation.gpu.elementary_triton import exponential, natural_log
from texvent.simulation.physical import crossing_time

NEGLIGIBLE = tl.constexpr(crossing_time.NEGLIGIBLE)
_LAST_STEP = tl.constexpr(crossing_time.LAST_STEP)
_MOST_STEPS = tl.constexpr(crossing_time.MOST_STEPS)


@triton.jit
def find_crossings(curve: tl.tuple, on: tl.tensor, off: tl.tensor) -> tl.tuple:
    """Time until a change reaches a threshold, µs, infinite for never; and whether it is ON.

    Args:
        curve: change, slope, transient, cutoff, duration and the share of the transient that is
            left then; float64.
        on: ON threshold.
        off: OFF threshold.
    """
    change, slope, transient, cutoff, duration, kept = curve
    steep = tl.where(slope == 0, 1.0, slope)
    wait = (tl.where(slope > 0, on, -off) - change) / steep
    wait = tl.where((wait > duration) | (slope == 0), float("inf"), wait)
    is_high, is_low = change >= on, change <= -off
    wait = tl.where(is_high | is_low, 0.0, wait)
    rises = is_high | ((slope > 0) & (is_low == 0))
    # End of the first arc: the extremum, or the end.
    decay_slope = cutoff * transient
    turns = (slope + decay_slope) * slope < 0
    ratio = tl.where(turns, -decay_slope / steep, 1.0)
    turn = natural_log(ratio) / tl.where(turns, cutoff, 1.0)
    turn = tl.where(turns, turn, float("inf"))
    stop = tl.where(turn >= duration, duration, turn)
    left = tl.where(turn >= duration, kept, 1.0 / ratio)
    level = change + slope * stop + transient * (1.0 - left)
    at_end = change + slope * duration + transient * (1.0 - kept)
    # The arc that meets a threshold.
    up = (slope > 0) & (at_end >= on)
    down = (slope <= 0) & (at_end <= -off)
    later = (turn < duration) & (up | down)
    direction = tl.where(slope + decay_slope == 0, slope, slope + decay_slope)
    is_first = tl.where(direction > 0, level, -level) >= tl.where(direction > 0, on, off)
    is_curved = (tl.abs(transient) > tl.minimum(on, off) * NEGLIGIBLE) & ((is_high | is_low) == 0)
    meets = is_curved & (is_first | later)
    wait = tl.where(is_curved, float("inf"), wait)
    if tl.max(meets.to(tl.int32)) > 0:
        times = tl.where(is_first, 0.0, stop), tl.where(is_first, stop, duration)
        shares = tl.where(is_first, 1.0, left), tl.where(is_first, left, kept)
        changes = tl.where(is_first, change, level), tl.where(is_first, level, at_end)
        is_on = changes[1] > changes[0]
        target = tl.where(is_on, on, -off)
        wait = tl.where(meets, _solve(curve, times, shares, changes, target, meets), wait)
        rises = tl.where(meets, is_on, rises)
    return wait, rises


@triton.jit
def _solve(
    curve: tl.tuple,
    times: tl.tuple,
    shares: tl.tuple,
    changes: tl.tuple,
    target: tl.tensor,
    where: tl.tensor,
) -> tl.tensor:
    """Time at which a monotonic arc reaches its target: Halley's method."""
    change, slope, transient, cutoff, _, _ = curve
    start, end = times
    line, fall = end - start, shares[0] - shares[1]
    part = (target - changes[0]) / tl.where(where, changes[1] - changes[0], 1.0)
    by_line = tl.abs(slope) * line >= tl.abs(transient) * fall
    left = tl.where(where & (by_line == 0), shares[0] - part * fall, 1.0)
    u = -natural_log(left) / tl.where(where, cutoff, 1.0)
    u = tl.where(by_line, start + part * line, u)
    u = tl.minimum(tl.maximum(u, start), end)
    unsolved, steps = where, 0
    while (tl.max(unsolved.to(tl.int32)) > 0) & (steps < _MOST_STEPS):
        kept = exponential(-cutoff * u)
        excess = change + slope * u + transient * (1.0 - kept) - target
        decay_slope = cutoff * transient * kept
        tangent = slope + decay_slope
        newton = 2.0 * tangent * tangent
        denominator = newton + excess * (cutoff * decay_slope)
        denominator = tl.where(2.0 * denominator < newton, newton, denominator)
        step = 2.0 * excess * tangent / tl.where(denominator > 0, denominator, 1.0)
        step = tl.where(denominator > 0, step, 0.0)
        ahead = tl.minimum(tl.maximum(u - step, start), end)
        u = tl.where(unsolved, ahead, u)
        unsolved = unsolved & (tl.abs(step) * cutoff > _LAST_STEP)
        steps += 1
    return u
