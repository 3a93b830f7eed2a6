"""Noise of the `physical` model on the GPU: the arrivals of `random.poisson_noise`, row by row."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import triton
import triton.language as tl

from texvent._require import require
from texvent.simulation.gpu.blocks_triton import (
    draw_word,
    place_in,
    read_before,
    read_now,
    to_uniform,
)
from texvent.simulation.gpu.elementary_triton import natural_log
from texvent.simulation.gpu.kernel_types import Call, Tensor
from texvent.simulation.gpu.launch import EXTRA, LAUNCH
from texvent.simulation.physical.gpu import light
from texvent.simulation.physical.gpu.light import PhysicalRules, noise_rate_of, rules_of
from texvent.simulation.random import poisson_noise

ROWS = 32
"""Rows of a program."""
SPREAD = 12.0
"""There is room for the mean number and so many standard deviations: more never come."""
FILLER = 2**63 - 1
"""Word after all others."""
_FIRST_DRAW = tl.constexpr(poisson_noise.FIRST_DRAW)
_KEPT_DRAW = tl.constexpr(poisson_noise.KEPT_DRAW)
_POLARITY_DRAW = tl.constexpr(poisson_noise.POLARITY_DRAW)
_MOST_FRACTION = tl.constexpr(poisson_noise.MOST_FRACTION)
_ON_FRACTION = tl.constexpr(light.ON_FRACTION)
_TWICE_HIGHEST = tl.constexpr(light.TWICE_HIGHEST)


class NoiseProcess(NamedTuple):
    """A noise process of the pixels of all clips."""

    cumulative_hz: Tensor
    """[B, H, W] float64: rate of each pixel plus those of its row before it, 1/s."""
    stream: int
    """Number of the process."""
    mean_hz: float
    """Events per second of the clip that has most."""
    is_thinned: bool
    """Whether the rate depends on intensity."""


class PackedArrivals(NamedTuple):
    """Noise of one call, by pixel, then by time, of all clips together."""

    words: Tensor
    """[n] int64, ascending: (pixel · axis_us + time) · 2 + polarity, with the time on the common
    axis; then at least one `FILLER`."""
    first: Tensor
    """[B, area] int64: number of the first word of a pixel in a clip."""
    axis_us: int
    """Length of the axis, µs."""


@triton.jit
def draw_arrivals(
    frames: tl.tuple,
    intervals: tl.tuple,
    rules: tl.tuple,
    process: tl.tuple,
    noise: tl.tuple,
    IS_THINNED: tl.constexpr,
    ROWS: tl.constexpr,
) -> None:
    """Draw the arrivals of some rows in one interval.

    Args:
        frames: `kernel_types.FrameLayout`.
        intervals: `kernel_types.Intervals`.
        rules: `light.PhysicalRules`.
        process: `cumulative_hz` and `stream` of a `NoiseProcess`.
        noise: words, see `PackedArrivals`, in any order; [1] int32, how many there are; for how
            many there is room; `axis_us`.
        IS_THINNED: whether the rate depends on intensity.
        ROWS: rows of a program.
    """
    words, made, room, axis_us = noise
    segment = tl.program_id(1).to(tl.int64)
    y = tl.program_id(0) * ROWS + tl.arange(0, ROWS)
    going = y < frames.area // frames.width
    clip = segment // frames.intervals
    rules = rules_of(rules, clip)
    row = process[0] + clip * frames.area + y * frames.width
    total = tl.load(row + frames.width - 1, mask=going, other=0.0)
    key = tl.load(intervals.key + segment).to(tl.uint64, bitcast=True)
    stream = tl.zeros([ROWS], tl.int64) + process[1]
    per_s = 1.0 / (tl.load(intervals.duration_us + segment).to(tl.float64) * 1e-6)
    place = tl.zeros([ROWS], tl.float64)
    number = tl.full([], 0, tl.int64)
    while tl.max(going.to(tl.int32)) > 0:
        chance = to_uniform(draw_word(key, y, stream, number + _FIRST_DRAW))
        place += -natural_log(1.0 - chance) * per_s
        going = going & (place < total)
        x = _first_above(row, place, going, frames.width)
        start = tl.load(row + x - 1, mask=going & (x > 0), other=0.0)
        share = (place - start) / (tl.load(row + x, mask=going, other=1.0) - start)
        share = tl.where(share < _MOST_FRACTION, share, _MOST_FRACTION)
        t = place_in(intervals, segment, tl.where(going, share, 0.0))
        pixel = y * frames.width + x
        stays = going
        if IS_THINNED:
            kept = to_uniform(draw_word(key, y, stream, number + _KEPT_DRAW))
            rate = noise_rate_of(read_before(frames, segment, pixel, going), rules)
            rate += noise_rate_of(read_now(frames, segment, pixel, going), rules)
            stays = going & (kept < rate / tl.load(rules.numbers + _TWICE_HIGHEST))
        coin = to_uniform(draw_word(key, y, stream, number + _POLARITY_DRAW))
        is_on = (coin < tl.load(rules.numbers + _ON_FRACTION)).to(tl.int64)
        rank = tl.cumsum(stays.to(tl.int32), 0)
        at = tl.atomic_add(made, tl.max(rank)) + rank - 1
        word = (pixel.to(tl.int64) * axis_us + t) * 2 + is_on
        tl.store(words + at, word, mask=stays & (at < room))
        number += 1


@triton.jit
def _first_above(row: tl.tensor, value: tl.tensor, where: tl.tensor, width: tl.int32) -> tl.tensor:
    """First column of each row whose number exceeds a value; the last one always does."""
    low = tl.zeros(value.shape, tl.int32)
    high = tl.zeros(value.shape, tl.int32) + (width - 1)
    while tl.max(high - low) > 0:
        middle = (low + high) // 2
        is_open = low < high
        is_above = tl.load(row + middle, mask=where & is_open, other=0.0) > value
        high = tl.where(is_open & is_above, middle, high)
        low = tl.where(is_open & (is_above == 0), middle + 1, low)
    return low


def draw_noise(
    call: Call, rules: PhysicalRules, processes: Sequence[NoiseProcess], axis_us: int
) -> PackedArrivals | None:
    """The noise of a call; None where there are no processes. Nothing waits for the device.

    Args:
        call: frames and intervals.
        rules: the options.
        processes: those that are not silent.
        axis_us: length of the common axis of times, µs.
    """
    if not processes:
        return None
    torch = require("torch", extra=EXTRA)
    frames, device = call.frames, call.frames.pixels.device
    mean = sum(process.mean_hz for process in processes) * axis_us * 1e-6
    room = int(mean + SPREAD * math.sqrt(mean)) + 32
    words = torch.full((room + 1,), FILLER, dtype=torch.int64, device=device)
    made = torch.zeros(1, dtype=torch.int32, device=device)
    height = frames.area // frames.width
    for process in processes:
        draw_arrivals[math.ceil(height / ROWS), call.segments](
            frames, call.intervals, rules, process[:2], (words, made, room, axis_us),
            IS_THINNED=process.is_thinned, ROWS=ROWS, num_warps=1, **LAUNCH,
        )  # fmt: skip
    words = words.sort().values
    every = slice(None, None, frames.intervals)
    opened_us = call.intervals.start_us[every] + call.intervals.origin_us[every]
    pixel = torch.arange(frames.area, dtype=torch.int64, device=device)
    sought = (pixel * axis_us + opened_us[:, None]) * 2
    return PackedArrivals(words, torch.searchsorted(words, sought), axis_us)
