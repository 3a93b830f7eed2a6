"""Clips on a GPU, as Triton kernels: the twin of `scan`, event for event.

A program owns a block of pixels of a clip and goes through all its frames with their state in
registers: once to count the events and find the bounds of each window, once more to add them to the
arrays where they belong; for events themselves once more.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import triton
import triton.language as tl
from numpy.typing import NDArray

from texvent._require import require
from texvent.simulation.clips import pixels
from texvent.simulation.clips.pixels import ClipArrays, ClipOutputs, ClipPixels
from texvent.simulation.gpu.blocks_triton import draw_word, to_uniform
from texvent.simulation.gpu.launch import (
    EXTRA,
    LAUNCH,
    LaunchSize,
    check_device,
    choose_launch_size,
    on_device,
    to_device,
)

_EVEN, _SUM = tl.constexpr(pixels.EVEN_BYTES), tl.constexpr(pixels.BYTE_SUM)
_EVEN_32 = tl.constexpr(pixels.EVEN_BYTES & 0xFFFFFFFF)
_MEAN, _UNIT = tl.constexpr(pixels.BYTES_MEAN), tl.constexpr(pixels.BYTES_UNIT)
_SPREAD, _MIX_1, _MIX_2 = (tl.constexpr(one) for one in pixels.NOISE_WORDS)
_NOISE_MEAN, _NOISE_UNIT = tl.constexpr(pixels.NOISE_MEAN), tl.constexpr(pixels.NOISE_UNIT)
_ON, _OFF = tl.constexpr(pixels.ON_DRAW), tl.constexpr(pixels.OFF_DRAW)
_PHASE, _CHOICE = tl.constexpr(pixels.PHASE_DRAW), tl.constexpr(pixels.CHOICE_DRAW)
_HOT, _NOISE = tl.constexpr(pixels.HOT_DRAW), tl.constexpr(pixels.NOISE_DRAW)
_LOWEST, _LONG_AGO = tl.constexpr(pixels.LOWEST), tl.constexpr(pixels.LONG_AGO_US)
COUNT, ADD, WRITE = range(3)
"""Passes."""
_COUNT, _ADD, _WRITE = tl.constexpr(COUNT), tl.constexpr(ADD), tl.constexpr(WRITE)
_NUMBERS = tl.constexpr(pixels.HAS_PHASE + 1)
_SIZE = LaunchSize(128, 4)


@triton.jit
def _normal(key: tl.tensor, y: tl.tensor, x: tl.tensor, draw: tl.constexpr) -> tl.tensor:
    word = draw_word(key, y, x, tl.full(y.shape, draw, tl.int64))
    pairs = (word & _EVEN) + ((word >> 8) & _EVEN)
    return (((pairs * _SUM) >> 48).to(tl.int32) - _MEAN).to(tl.float64) * _UNIT


@triton.jit
def _noise(at: tl.tensor, key: tl.tensor) -> tl.tensor:
    """Normal number of a pixel at a frame; see `pixels.NOISE_WORDS`."""
    word = at.to(tl.uint32) * _SPREAD + key.to(tl.uint32)
    word = (word ^ (word >> 16)) * _MIX_1
    word = (word ^ (word >> 15) ^ (key >> 32).to(tl.uint32)) * _MIX_2
    word = word ^ (word >> 16)
    pairs = (word & _EVEN_32) + ((word >> 8) & _EVEN_32)
    return (((pairs + (pairs >> 16)) & 0xFFFF).to(tl.int32) - _NOISE_MEAN).to(tl.float64)


@triton.jit
def _thresholds(numbers: tl.tensor, key: tl.tensor, y: tl.tensor, x: tl.tensor) -> tl.tuple:
    """Thresholds of pixels, and what those that are hot move by."""
    zero = tl.zeros(y.shape, tl.float64)
    on, off, mismatch = zero + tl.load(numbers), zero + tl.load(numbers + 1), tl.load(numbers + 2)
    if mismatch > 0:
        on = tl.maximum(on + on * (mismatch * _normal(key, y, x, _ON)), _LOWEST)
        off = tl.maximum(off + off * (mismatch * _normal(key, y, x, _OFF)), _LOWEST)
    chance = to_uniform(draw_word(key, y, x, tl.full(y.shape, _CHOICE, tl.int64)))
    moved = tl.load(numbers + 5) * _normal(key, y, x, _HOT)
    return on, off, tl.where(chance < tl.load(numbers + 4), moved, zero)


@triton.jit
def _add_event(
    made: tl.tuple, window: tl.tensor, event: tl.tuple, opened_us: tl.tensor, shape: tl.tuple
) -> None:
    """Add an event of every pixel that fires; each pixel belongs to one program."""
    first_us, last_us, _, sums, counts, latest, _ = made
    at, t_us, is_on, fires = event
    area, bins = shape
    if sums is not None:
        begin = tl.load(first_us + window)
        span = tl.maximum(tl.load(last_us + window) - begin, 1)
        offset = tl.where(fires, t_us - begin, 0) * (bins - 1)
        time_bin, after = offset // span, offset % span
        to = sums + (window * (bins + 1) + time_bin) * area + at
        sign = tl.where(is_on, 1, -1).to(tl.int64)
        old = tl.load(to, mask=fires, other=0)
        tl.store(to, old + sign * (span - after), mask=fires)
        old = tl.load(to + area, mask=fires, other=0)
        tl.store(to + area, old + sign * after, mask=fires)
    pair = (window * 2 + is_on.to(tl.int64)) * area + at
    if counts is not None:
        old = tl.load(counts + pair, mask=fires, other=0)
        tl.store(counts + pair, old + 1, mask=fires)
    if latest is not None:
        tl.store(latest + pair, (t_us - opened_us).to(tl.int32), mask=fires)


@triton.jit
def _count_steps(stop: tl.tensor, on: tl.tensor, off: tl.tensor, inside: tl.tensor) -> tl.tuple:
    """Signed threshold of the polarity that a pixel may fire, and how many it crosses."""
    reached = inside & ((stop >= on) | (stop <= -off))
    step = tl.where(stop > 0, on, -off)
    count = tl.floor(stop / step)
    size, distance = tl.abs(step), tl.abs(stop)
    # The quotient may be rounded across a whole number; what counts is the product.
    count += tl.where(distance >= (count + 1.0) * size, 1.0, 0.0)
    count -= tl.where(distance < count * size, 1.0, 0.0)
    return step, tl.where(reached, count, 0.0).to(tl.int32)


@triton.jit
def _crossing_share(start: tl.tensor, stop: tl.tensor, level: tl.tensor, is_on: tl.tensor) -> Any:
    slope = tl.where(stop == start, 1.0, stop - start)
    share = tl.where(stop == start, 1.0, (level - start) / slope)
    is_before = tl.where(is_on, start >= level, start <= level)
    return tl.where(is_before, 0.0, tl.minimum(tl.maximum(share, 0.0), 1.0))


@triton.jit
def _fire(
    made: tl.tuple,
    frame: tl.tuple,
    levels: tl.tuple,
    state: tl.tuple,
    shape: tl.tuple,
    PASS: tl.constexpr,
) -> tl.tuple:
    """Events of pixels between two frames.

    Args:
        made: as `scan_clips` has it.
        frame: window, when it opened, time of the first frame, and from it to the second, in us.
        levels: brightness over the reference at both frames, signed step, and how many are crossed.
        state: pixels, when they fired last, their refractory period, and the next event's place.
        shape: area, bins.
        PASS: count, add or write.

    Returns:
        When the pixels fired last, and the next event's place.
    """
    window, opened_us, start_us, duration = frame
    start, stop, step, number = levels
    at, fired_us, refractory_us, place = state
    area, _ = shape
    for k in range(tl.max(number)):
        share = _crossing_share(start, stop, (k + 1) * step, step > 0)
        t_us = start_us + tl.minimum(tl.floor(share * duration), duration - 1.0).to(tl.int64)
        fires = (k < number) & (t_us - fired_us >= refractory_us)
        fired_us = tl.where(fires, t_us, fired_us)
        if PASS == _ADD:
            _add_event(made, window, (at, t_us, step > 0, fires), opened_us, shape)
        elif PASS == _COUNT:
            tl.atomic_min(made[0] + window, tl.min(tl.where(fires, t_us, 2**62)))
            tl.atomic_max(made[1] + window, tl.max(tl.where(fires, t_us, 0)))
        else:
            rank = tl.cumsum(fires.to(tl.int64), 0) - fires.to(tl.int64)
            word = ((t_us * area + at) << 1) | (step > 0).to(tl.int64)
            tl.store(made[6] + place + rank, word, mask=fires)
        place += tl.sum(fires.to(tl.int64))
    return fired_us, place


@triton.jit
def scan_clips(
    clips: tl.tuple,
    made: tl.tuple,
    shape: tl.tuple,
    per_window: tl.int32,
    bins: tl.int32,
    PASS: tl.constexpr,
    BLOCK: tl.constexpr,
) -> None:
    """One pass over the frames of all clips.

    Args:
        clips: frames [B, T + 1, area] uint8, times [B, T + 1] int64, and `ClipPixels`.
        made: `first_us` and `last_us` [B, W] int64, of the windows; `tally` [B, blocks] int64:
            events of a program, then where they begin; `sums` [B, W, bins + 1, area] int64,
            `counts` and `latest` as `ClipArrays` has them, and `words`; None: not asked for.
        shape: T, area, columns.
        per_window: intervals.
        bins: of a grid.
        PASS: count, add or write.
        BLOCK: pixels of a program.
    """
    pixels, times, numbers, keys, table = clips
    intervals, area, width = shape
    clip = tl.program_id(1).to(tl.int64)
    at = tl.program_id(0) * BLOCK + tl.arange(0, BLOCK)
    inside = at < area
    numbers, key = numbers + clip * _NUMBERS, tl.load(keys + clip).to(tl.uint64, bitcast=True)
    on, off, hot = _thresholds(numbers, key, at // width, at % width)
    noise_per_unit = tl.load(numbers + 3) * _NOISE_UNIT
    refractory_us = tl.load(numbers + 6).to(tl.int64)
    pixels, times = pixels + clip * (intervals + 1) * area + at, times + clip * (intervals + 1)
    before = tl.load(table + tl.load(pixels, mask=inside, other=0).to(tl.int32))
    reference = before
    if tl.load(numbers + 7) > 0:
        word = draw_word(key, at // width, at % width, tl.full([BLOCK], _PHASE, tl.int64))
        reference += off - to_uniform(word) * (on + off)
    fired_us = tl.full([BLOCK], _LONG_AGO, tl.int64)
    zero = tl.full([], 0, tl.int64)
    cell = made[2] + clip * tl.num_programs(0) + tl.program_id(0)
    place = tl.load(cell) if PASS == _WRITE else zero
    for interval in range(intervals):
        window = clip * (intervals // per_window) + interval // per_window
        opened_us = tl.load(times + interval // per_window * per_window)
        start_us = tl.load(times + interval)
        duration = (tl.load(times + interval + 1) - start_us).to(tl.float64)
        noise = noise_per_unit * _noise(at, draw_word(key, zero, zero, zero + _NOISE + interval))
        reference = (reference - noise) - hot
        byte = tl.load(pixels + tl.cast(interval + 1, tl.int64) * area, mask=inside, other=0)
        now = tl.load(table + byte.to(tl.int32))
        stop, start = now - reference, before - (reference + (noise + hot))
        step, number = _count_steps(stop, on, off, inside)
        frame, levels = (window, opened_us, start_us, duration), (start, stop, step, number)
        state = at, fired_us, refractory_us, place
        fired_us, place = _fire(made, frame, levels, state, (area, bins), PASS)
        reference += number.to(tl.float64) * step
        before = now
    if PASS == _COUNT:
        tl.store(cell, place)


def simulate_on_gpu(
    frames: Any, times_us: NDArray[np.int64], clips: ClipPixels, outputs: ClipOutputs
) -> ClipArrays:
    """As `scan.simulate_on_cpu`, of a tensor on a GPU, or on a CPU in Triton's interpreter.

    Raises:
        ConfigError: the frames are not on a GPU.
    """
    torch, device = require("torch", extra=EXTRA), frames.device
    check_device(device)
    count, _, height, width = frames.shape
    intervals, area = frames.shape[1] - 1, height * width
    windows, size = intervals // outputs.intervals_per_window, choose_launch_size(_SIZE)
    grid = triton.cdiv(area, size.block), count

    def room(dtype: Any, *shape: int, value: int = 0) -> Any:
        return torch.full(shape, value, dtype=dtype, device=device)

    pairs = (count, windows, 2, height, width)
    first_us = room(torch.int64, count, windows, value=2**62)
    last_us, tally = room(torch.int64, count, windows), room(torch.int64, count, grid[0])
    sums: Any = None
    counts = latest = words = ends = grids = None
    if outputs.grids:
        sums = room(torch.int64, count, windows, outputs.bins + 1, height, width)
    if outputs.counts:
        counts = room(torch.int32, *pairs)
    if outputs.latest:
        latest = room(torch.int32, *pairs, value=-1)
    plan = (times_us, clips.numbers, clips.keys.view(np.int64), clips.brightness)
    arrays = (frames.contiguous(), *(to_device(one, device) for one in plan))

    def scan(which: int) -> None:
        scan_clips[grid](
            arrays, (first_us, last_us, tally, sums, counts, latest, words),
            (intervals, area, width), outputs.intervals_per_window, outputs.bins,
            PASS=which, BLOCK=size.block, num_warps=size.warps, **LAUNCH,
        )  # fmt: skip

    with on_device(device), torch.no_grad():
        scan(COUNT)
        if outputs.grids or outputs.counts or outputs.latest:
            scan(ADD)
        if outputs.grids:
            span = (last_us - first_us).clamp(min=1)[..., None, None, None]
            grids = (sums[:, :, :-1].double() / span).float()
        if outputs.events:
            passed = tally.flatten().cumsum(0).view_as(tally)
            tally, ends = passed - tally, passed[:, -1].cpu().numpy()
            words = room(torch.int64, int(ends[-1]))
            scan(WRITE)
            words = torch.cat(
                [part.sort().values for part in words.tensor_split(ends[:-1].tolist())]
            )
    return ClipArrays(grids, counts, latest, words, ends)
