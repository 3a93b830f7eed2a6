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

from typing import Any, Literal, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_range
from texvent.errors import InputError
from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent.simulate.packets import FrameInterval, UnsortedEvents, make_packet, place_in
from texvent.simulate.random.draws import Purpose, draw_uniforms, frame_key

Rounding: TypeAlias = Literal["published", "stochastic"]
VoxelArray: TypeAlias = NDArray[Any]
"""[2, B, H, W] float: events per node, ON first, then OFF."""
Float64Array: TypeAlias = NDArray[np.float64]

TOLERANCE = 1e-6
"""Part of an event below which a sum counts as whole."""
JUST_BELOW_ONE = 1.0 - 2.0**-53
ORDER_BITS = 14
"""Bits of a draw's number that count the events of one sub-interval."""
MAX_COUNT = 2**ORDER_BITS - 1
MAX_NODES = 4096
ROUNDING_ORDER = 1 << 27
"""First draw for rounding; those below are for times."""


def voxel_to_events(
    voxel: VoxelArray,
    start_us: int,
    stop_us: int,
    *,
    seed: int = 0,
    rounding: Rounding = "published",
) -> EventStream:
    """Events of one voxel grid.

    Args:
        voxel: events per node, [2, B, H, W], ON first, then OFF; see the module's text.
        start_us: time of node 0, µs (included).
        stop_us: time of node B − 1, µs (excluded).
        seed: of the random draws, 0..2⁶³−1.
        rounding: as for `sample_events`.

    Raises:
        InputError: the grid has another shape, a negative or infinite count or too large a one,
            or no time passes.

    Example:
        >>> voxel = np.zeros((2, 10, 1, 1))
        >>> voxel[0, 3:5, 0, 0] = 0.25, 0.75  # one ON event, at 3.75 ninths of the interval
        >>> events = voxel_to_events(voxel, 0, 9000)
        >>> events.t.tolist(), events.polarity.tolist()
        ([3750], [1])
    """
    check_range("seed", seed, 0, 2**63 - 1)
    if stop_us <= start_us:
        raise InputError(
            f"the interval {start_us}..{stop_us} µs is empty; it must last 1 µs or more"
        )
    interval = FrameInterval(start_us, stop_us, frame_key(seed, stop_us - start_us))
    events = sample_events(voxel, interval, rounding=rounding)
    return make_packet(events, interval, SensorSize(voxel.shape[3], voxel.shape[2]))


def sample_events(
    voxel: VoxelArray,
    interval: FrameInterval,
    *,
    rounding: Rounding = "published",
) -> UnsortedEvents:
    """Events of one voxel grid, unsorted.

    Args:
        voxel: events per node, [2, B, H, W], ON first, then OFF.
        interval: time from node 0 to node B − 1; its key decides the draws.
        rounding: of the part of an event that is left where a pixel's sum is not
            whole; see `infer_counts`.

    Raises:
        InputError: another shape, a negative or infinite count, or too large a one.

    Source: V2CE, section on LDATI.
    """
    check_voxel(voxel)
    placed = infer_counts(voxel, interval.key, rounding=rounding)
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


def infer_counts(voxel: VoxelArray, key: np.uint64, *, rounding: Rounding) -> PlacedCounts:
    """Events per sub-interval, so that their linear voxel grid is close to `voxel`.

    From the start: node i, less the carry of the events before it, is what the events of
    sub-interval i added to it. The next whole number is their count. The difference, which they
    must have added to node i + 1, is carried there. The remainder, the last
    node less its carry, goes to the last sub-interval.

    Args:
        voxel: events per node, [2, B, H, W].
        key: of the draws, for stochastic rounding.
        rounding: "published": the remainder is rounded down and is never below 0, so a pixel's
            number of events is its sum rounded down or up.
            "stochastic": rounded to either side, so that the mean number is the sum.
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
    if rounding == "published":
        whole = np.floor(remainder + TOLERANCE)
        counts[:, -1] += np.maximum(whole, 0.0).astype(np.int64)
    else:
        _round_at_random(counts, remainder, key)
    if int(counts.max()) > MAX_COUNT:
        raise InputError(
            f"the voxel grid holds {int(counts.max())} events of one pixel between two nodes; "
            f"at most {MAX_COUNT} are possible"
        )
    return PlacedCounts(counts, np.clip(fraction, 0.0, JUST_BELOW_ONE))


def _round_at_random(counts: NDArray[np.int64], remainder: Float64Array, key: np.uint64) -> None:
    """Add the remainder, rounded up or down at random; a negative one removes the latest event."""
    height, width = remainder.shape[1:]
    polarity, row, column = np.ogrid[: remainder.shape[0], :height, :width]
    chance = draw_uniforms(key, row, column, rounding_draw(polarity))
    whole = np.floor(remainder + TOLERANCE)
    counts[:, -1] += (whole + (chance < remainder - whole)).astype(np.int64)
    p, y, x = np.nonzero(counts[:, -1] < 0)
    counts[p, -1, y, x] = 0
    has_events = counts[p, :, y, x] > 0
    latest = counts.shape[1] - 1 - np.argmax(has_events[:, ::-1], axis=1)
    counts[p, latest, y, x] -= 1


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


def rounding_draw(polarity: Any) -> Any:
    """Number of the draw that rounds the remainder of a polarity (0 = ON, 1 = OFF)."""
    return Purpose.VOXEL.draw(ROUNDING_ORDER + polarity)


def check_voxel(voxel: VoxelArray) -> None:
    """Refuse what is no voxel grid of counts.

    Raises:
        InputError: not [2, B ≥ 2, H, W], or a count that is NaN, infinite or negative.
    """
    shape = np.shape(voxel)
    if len(shape) != 4 or shape[0] != 2 or not 2 <= shape[1] <= MAX_NODES or 0 in shape:
        raise InputError(
            f"a voxel grid must be [2, B, H, W] (ON and OFF, 2..{MAX_NODES} nodes in time); "
            f"got shape {list(shape)}"
        )
    low, high = float(np.min(voxel)), float(np.max(voxel))
    if not (low >= 0.0 and high < float("inf")):
        raise InputError(
            f"a voxel grid must hold finite counts of at least 0; got {low:g}..{high:g}. Split a "
            "signed grid into ON and OFF"
        )
