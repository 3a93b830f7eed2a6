"""ESIM's pixel model on the GPU: threshold crossings as Triton kernels, and their launches.

As with Texvent, a program owns a block of pixels and goes through all intervals of a call, once to
count the events and once to write them.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import triton
import triton.language as tl

from texvent._require import require
from texvent.simulation.esim.config import WHITE, EsimConfig
from texvent.simulation.esim.pixels import log_intensity
from texvent.simulation.gpu.blocks_triton import (
    count_bad,
    find_cell,
    own_pixels,
    pack_event,
    place_in,
    read,
    read_before,
    read_now,
    read_share,
    skip_frames,
    write_events,
)
from texvent.simulation.gpu.kernel_types import Call, Records, Tensor
from texvent.simulation.gpu.launch import (
    EXTRA,
    LAUNCH,
    RAMP_LAUNCH,
    RECORD_BLOCK,
    make_records,
    segment_grid,
    to_device,
)
from texvent.simulation.gpu.passes import GpuPixels

THRESHOLD_ON, THRESHOLD_OFF, LOG_EPS = range(3)
"""Places in `EsimRules.numbers`."""


class EsimRules(NamedTuple):
    """The options of the model, on the device."""

    numbers: Tensor
    """[3] float64, because Triton rounds a plain number to float32."""
    logs: Tensor
    """[256] float64: log intensity of a byte."""


_THRESHOLD_ON = tl.constexpr(THRESHOLD_ON)
_THRESHOLD_OFF = tl.constexpr(THRESHOLD_OFF)
_LOG_EPS = tl.constexpr(LOG_EPS)
_WHITE = tl.constexpr(WHITE)


@triton.jit
def scan_ramp(
    frames: tl.tuple,
    intervals: tl.tuple,
    rules: tl.tuple,
    reference: tl.tensor,
    tally: tl.tuple,
    records: tl.tuple,
    ALIGN: tl.constexpr,
    BLOCK: tl.constexpr,
) -> None:
    """Find every threshold that a straight line of log intensity crosses in every interval.

    Arguments as for `texvent.simulation.texvent.gpu.scan_triton.scan_levels`, but `rules` are
    `EsimRules`, and `reference` is a log intensity, float64.

    Source: as `crossing.ramp`, whose events these are.
    """
    clip, at, inside, home, pixels = own_pixels(frames, ALIGN, BLOCK)
    threshold_on = tl.load(rules.numbers + _THRESHOLD_ON)
    threshold_off = tl.load(rules.numbers + _THRESHOLD_OFF)
    intensity = read(frames.previous + home, inside)
    before = brightness_of(intensity, rules)
    level = tl.load(reference + home, mask=inside, other=0.0)
    bad = count_bad(intensity, inside)
    for interval in range(frames.intervals):
        segment = clip * frames.intervals + interval
        intensity = read(pixels + skip_frames(frames, interval, ALIGN), inside)
        now = brightness_of(intensity, rules)
        if read_share(intervals, segment) == 1:
            level = before
        is_on = now > level
        threshold = tl.where(is_on, threshold_on, threshold_off)
        size = tl.where(inside, tl.abs(now - level), 0.0)
        cell = find_cell(tally, segment)
        place = tl.full([], 0, tl.int64)
        if tally.bad is None:
            place = tl.load(cell)
        order = 1
        passed = tl.zeros([BLOCK], tl.int32)
        reached = size >= threshold
        while tl.max(reached.to(tl.int32)) > 0:
            if tally.bad is None:
                write_events(records, place, reached, (at, order, level))
            place += tl.sum(reached.to(tl.int32))
            passed += reached.to(tl.int32)
            order += 1
            reached = size >= order * threshold
        if tally.bad is not None:
            tl.store(cell, place)
            bad += count_bad(intensity, inside)
        moved = passed.to(tl.float64) * threshold
        level = tl.where(is_on, level + moved, level - moved)
        before = now
    if tally.bad is not None:
        tl.atomic_add(tally.bad, tl.sum(bad))
    else:
        tl.store(reference + home, level, mask=inside)


@triton.jit
def stamp_crossings(
    frames: tl.tuple,
    intervals: tl.tuple,
    rules: tl.tuple,
    records: tl.tuple,
    ends: tl.tensor,
    words: tl.tensor,
    BLOCK: tl.constexpr,
) -> None:
    """Give every crossing its time, and write it down as one word.

    Args:
        frames: `kernel_types.FrameLayout`.
        intervals: `kernel_types.Intervals`.
        rules: `EsimRules`.
        records: `kernel_types.Records`.
        ends: [S + 1] int64, where the records of each segment begin, and their number.
        words: [n] int64, see `blocks_triton.pack_event`.
        BLOCK: records that a program takes at a time.
    """
    segment = tl.program_id(0).to(tl.int64)
    threshold_on = tl.load(rules.numbers + _THRESHOLD_ON)
    threshold_off = tl.load(rules.numbers + _THRESHOLD_OFF)
    start = tl.load(ends + segment) + tl.program_id(1) * BLOCK
    stop = tl.load(ends + segment + 1)
    for begin in range(start, stop, tl.num_programs(1) * BLOCK):
        at = begin + tl.arange(0, BLOCK)
        inside = at < stop
        pixel = tl.load(records.pixel + at, mask=inside, other=0)
        order = tl.load(records.order + at, mask=inside, other=1)
        level = tl.load(records.reference + at, mask=inside, other=0.0)
        before = brightness_of(read_before(frames, segment, pixel, inside), rules)
        now = brightness_of(read_now(frames, segment, pixel, inside), rules)
        is_on = now > level
        threshold = tl.where(is_on, threshold_on, threshold_off)
        first = tl.where(is_on, before - level, level - before)
        last = tl.abs(now - level)
        share = crossing_share(first, last, order * threshold)
        t = place_in(intervals, segment, share)
        tl.store(words + at, pack_event(t, pixel, is_on, 0, frames.area), mask=inside)


@triton.jit
def brightness_of(intensity: tl.tensor, rules: tl.tuple) -> tl.tensor:
    """`ln(I / 255 + ε)`, float64: of bytes from the host's table, else the GPU's logarithm."""
    if intensity.dtype == tl.int32:
        brightness = tl.load(rules.logs + intensity)
    else:
        share = intensity.to(tl.float64) / _WHITE
        brightness = tl.log(share + tl.load(rules.numbers + _LOG_EPS))
    return brightness


@triton.jit
def crossing_share(first: tl.tensor, last: tl.tensor, level: tl.tensor) -> tl.tensor:
    """Share of a line from `first` to `last` at which it reaches `level`; 0 if it starts beyond."""
    # A pixel that has not reached the level may rest, and nothing may be divided by 0.
    slope = tl.where(first < last, last - first, 1.0)
    share = tl.minimum((level - first) / slope, 1.0)
    return tl.where(first < level, share, 0.0)


class EsimGpuPixels(GpuPixels[EsimConfig]):
    """The pixels of a batch of clips under ESIM."""

    def __init__(self, config: EsimConfig, seeds: Sequence[int]) -> None:
        """Pixels that have seen no frame.

        Args:
            config: the options.
            seeds: one per clip; nothing is drawn.
        """
        super().__init__(config, RAMP_LAUNCH)

    def begin(self, frames: Tensor) -> None:
        """See `GpuPixels`."""
        torch = require("torch", extra=EXTRA)
        config, device = self.config, frames.device
        # What it holds does not matter: the first interval begins at its own start.
        self._reference = torch.zeros(frames.shape, dtype=torch.float64, device=device)
        numbers = np.empty(3)
        numbers[THRESHOLD_ON] = config.contrast_threshold_on
        numbers[THRESHOLD_OFF] = config.contrast_threshold_off
        numbers[LOG_EPS] = config.log_eps
        logs = log_intensity(np.arange(256, dtype=np.uint8), config.log_eps)
        self._rules = EsimRules(
            to_device(numbers, device),
            to_device(logs, device),
        )

    def _scan(self, call: Call) -> tuple[Any, Any, Any]:
        return scan_ramp, self._rules, self._reference

    def records(self, count: int, words: Tensor) -> Records:
        """See `GpuPixels`."""
        return make_records(count, self._reference, has_order=True)

    def timestamp(self, call: Call, records: Records, ends: Tensor, words: Tensor) -> None:
        """Give every record its time; see `stamp_crossings`."""
        stamp_crossings[segment_grid(call, len(records.pixel), RECORD_BLOCK)](
            call.frames,
            call.intervals,
            self._rules,
            records,
            ends,
            words,
            BLOCK=RECORD_BLOCK,
            **LAUNCH,
        )
