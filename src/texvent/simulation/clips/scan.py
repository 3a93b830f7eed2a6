"""Clips on a CPU: one pass over the frames, window by window, compiled."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.runtime.threads import run_parts
from texvent.simulation.clips import pixels
from texvent.simulation.clips.pixels import ClipArrays, ClipOutputs, ClipPixels, Float64Array
from texvent.simulation.random.compiled_draws import draw_uniform_at, draw_word_at, place_of

_1, _8, _32, _48 = (np.uint64(bits) for bits in (1, 8, 32, 48))
_EVEN, _SUM = np.uint64(pixels.EVEN_BYTES), np.uint64(pixels.BYTE_SUM)
_8_32, _15, _16 = (np.uint32(bits) for bits in (8, 15, 16))
_EVEN_32, _LOW_16 = np.uint32(pixels.EVEN_BYTES & 0xFFFFFFFF), np.uint32(0xFFFF)
_SPREAD, _MIX_1, _MIX_2 = (np.uint32(one) for one in pixels.NOISE_WORDS)
_NOISE_MEAN, _NOISE_UNIT = pixels.NOISE_MEAN, pixels.NOISE_UNIT
_MEAN, _UNIT = pixels.BYTES_MEAN, pixels.BYTES_UNIT
_ON, _OFF, _PHASE = pixels.ON_DRAW, pixels.OFF_DRAW, pixels.PHASE_DRAW
_CHOICE, _HOT, _NOISE = pixels.CHOICE_DRAW, pixels.HOT_DRAW, pixels.NOISE_DRAW
_LOWEST, _LONG_AGO = pixels.LOWEST, pixels.LONG_AGO_US


class _Pixels(NamedTuple):
    """State and constants of the pixels of one clip, [area] each."""

    reference: Float64Array
    on: Float64Array
    off: Float64Array
    hot: Float64Array
    hot_pixel: NDArray[np.int64]
    """Flat indices of the pixels that are hot."""
    fired_us: NDArray[np.int64]


class FoundEvents(NamedTuple):
    """Room for the events of a window."""

    pixel: NDArray[np.int64]
    t_us: NDArray[np.int64]
    sign: NDArray[np.int64]


class MadeArrays(NamedTuple):
    """Outputs of one clip, by window; without rows where not asked for."""

    grids: NDArray[np.float32]
    counts: NDArray[np.int32]
    latest: NDArray[np.int32]


def simulate_on_cpu(
    frames: NDArray[np.uint8],
    times_us: NDArray[np.int64],
    clips: ClipPixels,
    outputs: ClipOutputs,
) -> ClipArrays:
    """Arrays of the clips, each made in a thread; arguments as `pixels.check_clips` wants them.

    Returns:
        NumPy arrays.
    """
    width, area = frames.shape[3], frames.shape[2] * frames.shape[3]

    def run(clip: int, made: MadeArrays) -> NDArray[np.int64]:
        of_clip = clips.numbers[clip], clips.keys[clip], clips.brightness
        pixel = frames[clip].reshape(-1, area)
        return _run_clip(pixel, times_us[clip], width, of_clip, outputs, made)

    return make_arrays(frames.shape, outputs, run)


def make_arrays(
    shape: tuple[int, ...],
    outputs: ClipOutputs,
    run: Callable[[int, MadeArrays], NDArray[np.int64]],
) -> ClipArrays:
    """Arrays of clips, each filled in by a thread.

    Args:
        shape: of the frames, [B, T + 1, H, W].
        outputs: what is made.
        run: fills in what is made of a clip, and returns its events as words, where asked for.

    Returns:
        NumPy arrays.
    """
    count, _, height, width = shape
    windows, area = (shape[1] - 1) // outputs.intervals_per_window, height * width
    of_grids = (count, windows, outputs.bins, area)
    grids = np.zeros(of_grids if outputs.grids else (count, 0, 1, 1), np.float32)
    pairs = (count, windows, 2, area)
    counts = np.zeros(pairs if outputs.counts else (count, 0, 1, 1), np.int32)
    latest = np.full(pairs if outputs.latest else (count, 0, 1, 1), -1, np.int32)

    def run_clip(clip: int) -> NDArray[np.int64]:
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
    sums, room = np.zeros(area * (outputs.bins + 1), np.int64), _room(2 * area)
    state, words = _begin(frames[0], width, *clip), [np.empty(0, np.int64)]
    for first in range(0, len(frames) - 1, per):
        span = first, first + per
        while (total := _scan(frames, times_us, span, clip, state, room)) < 0:
            room = _room(2 * len(room.pixel))
        if outputs.events:
            pixel, t_us, sign = (column[:total] for column in room)
            words.append(words_of(pixel, t_us, sign > 0, area))
        spread_events(room, total, int(times_us[first]), first // per, made, sums)
    return np.concatenate(words)


def words_of(
    pixel: NDArray[np.int64], t_us: NDArray[np.int64], is_on: NDArray[Any], area: int
) -> NDArray[np.int64]:
    """Events of a window as sorted words; see `pixels.ClipArrays`."""
    return np.sort((t_us * area + pixel) << 1 | is_on)


def _room(size: int) -> FoundEvents:
    return FoundEvents(*(np.empty(size, np.int64) for _ in FoundEvents._fields))


@jit(inline="always")
def _normal(word: np.uint64) -> float:
    pairs = (word & _EVEN) + ((word >> _8) & _EVEN)
    return np.float64(np.int64((pairs * _SUM) >> _48) - _MEAN) * _UNIT


@jit(inline="always")
def _noise(pixel: Any, key: np.uint64) -> Any:
    """Normal number of a pixel at a frame; see `pixels.NOISE_WORDS`."""
    word = np.uint32(np.uint32(pixel) * _SPREAD + np.uint32(key))
    word = np.uint32((word ^ (word >> _16)) * _MIX_1)
    word = np.uint32((word ^ (word >> _15) ^ np.uint32(key >> _32)) * _MIX_2)
    word ^= word >> _16
    pairs = (word & _EVEN_32) + ((word >> _8_32) & _EVEN_32)
    return np.float64(np.int32((pairs + (pairs >> _16)) & _LOW_16) - _NOISE_MEAN)


@jit
def _begin(
    first: NDArray[np.uint8], width: int, numbers: Float64Array, key: np.uint64, table: Float64Array
) -> _Pixels:
    """Pixels of a clip that have seen its first frame."""
    area = first.size
    reference, on, off, hot = np.empty(area), np.empty(area), np.empty(area), np.zeros(area)
    for i in range(area):
        at = place_of(i // width, i % width)
        on[i], off[i] = numbers[0], numbers[1]
        if numbers[2] > 0:
            spread = numbers[2] * _normal(draw_word_at(key, at, _ON))
            on[i] = max(numbers[0] + numbers[0] * spread, _LOWEST)
            spread = numbers[2] * _normal(draw_word_at(key, at, _OFF))
            off[i] = max(numbers[1] + numbers[1] * spread, _LOWEST)
        if draw_uniform_at(key, at, _CHOICE) < numbers[4]:
            hot[i] = numbers[5] * _normal(draw_word_at(key, at, _HOT))
        reference[i] = table[first[i]]
        if numbers[7] > 0:
            reference[i] += off[i] - draw_uniform_at(key, at, _PHASE) * (on[i] + off[i])
    return _Pixels(reference, on, off, hot, np.flatnonzero(hot), np.full(area, _LONG_AGO))


@jit(error_model="numpy")
def _scan(
    frames: NDArray[np.uint8],
    times_us: NDArray[np.int64],
    span: tuple[int, int],
    clip: tuple[Float64Array, np.uint64, Float64Array],
    state: _Pixels,
    found: FoundEvents,
) -> int:
    """Events of a window, not in order; −1, and nothing has moved, where there is no room."""
    numbers, key, table = clip
    reference, on, off, hot, hot_pixel, fired_us = state
    noise_per_unit, refractory_us = numbers[3] * _NOISE_UNIT, np.int64(numbers[6])
    kept, kept_us = reference.copy(), fired_us.copy()
    near, total = np.empty(reference.size + 1, np.int64), 0
    for interval in range(span[0], span[1]):
        before, now, start_us = frames[interval], frames[interval + 1], times_us[interval]
        duration = np.float64(times_us[interval + 1] - start_us)
        frame_word = draw_word_at(key, np.uint64(0), _NOISE + interval)
        if noise_per_unit > 0:
            for i in range(reference.size):
                reference[i] -= noise_per_unit * _noise(i, frame_word)
        for i in hot_pixel:
            reference[i] -= hot[i]
        number = _list_near(now, table, reference, on, off, near)
        for i in near[:number]:
            noise = noise_per_unit * _noise(i, frame_word) + hot[i]
            stop = table[now[i]] - reference[i]
            start = table[before[i]] - (reference[i] + noise)
            step = on[i] if stop > 0 else -off[i]
            count = np.floor(stop / step)
            # The quotient may be rounded across a whole number; what counts is the product.
            count += 1.0 if abs(stop) >= (count + 1.0) * abs(step) else 0.0
            count -= 1.0 if abs(stop) < count * abs(step) else 0.0
            if total + count > found.pixel.size:
                reference[:], fired_us[:] = kept, kept_us
                return -1
            for k in range(int(count)):
                level = (k + 1.0) * step
                is_before = start >= level if step > 0 else start <= level
                share = 1.0 if stop == start else (level - start) / (stop - start)
                share = 0.0 if is_before else min(max(share, 0.0), 1.0)
                t_us = start_us + np.int64(min(np.floor(share * duration), duration - 1.0))
                if t_us - fired_us[i] >= refractory_us:
                    fired_us[i] = t_us
                    found.pixel[total], found.t_us[total] = i, t_us
                    found.sign[total] = 1 if step > 0 else -1
                    total += 1
            reference[i] += count * step
    return total


@jit(error_model="numpy")
def _list_near(
    now: NDArray[np.uint8],
    table: Float64Array,
    reference: Float64Array,
    on: Float64Array,
    off: Float64Array,
    near: NDArray[np.int64],
) -> int:
    """List the pixels that have reached a threshold; how many."""
    number = np.uint64(0)
    for i in range(now.size):
        change = table[now[i]] - reference[i]
        near[number] = i
        number += np.uint64((change >= on[i]) | (change <= -off[i]))
    return int(number)


@jit(error_model="numpy")
def spread_events(
    found: FoundEvents,
    total: int,
    start_us: int,
    window: int,
    made: MadeArrays,
    sums: NDArray[np.int64],
) -> None:
    """Add the events of a window to the arrays; `sums`, [area · (bins + 1)], is 0 around it."""
    grids, counts, latest = made
    first_us, last_us = np.int64(2**62), np.int64(0)
    for n in range(total):
        first_us, last_us = min(first_us, found.t_us[n]), max(last_us, found.t_us[n])
    for n in range(total if counts.shape[0] else 0):
        counts[window, (found.sign[n] + 1) // 2, found.pixel[n]] += 1
    for n in range(total if latest.shape[0] else 0):
        p, since = (found.sign[n] + 1) // 2, np.int32(found.t_us[n] - start_us)
        latest[window, p, found.pixel[n]] = max(latest[window, p, found.pixel[n]], since)
    if not grids.shape[0] or not total:
        return
    bins = grids.shape[1]
    span = np.float64(np.int64(last_us - first_us) or 1)
    for n in range(total):
        # Whole numbers below 2⁵³: exact.
        place = np.float64(found.t_us[n] - first_us) * (bins - 1)
        time_bin = np.int64(place / span)
        after = np.int64(place - time_bin * span)
        cell = np.uint64(found.pixel[n] * (bins + 1) + time_bin)
        found.t_us[n] = time_bin
        sums[cell] += found.sign[n] * (np.int64(span) - after)
        sums[cell + _1] += found.sign[n] * after
    for n in range(total):
        pixel, time_bin = found.pixel[n], found.t_us[n]
        cell = np.uint64(pixel * (bins + 1) + time_bin)
        if sums[cell] != 0:
            grids[window, time_bin, pixel] = np.float32(sums[cell] / span)
        if time_bin + 1 < bins and sums[cell + _1] != 0:
            grids[window, time_bin + 1, pixel] = np.float32(sums[cell + _1] / span)
        sums[cell], sums[cell + _1] = 0, 0
