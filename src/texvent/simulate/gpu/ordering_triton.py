"""Sorted event words → columns, as a Triton kernel."""

from __future__ import annotations

import triton
import triton.language as tl


@triton.jit
def unpack_events(
    words: tl.tensor,
    clips: tl.tuple,
    columns: tl.tuple,
    area: tl.int64,
    width: tl.int32,
    BLOCK: tl.constexpr,
) -> None:
    """Unpack the words of `blocks_triton.pack_event`.

    Args:
        words: [n] int64, ascending.
        clips: [B + 1] where the events of each clip begin, and their number; and [B] what was
            added to the clip's times, µs; int64.
        columns: x, y, t, p, label, [n] each.
        area: pixels of a frame.
        width: pixels of a row.
        BLOCK: events that a program takes at a time.
    """
    clip = tl.program_id(0)
    first = tl.load(clips[0] + clip) + tl.program_id(1) * BLOCK
    stop = tl.load(clips[0] + clip + 1)
    origin_us = tl.load(clips[1] + clip)
    for start in range(first, stop, tl.num_programs(1) * BLOCK):
        at = start + tl.arange(0, BLOCK)
        inside = at < stop
        word = tl.load(words + at, mask=inside, other=0)
        place = word >> 2
        pixel = (place % area).to(tl.int32)
        tl.store(columns[0] + at, pixel % width, mask=inside)
        tl.store(columns[1] + at, pixel // width, mask=inside)
        tl.store(columns[2] + at, place // area - origin_us, mask=inside)
        tl.store(columns[3] + at, ((word >> 1) & 1).to(tl.int8), mask=inside)
        tl.store(columns[4] + at, (word & 1).to(tl.int8), mask=inside)
