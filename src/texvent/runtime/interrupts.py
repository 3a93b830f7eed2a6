"""Delay Ctrl-C while a library runs that would lose the exception."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

DELAYED = (signal.SIGINT, signal.SIGTERM)


@contextmanager
def delay_interrupts() -> Iterator[None]:
    """Let the block finish before Ctrl-C (or a handled SIGTERM) takes effect.

    HDF5 calls back into Python while it cleans up, where an exception is printed and dropped: a
    KeyboardInterrupt raised there would be lost, and the run would go on. Outside the main
    thread, where Python never raises it, this does nothing.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    received: list[tuple[int, FrameType | None]] = []
    before = {number: signal.getsignal(number) for number in DELAYED}
    handled = {number: handler for number, handler in before.items() if callable(handler)}
    for number in handled:
        signal.signal(number, lambda code, frame: received.append((code, frame)))
    try:
        yield
    finally:
        for number, handler in handled.items():
            signal.signal(number, handler)
        for code, frame in received[:1]:
            handled[signal.Signals(code)](code, frame)
