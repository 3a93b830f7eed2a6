"""The definition of a packet's order; sorts where nothing is compiled."""

import numpy as np

from texvent.simulation.packets import SortedEvents, UnsortedEvents


def sort_events(
    events: UnsortedEvents, span_us: tuple[int, int], shape: tuple[int, int]
) -> SortedEvents:
    """As `kernels.radix_sort.sort_events`."""
    (start_us, stop_us), pixels = span_us, shape[0] * shape[1]
    pixel, t, p, label = events
    if (stop_us - start_us) * pixels * 4 < 2**63:
        # One integer per event sorts much faster than four columns, and holds all of them.
        key = np.sort((((t - start_us) * pixels + pixel) * 2 + p) * 2 + label)
        label, p = (key & 1).astype(np.uint8), (key >> 1 & 1).astype(np.uint8)
        offset, pixel = np.divmod(key >> 2, pixels)
        t = start_us + offset
    else:
        order = np.lexsort((label, p, pixel, t))
        t, pixel, p, label = t[order], pixel[order], p[order], label[order]
    y, x = np.divmod(pixel, shape[1])
    return SortedEvents(x.astype(np.uint16), y.astype(np.uint16), t, p, label)
