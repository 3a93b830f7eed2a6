"""Fourteen statistics of every patch of 12×12 px × 50 ms: what events look like, not where."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream
from texvent.metrics.windows import flat_index

PATCH_PX = 12
PATCH_US = 50_000
LEAST_EVENTS = 8
TIME_BINS = 10
SECOND = 1e-6
"""µs → s."""

FEATURES = (
    "log_count",
    "on_share",
    "active_share",
    "count_variation",
    "log_mean_interval",
    "sd_log_interval",
    "short_intervals",
    "polarity_flips",
    "time_entropy",
    "time_correlation",
    "mean_step_px",
    "mean_log_gap",
    "sd_log_gap",
    "no_gap",
)
NO_INTERVAL = -1.3
"""Feature log_mean_interval of a patch in which no pixel fired twice: log10 of 50 ms."""

Float64Array = NDArray[np.float64]
Int64Array = NDArray[np.int64]


def patch_statistics(events: EventStream) -> Float64Array:
    """Features of every patch with at least 8 events; patches cut by the border are left out.

    Returns:
        [patches, 14], columns as in `FEATURES`. Intervals are between events of a pixel, whatever
        their polarity; steps and gaps are between events that follow each other in the patch.
    """
    columns, rows = events.size.width // PATCH_PX, events.size.height // PATCH_PX
    x, y = events.x.astype(np.int64), events.y.astype(np.int64)
    whole = (x < columns * PATCH_PX) & (y < rows * PATCH_PX)
    place = flat_index((events.t // PATCH_US, 1), (y // PATCH_PX, rows), (x // PATCH_PX, columns))[
        whole
    ]
    _, patch, size = np.unique(place, return_inverse=True, return_counts=True)
    busy = size >= LEAST_EVENTS
    kept = busy[patch]
    number = np.cumsum(busy) - 1
    patch = number[patch[kept]]
    chosen = np.flatnonzero(whole)[kept]
    # Stable: events stay in time order within their patch.
    order = np.argsort(patch, kind="stable")
    patch, chosen = patch[order], chosen[order]
    return _describe(patch, x[chosen], y[chosen], events.t[chosen], events.p[chosen])


def _describe(
    patch: Int64Array, x: Int64Array, y: Int64Array, t: Int64Array, p: NDArray[np.uint8]
) -> Float64Array:
    patches = int(patch[-1]) + 1 if patch.size else 0
    size = np.bincount(patch, minlength=patches).astype(np.float64)
    on_share = _mean(p.astype(np.float64), patch, patches)
    return np.column_stack(
        [
            np.log(size),
            on_share,
            *_spread_over_pixels(patch, x, y, patches),
            *_intervals(patch, x, y, t, p),
            *_time_histogram(patch, t, patches),
            *_following(patch, x, y, t, patches),
        ]
    )


def _pixel_of(patch: Int64Array, x: Int64Array, y: Int64Array) -> Int64Array:
    return flat_index((patch, 1), (y % PATCH_PX, PATCH_PX), (x % PATCH_PX, PATCH_PX))


def _spread_over_pixels(
    patch: Int64Array, x: Int64Array, y: Int64Array, patches: int
) -> tuple[Float64Array, Float64Array]:
    """Share of active pixels; sd / mean of the counts of active pixels."""
    area = PATCH_PX * PATCH_PX
    counts = np.bincount(_pixel_of(patch, x, y), minlength=patches * area).reshape(patches, area)
    active = np.count_nonzero(counts, axis=1)
    mean = counts.sum(axis=1) / active
    variance = (counts.astype(np.float64) ** 2).sum(axis=1) / active - mean**2
    return active / area, np.sqrt(np.maximum(variance, 0.0)) / mean


def _intervals(
    patch: Int64Array, x: Int64Array, y: Int64Array, t: Int64Array, p: NDArray[np.uint8]
) -> tuple[Float64Array, Float64Array, Float64Array, Float64Array]:
    """Same-pixel intervals: log of the mean, sd of the log, share below 2 ms, polarity flips."""
    patches = int(patch[-1]) + 1 if patch.size else 0
    pixel = _pixel_of(patch, x, y)
    order = np.argsort(pixel, kind="stable")
    together = np.diff(pixel[order]) == 0
    seconds = np.diff(t[order])[together] * SECOND
    flips = (np.diff(p[order].astype(np.int8)) != 0)[together]
    owner = patch[order][1:][together]
    logs = np.log10(seconds + 1e-5)
    present = np.bincount(owner, minlength=patches) > 0
    with np.errstate(invalid="ignore"):
        log_mean = np.log10(_mean(seconds, owner, patches) + 1e-5)
    return (
        np.where(present, log_mean, NO_INTERVAL),
        _spread(logs, owner, patches),
        np.nan_to_num(_mean((seconds < 2e-3).astype(np.float64), owner, patches)),
        np.nan_to_num(_mean(flips.astype(np.float64), owner, patches)),
    )


def _time_histogram(
    patch: Int64Array, t: Int64Array, patches: int
) -> tuple[Float64Array, Float64Array]:
    """Entropy (nats) and lag-1 autocorrelation of the events' distribution over the window."""
    cell = flat_index((patch, 1), (t % PATCH_US * TIME_BINS // PATCH_US, TIME_BINS))
    counts = np.bincount(cell, minlength=patches * TIME_BINS).reshape(patches, TIME_BINS)
    share = counts / counts.sum(axis=1, keepdims=True)
    entropy = -(share * np.log(np.where(share > 0, share, 1.0))).sum(axis=1)
    centred = counts - counts.mean(axis=1, keepdims=True)
    power = (centred**2).sum(axis=1)
    lagged = (centred[:, 1:] * centred[:, :-1]).sum(axis=1)
    return entropy, np.divide(lagged, power, out=np.zeros(patches), where=power > 0)


def _following(
    patch: Int64Array, x: Int64Array, y: Int64Array, t: Int64Array, patches: int
) -> tuple[Float64Array, Float64Array, Float64Array, Float64Array]:
    """Events that follow each other in a patch: mean distance, log of the gap, share of no gap."""
    together = np.diff(patch) == 0
    owner = patch[1:][together]
    step = np.hypot(np.diff(x), np.diff(y))[together]
    gap = np.diff(t)[together]
    logs = np.log10(gap * SECOND + 1e-6)
    return (
        _mean(step, owner, patches),
        _mean(logs, owner, patches),
        _spread(logs, owner, patches),
        _mean((gap <= 1).astype(np.float64), owner, patches),
    )


def _mean(values: Float64Array, owner: Int64Array, count: int) -> Float64Array:
    """Mean of the values of each owner, NaN where it has none."""
    total = np.bincount(owner, weights=values, minlength=count)
    number = np.bincount(owner, minlength=count)
    return np.asarray(np.divide(total, number, out=np.full(count, np.nan), where=number > 0))


def _spread(values: Float64Array, owner: Int64Array, count: int) -> Float64Array:
    """Standard deviation of the values of each owner, 0 where it has none."""
    centre = _mean(values, owner, count)
    return np.sqrt(np.nan_to_num(_mean((values - centre[owner]) ** 2, owner, count)))
