"""Memory that a run may use: as the user says, or a share of the machine's."""

from __future__ import annotations

import contextlib
import functools
import os
import re
import sys
from pathlib import Path

from texvent.errors import ConfigError, shown

SHARE = 0.8
"""Of the machine's memory, or of its control group's, that a run uses at most by default."""
UNITS = {"": 1, "k": 10**3, "m": 10**6, "g": 10**9, "t": 10**12}
BINARY_UNITS = {"ki": 2**10, "mi": 2**20, "gi": 2**30, "ti": 2**40}
UNKNOWN_BYTES = 8 * 2**30
"""Taken for the machine's memory where the system does not report it, as on Windows."""
_CONTROL_GROUPS = (
    Path("/sys/fs/cgroup/memory.max"),
    Path("/sys/fs/cgroup/memory/memory.limit_in_bytes"),
)
_asked: list[int] = []


def parse_memory(text: str) -> int:
    """Bytes in a text such as 4GB, 512MiB or 1e9.

    Raises:
        ConfigError: it is none, or less than 1 MB.

    Example:
        >>> parse_memory("4GB"), parse_memory("1.5 GiB")
        (4000000000, 1610612736)
    """
    match = re.fullmatch(r"(\d{1,15}(?:\.\d{1,9})?)\s*([kmgt]i?)?b?", text.strip().lower())
    size = float(match[1]) * {**UNITS, **BINARY_UNITS}[match[2] or ""] if match else 0
    if not 1e6 <= size <= 1e18:
        raise ConfigError(f"memory is {shown(text)}; give 1MB or more, such as 4GB or 512MiB")
    return int(size)


def allow_memory(text: str | None) -> None:
    """Set what `allowed_bytes` answers in this process from now on; None is the default."""
    _asked[:] = [] if text is None else [parse_memory(text)]


def allowed_bytes() -> int:
    """Memory that a run may use, bytes: as asked for, or `SHARE` of the machine's."""
    return _asked[0] if _asked else int(SHARE * _available())


@functools.cache
def _available() -> int:
    """The least of what the machine has, its control group allows, and the process may map."""
    sizes = [machine_bytes() or UNKNOWN_BYTES, *_process_limits()]
    for path in _CONTROL_GROUPS:
        with contextlib.suppress(OSError, ValueError):  # not there, or "max"
            sizes.append(int(path.read_text(encoding="ascii")))
    return min(sizes)


def machine_bytes() -> int | None:
    """Memory of the machine, bytes; None where the system does not report it."""
    try:
        return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (AttributeError, ValueError):  # Windows has no sysconf
        return None


def peak_bytes() -> int | None:
    """The most memory that this process has had at once, bytes; None where it is not known."""
    try:
        import resource
    except ImportError:  # Windows has no such module
        return None
    # Linux reports ru_maxrss in KiB, macOS in bytes.
    unit = 1 if sys.platform == "darwin" else 1024
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit


def _process_limits() -> list[int]:
    """Memory that the process may map, bytes, where that is limited."""
    try:
        import resource
    except ImportError:
        return []
    limits = (resource.getrlimit(kind)[0] for kind in (resource.RLIMIT_AS, resource.RLIMIT_DATA))
    return [limit for limit in limits if limit != resource.RLIM_INFINITY]
