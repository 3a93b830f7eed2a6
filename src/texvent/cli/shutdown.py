"""The end of the process, while kernels may still be compiling for later runs."""

from __future__ import annotations

import os
import sys

LOADING_S = 1.0
"""Compiled kernels are loaded within this time; only a longer wait is announced."""


def end_process(code: int) -> int:
    """Wait for kernels that are being compiled if the run went well, and say so; else end now.

    Python itself waits for threads without a message, and Ctrl-C would not end that.

    Args:
        code: exit code of the run; everything it opened is closed.

    Returns:
        `code`, where nothing is left to wait for; else the process ends here.
    """
    background_jit = sys.modules.get("texvent.runtime.background_jit")
    try:
        wait_s = LOADING_S if code == 0 else 0.0
        if background_jit is None or background_jit.wait_until_idle(wait_s):
            return code
        if code == 0:
            sys.stderr.write(
                "the output is complete; compiling for later runs, once on this machine: "
                "Ctrl-C leaves it to the next one\n"
            )
            sys.stderr.flush()
            background_jit.wait_until_idle()
            return code
    except KeyboardInterrupt:
        pass
    for stream in (sys.stdout, sys.stderr):
        stream.flush()
    # Threads cannot be told to stop compiling. Numba writes its cache beside and renames.
    os._exit(code)
