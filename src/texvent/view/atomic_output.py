"""Outputs that are complete when their `with` block ends without error, else absent."""

from __future__ import annotations

from abc import ABC, abstractmethod
from contextlib import ExitStack
from types import TracebackType
from typing import Self


class AtomicOutput(ABC):
    """Opens its files in the `with` statement and completes them at the end of the block."""

    def __init__(self) -> None:
        self._stack = ExitStack()

    @abstractmethod
    def _open(self, stack: ExitStack) -> None:
        """Enter the contexts of the files, such as `atomic_file`."""

    @abstractmethod
    def _complete(self) -> None:
        """Write what is left; the block ended without error."""

    def __enter__(self) -> Self:
        with ExitStack() as stack:
            self._open(stack)
            self._stack = stack.pop_all()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if error is not None:
            self._stack.__exit__(kind, error, trace)
            return
        with self._stack:
            self._complete()
