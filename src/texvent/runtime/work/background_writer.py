"""A background writer: a short queue, written by a thread of its own."""

from __future__ import annotations

from collections import deque
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Any, Protocol, Self

from texvent.runtime.work.interrupts import delay_interrupts

DEPTH = 8
"""Most packets in the queue; they are held in memory."""


class Appendable(Protocol):
    """A writer of any kind."""

    def append(self, *parts: Any) -> None:
        """Write the next item."""
        ...


class BackgroundWriter:
    """Appends to `sink` in another thread, in order.

    Use it in a `with` block inside the sink's own. At the end of the block the queue is empty. If
    the block ends with an exception the queue is dropped, and the sink discards its file. An error
    of the sink is raised by a later `append`, at the latest at the end of the block. It saves time
    where the sink releases the interpreter lock (compression, encoding).
    """

    def __init__(self, sink: Appendable) -> None:
        self._sink = sink
        self._queue: deque[Future[None]] = deque()
        self._worker = ThreadPoolExecutor(1, thread_name_prefix="texvent-writer")

    def __enter__(self) -> Self:
        return self

    def append(self, *parts: Any) -> None:
        """Queue the next item; waits while the queue is full.

        Raises:
            Exception: raised by the sink for an earlier item.
        """
        while self._queue and (len(self._queue) >= DEPTH or self._queue[0].done()):
            self._queue.popleft().result()
        self._queue.append(self._worker.submit(self._sink.append, *parts))

    def __exit__(self, *raised: object) -> None:
        try:
            while raised[0] is None and self._queue:
                self._queue.popleft().result()
        finally:
            # A second Ctrl-C must not let the sink close while the thread is still inside it.
            with delay_interrupts():
                self._worker.shutdown(cancel_futures=True)
