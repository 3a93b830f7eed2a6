"""LDATI: a voxel grid of event counts becomes events at continuous times.

Local dynamic-aware timestamp inference, from V2CE (Zhang et al., "V2CE: Video to Continuous
Events Simulator", ICRA 2024); it works on any voxel grid that is linear in time:

    node:        0          1          2   ...   B-1       B nodes, evenly spaced in the interval
                 |----------|----------|---------|
    sub-interval:     0          1        ...            B-1 sub-intervals between them

An event in sub-interval i, at the fraction τ of its length, added 1 − τ to node i and τ to
node i + 1. Going along a pixel's nodes undoes this: the first node says how many events its
sub-interval holds, and what they must have added to the second node, and so on. A lone event gets
exactly the time that made the grid. Where a sub-interval holds several, the grid cannot
resolve them: their times are drawn from a density that rises or falls as the neighbours' counts do.

docs/simulators/v2ce.md names the deviations.
"""

from __future__ import annotations

from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError
from texvent.simulate.packets import FrameInterval, UnsortedEvents, place_in
from texvent.simulate.random.draws import Purpose, draw_uniforms

VoxelArray: TypeAlias = NDArray[Any]
"""[2, B, H, W] float: events per node, ON first, then OFF."""
Float64Array: TypeAlias = NDArray[np.float64]

TOLERANCE = 1e-6
"""Part of an event below which a sum counts as whole."""
JUST_BELOW_ONE = 1.0 - 2.0**-53
ORDER_BITS = 14
"""Bits of a draw's number that count the events of one sub-interval."""
MAX_COUNT = 2**ORDER_BITS - 1


def sample_events(voxel: VoxelArray, interval: FrameInterval) -> UnsortedEvents:
    """Events of one voxel grid, unsorted.

    Args:
        voxel: events per node, [2, B, H, W], ON first, then OFF; finite, at least 0.
        interval: time from node 0 to node B − 1; its key decides the draws.

    Raises:
        InputError: a count is too large.

    Source: V2CE, section on LDATI.
    """
    placed = infer_counts(voxel)
    slope = density_slope(placed.counts)
    lone = np.nonzero(placed.counts == 1)
    crowd = np.nonzero(placed.counts > 1)
    sizes = placed.counts[crowd]
    # Row k of a sub-interval's events takes its k-th draw.
    order = np.arange(sizes.sum()) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    p, i, y, x = (np.repeat(index, sizes) for index in crowd)
    chance = draw_uniforms(interval.key, y, x, time_draw(p * placed.counts.shape[1] + i, order))
    fraction = sample_density(np.repeat(slope[crowd], sizes), chance)
    polarity, position, row, column = (
        np.concatenate([one, many]) for one, many in zip(lone, (p, i, y, x), strict=True)
    )
    fraction = np.concatenate([placed.fraction[lone], fraction])
    t = place_in(interval, (position + fraction) / placed.counts.shape[1])
    return UnsortedEvents.signal(row * voxel.shape[3] + column, t, (polarity == 0).astype(np.uint8))


class PlacedCounts(NamedTuple):
    """Number of events of each sub-interval, and the time of a lone one."""

    counts: NDArray[np.int64]
    """[2, B − 1, H, W], at least 0."""
    fraction: Float64Array
    """[2, B − 1, H, W], place of a lone event in its sub-interval, in [0, 1)."""


def infer_counts(voxel: VoxelArray) -> PlacedCounts:
    """Events per sub-interval, so that their linear voxel grid is close to `voxel`.

    From the start: node i, less the carry of the events before it, is what the events of
    sub-interval i added to it. The next whole number is their count. The difference, which they
    must have added to node i + 1, is carried there. The remainder, the last
    node less its carry, goes to the last sub-interval, rounded down and never below 0: a pixel's
    number of events is its sum rounded down or up.

    Args:
        voxel: events per node, [2, B, H, W].
    """
    nodes = np.asarray(voxel, np.float64)
    length = nodes.shape[1] - 1
    shape = (nodes.shape[0], length, *nodes.shape[2:])
    counts, fraction = np.zeros(shape, np.int64), np.zeros(shape)
    carry = np.zeros_like(nodes[:, 0])
    for i in range(length):
        left = nodes[:, i] - carry
        counts[:, i] = np.ceil(left - TOLERANCE)
        carry = counts[:, i] - left
        fraction[:, i] = carry
    remainder = nodes[:, length] - carry
    whole = np.floor(remainder + TOLERANCE)
    counts[:, -1] += np.maximum(whole, 0.0).astype(np.int64)
    if int(counts.max()) > MAX_COUNT:
        raise InputError(
            f"the voxel grid holds {int(counts.max())} events of one pixel between two nodes; "
            f"at most {MAX_COUNT} are possible"
        )
    return PlacedCounts(counts, np.clip(fraction, 0.0, JUST_BELOW_ONE))


def density_slope(counts: NDArray[np.int64]) -> Float64Array:
    """Slope s of the density 1 + s · (τ − ½) of event times τ in each sub-interval.

    s is the slope of the line fitted to the counts of three neighbours, in units of the middle
    one: `(n[i+1] − n[i−1]) / (2 n[i])`. The first and last sub-interval have a neighbour on one
    side only and no slope.

    Args:
        counts: events per sub-interval, [2, B − 1, H, W].

    Returns:
        [2, B − 1, H, W]; 0 where nothing happens.
    """
    slope = np.zeros(counts.shape)
    middle = counts[:, 1:-1]
    change = (counts[:, 2:] - counts[:, :-2]) / (2.0 * np.maximum(middle, 1))
    slope[:, 1:-1] = np.where(middle > 0, change, 0.0)
    return slope


def sample_density(slope: Float64Array, chance: Float64Array) -> Float64Array:
    """Times τ in [0, 1) of the density `1 + s · (τ − ½)`: its distribution, inverted.

    A line steeper than 2 would be negative at its low end. Times then come from that part at its
    high end whose area is 1: the last (s > 0) or first (s < 0) `2 / |s|` of the sub-interval.

    Args:
        slope: s, [n].
        chance: uniform numbers in [0, 1), [n].

    Returns:
        The greater τ with `(1 − s/2) τ + s τ²/2 = chance`, [n].

    Example:
        >>> sample_density(np.array([0.0, 2.0, -2.0]), np.array([0.25, 0.25, 0.75])).tolist()
        [0.25, 0.5, 0.5]
    """
    start = 1.0 - slope / 2.0
    root = np.sqrt(np.maximum(start * start + 2.0 * slope * chance, 0.0))
    # Two forms of the quadratic's root, each where it subtracts nothing from its like.
    is_steep = start < 0.0
    fraction = np.where(
        is_steep,
        (root - start) / np.where(is_steep, slope, 1.0),
        2.0 * chance / np.maximum(start + root, np.finfo(np.float64).tiny),
    )
    return np.asarray(np.minimum(fraction, JUST_BELOW_ONE))


def time_draw(place: Any, order: Any) -> Any:
    """Number of the draw for the time of event `order` at `place` = polarity · (B − 1) + i."""
    return Purpose.VOXEL.draw(place * 2**ORDER_BITS + order)
