"""Memory that was freed goes back to the system, also in long runs with several threads.

glibc keeps what is freed for later. Frames that one thread allocates and another one frees tear
holes into that store, and over a long video it grows to twice what is in use.
"""

from __future__ import annotations

import ctypes
import functools
import sys
from collections.abc import Callable


def release_freed_memory() -> None:
    """Return freed memory to the system; takes some milliseconds. Does nothing without glibc."""
    trim = _find_trim()
    if trim is not None:
        trim(0)


@functools.cache
def _find_trim() -> Callable[[int], int] | None:
    if sys.platform != "linux":
        return None
    function: Callable[[int], int] | None = getattr(ctypes.CDLL(None), "malloc_trim", None)
    return function
