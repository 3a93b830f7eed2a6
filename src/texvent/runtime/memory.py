"""Memory of the machine and of this process, and how much freed memory the C allocator keeps.

Decoders ask `check_claim` before they make room for what the head of a file claims.

glibc keeps the memory of small arrays for later ones. Where one thread allocates frames and another
frees them, this store fragments, and in a long video it grows to twice what is in use. Large arrays
go back to the system at once; it then clears every page of the next one, which costs more than
filling it.
"""

from __future__ import annotations

import contextlib
import ctypes
import functools
import os
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from texvent.errors import FileFormatError, InputError

SHARE = 0.8
"""Share of the machine's memory, or of its control group's, that a run uses at most by default."""
UNKNOWN_BYTES = 8 * 2**30
"""Taken for the machine's memory where the system does not report it, as on Windows."""
SMALL_BYTES = 512 * 2**20
"""Unpacked size below which no file is out of proportion: a black frame of 16k, 8 bits."""
MOST_EXPANSION = 100
"""Columns, text and photographs shrink to a half or a tenth; zeros shrink to a thousandth."""
_CONTROL_GROUPS = (
    Path("/sys/fs/cgroup/memory.max"),
    Path("/sys/fs/cgroup/memory/memory.limit_in_bytes"),
)


@functools.cache
def usable_bytes() -> int:
    """Memory that a run may use, bytes: `SHARE` of what machine, control group and process have."""
    sizes = [machine_bytes() or UNKNOWN_BYTES, *_process_limits()]
    for path in _CONTROL_GROUPS:
        with contextlib.suppress(OSError, ValueError):  # not there, or "max"
            sizes.append(int(path.read_text(encoding="ascii")))
    return int(SHARE * min(sizes))


def check_claim(
    claimed: int, path: Path | str, *, copies: int = 1, size: int | None = None
) -> None:
    """Refuse a file that would take more memory than there is, or out of proportion to its size.

    Args:
        claimed: bytes that it unpacks to, as its head says.
        path: the file, or the name of a part of one.
        copies: how often all of it is in memory at once.
        size: bytes of the part; None: those of the file.

    Raises:
        FileFormatError: see above.
    """
    check_proportion(claimed, path, size)
    if copies * claimed > usable_bytes():
        raise FileFormatError(
            f"{path} takes {copies * claimed / 1e9:.1f} GB of memory, and a run may use "
            f"{usable_bytes() / 1e9:.1f} GB of this machine; make it smaller, or take a machine "
            "with more memory"
        )


@contextlib.contextmanager
def explain_memory(what: str) -> Iterator[None]:
    """Turn torch's failure of memory into one line.

    Raises:
        InputError: it says `what`.
    """
    try:
        yield
    except RuntimeError as error:
        if "memory" not in str(error):
            raise
        raise InputError(what) from error


def check_proportion(claimed: int, path: Path | str, size: int | None = None) -> None:
    """Refuse a file, or a part of one, that claims to unpack to more than its size allows.

    Raises:
        FileFormatError: see above.
    """
    size = Path(path).stat().st_size if size is None else size
    if claimed > max(SMALL_BYTES, MOST_EXPANSION * size):
        raise FileFormatError(
            f"{path} has {size} bytes and claims to unpack to {claimed}; it is "
            "damaged, or made to fill the memory"
        )


def most_unpacked(path: Path) -> int:
    """Bytes that a file may unpack to in proportion to its size."""
    return max(SMALL_BYTES, MOST_EXPANSION * path.stat().st_size)


def machine_bytes() -> int | None:
    """Memory of the machine, bytes; None where the system does not report it."""
    try:
        return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (AttributeError, ValueError):  # Windows has no sysconf
        return None


def _process_limits() -> list[int]:
    """Memory that the process may map, bytes, where that is limited."""
    try:
        import resource
    except ImportError:
        return []
    limits = (resource.getrlimit(kind)[0] for kind in (resource.RLIMIT_AS, resource.RLIMIT_DATA))
    return [limit for limit in limits if limit != resource.RLIM_INFINITY]


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
