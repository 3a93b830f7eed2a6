"""One sub-interval as the Texvent model sees it: its time and the brightness at both ends."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.firings import Interval

Float64Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class SubInterval:
    """What is compared with what between two neighbouring frames, and when."""

    span: Interval
    """Time of both frames, and the key of the random draws between them."""
    previous: Float64Array
    """Brightness at the start, L(α + I^{j−1}), [H, W], log units."""
    brightness: Float64Array
    """Brightness at the end, L(α + I^j), [H, W], log units."""
    reference: Float64Array
    """Reference brightness the pixels compare with, L(α + κ ⋄ I^{j−1}), [H, W], log units."""


def place_in(span: Interval, fraction: Float64Array) -> NDArray[np.int64]:
    """Times at fractions 0..1 of an interval, rounded down; never its end itself.

    Args:
        span: the interval.
        fraction: [n].

    Returns:
        [n] µs, in `[start_us, stop_us)`.

    Example:
        >>> place_in(Interval(0, 10_000, np.uint64(0)), np.array([0.0, 0.75, 1.0])).tolist()
        [0, 7500, 9999]
    """
    offset = np.floor(fraction * span.duration_us).astype(np.int64)
    return np.asarray(np.minimum(span.start_us + offset, span.stop_us - 1))
