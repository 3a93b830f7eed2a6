"""The C allocator: how much freed memory the process keeps, and when the system gets it back.

glibc keeps the memory of small arrays for later ones. Where one thread allocates frames and another
frees them, this store fragments, and in a long video it grows to twice what is in use. Large arrays
go back to the system at once; it then clears every page of the next one, which costs more than
filling it.
"""

from __future__ import annotations

import ctypes
import functools
import sys
from collections.abc import Callable

import numpy as np

_LARGEST_KEPT = (32 << 20) - (1 << 16)
"""glibc's DEFAULT_MMAP_THRESHOLD_MAX, less an array's header, bytes."""


def release_freed_memory() -> None:
    """Return freed memory to the system; takes some milliseconds. Does nothing without glibc."""
    trim = _find_trim()
    if trim is not None:
        trim(0)


@functools.cache
def keep_freed_memory() -> None:
    """Let arrays of up to 32 MB use memory that was freed before, up to 64 MB of it.

    glibc keeps arrays up to the size of the largest one freed so far, and twice that size in all
    (mallopt(3), M_MMAP_THRESHOLD). So this frees one of 32 MB. It has no effect where the process
    has freed a larger one already.
    """
    np.empty(_LARGEST_KEPT, np.uint8)


@functools.cache
def _find_trim() -> Callable[[int], int] | None:
    if sys.platform != "linux":
        return None
    function: Callable[[int], int] | None = getattr(ctypes.CDLL(None), "malloc_trim", None)
    return function
