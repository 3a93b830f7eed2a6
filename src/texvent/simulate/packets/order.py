"""What sorting the events of an interval into a packet takes and gives, for every pixel model."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias, cast

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.backend.select import AUTO, load_kernel_when_ready


class Unordered(NamedTuple):
    """Events of one interval, a row per event, in any order; never changed."""

    pixel: NDArray[np.int64]
    """[n] flat index y · W + x."""
    t: NDArray[np.int64]
    """[n] times, µs, all in the interval."""
    p: NDArray[np.uint8]
    """[n] 1 = ON, 0 = OFF."""
    label: NDArray[np.uint8]
    """[n] 0 or 1, see `events.SIGNAL`."""


class Columns(NamedTuple):
    """The columns of an `EventStream`, sorted by (t, y, x, p, label)."""

    x: NDArray[np.uint16]
    y: NDArray[np.uint16]
    t: NDArray[np.int64]
    p: NDArray[np.uint8]
    label: NDArray[np.uint8]


OrderEvents: TypeAlias = Callable[[Unordered, tuple[int, int], tuple[int, int]], Columns]
"""`order_events(events, (start_us, stop_us), (height, width))`, see `order_reference`."""


def load_order_events(backend: str = AUTO) -> OrderEvents:
    """The function of a backend; "auto" sorts in NumPy until the compiled one is ready.

    Raises:
        ConfigError: no backend has that name.
        MissingDependencyError: what the backend needs is not installed.
    """
    return cast("OrderEvents", load_kernel_when_ready(__name__, "order_events", backend))


def read_only(array: NDArray[Any]) -> NDArray[Any]:
    """A flat view that cannot be written, so that Numba compiles for one kind of array only."""
    view = np.ascontiguousarray(array).reshape(-1).view()
    view.flags.writeable = False
    return view
