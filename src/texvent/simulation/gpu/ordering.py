"""The order of the events of a batch: clip by clip, then by (t, y, x, p, label)."""

from __future__ import annotations

import triton
import triton.language as tl

from texvent._require import require
from texvent.simulation.gpu.kernel_types import Tensor
from texvent.simulation.gpu.launch import EXTRA, LAUNCH, RECORD_BLOCK


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


def order_events(
    words: Tensor, clip_offsets: Tensor, origins_us: Tensor, *, area: int, width: int
) -> tuple[Tensor, Tensor, Tensor, Tensor, Tensor]:
    """Sort events and take them apart.

    One word holds all of an event, and no two clips share a time on the common axis, so that one
    radix sort of whole numbers orders the batch: nothing depends on which program wrote first.

    Args:
        words: [n] int64, see `blocks_triton.pack_event`, in any order.
        clip_offsets: [B + 1] int64, where the events of each clip begin, and their number.
        origins_us: [B] int64, what was added to the times of each clip, µs.
        area: pixels of a frame.
        width: pixels of a row.

    Returns:
        x, y (int32), t (int64, µs), p, label (int8), [n] each, on the device of `words`.
    """
    torch = require("torch", extra=EXTRA)
    dtypes = (torch.int32, torch.int32, torch.int64, torch.int8, torch.int8)
    columns = tuple(torch.empty(len(words), dtype=dtype, device=words.device) for dtype in dtypes)
    if len(words):
        clips = len(origins_us)
        grid = (clips, max(1, triton.cdiv(len(words), clips * RECORD_BLOCK)))
        unpack_events[grid](
            torch.sort(words).values, (clip_offsets, origins_us), columns, area, width,
            BLOCK=RECORD_BLOCK, **LAUNCH,
        )  # fmt: skip
    return columns
