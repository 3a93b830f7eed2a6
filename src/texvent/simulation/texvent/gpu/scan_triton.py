"""Texvent's pixel model (Eqs. 5 and 7) as Triton kernels; `pixels` launches them.

A program owns a block of pixels of one clip and goes through all intervals of a call with their
state in registers: once to count the events, once more to write them. What costs more per event
than per pixel (the logarithm, the time) is left to `timestamp_events`, which reads events only.
"""

from __future__ import annotations

import triton
import triton.language as tl

from texvent.simulation.gpu.blocks_triton import (
    count_bad,
    draw_word,
    find_cell,
    mark_fired,
    own_pixels,
    pack_event,
    place_in,
    read,
    read_before,
    read_now,
    read_order,
    read_share,
    skip_frames,
    to_uniform,
    write_events,
)
from texvent.simulation.texvent.gpu import rules

_BALANCE = tl.constexpr(rules.BALANCE)
_THRESHOLD = tl.constexpr(rules.THRESHOLD)
_UP = tl.constexpr(rules.UP)
_DOWN = tl.constexpr(rules.DOWN)
_LARGEST = tl.constexpr(1e3)
"""Change of brightness that no two allowed intensities differ by, log units."""
_EQ7 = tl.constexpr(rules.TIMESTAMP_RULES["eq7"])
_RANDOM = tl.constexpr(rules.TIMESTAMP_RULES["random"])
_LINEAR = tl.constexpr(rules.TIMESTAMP_RULES["linear"])
_TIMESTAMP_DRAW = tl.constexpr(rules.TIMESTAMP_DRAW)


@triton.jit
def scan_levels(
    frames: tl.tuple,
    intervals: tl.tuple,
    rules: tl.tuple,
    reference: tl.tensor,
    tally: tl.tuple,
    records: tl.tuple,
    ALIGN: tl.constexpr,
    BLOCK: tl.constexpr,
) -> None:
    """Find the events of every interval where a reference is always an earlier intensity.

    Two intensities per pixel decide: it fires at the lower one and below, at the higher one and
    above. For bytes both come from a table made in float64, so the decision is the reference's.

    Args:
        frames: `kernel_types.FrameLayout`.
        intervals: `kernel_types.Intervals`.
        rules: `rules.TexventRules`.
        reference: [B, area] intensity each pixel compares with; brought up to date in pass 2.
        tally: `kernel_types.PassCounts`.
        records: `kernel_types.Records`, or None for pass 1, which counts.
        ALIGN: see `kernel_types.Call`.
        BLOCK: pixels of a program.

    Equation: (5), section 3.2.2.
    """
    clip, at, inside, home, pixels = own_pixels(frames, ALIGN, BLOCK)
    before = read(frames.previous + home, inside)
    level = read(reference + home, inside)
    # Pixels past the last one keep levels that nothing reaches.
    low, high = _move_levels(level, inside, level * 0 - 1, level * 0 + 32767, rules)
    now = read(pixels, inside)
    bad = count_bad(before, inside)
    for interval in range(frames.intervals):
        # Asked for one interval ahead, so that memory answers while this one is compared.
        following = pixels + skip_frames(frames, interval + 1, ALIGN)
        ahead = read(following, inside & (interval + 1 < frames.intervals))
        segment = clip * frames.intervals + interval
        if read_share(intervals, segment) == 1:
            level = before
            low, high = _move_levels(before, inside, low, high, rules)
        fired = (now <= low) | (now >= high)
        total = tl.sum(fired.to(tl.int32))
        cell = find_cell(tally, segment)
        if tally.bad is not None:
            tl.store(cell, total)
            mark_fired(tally, segment, frames.area, fired, BLOCK)
            bad += count_bad(now, inside)
        elif total > 0:
            write_events(records, tl.load(cell), fired, (at, at, level))
        if total > 0:
            low, high = _move_levels(now, fired, low, high, rules)
            level = tl.where(fired, now, level)
        before = now
        now = ahead
    if tally.bad is not None:
        tl.atomic_add(tally.bad, tl.sum(bad))
    else:
        tl.store(reference + home, level, mask=inside)


@triton.jit
def _move_levels(
    intensity: tl.tensor, where: tl.tensor, low: tl.tensor, high: tl.tensor, rules: tl.tuple
) -> tl.tuple:
    """Intensities at which a pixel with this reference fires, if `where`; else the old."""
    if intensity.dtype == tl.int32:
        pair = tl.load(rules.levels + intensity, mask=where, other=0)
        new_low = pair >> 16
        new_high = pair & 0xFFFF
    else:
        balance = tl.load(rules.numbers + _BALANCE)
        balanced = intensity.to(tl.float64) + balance
        new_low = _round_down(balanced * tl.load(rules.numbers + _DOWN) - balance)
        new_high = _round_up(balanced * tl.load(rules.numbers + _UP) - balance)
    return tl.where(where, new_low, low), tl.where(where, new_high, high)


@triton.jit
def _round_up(number: tl.tensor) -> tl.tensor:
    """The smallest float32 that is not below a float64 of at least 0."""
    near = number.to(tl.float32)
    after = (near.to(tl.int32, bitcast=True) + 1).to(tl.float32, bitcast=True)
    return tl.where(near.to(tl.float64) < number, after, near)


@triton.jit
def _round_down(number: tl.tensor) -> tl.tensor:
    """The largest float32 that is not above a float64; −1 for those below 0."""
    near = number.to(tl.float32)
    before = (near.to(tl.int32, bitcast=True) - 1).to(tl.float32, bitcast=True)
    rounded = tl.where(near.to(tl.float64) > number, before, near)
    return tl.where(number < 0, -1.0, rounded)


@triton.jit
def scan_brightness(
    frames: tl.tuple,
    intervals: tl.tuple,
    rules: tl.tuple,
    reference: tl.tensor,
    tally: tl.tuple,
    records: tl.tuple,
    ALIGN: tl.constexpr,
    BLOCK: tl.constexpr,
) -> None:
    """Find the events of every interval where references move freely: a leak, steps, many events.

    Arguments as for `scan_levels`, but `reference` is a brightness, float64, log units. It compares
    brightness itself, so every pixel of every frame costs a logarithm or a look-up.

    Equation: (5), section 3.2.2.
    """
    clip, at, inside, home, pixels = own_pixels(frames, ALIGN, BLOCK)
    threshold = tl.load(rules.numbers + _THRESHOLD)
    last = read(frames.previous + home, inside)
    before = brightness_of(last, rules)
    level = tl.load(reference + home, mask=inside, other=0.0)
    bad = count_bad(last, inside)
    for interval in range(frames.intervals):
        segment = clip * frames.intervals + interval
        last = read(pixels + skip_frames(frames, interval, ALIGN), inside)
        now = brightness_of(last, rules)
        share = read_share(intervals, segment)
        if share == 1:
            level = before
        elif share > 0:
            level += share * (before - level)
        size = tl.abs(now - level)
        fired = inside & (size >= threshold)
        number = tl.where(fired, count_events(size, threshold, rules), 0)
        total = tl.sum(number)
        cell = find_cell(tally, segment)
        if tally.bad is not None:
            tl.store(cell, total)
            mark_fired(tally, segment, frames.area, fired, BLOCK)
            bad += count_bad(last, inside)
        elif total > 0:
            place = tl.load(cell)
            for order in range(1, tl.max(number) + 1):
                reached = order <= number
                write_events(records, place, reached, (at, order, level))
                place += tl.sum(reached.to(tl.int32))
        if rules.is_step:
            moved = number.to(tl.float64) * threshold
            level = tl.where(now > level, level + moved, level - moved)
        else:
            level = tl.where(fired, now, level)
        before = now
    if tally.bad is not None:
        tl.atomic_add(tally.bad, tl.sum(bad))
    else:
        tl.store(reference + home, level, mask=inside)


@triton.jit
def brightness_of(intensity: tl.tensor, rules: tl.tuple) -> tl.tensor:
    """L(α + I), float64: of bytes from the host's table, else the GPU's logarithm."""
    if intensity.dtype == tl.int32:
        brightness = tl.load(rules.logs + intensity)
    else:
        brightness = tl.log(intensity.to(tl.float64) + tl.load(rules.numbers + _BALANCE))
    return brightness


@triton.jit
def count_events(size: tl.tensor, threshold: tl.tensor, rules: tl.tuple) -> tl.tensor:
    """Number of events of a change of `size` ≥ δ, int32."""
    if rules.multi_event:
        # Of intensities that are refused after the pass, the size may be NaN or infinite.
        number = tl.floor(tl.where(size < _LARGEST, size, 0.0) / threshold).to(tl.int32)
    else:
        number = tl.full(size.shape, 1, tl.int32)
    return number


@triton.jit
def find_extremes(
    frames: tl.tuple,
    rules: tl.tuple,
    records: tl.tuple,
    ends: tl.tensor,
    extremes: tl.tensor,
    BLOCK: tl.constexpr,
) -> None:
    """The smallest and the largest |change| of every segment's events, for Eq. 7.

    Args:
        frames: `kernel_types.FrameLayout`.
        rules: `rules.TexventRules`.
        records: `kernel_types.Records`.
        ends: [S + 1] int64, where the records of each segment begin, and their number.
        extremes: [S, 2] float64, set to +∞ and −∞ before.
        BLOCK: records that a program takes at a time.
    """
    segment = tl.program_id(0).to(tl.int64)
    first = tl.load(ends + segment) + tl.program_id(1) * BLOCK
    stop = tl.load(ends + segment + 1)
    smallest = tl.full([BLOCK], float("inf"), tl.float64)
    largest = tl.full([BLOCK], float("-inf"), tl.float64)
    for start in range(first, stop, tl.num_programs(1) * BLOCK):
        at = start + tl.arange(0, BLOCK)
        inside = at < stop
        pixel = tl.load(records.pixel + at, mask=inside, other=0)
        size = tl.abs(
            brightness_of(read_now(frames, segment, pixel, inside), rules)
            - _reference_of(records, at, inside, rules)
        )
        smallest = tl.where(inside, tl.minimum(smallest, size), smallest)
        largest = tl.where(inside, tl.maximum(largest, size), largest)
    if first < stop:
        tl.atomic_min(extremes + 2 * segment, tl.min(smallest))
        tl.atomic_max(extremes + 2 * segment + 1, tl.max(largest))


@triton.jit
def _reference_of(
    records: tl.tuple, at: tl.tensor, inside: tl.tensor, rules: tl.tuple
) -> tl.tensor:
    """The reference brightness of records, float64, whatever they hold of it."""
    reference = read(records.reference + at, inside)
    return reference if reference.dtype == tl.float64 else brightness_of(reference, rules)


@triton.jit
def timestamp_events(
    frames: tl.tuple,
    intervals: tl.tuple,
    rules: tl.tuple,
    records: tl.tuple,
    ends: tl.tuple,
    words: tl.tensor,
    TIMESTAMP_RULE: tl.constexpr,
    BLOCK: tl.constexpr,
) -> None:
    """Give every record a time, and write it down as one word.

    Args:
        frames: `kernel_types.FrameLayout`.
        intervals: `kernel_types.Intervals`.
        rules: `rules.TexventRules`.
        records: `kernel_types.Records`.
        ends: [S + 1] where the records of each segment begin, and `find_extremes`'s result or None.
        words: [n] int64, see `blocks_triton.pack_event`.
        TIMESTAMP_RULE: which rule, see `rules.TIMESTAMP_RULES`.
        BLOCK: records that a program takes at a time.

    Equation: (7), section 3.2.2; see `texvent.simulation.texvent.timestamps`.
    """
    segment = tl.program_id(0).to(tl.int64)
    first = tl.load(ends[0] + segment) + tl.program_id(1) * BLOCK
    stop = tl.load(ends[0] + segment + 1)
    for start in range(first, stop, tl.num_programs(1) * BLOCK):
        at = start + tl.arange(0, BLOCK)
        inside = at < stop
        pixel = tl.load(records.pixel + at, mask=inside, other=0)
        order = read_order(records, at, inside)
        reference = _reference_of(records, at, inside, rules)
        now = brightness_of(read_now(frames, segment, pixel, inside), rules)
        if TIMESTAMP_RULE == _EQ7:
            fraction = _larger_change_earlier(now - reference, ends[1] + 2 * segment)
        elif TIMESTAMP_RULE == _RANDOM:
            key = tl.load(intervals.key + segment).to(tl.uint64, bitcast=True)
            y = pixel // frames.width
            x = pixel % frames.width
            fraction = to_uniform(draw_word(key, y, x, order + _TIMESTAMP_DRAW))
        elif TIMESTAMP_RULE == _LINEAR:
            before = brightness_of(read_before(frames, segment, pixel, inside), rules)
            fraction = _linear_crossing(before, now, reference, order, rules)
        else:
            fraction = tl.full([BLOCK], 1.0, tl.float64)
        is_on = (now > reference).to(tl.int64)
        t = place_in(intervals, segment, fraction)
        tl.store(words + at, pack_event(t, pixel, is_on, 0, frames.area), mask=inside)


@triton.jit
def _larger_change_earlier(change: tl.tensor, extremes: tl.tensor) -> tl.tensor:
    smallest = tl.load(extremes)
    spread = tl.load(extremes + 1) - smallest
    share = (tl.abs(change) - smallest) / tl.where(spread > 0, spread, 1.0)
    return tl.where(spread > 0, 1.0 - share, 0.5)


@triton.jit
def _linear_crossing(
    before: tl.tensor, now: tl.tensor, reference: tl.tensor, order: tl.tensor, rules: tl.tuple
) -> tl.tensor:
    moved = order.to(tl.float64) * tl.load(rules.numbers + _THRESHOLD)
    is_on = now > reference
    level = tl.where(is_on, reference + moved, reference - moved)
    is_over = tl.where(is_on, before >= level, before <= level)
    slope = now - before
    share = (level - before) / tl.where(slope != 0, slope, 1.0)
    share = tl.where(slope != 0, share, 1.0)
    return tl.minimum(tl.maximum(tl.where(is_over, 0.0, share), 0.0), 1.0)
