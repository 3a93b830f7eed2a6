"""Memory of the machine and of this process."""

from __future__ import annotations

import contextlib
import functools
import os
from pathlib import Path

SHARE = 0.8
"""Of the machine's memory, or of its control group's, that a run uses at most by default."""
UNKNOWN_BYTES = 8 * 2**30
"""Taken for the machine's memory where the system does not report it, as on Windows."""
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
