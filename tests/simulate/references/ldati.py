"""LDATI pixel by pixel, in plain Python numbers: the definition that `ldati` is tested against."""

from __future__ import annotations

import math

import numpy as np

from texvent.simulate.packets import FrameInterval, UnsortedEvents
from texvent.simulate.random.draws import draw_uniforms
from texvent.simulate.v2ce.ldati import (
    JUST_BELOW_ONE,
    TOLERANCE,
    VoxelArray,
    time_draw,
)


def sample_events(voxel: VoxelArray, interval: FrameInterval) -> UnsortedEvents:
    """Events of one voxel grid; arguments and events as `ldati.sample_events`."""
    _, nodes, height, width = voxel.shape
    length = nodes - 1
    rows: list[tuple[int, int, int]] = []
    for polarity, y, x in np.ndindex(2, height, width):
        column = [float(value) for value in voxel[polarity, :, y, x]]
        counts, lone = place_column(column)
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


def place_column(column: list[float]) -> tuple[list[int], list[float]]:
    """Counts per sub-interval of one pixel and polarity, and the places of lone events.

    Args:
        column: events per node, B numbers.

    Returns:
        B − 1 counts, and B − 1 fractions in [0, 1).
    """
    last = len(column) - 2
    counts, lone = [0] * (last + 1), [0.0] * (last + 1)
    carry = 0.0
    for i in range(last + 1):
        left = column[i] - carry
        counts[i] = math.ceil(left - TOLERANCE)
        carry = lone[i] = counts[i] - left
    remainder = column[last + 1] - carry
    counts[last] += max(math.floor(remainder + TOLERANCE), 0)
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
