"""Prefetch: make the next items in a thread while earlier ones are used."""

from __future__ import annotations

from collections import deque
from collections.abc import Generator, Iterable
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Any, TypeVar

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
