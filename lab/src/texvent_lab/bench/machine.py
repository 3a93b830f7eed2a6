"""What a result was measured with: the commit, versions and the machine."""

from __future__ import annotations

import os
import platform
from importlib import metadata
from pathlib import Path
from typing import Any

from texvent import __version__
from texvent.extending import source_commit

PACKAGES = ("numpy", "numba", "opencv-python-headless", "h5py", "torch")
"""Packages whose versions may change a figure."""
CPU_FACTS = Path("/proc/cpuinfo")


def describe_environment() -> dict[str, Any]:
    """Facts that a result's document states, ready for JSON.

    Returns:
        `commit` of the source tree, with "+changes" where files differ from it; of an installed
        package, which has none, its version. Then versions and the device.
    """
    return {
        "commit": source_commit() or f"installed {__version__}",
        "texvent_version": __version__,
        "python": platform.python_version(),
        "packages": {name: version for name in PACKAGES if (version := _version(name))},
        "device": f"{_processor()}, {os.cpu_count()} cores",
        "system": f"{platform.system()} {platform.machine()}",
    }


def _version(package: str) -> str | None:
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return None


def _processor() -> str:
    """Name of the processor; Linux keeps it in a file, other systems in the platform's answer."""
    if CPU_FACTS.is_file():
        for line in CPU_FACTS.read_text(encoding="utf-8").splitlines():
            name, _, value = line.partition(":")
            if name.strip() == "model name":
                return value.strip()
    return platform.processor() or platform.machine()
