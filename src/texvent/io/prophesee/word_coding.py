"""Files that are a header followed by words of fixed length: what EVT2, EVT2.1, EVT3, DAT share.

Both directions are streams: a block of words or a packet of events at a time.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack
from pathlib import Path
from types import TracebackType
from typing import Any, Protocol, Self, cast

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, InputError, OutputError
from texvent.events import COLUMN_TYPES, EventStream
from texvent.io.atomic import atomic_file, check_output
from texvent.io.columns import stream_from_file
from texvent.io.limits import FormatLimits
from texvent.sensor import SensorSize

BLOCK_BYTES = 2**21
"""Data decoded at once: a multiple of every word length. In EVT3 about 500,000 events."""
PIECE_EVENTS = 2**18
"""Events encoded at once."""

Columns = dict[str, NDArray[Any]]


class PacketDecoder(Protocol):
    """Turns consecutive blocks of words into events; it remembers the state between them."""

    word: np.dtype[Any]
    """Type of one word, little-endian."""

    def decode(self, words: NDArray[Any]) -> Columns:
        """Columns x, y, t, p of the events in these words."""
        ...


class PacketEncoder(Protocol):
    """Turns consecutive packets into words; it remembers the state between them."""

    def start(self) -> bytes:
        """What precedes the first event."""
        ...

    def encode(self, columns: Columns) -> bytes | memoryview:
        """Words of the events in columns x, y, t, p."""
        ...


class WordKernels(Protocol):
    """What a module of `texvent.io.kernels` offers for a format whose words have a state."""

    START: tuple[int, ...]
    """Words before the first event."""
    WORD: str
    """NumPy type of the numbers the functions take; a word of the file may be two of them."""
    DECODER_STATE: tuple[int, ...]
    """State before the first word is read."""
    ENCODER_STATE: tuple[int, ...]
    """State after the words `START` were written."""

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


class KernelDecoder:
    """A decoder made of compiled loops.

    Args:
        kernels: name of a module that offers `WordKernels`, imported here, not before.
        word: type of one word of the file.
    """

    def __init__(self, kernels: str, word: str) -> None:
        self._kernels: WordKernels = _load_kernels(kernels)
        self.word = np.dtype(word)
        self._state = np.array(self._kernels.DECODER_STATE, dtype=np.int64)

    def decode(self, words: NDArray[Any]) -> Columns:
        """Columns x, y, t, p of the events in these words."""
        words = words.view(self._kernels.WORD)
        count = self._kernels.count_events(words)
        columns = {name: np.empty(count, dtype=COLUMN_TYPES[name]) for name in "xytp"}
        count = self._kernels.decode_words(words, self._state, tuple(columns.values()))
        return {name: column[:count] for name, column in columns.items()}


class KernelEncoder:
    """An encoder made of compiled loops; see `KernelDecoder`."""

    def __init__(self, kernels: str) -> None:
        self._kernels: WordKernels = _load_kernels(kernels)
        self._state = np.array(self._kernels.ENCODER_STATE, dtype=np.int64)

    def start(self) -> bytes:
        """What precedes the first event."""
        return np.array(self._kernels.START, dtype=self._kernels.WORD).tobytes()

    def encode(self, columns: Columns) -> memoryview:
        """Words of the events in columns x, y, t, p."""
        room = self._kernels.count_words(columns["t"], self._state)
        words = np.empty(room, dtype=self._kernels.WORD)
        ordered = tuple(columns[name] for name in "xytp")
        count = self._kernels.encode_events(ordered, self._state, words)
        return words[:count].data.cast("B")


class WordWriter:
    """Appends packets as words; memory does not grow with the recording.

    Args:
        path: the file.
        header: bytes before the first word.
        encoder: makes an encoder when the file is started.
        limits: what the format holds.
        size: sensor size, pixels.
        overwrite: whether an existing file may be replaced.

    Raises:
        OutputError: the file exists already, its folder refuses it, or the disk is full.
        InputError: the format cannot hold the sensor or an event; a packet of another size, or
            before the one before it.
    """

    def __init__(
        self,
        path: Path,
        *,
        header: bytes,
        encoder: Callable[[], PacketEncoder],
        limits: FormatLimits,
        size: SensorSize,
        overwrite: bool,
    ) -> None:
        check_output(path, overwrite=overwrite)
        limits.check_size(path, size)
        self._path = path
        self._header = header
        self._make_encoder = encoder
        self._limits = limits
        self._size = size
        self._overwrite = overwrite
        self._stack = ExitStack()
        self._encoder: PacketEncoder | None = None
        self._file: Any = None
        self._last_us = 0

    def __enter__(self) -> Self:
        with ExitStack() as stack:
            part = stack.enter_context(atomic_file(self._path, overwrite=self._overwrite))
            self._file = stack.enter_context(part.open("wb"))
            self._encoder = self._make_encoder()
            self._file.write(self._header + self._encoder.start())
            self._stack = stack.pop_all()
        return self

    def append(self, packet: EventStream) -> None:
        """Add the events of a packet, which starts no earlier than the one before it ended."""
        if self._encoder is None:
            raise OutputError(f"{self._path} is not open; append inside the writer's with block")
        if packet.size != self._size:
            raise InputError(f"the packet is {packet.size}, the file is {self._size}")
        if len(packet) == 0:
            return
        self._limits.check_packet(self._path, packet)
        if int(packet.t[0]) < self._last_us:
            raise InputError(
                f"a packet starts at {int(packet.t[0])} µs, before the one before it ends "
                f"({self._last_us} µs); append packets in time order"
            )
        self._last_us = int(packet.t[-1])
        # In pieces, so that a whole recording in one packet needs no second copy of itself.
        for start in range(0, len(packet), PIECE_EVENTS):
            piece = slice(start, start + PIECE_EVENTS)
            columns = {name: column[piece] for name, column in packet.columns().items()}
            self._file.write(self._encoder.encode(columns))

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._stack.__exit__(kind, error, trace)


class WordPackets:
    """Re-iterable packets of a file of words.

    Args:
        path: the file.
        start: bytes before the first word.
        decoder: makes a decoder, for each pass over the file.
        size: sensor size, pixels.
        metadata: of every packet.
    """

    def __init__(
        self,
        path: Path,
        *,
        start: int,
        decoder: Callable[[], PacketDecoder],
        size: SensorSize,
        metadata: Mapping[str, Any],
    ) -> None:
        self._path = path
        self._start = start
        self._make_decoder = decoder
        self._size = size
        self._metadata = metadata

    def __iter__(self) -> Iterator[EventStream]:
        decoder = self._make_decoder()
        last_us: int | None = None
        with self._path.open("rb") as file:
            file.seek(self._start)
            while block := file.read(BLOCK_BYTES):
                if len(block) % decoder.word.itemsize:
                    raise FileFormatError(
                        f"{self._path} ends inside a word of {decoder.word.itemsize} bytes; "
                        "the file was cut off"
                    )
                columns = decoder.decode(np.frombuffer(block, dtype=decoder.word))
                if len(columns["t"]) == 0:
                    continue
                packet = stream_from_file(self._path, columns, self._size, self._metadata)
                if last_us is not None and int(packet.t[0]) < last_us:
                    raise FileFormatError(
                        f"{self._path}: time decreases from {last_us} to {int(packet.t[0])} µs"
                    )
                last_us = int(packet.t[-1])
                yield packet


def _load_kernels(module: str) -> WordKernels:
    # A module satisfies the protocol by its functions.
    return cast("WordKernels", importlib.import_module(module))
