"""Memory for what a kernel needs only while it works, kept by each thread from call to call.

The system clears every page of a fresh array at its first touch, which costs more than most kernels
do with it, and memory that was freed goes back to the system at a packet's size. What is kept grows
to the largest packet that the thread has seen.
"""

from __future__ import annotations

import threading
from typing import Any

import numpy as np
from numpy.typing import NDArray

SLACK = 1.25
"""By how much more than asked for is taken, so that slowly growing packets do not ask each time."""


class _Kept(threading.local):
    def __init__(self) -> None:
        self.arrays: dict[str, NDArray[Any]] = {}


_kept = _Kept()


def take_scratch(use: str, size: int, dtype: type[np.generic]) -> NDArray[Any]:
    """A flat array of a thread's own, of any content, until the thread asks again for that use.

    Args:
        use: what it is for; each use has one type.
        size: how many elements, at least 0.
        dtype: their type.

    Returns:
        [size], writable.
    """
    array = _kept.arrays.get(use)
    if array is None or array.size < size:
        array = _kept.arrays[use] = np.empty(int(size * SLACK), dtype)
    return array[:size]
