"""The end of the process, while kernels may still be compiling for later runs."""

from __future__ import annotations

import os
import sys

PATIENCE_S = 1.0
"""Kernels that were compiled before are loaded within this time: nothing is said about them."""


def leave(code: int) -> int:
    """Wait for kernels that are being compiled, with a word, if the run went well; else end now.

    Python itself waits for threads without a word, and Ctrl-C would not end that.

    Args:
        code: exit code of the run; everything it opened is closed.

    Returns:
        `code`, where nothing is left to wait for; else the process ends here.
    """
    readiness = sys.modules.get("texvent.runtime.background_jit")
    try:
        if readiness is None or readiness.wait_until_idle(PATIENCE_S if code == 0 else 0.0):
            return code
        if code == 0:
            sys.stderr.write(
                "the output is complete; compiling for later runs, once on this machine: "
                "Ctrl-C leaves it to the next one\n"
            )
            sys.stderr.flush()
            readiness.wait_until_idle()
            return code
    except KeyboardInterrupt:
        pass
    for stream in (sys.stdout, sys.stderr):
        stream.flush()
    # Threads cannot be told to stop compiling. Numba writes its cache beside and renames.
    os._exit(code)
