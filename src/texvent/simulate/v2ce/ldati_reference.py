"""LDATI pixel by pixel, in plain Python numbers: the definition that `ldati` is tested against."""

from __future__ import annotations

import math

import numpy as np

from texvent.simulate.packets.interval import FrameInterval
from texvent.simulate.packets.unsorted_events import UnsortedEvents
from texvent.simulate.random.draws import draw_uniforms
from texvent.simulate.v2ce.ldati import (
    JUST_BELOW_ONE,
    TOLERANCE,
    Rounding,
    VoxelArray,
    check_voxel,
    rounding_draw,
    time_draw,
)


def sample_events(
    voxel: VoxelArray,
    interval: FrameInterval,
    *,
    rounding: Rounding = "published",
    bidirectional: bool = False,
) -> UnsortedEvents:
    """Events of one voxel grid; arguments, errors and events as `ldati.sample_events`."""
    check_voxel(voxel)
    _, nodes, height, width = voxel.shape
    length = nodes - 1
    rows: list[tuple[int, int, int]] = []
    for polarity, y, x in np.ndindex(2, height, width):
        column = [float(value) for value in voxel[polarity, :, y, x]]
        chance = float(draw_uniforms(interval.key, y, x, rounding_draw(polarity)))
        settle = None if rounding == "published" else chance
        counts, lone = place_column(column, settle, bidirectional=bidirectional)
        for i in range(length):
            for k in range(counts[i]):
                if counts[i] == 1:
                    fraction = lone[i]
                else:
                    draw = time_draw(polarity * length + i, k)
                    uniform = float(draw_uniforms(interval.key, y, x, draw))
                    fraction = invert_density(slope_at(counts, i), uniform)
                offset = math.floor((i + fraction) / length * interval.duration_us)
                t = min(interval.start_us + offset, interval.stop_us - 1)
                rows.append((y * width + x, t, 1 - polarity))
    pixel, t_us, p = np.array(rows, np.int64).reshape(-1, 3).T
    return UnsortedEvents.signal(pixel, t_us, p.astype(np.uint8))


def place_column(
    column: list[float], chance: float | None, *, bidirectional: bool
) -> tuple[list[int], list[float]]:
    """Counts per sub-interval of one pixel and polarity, and the places of lone events.

    Args:
        column: events per node, B numbers.
        chance: uniform number that rounds the rest, or None for the published rounding.
        bidirectional: go from both ends to the middle.

    Returns:
        B − 1 counts, and B − 1 fractions in [0, 1).
    """
    last = len(column) - 2
    settling = last // 2 if bidirectional else last
    counts, lone = [0] * (last + 1), [0.0] * (last + 1)
    debt = 0.0
    for i in range(settling if bidirectional else last + 1):
        due = column[i] - debt
        counts[i] = math.ceil(due - TOLERANCE)
        debt = lone[i] = counts[i] - due
    credit = column[last + 1]
    for i in range(last, settling, -1):
        lone[i] = credit
        held = column[i] + credit
        counts[i] = math.floor(held + TOLERANCE)
        credit = max(held - counts[i], 0.0)
    rest = credit - debt
    if bidirectional:
        lone[settling] = credit
        rest += column[settling]
    if chance is not None:
        whole = math.floor(rest + TOLERANCE)
        whole += chance < rest - whole
    else:
        whole = math.ceil(rest - TOLERANCE) if bidirectional else math.floor(rest + TOLERANCE)
        whole = max(whole, 0)
    counts[settling] += whole
    if counts[settling] < 0:
        counts[settling] = 0
        counts[max(i for i in range(settling + 1) if counts[i])] -= 1
    return counts, [min(max(place, 0.0), JUST_BELOW_ONE) for place in lone]


def slope_at(counts: list[int], i: int) -> float:
    """Slope of the density of event times in sub-interval i, which holds events."""
    if not 0 < i < len(counts) - 1:
        return 0.0
    return (counts[i + 1] - counts[i - 1]) / (2.0 * counts[i])


def invert_density(slope: float, chance: float) -> float:
    """The τ up to which the density `1 + s · (τ − ½)` has the area `chance`."""
    start = 1.0 - slope / 2.0
    root = math.sqrt(max(start * start + 2.0 * slope * chance, 0.0))
    if start < 0.0:
        return min((root - start) / slope, JUST_BELOW_ONE)
    return min(2.0 * chance / max(start + root, np.finfo(np.float64).tiny), JUST_BELOW_ONE)
