"""Arrays of clips on a CPU, made of their events window by window, compiled."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.array_pool import ArrayPool
from texvent.runtime.jit import jit
from texvent.runtime.threads import run_parts
from texvent.simulation.clips.pixels import ClipArrays, ClipOutputs, Float64Array

_PART = 2048
"""Events that are placed before they are added."""


class FoundEvents(NamedTuple):
    """Events of a window, those of a run of pixels together: the pixels are in equal runs."""

    t_us: NDArray[np.int32]
    """[room] since the window opened."""
    cell: NDArray[np.int32]
    """[room] pixel · 2 + polarity."""
    ends: NDArray[np.int64]
    """[runs + 1] where the events of each run begin, and the last ones end."""


class MadeArrays(NamedTuple):
    """Outputs of one clip, by window; without rows where not asked for."""

    grids: NDArray[np.float32]
    """Undefined until the events of a window are spread."""
    counts: NDArray[np.int32]
    latest: NDArray[np.int32]


def make_arrays(
    shape: tuple[int, ...],
    outputs: ClipOutputs,
    run: Callable[[int, MadeArrays], NDArray[np.int64]],
    pool: ArrayPool,
) -> ClipArrays:
    """Arrays of clips, each filled in by a thread.

    Args:
        shape: of the frames, [B, T + 1, H, W].
        outputs: what is made.
        run: fills in what is made of a clip, and returns its events as words, where asked for.
        pool: whose memory is taken.

    Returns:
        NumPy arrays.
    """
    count, _, height, width = shape
    windows, area = (shape[1] - 1) // outputs.intervals_per_window, height * width
    of_grids = (count, windows, outputs.bins, area)
    grids = pool.take(of_grids if outputs.grids else (count, 0, 1, 1), np.float32)
    pairs = (count, windows, 2, area)
    counts = pool.take(pairs if outputs.counts else (count, 0, 1, 1), np.int32)
    latest = pool.take(pairs if outputs.latest else (count, 0, 1, 1), np.int32)

    def run_clip(clip: int) -> NDArray[np.int64]:
        counts[clip], latest[clip] = 0, -1
        return run(clip, MadeArrays(grids[clip], counts[clip], latest[clip]))

    words = run_parts(run_clip, range(count))
    ends = np.cumsum([len(one) for one in words])

    def shaped(array: NDArray[Any], *, is_asked: bool) -> NDArray[Any] | None:
        return array.reshape(*array.shape[:-1], height, width) if is_asked else None

    return ClipArrays(
        shaped(grids, is_asked=outputs.grids),
        shaped(counts, is_asked=outputs.counts),
        shaped(latest, is_asked=outputs.latest),
        np.concatenate(words) if outputs.events else None,
        ends if outputs.events else None,
    )


def words_of(found: FoundEvents, opened_us: int, area: int) -> NDArray[np.int64]:
    """Events of a window as sorted words; see `pixels.ClipArrays`."""
    total = found.ends[-1]
    t_us, cell = found.t_us[:total] + np.int64(opened_us), found.cell[:total]
    return np.sort(((t_us * area) << 1) + cell)


@jit(error_model="numpy")
def spread_events(
    found: FoundEvents, run: int, window: int, made: MadeArrays, sums: Float64Array
) -> None:
    """Make the grid of a window of its events, and add them to the other arrays.

    Args:
        found: the events.
        run: pixels of a run; the last one may have fewer.
        window: number of the window.
        made: the arrays.
        sums: [(bins + 1) · run] zeros, before and after.
    """
    grids, counts, latest = made
    total = found.ends[-1]
    for n in range(total if counts.shape[0] else 0):
        counts[window, found.cell[n] & 1, found.cell[n] >> 1] += 1
    for n in range(total if latest.shape[0] else 0):
        p, pixel = found.cell[n] & 1, found.cell[n] >> 1
        latest[window, p, pixel] = max(latest[window, p, pixel], found.t_us[n])
    if not grids.shape[0]:
        return
    if not total:
        grids[window] = 0.0
        return
    first_us, last_us = _bounds(found.t_us[:total])
    span = np.float64(np.int64(last_us) - np.int64(first_us) or 1)
    bins, area = grids.shape[1], grids.shape[2]
    after, place = np.empty(_PART), np.empty(_PART, np.int32)
    for number in range(found.ends.size - 1):
        begin, end, first = found.ends[number], found.ends[number + 1], number * run
        size = min(run, area - first)
        for start in range(begin, end, _PART):
            t_us, cell = found.t_us[start : min(start + _PART, end)], found.cell[start:]
            _place(t_us, cell, first_us, (span, bins, first, run), after, place)
            _add(t_us.size, cell, span, after, place, run, sums)
        for time_bin in range(bins):
            row = grids[window, time_bin, first : first + size]
            _divide(sums[time_bin * run : time_bin * run + size], span, row)
        sums[bins * run :] = 0.0


@jit
def _bounds(t_us: NDArray[np.int32]) -> tuple[np.int32, np.int32]:
    first_us, last_us = t_us[0], t_us[0]
    for n in range(t_us.size):
        first_us, last_us = min(first_us, t_us[n]), max(last_us, t_us[n])
    return first_us, last_us


@jit(error_model="numpy")
def _place(
    t_us: NDArray[np.int32],
    cell: NDArray[np.int32],
    first_us: np.int32,
    shape: tuple[float, int, int, int],
    after: Float64Array,
    place: NDArray[np.int32],
) -> None:
    """Time bin of events, as a cell of `sums`, and how far they lie behind its beginning."""
    span, bins, first, run = shape
    for n in range(t_us.size):
        # Whole numbers below 2⁵³: exact.
        scaled = np.float64(np.int64(t_us[n]) - first_us) * np.float64(bins - 1)
        time_bin = np.floor(scaled / span)
        after[n] = scaled - time_bin * span
        place[n] = np.int32(time_bin) * run + (cell[n] >> 1) - first


@jit
def _add(
    count: int,
    cell: NDArray[np.int32],
    span: float,
    after: Float64Array,
    place: NDArray[np.int32],
    run: int,
    sums: Float64Array,
) -> None:
    step = np.uint64(run)
    for n in range(count):
        sign, at = np.float64(2 * (cell[n] & 1) - 1), np.uint64(place[n])
        share = sign * after[n]
        sums[at] += sign * span - share
        sums[at + step] += share


@jit(error_model="numpy")
def _divide(sums: Float64Array, span: float, row: NDArray[np.float32]) -> None:
    """Grid of a bin; its sums are 0 afterwards."""
    for i in range(row.size):
        row[i] = np.float32(sums[i] / span)
        sums[i] = 0.0
