"""How much freed memory the process keeps, and when it goes back to the system.

glibc keeps small arrays that are freed for later. Frames that one thread allocates and another one
frees tear holes into that store, and over a long video it grows to twice what is in use. Large
arrays go back at once; the system clears every page of the next one, which costs more than filling
it.
"""

from __future__ import annotations

import ctypes
import functools
import sys
from collections.abc import Callable

import numpy as np

_LARGEST_KEPT = (32 << 20) - (1 << 16)
"""What glibc calls DEFAULT_MMAP_THRESHOLD_MAX, less what surrounds an array."""


def release_freed_memory() -> None:
    """Return freed memory to the system; takes some milliseconds. Does nothing without glibc."""
    trim = _find_trim()
    if trim is not None:
        trim(0)


@functools.cache
def keep_freed_memory() -> None:
    """Let arrays of up to 32 MB use memory that was freed before, up to 64 MB of it.

    glibc takes the largest array that was ever freed for the size up to which arrays are kept, and
    twice that for how much is (mallopt(3), M_MMAP_THRESHOLD). So this frees one, and does nothing
    where some program has freed a larger one already.
    """
    np.empty(_LARGEST_KEPT, np.uint8)


@functools.cache
def _find_trim() -> Callable[[int], int] | None:
    if sys.platform != "linux":
        return None
    function: Callable[[int], int] | None = getattr(ctypes.CDLL(None), "malloc_trim", None)
    return function
