"""The order of the events of a batch: clip by clip, then by (t, y, x, p, label)."""

from __future__ import annotations

import triton

from texvent._require import require
from texvent.simulate.gpu.device import EXTRA, LAUNCH
from texvent.simulate.gpu.kernel_types import Tensor
from texvent.simulate.gpu.ordering_triton import unpack_events

_BLOCK = 512


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
        grid = (clips, max(1, triton.cdiv(len(words), clips * _BLOCK)))
        unpack_events[grid](
            torch.sort(words).values, (clip_offsets, origins_us), columns, area, width,
            BLOCK=_BLOCK, **LAUNCH,
        )  # fmt: skip
    return columns
