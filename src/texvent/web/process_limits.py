"""Bounds that the system keeps for a worker process: memory and processor time."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

PROBE_MEMORY_GB = 2.0
PROBE_CPU_S = 20


def bound_memory(gigabytes: float) -> None:
    """Let this process take that much more memory than it has now; allocations beyond it fail.

    Systems other than Linux leave memory unbounded.
    """
    if sys.platform != "linux":
        return
    resource = _resource()
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    most = _size_now() + int(gigabytes * 1e9)
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (most, hard))


@contextlib.contextmanager
def bounded_probe() -> Iterator[None]:
    """Inside, this process has `PROBE_MEMORY_GB` and `PROBE_CPU_S` for a first look at an upload.

    The system ends a process that takes longer.
    """
    if sys.platform != "linux":
        yield
        return
    resource = _resource()
    kinds = (resource.RLIMIT_AS, resource.RLIMIT_CPU)
    before = [resource.getrlimit(kind) for kind in kinds]
    usage = resource.getrusage(resource.RUSAGE_SELF)
    seconds = int(usage.ru_utime + usage.ru_stime) + 1 + PROBE_CPU_S
    bound_memory(PROBE_MEMORY_GB)
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, before[1][1]))
    try:
        yield
    finally:
        for kind, limits in zip(kinds, before, strict=True):
            resource.setrlimit(kind, limits)


def _resource() -> Any:
    # The module is missing on Windows.
    import resource

    return resource


def _size_now() -> int:
    pages = int(Path("/proc/self/statm").read_text("ascii").split()[0])
    return pages * int(_resource().getpagesize())
