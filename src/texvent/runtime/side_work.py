"""Work beside a run, such as keeping what it has made for the next one.

It ends before a command or a task of an engine does. Where the process is asked to end, it has some
seconds; what it writes through `io.atomic` is then whole or not there.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Hashable

from texvent.runtime.interrupts import clean_ups

PATIENCE_S = 5.0
"""Time that work has to end in where the process is asked to end."""
_running: dict[Hashable, threading.Thread] = {}


def begin_side_work(key: Hashable, work: Callable[[], None]) -> None:
    """Call a function in a thread of its own, after what goes by the same key.

    Args:
        key: of `finish_side_work`.
        work: reports its errors itself.
    """

    def run() -> None:
        try:
            work()
        finally:
            del _running[key]

    finish_side_work(key)
    # No daemon: the end of a script waits for it.
    thread = _running[key] = threading.Thread(target=run, name="texvent-side-work")
    try:
        thread.start()
    except RuntimeError:  # the system gives no more threads
        run()


def finish_side_work(key: Hashable | None = None, *, seconds: float | None = None) -> None:
    """Wait for work.

    Args:
        key: which; None: for all.
        seconds: longest wait; None: until it ends.
    """
    end_s = None if seconds is None else time.monotonic() + seconds
    for name, thread in list(_running.items()):
        if key in (None, name) and thread.is_alive():
            thread.join(None if end_s is None else max(0.0, end_s - time.monotonic()))


def _finish_soon() -> None:
    finish_side_work(seconds=PATIENCE_S)


clean_ups.insert(0, _finish_soon)  # before the parts of files are removed
