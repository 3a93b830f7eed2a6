"""Pool of arrays: memory is used again once nothing refers to it, since fresh pages cost time."""

from __future__ import annotations

import math
import weakref
from collections import deque
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import DTypeLike, NDArray

MOST = 5
"""Pieces of memory of a size that are kept; more are made as long as more are held."""
_Kept: TypeAlias = tuple[NDArray[np.uint8], "weakref.ref[Any]"]
"""Memory, and the array that shows it."""


class ArrayPool:
    """Memory of arrays by size; a pickled copy has none.

    Example:
        >>> from texvent.runtime.array_pool import ArrayPool
        >>> pool = ArrayPool()
        >>> first = pool.take((2, 3), "f4")
        >>> row = first[0]
        >>> del first
        >>> pool.take((2, 3), "f4").ctypes.data == row.ctypes.data  # the row is still held
        False
    """

    def __init__(self) -> None:
        """An empty pool."""
        self._kept: dict[int, deque[_Kept]] = {}

    def __reduce__(self) -> tuple[type[ArrayPool], tuple[()]]:
        """An empty pool."""
        return ArrayPool, ()

    def take(self, shape: tuple[int, ...], dtype: DTypeLike) -> NDArray[Any]:
        """An array of any content.

        Its memory is not used again while an array or a tensor shows any part of it.
        """
        size = math.prod(shape) * np.dtype(dtype).itemsize
        if not size:
            return np.empty(shape, dtype)
        kept = self._kept.setdefault(size, deque(maxlen=MOST))
        memory = _take_free(kept)
        if memory is None:
            memory = np.empty(size, np.uint8)
        # Views of an array that shows a buffer hold that array, not what it shows.
        array = np.frombuffer(memory.data, dtype)
        kept.append((memory, weakref.ref(array)))
        return array.reshape(shape)


def _take_free(kept: deque[_Kept]) -> NDArray[np.uint8] | None:
    """Memory that no array shows; what a thread looks at, no other one sees."""
    for _ in range(len(kept)):
        try:
            memory, array = kept.popleft()
        except IndexError:  # another thread took the last one
            break
        if array() is None:
            return memory
        kept.append((memory, array))
    return None
