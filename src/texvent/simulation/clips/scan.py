"""Clips on a CPU: one pass over the frames, window by window and tile by tile, compiled.

Loops do one thing for all pixels of a tile, without branches, so that processors take eight or
sixteen pixels at once. Pixels that fire are listed; of a list too, all first events are timed
together, then all second ones.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.array_pool import ArrayPool
from texvent.runtime.jit import jit
from texvent.simulation.clips import pixels
from texvent.simulation.clips.arrays import (
    FoundEvents,
    MadeArrays,
    make_arrays,
    spread_events,
    words_of,
)
from texvent.simulation.clips.pixel_state import PixelArrays, begin_pixels, draw_noise
from texvent.simulation.clips.pixels import ClipArrays, ClipOutputs, ClipPixels, Float64Array
from texvent.simulation.random.compiled_draws import draw_word_at

_32 = np.uint64(32)
_NOISE_UNIT, _NOISE = pixels.NOISE_UNIT, pixels.NOISE_DRAW
TILE = 4096
"""Pixels of a tile, whose state stays in the cache of a core; a multiple of 8."""
_LANES = 32
"""Lists are worked on in multiples of this, as processors like it; the rest is never read."""


class _Tile(NamedTuple):
    """Room for an interval of a tile."""

    brightness: Float64Array
    """[2, TILE] at two frames."""
    noise: NDArray[np.int16]
    moved: Float64Array
    """Log units that the references moved by."""
    is_near: NDArray[np.uint8]
    """Whether a threshold is reached."""


class _List(NamedTuple):
    """Room for the pixels of a tile that fire, and those of them that fire once more."""

    pixel: NDArray[np.uint32]
    start: Float64Array
    """Brightness over the reference at the first frame."""
    length: Float64Array
    """From it to that at the second frame."""
    step: Float64Array
    """Threshold that is crossed; negative: OFF."""
    crossed: Float64Array
    """All thresholds that are crossed, log units."""
    crossings: NDArray[np.int32]
    cell: NDArray[np.int32]
    """Pixel · 2 + polarity."""
    kept: NDArray[np.uint32]


def simulate_on_cpu(
    frames: NDArray[np.uint8],
    times_us: NDArray[np.int64],
    clips: ClipPixels,
    outputs: ClipOutputs,
    pool: ArrayPool | None = None,
) -> ClipArrays:
    """Arrays of the clips, each made in a thread; arguments as `pixels.check_clips` wants them.

    A pool lends them its memory.

    Returns:
        NumPy arrays.
    """
    width, area = frames.shape[3], frames.shape[2] * frames.shape[3]

    def run(clip: int, made: MadeArrays) -> NDArray[np.int64]:
        of_clip = clips.numbers[clip], clips.keys[clip], clips.brightness
        pixel = frames[clip].reshape(-1, area)
        return _run_clip(pixel, times_us[clip], width, of_clip, outputs, made)

    return make_arrays(frames.shape, outputs, run, pool or ArrayPool())


def _run_clip(
    frames: NDArray[np.uint8],
    times_us: NDArray[np.int64],
    width: int,
    clip: tuple[Float64Array, np.uint64, Float64Array],
    outputs: ClipOutputs,
    made: MadeArrays,
) -> NDArray[np.int64]:
    """Fill in what is made of a clip, [T + 1, area]; its events as words, where asked for."""
    area, per = frames.shape[1], outputs.intervals_per_window
    state, windows = begin_pixels(frames[0], width, *clip), (len(frames) - 1) // per
    ends = np.zeros(-(-area // TILE) + 1, np.int64)
    found = FoundEvents(np.empty(2 * area, np.int32), np.empty(2 * area, np.int32), ends)
    if not outputs.events:
        _scan(frames, times_us, (0, windows, per), clip, state, found, made)
        return np.empty(0, np.int64)
    words = []
    for window in range(windows):
        span = window, window + 1, per
        found = _scan(frames, times_us, span, clip, state, found, made)
        words.append(words_of(found, int(times_us[window * per]), area))
    return np.concatenate(words)


@jit
def _scan(
    frames: NDArray[np.uint8],
    times_us: NDArray[np.int64],
    span: tuple[int, int, int],
    clip: tuple[Float64Array, np.uint64, Float64Array],
    state: PixelArrays,
    found: FoundEvents,
    made: MadeArrays,
) -> FoundEvents:
    """Simulate windows, and add their events to what is made.

    Args:
        frames: [T + 1, area].
        times_us: [T + 1].
        span: the first window, the end of the windows, and the intervals of each.
        clip: row of `ClipPixels.numbers`, key, and brightness of a byte.
        state: moves on.
        found: room, whose content goes.
        made: filled in.

    Returns:
        The events of the last window.
    """
    area = frames.shape[1]
    tile = _Tile(
        np.empty((2, TILE)), np.zeros(TILE, np.int16), np.empty(TILE), np.zeros(TILE, np.uint8)
    )
    size = TILE + _LANES
    listed = _List(
        np.zeros(size, np.uint32), np.zeros(size), np.zeros(size), np.zeros(size), np.zeros(size),
        np.zeros(size, np.int32), np.zeros(size, np.int32), np.zeros(size, np.uint32),
    )  # fmt: skip
    sums = np.zeros((made.grids.shape[1] + 1) * TILE)
    for window in range(span[0], span[1]):
        intervals, total = (window * span[2], (window + 1) * span[2]), 0
        for first in range(0, area, TILE):
            found.ends[first // TILE] = total
            of_tile = _pixels_of(state, first, min(first + TILE, area), clip[0][2] > 0)
            found, total = _scan_tile(
                (frames, times_us), intervals, clip, of_tile, first, (tile, listed), found, total
            )
        found.ends[-1] = total
        spread_events(found, TILE, window, made, sums)
    return found


@jit
def _pixels_of(state: PixelArrays, first: int, stop: int, has_mismatch: bool) -> PixelArrays:
    """Pixels of a tile; thresholds without mismatch are those of the first tile, in the cache."""
    at = first if has_mismatch else 0
    return PixelArrays(
        state.reference[first:stop], state.on[at : at + stop - first],
        state.off[at : at + stop - first], state.hot[first:stop], state.fired_us[first:stop],
    )  # fmt: skip


@jit
def _scan_tile(
    film: tuple[NDArray[np.uint8], NDArray[np.int64]],
    intervals: tuple[int, int],
    clip: tuple[Float64Array, np.uint64, Float64Array],
    state: PixelArrays,
    first: int,
    room: tuple[_Tile, _List],
    found: FoundEvents,
    total: int,
) -> tuple[FoundEvents, int]:
    """Events of a tile in a window, behind those that were found; how many there are then."""
    (frames, times_us), (numbers, key, table), (tile, listed) = film, clip, room
    noise_per_unit, refractory_us = numbers[3] * _NOISE_UNIT, np.int64(numbers[6])
    opened_us, size, side = times_us[intervals[0]], state.reference.size, 0
    tile.is_near[size:] = 0
    _look_up(table, frames[intervals[0], first : first + size], tile.brightness[0])
    for interval in range(intervals[0], intervals[1]):
        before, now = tile.brightness[side], frames[interval + 1, first : first + size]
        if _differ(frames[interval, first : first + size], now):
            side = 1 - side
            _look_up(table, now, tile.brightness[side])
        if noise_per_unit > 0:
            word = draw_word_at(key, np.uint64(0), _NOISE + interval)
            draw_noise(np.uint32(word), np.uint32(word >> _32), first, tile.noise[:size])
        _move(state, tile.brightness[side], noise_per_unit, tile)
        count = _list_near(tile.is_near.view(np.uint64), tile.is_near, listed.pixel)
        if count > 0:
            _measure(count, state, (before, tile.brightness[side]), tile.moved, listed)
            _count_crossings(_whole(count), first, listed)
            _move_on(count, listed, state.reference)
            start_us = times_us[interval] - opened_us
            times = np.float64(start_us), np.float64(times_us[interval + 1] - times_us[interval])
            limits = opened_us, refractory_us, first
            found, total = _fire(count, times, limits, listed, state.fired_us, found, total)
    return found, total


@jit
def _fire(
    count: int,
    times: tuple[float, float],
    limits: tuple[np.int64, np.int64, int],
    listed: _List,
    fired_us: NDArray[np.int64],
    found: FoundEvents,
    total: int,
) -> tuple[FoundEvents, int]:
    """Events of listed pixels in an interval, behind those that were found."""
    crossed = 0
    while count > 0:
        if total + count + _LANES > found.t_us.size:
            found = _widen(found, count)
        t_us, cell = found.t_us[total:], found.cell[total:]
        _time_crossings(_whole(count), crossed, times, listed, t_us, cell)
        total += _drop_refractory(count, limits, fired_us, t_us, cell) if limits[1] > 0 else count
        crossed += 1
        count = _keep_crossing(count, crossed, listed)
    return found, total


@jit(inline="always")
def _whole(count: int) -> int:
    return (count + _LANES - 1) // _LANES * _LANES


@jit
def _widen(found: FoundEvents, count: int) -> FoundEvents:
    """Twice the room, and more than `count`."""
    more = np.empty(found.t_us.size + count + _LANES, np.int32)
    t_us, cell = np.concatenate((found.t_us, more)), np.concatenate((found.cell, more))
    return FoundEvents(t_us, cell, found.ends)


@jit
def _look_up(table: Float64Array, levels: NDArray[np.uint8], brightness: Float64Array) -> None:
    for i in range(levels.size):
        brightness[i] = table[levels[i]]


@jit
def _differ(before: NDArray[np.uint8], now: NDArray[np.uint8]) -> bool:
    found = np.uint8(0)
    for i in range(before.size):
        found = np.uint8(found | np.uint8(before[i] ^ now[i]))
    return bool(found != 0)


@jit
def _move(state: PixelArrays, brightness: Float64Array, noise_per_unit: float, tile: _Tile) -> None:
    """Move references by noise, and mark the pixels that have reached a threshold."""
    reference, on, off, hot, _ = state
    noise, moved, is_near = tile.noise, tile.moved, tile.is_near
    for i in range(reference.size):
        shift = noise_per_unit * np.float64(np.int32(noise[i]))
        reference[i] = (reference[i] - shift) - hot[i]
        moved[i] = shift + hot[i]
        change = brightness[i] - reference[i]
        is_near[i] = np.uint8((change >= on[i]) | (change <= -off[i]))


@jit
def _list_near(
    words: NDArray[np.uint64], is_near: NDArray[np.uint8], pixel: NDArray[np.uint32]
) -> int:
    """List the marked pixels; how many. `words` are the marks, eight at a time."""
    count = np.uint64(0)
    for at in range(words.size):
        if words[at] != 0:
            for i in range(8 * at, 8 * at + 8):
                pixel[count] = i
                count += np.uint64(is_near[i])
    return int(count)


@jit
def _measure(
    count: int,
    state: PixelArrays,
    brightness: tuple[Float64Array, Float64Array],
    moved: Float64Array,
    listed: _List,
) -> None:
    """Brightness of listed pixels over their references, and the step that they may cross."""
    before, now = brightness
    for j in range(count):
        i = np.uint64(listed.pixel[j])
        stop = now[i] - state.reference[i]
        listed.start[j] = before[i] - (state.reference[i] + moved[i])
        listed.length[j] = stop
        # Both are read, so that nothing branches: the sign of noise cannot be predicted.
        on, off = state.on[i], -state.off[i]
        listed.step[j] = on if stop > 0 else off


@jit(error_model="numpy")
def _count_crossings(count: int, first: int, listed: _List) -> None:
    """Crossings of listed pixels; `length` was the brightness at the second frame."""
    pixel, start, length, step, crossed, crossings, cell, _ = listed
    for j in range(count):
        stop, size, distance = length[j], abs(step[j]), abs(length[j])
        number = np.floor(stop / step[j])
        # The quotient may be rounded across a whole number; what counts is the product.
        number += 1.0 if distance >= (number + 1.0) * size else 0.0
        number -= 1.0 if distance < number * size else 0.0
        crossed[j] = number * step[j]
        length[j] = stop - start[j]
        crossings[j] = np.int32(number)
        cell[j] = np.int32((first + np.int32(pixel[j])) * 2 + np.int32(step[j] > 0))


@jit
def _move_on(count: int, listed: _List, reference: Float64Array) -> None:
    for j in range(count):
        reference[listed.pixel[j]] += listed.crossed[j]


@jit(error_model="numpy")
def _time_crossings(
    count: int,
    crossed: int,
    times: tuple[float, float],
    listed: _List,
    t_us: NDArray[np.int32],
    cell: NDArray[np.int32],
) -> None:
    """Events where listed pixels cross after `crossed` crossings.

    A level that lay behind a pixel at the first frame already, because noise moved the reference,
    is crossed at once.
    """
    start_us, duration = times
    last, steps = duration - 1.0, crossed + 1.0
    for j in range(count):
        ahead = steps * listed.step[j] - listed.start[j]
        share = ahead / listed.length[j]
        share = share if ahead * listed.step[j] > 0 else 0.0
        since = np.floor(share * duration)
        t_us[j] = np.int32(start_us + (since if since < last else last))
        cell[j] = listed.cell[j]


@jit
def _drop_refractory(
    count: int,
    limits: tuple[np.int64, np.int64, int],
    fired_us: NDArray[np.int64],
    t_us: NDArray[np.int32],
    cell: NDArray[np.int32],
) -> int:
    """Keep the events of pixels that may fire again; how many."""
    opened_us, refractory_us, first = limits
    kept = 0
    for n in range(count):
        at, now_us = (cell[n] >> 1) - first, opened_us + t_us[n]
        if now_us - fired_us[at] >= refractory_us:
            fired_us[at] = now_us
            t_us[kept], cell[kept] = t_us[n], cell[n]
            kept += 1
    return kept


@jit
def _keep_crossing(count: int, crossed: int, listed: _List) -> int:
    """Keep the listed pixels that cross more often than `crossed` times; how many."""
    _, start, length, step, _, crossings, cell, kept = listed
    number = np.uint64(0)
    for j in range(count):
        kept[number] = j
        number += np.uint64(crossings[j] > crossed)
    for n in range(int(number)):
        at = np.uint64(kept[n])
        start[n], length[n], step[n] = start[at], length[at], step[at]
        crossings[n], cell[n] = crossings[at], cell[at]
    return int(number)
