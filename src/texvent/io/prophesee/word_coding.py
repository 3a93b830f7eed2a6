"""Words of fixed length ↔ events by compiled loops: what EVT2, EVT2.1 and EVT3 share.

Both directions are streams: the state goes on from one block to the next.
"""

from __future__ import annotations

from typing import Any, Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.events import COLUMN_TYPES
from texvent.io.protocol import Columns

Words: TypeAlias = bytes | memoryview | NDArray[Any]
"""Whole words, as they lie in the file."""


class WordKernels(Protocol):
    """What the module of compiled loops of a format offers."""

    @property
    def START(self) -> tuple[int, ...]:  # noqa: N802  # modules name constants in capitals
        """Words before the first event."""
        ...

    @property
    def WORD(self) -> str:  # noqa: N802
        """NumPy type of the numbers the functions take; a word of the file may be two of them."""
        ...

    @property
    def DECODER_STATE(self) -> tuple[int, ...]:  # noqa: N802
        """State before the first word is read."""
        ...

    @property
    def ENCODER_STATE(self) -> tuple[int, ...]:  # noqa: N802
        """State after the words `START` were written."""
        ...

    def count_events(self, words: NDArray[Any]) -> int:
        """At least as many as the words hold."""
        ...

    def decode_words(
        self, words: NDArray[Any], state: NDArray[np.int64], columns: tuple[NDArray[Any], ...]
    ) -> int:
        """Fill columns x, y, t, p and update the state; returns the number of events."""
        ...

    def count_words(self, times: NDArray[np.int64], state: NDArray[np.int64]) -> int:
        """At least as many as the events at these times need."""
        ...

    def encode_events(
        self, columns: tuple[NDArray[Any], ...], state: NDArray[np.int64], words: NDArray[Any]
    ) -> int:
        """Fill words from columns x, y, t, p and update the state; returns their number."""
        ...


class WordDecoder:
    """Turns consecutive blocks of words into events."""

    def __init__(self, kernels: WordKernels) -> None:
        self._kernels = kernels
        self._state = np.array(kernels.DECODER_STATE, dtype=np.int64)

    def decode(self, words: Words) -> Columns:
        """Columns x, y, t, p of the events in these words."""
        numbers = np.frombuffer(words, self._kernels.WORD)
        count = self._kernels.count_events(numbers)
        columns = {name: np.empty(count, dtype=COLUMN_TYPES[name]) for name in "xytp"}
        count = self._kernels.decode_words(numbers, self._state, tuple(columns.values()))
        return {name: column[:count] for name, column in columns.items()}


class WordEncoder:
    """Turns consecutive blocks of events into words."""

    def __init__(self, kernels: WordKernels) -> None:
        self._kernels = kernels
        self._state = np.array(kernels.ENCODER_STATE, dtype=np.int64)

    def start(self) -> bytes:
        """Words before the first event."""
        return np.array(self._kernels.START, dtype=self._kernels.WORD).tobytes()

    def encode(self, columns: Columns) -> memoryview:
        """Words of the events in columns x, y, t, p."""
        room = self._kernels.count_words(columns["t"], self._state)
        words = np.empty(room, dtype=self._kernels.WORD)
        ordered = tuple(columns[name] for name in "xytp")
        count = self._kernels.encode_events(ordered, self._state, words)
        return words[:count].data.cast("B")
