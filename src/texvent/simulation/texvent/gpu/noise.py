"""Noise addition (Eq. 6) on the GPU: Poisson tables from the host, draws by blocks of pixels."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import triton
import triton.language as tl

from texvent._require import require
from texvent.simulation.gpu import kernel_types
from texvent.simulation.gpu.blocks_triton import (
    draw_word,
    pack_event,
    place_in,
    read_now,
    to_uniform,
)
from texvent.simulation.gpu.intervals import Int64Array, Span
from texvent.simulation.gpu.kernel_types import (
    DARK_BELOW,
    ON_FRACTION,
    Call,
    NoiseRules,
    Tensor,
)
from texvent.simulation.gpu.launch import EXTRA, LAUNCH, to_device
from texvent.simulation.random.draws import Purpose
from texvent.simulation.texvent.config import TexventConfig
from texvent.simulation.texvent.noise import (
    NOISE_BLOCK,
    NOISE_PLACE_SHIFT,
    poisson_cumulative,
)

_BLOCK = tl.constexpr(NOISE_BLOCK)
_PLACE_SHIFT = tl.constexpr(NOISE_PLACE_SHIFT)
_TIME_MASK = tl.constexpr((1 << NOISE_PLACE_SHIFT) - 1)
_TIME_UNIT = tl.constexpr(2.0**-NOISE_PLACE_SHIFT)
_COUNT_DRAW = tl.constexpr(Purpose.NOISE_COUNT.draw())
_PLACE_DRAW = tl.constexpr(Purpose.NOISE_PLACE.draw())
_POLARITY_DRAW = tl.constexpr(Purpose.NOISE_POLARITY.draw())
_PER_MARK = tl.constexpr(kernel_types.PIXELS_PER_MARK)
_ON_FRACTION = tl.constexpr(kernel_types.ON_FRACTION)
_DARK_BELOW = tl.constexpr(kernel_types.DARK_BELOW)


@triton.jit
def draw_noise(
    frames: tl.tuple,
    intervals: tl.tuple,
    rules: tl.tuple,
    fired: tl.tensor,
    tally: tl.tensor,
    words: tl.tensor,
    LANES: tl.constexpr,
    DRAWS: tl.constexpr,
) -> None:
    """Draw the noise of every segment: once to count it, once to write it down.

    Args:
        frames: `kernel_types.FrameLayout`.
        intervals: `kernel_types.Intervals`.
        rules: `kernel_types.NoiseRules`.
        fired: `PassCounts.fired`, or None where noise is not on dark, resting pixels only.
        tally: [S, noise blocks]: pass 1 leaves the number of events here, int32; pass 2 finds where
            the block's events begin among all words, int64.
        words: [n] int64, see `blocks_triton.pack_event`; None in pass 1.
        LANES: noise blocks of a program.
        DRAWS: events of a block that are drawn at once.

    Equation: (6), section 3.2.2, drawn as `texvent.simulation.texvent.noise` says.
    """
    segment = tl.program_id(1).to(tl.int64)
    lane = tl.program_id(0) * LANES + tl.arange(0, LANES)
    blocks = (frames.area + _BLOCK - 1) // _BLOCK
    inside = lane < blocks
    key = tl.load(intervals.key + segment).to(tl.uint64, bitcast=True)
    first = tl.full([LANES], _COUNT_DRAW, tl.int64)
    chance = to_uniform(draw_word(key, lane >> 16, lane & 0xFFFF, first))
    count = tl.where(inside, _count_below(chance, intervals, segment, rules), 0)
    cell = tally + segment * blocks + lane
    place = tl.zeros([LANES], tl.int64)
    if words is not None:
        place = tl.load(cell, mask=inside, other=0)
    block = lane[:, None]
    y, x = block >> 16, block & 0xFFFF
    for start in range(0, tl.max(count), DRAWS):
        k = (start + tl.arange(0, DRAWS)).to(tl.int64)[None, :]
        word = draw_word(key, y, x, k + _PLACE_DRAW)
        pixel = block * _BLOCK + (word >> _PLACE_SHIFT).to(tl.int32)
        falls = (k < count[:, None]) & (pixel < frames.area)
        if fired is not None:
            falls &= _is_resting(frames, segment, pixel, falls, (fired, rules))
        number = falls.to(tl.int32)
        if words is not None:
            share = (word & _TIME_MASK).to(tl.float64) * _TIME_UNIT
            coin = to_uniform(draw_word(key, y, x, k + _POLARITY_DRAW))
            is_on = (coin < tl.load(rules.numbers + _ON_FRACTION)).to(tl.int64)
            t = place_in(intervals, segment, share)
            at = place[:, None] + tl.cumsum(number, 1) - number
            tl.store(words + at, pack_event(t, pixel, is_on, 1, frames.area), mask=falls)
        place += tl.sum(number, axis=1)
    if words is None:
        tl.store(cell, place, mask=inside)


@triton.jit
def _count_below(
    chance: tl.tensor, intervals: tl.tuple, segment: tl.tensor, rules: tl.tuple
) -> tl.tensor:
    """Number of entries of the segment's cumulative Poisson table up to `chance`."""
    row = rules.cumulative + tl.load(intervals.table + segment) * rules.length
    low = tl.zeros(chance.shape, tl.int32)
    high = tl.full(chance.shape, 0, tl.int32) + rules.length
    while tl.max(high - low) > 0:
        middle = (low + high) // 2
        open_ = low < high
        is_above = tl.load(row + middle, mask=open_, other=2.0) > chance
        high = tl.where(open_ & is_above, middle, high)
        low = tl.where(open_ & (is_above == 0), middle + 1, low)
    return low


@triton.jit
def _is_resting(
    frames: tl.tuple, segment: tl.tensor, pixel: tl.tensor, where: tl.tensor, mask: tl.tuple
) -> tl.tensor:
    """The mask M of Eq. 6 at single pixels: darker than σ, and not fired."""
    fired, rules = mask
    intensity = read_now(frames, segment, pixel, where).to(tl.float64)
    marks = fired + segment * ((frames.area + _PER_MARK - 1) // _PER_MARK)
    byte = tl.load(marks + pixel // _PER_MARK, mask=where, other=0)
    bit = (byte.to(tl.int32) >> (pixel % _PER_MARK)) & 1
    return (intensity < tl.load(rules.numbers + _DARK_BELOW)) & (bit == 0)


_CELLS = 512
"""Draws of a program at a time."""
_MOST_DRAWS = 128
_NEVER = 2.0
"""Fills up tables of several lengths: above every uniform number."""


def noise_rules(config: TexventConfig, span: Span, frames: Tensor) -> tuple[NoiseRules, Int64Array]:
    """Noise rules of the intervals of a span.

    Args:
        config: options of the model.
        span: the intervals.
        frames: decides the device, and the type in which intensities are compared with σ.

    Returns:
        The rules, and which table each interval draws from, [B, T].
    """
    durations, row = np.unique(span.duration_us, return_inverse=True)
    tables = [
        poisson_cumulative(config.expected_noise(one * 1e-6) * NOISE_BLOCK)
        for one in durations.tolist()
    ]
    length = max(map(len, tables))
    cumulative = np.full((len(tables), length), _NEVER)
    for one, table in zip(cumulative, tables, strict=True):
        one[: len(table)] = table
    numbers = np.empty(2)
    numbers[ON_FRACTION] = config.noise_on_fraction
    # As NumPy compares: a float32 frame with a float32 number.
    is_float = frames.is_floating_point()
    numbers[DARK_BELOW] = np.float32(config.noise_intensity) if is_float else config.noise_intensity
    rules = NoiseRules(
        to_device(numbers, frames.device), to_device(cumulative, frames.device), length
    )
    return rules, row.reshape(span.duration_us.shape)


class NoiseDraw:
    """The noise of one call."""

    def __init__(self, call: Call, rules: NoiseRules, fired: Tensor | None) -> None:
        """Count it.

        Args:
            call: frames and intervals.
            rules: of `noise_rules`.
            fired: `PassCounts.fired`; None where noise falls on any pixel.
        """
        torch = require("torch", extra=EXTRA)
        self._call, self._rules, self._fired = call, rules, fired
        self._blocks = math.ceil(call.frames.area / NOISE_BLOCK)
        device = call.frames.pixels.device
        self._count = torch.empty(call.segments * self._blocks, dtype=torch.int32, device=device)
        self._launch(self._count, None)

    @property
    def per_block(self) -> Tensor:
        """Events by segment and noise block, [S · blocks] int32."""
        return self._count

    def write(self, starts: Tensor, words: Tensor) -> None:
        """Write the events down.

        Args:
            starts: [S · blocks] int64, where the events of each block begin in `words`.
            words: [n] int64.
        """
        self._launch(starts, words)

    def _launch(self, tally: Tensor, words: Any) -> None:
        draws = min(_MOST_DRAWS, triton.next_power_of_2(self._rules.length))
        lanes = _CELLS // draws
        grid = (math.ceil(self._blocks / lanes), self._call.segments)
        draw_noise[grid](
            self._call.frames,
            self._call.intervals,
            self._rules,
            self._fired,
            tally,
            words,
            LANES=lanes,
            DRAWS=draws,
            **LAUNCH,
        )
