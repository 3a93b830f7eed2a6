"""Events of one sub-interval, sorted into a packet."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream
from texvent.simulate.interval import SubInterval

_KEY_LIMIT = 2**63


def sort_packet(
    pixel: NDArray[np.int64],
    t: NDArray[np.int64],
    p: NDArray[np.uint8],
    label: NDArray[np.uint8],
    *,
    interval: SubInterval,
) -> EventStream:
    """Events in the order every packet has: by (t, y, x, p), then signal before noise.

    Args:
        pixel: flat index y · W + x, [n].
        t: times, µs, [n], all in the sub-interval.
        p: 1 = ON, 0 = OFF, [n].
        label: `events.SIGNAL` or `events.NOISE`, [n].
        interval: the sub-interval.
    """
    start_us, size = interval.start_us, interval.size
    pixels = size.width * size.height
    if (interval.stop_us - start_us) * pixels * 4 > _KEY_LIMIT:
        order = np.lexsort((label, p, pixel, t))
        pixel, t, p, label = pixel[order], t[order], p[order], label[order]
    else:
        # One integer per event sorts much faster than four columns, and holds all of them.
        key = np.sort(((t - start_us) * pixels + pixel) * 4 + p * 2 + label)
        label, p = (key & 1).astype(np.uint8), (key >> 1 & 1).astype(np.uint8)
        offset, pixel = np.divmod(key >> 2, pixels)
        t = start_us + offset
    y, x = np.divmod(pixel, size.width)
    return EventStream(x.astype(np.uint16), y.astype(np.uint16), t, p, size, label=label)
