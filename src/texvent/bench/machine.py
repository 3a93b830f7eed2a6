"""What a result was measured with: the commit, versions and the machine."""

from __future__ import annotations

import os
import platform
import subprocess
from importlib import metadata
from pathlib import Path
from typing import Any

from texvent._version import __version__

PACKAGES = ("numpy", "numba", "opencv-python-headless", "h5py", "torch")
"""Packages whose versions may change a figure."""
PATIENCE_S = 10
CPU_FACTS = Path("/proc/cpuinfo")


def describe_environment() -> dict[str, Any]:
    """Facts that a result's document states, ready for JSON.

    Returns:
        `commit` of the source tree, with "+changes" where files differ from it; of an installed
        package, which has none, its version. Then versions and the device.
    """
    return {
        "commit": _commit(),
        "texvent_version": __version__,
        "python": platform.python_version(),
        "packages": {name: version for name in PACKAGES if (version := _version(name))},
        "device": f"{_processor()}, {os.cpu_count()} cores",
        "system": f"{platform.system()} {platform.machine()}",
    }


def _commit() -> str:
    package = Path(__file__).parents[1]
    # Asked for a file of ours: a package installed inside another project's tree is not its commit.
    if _git(package, "ls-files", "--error-unmatch", "_version.py") is None:
        return f"installed {__version__}"
    commit = _git(package, "rev-parse", "HEAD") or ""
    changes = _git(package, "status", "--porcelain", "--untracked-files=no", ".")
    return f"{commit}+changes" if changes else commit


def _git(folder: Path, *words: str) -> str | None:
    """Output of a git command, or None where git or the tree is missing."""
    command = ["git", "-C", str(folder), *words]
    try:
        done = subprocess.run(
            command, capture_output=True, text=True, timeout=PATIENCE_S, check=False
        )
    except (OSError, subprocess.TimeoutExpired):
        return None
    return None if done.returncode else done.stdout.strip()


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
