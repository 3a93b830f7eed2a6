"""Arrays of kernels: scratch memory, which each thread keeps from call to call; read-only views.

The system clears every page of a new array at its first use, which costs more than most kernels
spend on it, and arrays of a packet's size go back to the system when freed. What a thread keeps
grows to its largest packet. Numba compiles a kernel for each kind of array, writable or not.
"""

from __future__ import annotations

import threading
from typing import Any

import numpy as np
from numpy.typing import NDArray

SLACK = 1.25
"""Allocate this many times the size asked for, so that slowly growing packets rarely allocate."""


class _Kept(threading.local):
    def __init__(self) -> None:
        self.arrays: dict[str, NDArray[Any]] = {}


_kept = _Kept()


def take_scratch(use: str, size: int, dtype: type[np.generic]) -> NDArray[Any]:
    """An uninitialised flat array of this thread, valid until its next call for the same use.

    Args:
        use: name of the use; each has one type.
        size: number of elements, at least 0.
        dtype: their type.

    Returns:
        [size], writable.
    """
    array = _kept.arrays.get(use)
    if array is None or array.size < size:
        array = _kept.arrays[use] = np.empty(int(size * SLACK), dtype)
    return array[:size]


def read_only(array: NDArray[Any]) -> NDArray[Any]:
    """A C-contiguous view (or copy) of an array that cannot be written."""
    view = np.ascontiguousarray(array).view()
    view.flags.writeable = False
    return view
