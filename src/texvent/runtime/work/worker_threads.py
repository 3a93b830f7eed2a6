"""Worker threads of a run: one makes items ahead of it (prefetch), one writes behind it."""

from __future__ import annotations

from collections import deque
from collections.abc import Generator, Iterable
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Any, Protocol, Self, TypeVar

from texvent.runtime.work.interrupts import delay_interrupts

Item = TypeVar("Item")

_END: Any = object()


def prefetch(items: Iterable[Item], *, depth: int) -> Generator[Item, None, None]:
    """The same items in the same order, made in another thread from now on.

    It saves time where making an item releases the interpreter lock: decoding, optical flow, NumPy
    on large arrays, compiled kernels. Closing the result (also by an exception in the loop over it,
    Ctrl-C included) waits for the current item, makes no more and closes `items`.

    Args:
        items: where the items come from; read by one thread at a time.
        depth: how many items are made ahead, at least 1; they are held in memory.

    Yields:
        Every item. An exception of `items` is raised in its place, after the items before it.
    """
    ahead = _prefetch(items, depth)
    next(ahead)  # from here on closing it ends the thread
    return ahead


def _prefetch(items: Iterable[Item], depth: int) -> Generator[Item, None, None]:
    source = iter(items)
    pending: deque[Future[Item]] = deque()
    # One worker, so items keep their order.
    worker = ThreadPoolExecutor(1, thread_name_prefix="texvent-prefetch")
    try:
        pending.extend(worker.submit(next, source, _END) for _ in range(depth))
        yield _END
        while (item := pending.popleft().result()) is not _END:
            pending.append(worker.submit(next, source, _END))
            yield item
    finally:
        worker.shutdown(cancel_futures=True)
        close = getattr(source, "close", None)
        if close is not None:
            close()


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
