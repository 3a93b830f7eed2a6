"""The row arbiter: rows queue to be read out, and their pixels wait; kernel by backend.

A pixel that fires asks for its row. The rows are served one by one, in the order in which they
asked; all events that wait in a row leave at once, with one time stamp. Serving takes a time for
the row and a time for each event, so the more events there are, the longer they wait.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.backend.select import Kernel

Int64Array: TypeAlias = NDArray[np.int64]

WAITS, LOST = -1, -2
"""In place of a read-out time: the event has not been read out yet; it never will be."""


class RowRules(NamedTuple):
    """How long the arbiter is busy with a row, ns."""

    row_ns: int
    """For each row that it serves."""
    event_ns: int
    """For each event of that row, in addition."""


ServeRows: TypeAlias = Callable[
    [Int64Array, Int64Array, tuple[int, int], RowRules, int, int], tuple[Int64Array, int]
]
"""`serve_rows(pixel, t_us, (height, width), rules, free_ns, stop_us)`, see
`row_arbiter_reference.serve_rows`."""
SERVE_ROWS = Kernel[ServeRows](__name__, "serve_rows")
