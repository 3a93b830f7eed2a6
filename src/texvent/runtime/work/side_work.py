"""Work beside a run, such as keeping what it has made for the next one.

It ends before a command or a task of an engine does, or else with the process. Where the process
is interrupted, it has some seconds; what it writes through `io.atomic` is then whole or not there.
"""

from __future__ import annotations

import atexit
import sys
import threading
import time
from collections.abc import Callable, Hashable, Iterator
from contextlib import contextmanager

from texvent.runtime.work.interrupts import clean_up, clean_ups

PATIENCE_S = 5.0
"""Time that work has to end in where the process is asked to end."""
_running: dict[Hashable, threading.Thread] = {}
_lock = threading.Lock()


def begin_side_work(key: Hashable, work: Callable[[], None]) -> None:
    """Call a function in a thread of its own, after what goes by the same key.

    Args:
        key: of `finish_side_work`.
        work: reports its errors itself.
    """

    def run() -> None:
        try:
            if before is not None:
                before.join()
            work()
        finally:
            with _lock:
                if _running.get(key) is thread:
                    del _running[key]

    thread = threading.Thread(target=run, name="texvent-side-work", daemon=True)
    with _lock:
        before = _running.get(key)
        try:
            thread.start()
            _running[key] = thread
            return
        except RuntimeError:  # the system gives no more threads
            pass
    run()


def finish_side_work(key: Hashable | None = None, *, seconds: float | None = None) -> None:
    """Wait for work.

    Args:
        key: which; None: for all.
        seconds: longest wait; None: until it ends.
    """
    end_s = None if seconds is None else time.monotonic() + seconds
    for name, thread in list(_running.items()):
        if key in (None, name):
            thread.join(None if end_s is None else max(0.0, end_s - time.monotonic()))


@contextmanager
def finishing_side_work() -> Iterator[None]:
    """Wait for all work at the end of the block and after an error, not after an interrupt."""
    try:
        yield
    except Exception:
        finish_side_work()
        raise
    finish_side_work()


def _finish_soon() -> None:
    atexit.unregister(_finish_at_exit)
    finish_side_work(seconds=PATIENCE_S)


def _finish_at_exit() -> None:
    if issubclass(getattr(sys, "last_type", None) or Exception, KeyboardInterrupt):
        clean_up()
    else:
        finish_side_work()


atexit.register(_finish_at_exit)
clean_ups.insert(0, _finish_soon)  # before the parts of files are removed
