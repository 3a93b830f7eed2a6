"""Writing behind: what is to be written waits in a short queue, a thread of its own writes it."""

from __future__ import annotations

from collections import deque
from concurrent.futures import Future, ThreadPoolExecutor
from types import TracebackType
from typing import Any, Protocol, Self

from texvent.runtime.interrupts import delay_interrupts

DEPTH = 8
"""Packets that may wait; they are held in memory."""


class Appendable(Protocol):
    """A writer of any kind."""

    def append(self, *parts: Any) -> None:
        """Take what comes next."""
        ...


class WriteBehind:
    """Hands everything that is appended to `sink`, in order, from another thread.

    To be used in a `with` block inside the sink's own: at the end of the block everything has
    reached the sink, unless the block ends with an exception, when what still waits is dropped and
    the sink is left to throw its file away. An error of the sink is raised by a later `append`, or
    at the latest at the end of the block. The sink must release the interpreter's lock while it
    works (compression, encoding) for this to gain anything.
    """

    def __init__(self, sink: Appendable) -> None:
        self._sink = sink
        self._waiting: deque[Future[None]] = deque()
        self._worker = ThreadPoolExecutor(1, thread_name_prefix="texvent-behind")

    def __enter__(self) -> Self:
        return self

    def append(self, *parts: Any) -> None:
        """Add what comes next; waits while `DEPTH` parts are still to be written.

        Raises:
            Exception: what an earlier `append` of the sink raised.
        """
        while self._waiting and (len(self._waiting) >= DEPTH or self._waiting[0].done()):
            self._waiting.popleft().result()
        self._waiting.append(self._worker.submit(self._sink.append, *parts))

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        try:
            while error is None and self._waiting:
                self._waiting.popleft().result()
        finally:
            # A second Ctrl-C must not let the sink close while the thread is still inside it.
            with delay_interrupts():
                self._worker.shutdown(cancel_futures=True)
