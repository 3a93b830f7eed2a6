"""A texvent that lacks what Windows lacks in Python: modules, functions and constants of POSIX.

Run as a program, in a folder: it imports every module of texvent, then makes, reads and converts
events there. Others import what they need before it is taken away: only texvent is looked at.
"""

from __future__ import annotations

import importlib
import os
import pkgutil
import signal
import sys
import time

MODULES = ("fcntl", "grp", "pwd", "resource", "termios", "tty", "pty")
"""Modules that Python on Windows does not have."""
OS_NAMES = (
    *("fork", "getpgid", "getuid", "geteuid", "getgid", "killpg", "mkfifo", "nice", "pread"),
    *("pwrite", "register_at_fork", "sched_getaffinity", "setsid", "sysconf", "uname"),
    *("O_CLOEXEC", "O_DIRECTORY", "O_NOFOLLOW", "O_NONBLOCK"),
)
SIGNALS = ("SIGALRM", "SIGHUP", "SIGKILL", "SIGQUIT", "SIGUSR1", "SIGUSR2", "SIGXCPU")
FIRST = ("cv2", "h5py", "av", "numba", "lz4.frame", "yaml", "rich.console", "requests",
         "tempfile", "shutil", "subprocess", "multiprocessing.pool", "asyncio", "pypi_simple",
         "concurrent.futures.process", "pandas", "rosbags.highlevel", "OpenEXR",
         "trimesh", "PIL.Image", "curses")  # fmt: skip
OPTIONAL = ("torch", "triton", "ray", "diffusers", "matplotlib", "safetensors")
"""Packages of extras: a module that needs one of them is passed over where it is missing."""


def take_away() -> None:
    """Remove what Windows lacks."""
    for name in MODULES:
        sys.modules[name] = None  # type: ignore[assignment]
    for module, names in ((os, OS_NAMES), (signal, SIGNALS)):
        for name in names:
            if hasattr(module, name):
                delattr(module, name)
    del time.clock_gettime


def import_all() -> int:
    """Import every module of texvent; returns how many there are."""
    import texvent
    from texvent.errors import MissingDependencyError

    count = 0
    for found in pkgutil.walk_packages(texvent.__path__, "texvent."):
        if found.name.endswith("__main__"):
            continue
        try:
            importlib.import_module(found.name)
        except (ImportError, MissingDependencyError) as error:
            missing = getattr(error.__cause__ or error, "name", None) or ""
            if missing.partition(".")[0] not in OPTIONAL:
                raise
        count += 1
    return count


def main() -> int:
    """Import everything, then run commands; returns the exit code of the first that fails."""
    for name in FIRST:
        importlib.import_module(name)
    take_away()
    sys.stdout.write(f"modules {import_all()}\n")
    import numpy as np

    from texvent.cli.app import main as texvent_main

    ramp = np.add.outer(np.arange(4.0) * 50, np.arange(48 * 36).reshape(36, 48) % 50)
    np.save("ramp.npy", ramp.astype(np.float32))
    simulate = [
        "simulate",
        "ramp.npy",
        "--fps",
        "100",
        "--interpolate",
        "blend",
        "--noise",
        "none",
        "-o",
    ]
    for words in (
        [*simulate, "ramp.h5", "--previews", "none"],
        ["info", "ramp.h5"],
        ["convert", "ramp.h5", "ramp.aedat4"],
        [*simulate, "ramp.h5", "--dry-run", "--overwrite"],
        ["doctor"],
    ):
        code = texvent_main(words)
        if code:
            return code
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
