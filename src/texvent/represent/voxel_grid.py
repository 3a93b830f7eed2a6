"""Voxel grids: polarity spread over the two nearest time bins of each event's pixel.

With N events in B bins, t* = (B − 1)(t − t₁) / (t_N − t₁) is an event's place on the axis of bins,
and every bin b within 1 of it receives polarity · (1 − |b − t*|).

Shares of bins are added up as integers, in units of 1 / (t_N − t₁), and divided once: sums are
exact, so NumPy, torch and every GPU give the same float32.

In all of them no events give zeros, and events that all have one time fall in bin 0.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_range
from texvent.errors import InputError
from texvent.represent.array_ops import (
    Array,
    ArrayOps,
    Axis,
    EventColumns,
    Events,
    columns_of,
    flat_index,
    sides_of,
)

MAX_BINS = 4096
MAX_INT64 = 2**63 - 1
PADDING = 1
"""Planes after the last bin that take the shares which fall beyond it, and are cut off."""


def voxel_zhu(events: Events, *, bins: int = 9, split_polarity: bool = False) -> Array:
    """Discretised event volume of Zhu et al.

    Args:
        events: the slice.
        bins: B, 1..4096; the paper has 9.
        split_polarity: give ON and OFF volumes of their own, both positive, in place of one signed
            sum, as the authors' later program (EventGAN) does.

    Returns:
        [B, H, W] float32, events (signed); or [2 · B, H, W], first the ON bins, then the OFF bins.

    Raises:
        ConfigError: bins out of range.
        InputError: so many events over so long a time that sums could overflow.

    Source: A. Z. Zhu, L. Yuan, K. Chaney, K. Daniilidis, "Unsupervised event-based learning of
        optical flow, depth, and egomotion", CVPR 2019, section 3.1: V(x, y, t) =
        Σ pᵢ k(x − xᵢ) k(y − yᵢ) k(t − tᵢ*) with k(a) = max(0, 1 − |a|), tᵢ* as above. Pixels are
        whole numbers, so the kernels in x and y are 1 at the event's pixel and 0 elsewhere.

    Example:
        >>> from texvent.events import EventStream
        >>> from texvent.sensor import SensorSize
        >>> events = EventStream([0, 0, 0], [0, 0, 0], [0, 10, 40], [1, 0, 1], SensorSize(1, 1))
        >>> voxel_zhu(events, bins=3).ravel().tolist()  # t* = 0, 0.5, 2
        [0.5, -0.5, 1.0]
    """
    columns = columns_of(events)
    return _spread(columns, bins, split_polarity=split_polarity)


def voxel_e2vid(events: Events, *, bins: int = 5, normalise: bool = False) -> Array:
    """Event tensor of E2VID: the same numbers as `voxel_zhu`, with the names and bins of E2VID.

    Args:
        events: the slice.
        bins: B, 1..4096; the published networks take 5.
        normalise: bring the non-zero voxels to mean 0 and standard deviation 1. E2VID and FireNet
            do so before the network; HyperE2VID and ET-Net do not.

    Returns:
        [B, H, W] float32, events (signed), or standard deviations if normalised.

    Raises:
        ConfigError: bins out of range.
        InputError: so many events over so long a time that sums could overflow.

    Source: H. Rebecq et al., "High speed and high dynamic range video with an event camera", TPAMI
        2021, and its program rpg_e2vid, `events_to_voxel_grid` and `EventPreprocessor`.
    Deviation: where all non-zero voxels are equal their mean is subtracted; the program divides
        by zero.
    """
    columns = columns_of(events)
    grid = _spread(columns, bins)
    return normalise_nonzero(grid, columns.ops) if normalise else grid


def voxel_dsec(
    events: Events,
    *,
    bins: int = 15,
    normalise: bool = True,
    rectify_map: NDArray[np.float32] | None = None,
) -> Array:
    """Voxel grid of the DSEC programs and E-RAFT: also bilinear in space, then normalised.

    Args:
        events: the slice, usually 100 ms.
        bins: B, 1..4096; E-RAFT takes 15.
        normalise: bring the non-zero voxels to mean 0 and standard deviation 1.
        rectify_map: position of each pixel after rectification, (x, y) in pixels, [H, W, 2], as in
            DSEC's rectify_map.h5. Events are spread over the four pixels around that place, and
            what falls outside the sensor is lost. None: pixels stay where they are.

    Returns:
        [B, H, W] float32, standard deviations, or events (signed) if not normalised.

    Raises:
        ConfigError: bins out of range.
        InputError: the map has another shape or is not finite, or sums could overflow.

    Source: M. Gehrig et al., "DSEC: a stereo event camera dataset for driving scenarios", RA-L
        2021, and its program, `representations.VoxelGrid`.
    Deviation: places left of or above the sensor are rounded down; the program rounds them
        towards zero, which gives negative weights. A rectified grid is summed in float64, not
        exactly; its order of summation can move the last bit of a float32.
    """
    columns = columns_of(events)
    if rectify_map is None:
        grid = _spread(columns, bins)
    else:
        grid = _spread_rectified(columns, bins, _checked_map(rectify_map, columns))
    return normalise_nonzero(grid, columns.ops) if normalise else grid


class _Shares(NamedTuple):
    """Shares of each event in the bin at or before it and in the next."""

    first: Array
    """The bin at or before t*, [n] int64."""
    before: Array
    """Share of that bin, in units of 1 / span, [n] int64."""
    after: Array
    """Share of the next bin, likewise."""
    span: int
    """µs from the first event to the last, at least 1."""


def _share(columns: EventColumns, bins: int) -> _Shares:
    """Divide each event between the bins around t*."""
    since = columns.t - columns.t[0]
    span = max(int(since[-1]), 1)
    if max(len(columns), bins) * span > MAX_INT64:
        raise InputError(
            f"{len(columns):,} events over {span:,} µs in {bins} bins are too much for one voxel "
            "grid; cut them with texvent.represent.slices first"
        )
    place = since * (bins - 1)
    after = place % span
    return _Shares(place // span, span - after, after, span)


def _spread(columns: EventColumns, bins: int, *, split_polarity: bool = False) -> Array:
    """[B, H, W] float32 with every event at its own pixel; [2 · B, H, W] if split."""
    check_range("bins", bins, 1, MAX_BINS)
    lanes = 2 if split_polarity else 1
    ops, shape = columns.ops, (lanes * bins, *columns.size.shape)
    if not len(columns):
        return ops.cast(ops.from_numpy(np.zeros(shape)), "float32")
    shares = _share(columns, bins)
    sign = 1 if split_polarity else columns.polarity
    # ON comes first in a split volume.
    lane = (1 - columns.p, lanes) if split_polarity else (columns.p * 0, lanes)
    padded = bins + PADDING
    sums: Array = 0
    for time_bin, share in ((shares.first, shares.before), (shares.first + 1, shares.after)):
        axes: tuple[Axis, ...] = (lane, (time_bin, padded), *columns.pixel_axes)
        sums = sums + ops.add_at(flat_index(*axes), sign * share, math.prod(sides_of(axes)))
    grid = sums.reshape(lanes, padded, *columns.size.shape)[:, :bins].reshape(shape)
    return ops.cast(ops.cast(grid, "float64") / shares.span, "float32")


def _spread_rectified(columns: EventColumns, bins: int, rectify_map: NDArray[np.float64]) -> Array:
    """[B, H, W] float32 with every event spread over the four pixels around its mapped place."""
    check_range("bins", bins, 1, MAX_BINS)
    ops, xp, (width, height) = columns.ops, columns.ops.xp, columns.size
    if not len(columns):
        return ops.cast(ops.from_numpy(np.zeros((bins, height, width))), "float32")
    shares = _share(columns, bins)
    place = ops.from_numpy(rectify_map)[columns.y, columns.x]
    left, top = xp.floor(place[:, 0]), xp.floor(place[:, 1])
    sums: Array = 0
    for time_bin, share in ((shares.first, shares.before), (shares.first + 1, shares.after)):
        for x in (left, left + 1):
            for y in (top, top + 1):
                is_inside = (x >= 0) & (x < width) & (y >= 0) & (y < height)
                kernel = (1 - abs(x - place[:, 0])) * (1 - abs(y - place[:, 1]))
                weight = xp.where(is_inside, kernel, 0.0 * kernel) * columns.polarity * share
                axes = (
                    (time_bin, bins + PADDING),
                    (ops.cast(xp.clip(y, 0, height - 1), "int64"), height),
                    (ops.cast(xp.clip(x, 0, width - 1), "int64"), width),
                )
                index = flat_index(*axes)
                sums = sums + ops.add_at(index, weight, math.prod(sides_of(axes)))
    grid = sums.reshape(bins + PADDING, height, width)[:bins]
    return ops.cast(grid / shares.span, "float32")


def _checked_map(rectify_map: NDArray[np.float32], columns: EventColumns) -> NDArray[np.float64]:
    table = np.asarray(rectify_map, dtype=np.float64)
    expected = (*columns.size.shape, 2)
    if table.shape != expected:
        raise InputError(
            f"rectify_map has shape {list(table.shape)}; a {columns.size} sensor needs "
            f"{list(expected)}: x and y for every pixel"
        )
    if not np.isfinite(table).all():
        raise InputError("rectify_map holds NaN or infinity; every pixel needs a finite place")
    return table


def normalise_nonzero(grid: Array, ops: ArrayOps) -> Array:
    """The grid with its non-zero values at mean 0 and standard deviation 1 (n − 1); zeros stay 0.

    Values that are all equal become 0.

    Args:
        grid: any shape, float32.
        ops: operations of the library that holds it.

    Returns:
        A new array, float32, standard deviations.

    Source: `EventPreprocessor` of rpg_e2vid and `VoxelGrid` of DSEC.
    """
    is_filled = grid != 0
    values = ops.cast(grid[is_filled], "float64")
    if not len(values):
        return ops.cast(grid, "float32")
    mean = values.mean()
    spread = values - mean
    # Compared by value: rounding in the mean can leave equal values a tiny deviation.
    is_constant = bool(values.min() == values.max())
    deviation = 1.0 if is_constant else float((spread * spread).sum() / (len(values) - 1)) ** 0.5
    wide = ops.cast(grid, "float64")
    scaled = (wide - (values[0] if is_constant else mean)) / deviation
    return ops.cast(ops.xp.where(is_filled, scaled, wide * 0.0), "float32")
