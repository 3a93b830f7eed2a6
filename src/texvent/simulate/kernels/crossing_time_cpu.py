"""`crossing_time` for one pixel, compiled by Numba to be called in kernels: same bits."""

from __future__ import annotations

import numba

from texvent.simulate.kernels.crossing_time import LAST_STEP, MOST_STEPS, NEGLIGIBLE, NEVER
from texvent.simulate.kernels.elementary_cpu import exponential, natural_log

Course = tuple[float, float, float, float, float, float]
"""The fields of `crossing_time.Course`, for one pixel."""


@numba.njit(cache=True, nogil=True, error_model="numpy")
def time_to_threshold(course: Course, on: float, off: float) -> tuple[float, int]:
    """See `crossing_time.time_to_threshold`."""
    change, slope, transient, _, room, _ = course
    if change >= on:
        return 0.0, 1
    if -change >= off:
        return 0.0, 0
    if abs(transient) > NEGLIGIBLE * min(on, off):
        return _along_curve(course, on, off)
    if slope == 0:
        return NEVER, 0
    wait = ((on if slope > 0 else -off) - change) / slope
    return (NEVER if wait > room else wait), (1 if slope > 0 else 0)


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _along_curve(course: Course, on: float, off: float) -> tuple[float, int]:
    change, slope, transient, corner, room, kept = course
    kick = corner * transient
    first = slope + kick
    turn, stop, left = NEVER, room, kept
    if first * slope < 0:
        ratio = -kick / slope
        turn = natural_log(ratio) / corner
        if turn < room:
            stop, left = turn, 1.0 / ratio
    level = _after(course, stop, left)
    rises = slope > 0 if first == 0 else first > 0
    if _passes(level, rises, on, off):
        arc = 0.0, stop, 1.0, left, change, level, on if rises else -off
        return _solve(course, arc), (1 if rises else 0)
    if not turn < room:
        return NEVER, 0
    rises, last = slope > 0, _after(course, room, kept)
    if _passes(last, rises, on, off):
        arc = stop, room, left, kept, level, last, on if rises else -off
        return _solve(course, arc), (1 if rises else 0)
    return NEVER, 0


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _after(course: Course, u: float, kept: float) -> float:
    change, slope, transient, _, _, _ = course
    return change + slope * u + transient * (1.0 - kept)


@numba.njit(cache=True, nogil=True)
def _passes(change: float, rises: bool, on: float, off: float) -> bool:
    return change >= on if rises else -change >= off


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _solve(course: Course, arc: tuple[float, float, float, float, float, float, float]) -> float:
    _, slope, transient, corner, _, _ = course
    start, stop, kept_first, kept_last, first, last, target = arc
    part = (target - first) / (last - first)
    line, fall = stop - start, kept_first - kept_last
    if abs(slope) * line >= abs(transient) * fall:
        u = start + part * line
    else:
        u = -natural_log(kept_first - part * fall) / corner
    u = min(max(u, start), stop)
    for _step in range(MOST_STEPS):
        kept = exponential(-corner * u)
        excess = _after(course, u, kept) - target
        kick = corner * transient * kept
        tangent = slope + kick
        newton = 2.0 * tangent * tangent
        bend = newton + excess * (corner * kick)
        bend = newton if 2.0 * bend < newton else bend
        if not bend > 0:
            break
        step = 2.0 * excess * tangent / bend
        u = min(max(u - step, start), stop)
        if not abs(step) * corner > LAST_STEP:
            break
    return u
