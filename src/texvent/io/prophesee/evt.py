"""RAW files (.raw) of EVT2, EVT2.1 and EVT3; their words are described in `evtN_coding.py`.

A RAW file is a text header (`% format EVT3;height=720;width=1280`, …, `% end`) and words of the
format it names. Older recordings have only `% evt 3.0` and `% geometry 1280x720`, or no size.

A part of zeros is damage: in EVT2 a zero is an event. Words of other types than the formats have,
and more than a few events without a time, are counted in a warning.

All three split time into a word TIME_HIGH, sent when it changes, and low bits at each event.
EVT3 alone is written. OpenEB takes the first TIME_HIGH as the start and subtracts it from every
time; a file of texvent therefore begins with TIME_HIGH 0, and times stay exact. Reading does not
shift time. Events before the first TIME_HIGH have no time and are left out, as OpenEB does;
other words are skipped.

External triggers are words too:

    EVT2    u32: 31..28 type 10 · 27..22 low time · 12..8 channel · 0 value
    EVT2.1  u64: the upper half is a word of EVT2, the lower half nothing
    EVT3    u16: 15..12 type 10 · 11..8 channel · 0 value; the time is that of the words before it

Source: Prophesee, "Data Encoding Formats" of the Metavision documentation.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import AbstractContextManager
from dataclasses import dataclass, replace
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Any, ClassVar, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, shown, warn
from texvent.events import COLUMN_TYPES
from texvent.io.block_codec import BlockCodec, BlockReader, FileContents, write_records
from texvent.io.block_writer import Columns, FileTarget, FormatLimits, SideData, WriteBlock
from texvent.io.byte_blocks import SECTOR_BYTES, read_records, zero_sectors
from texvent.io.prophesee.text_header import TextHeader, make_text_header, read_text_header
from texvent.io.reading import ReadOptions

TIME_LOW, TIME_HIGH, TRIGGER = 6, 8, 10
Words: TypeAlias = bytes | memoryview | NDArray[Any]
"""Whole words, as stored in the file."""
Fields: TypeAlias = NDArray[np.int64]


@dataclass(frozen=True)
class TriggerCoding:
    """Places of the fields in a word; a field is (lowest bit, number of bits)."""

    word: str
    kind: tuple[int, int]
    high: tuple[int, int]
    """High bits of the time, in a word TIME_HIGH."""
    low: tuple[int, int] | None
    """Low bits of the time, in the trigger; None: in a word TIME_LOW before it."""
    channel: tuple[int, int]
    value: tuple[int, int]

    @property
    def low_bits(self) -> int:
        """Number of low bits of the time."""
        return self.low[1] if self.low is not None else self.high[1]


EVT2 = TriggerCoding("<u4", (28, 4), (0, 28), (22, 6), (8, 5), (0, 1))
EVT21 = replace(EVT2, word="<u8")
"""Layout of words whose upper half comes first."""
EVT3 = TriggerCoding("<u2", (12, 4), (0, 12), None, (8, 4), (0, 1))


def read_triggers(blocks: Iterable[Words], coding: TriggerCoding) -> Iterator[Columns]:
    """Columns t (µs), channel and value of the triggers in consecutive blocks of words."""
    from texvent.io.prophesee.time_high import FIRST_STATE, count_turns  # brings Numba

    state, high, low = np.array(FIRST_STATE), -1, 0
    for block in blocks:
        words = np.frombuffer(block, coding.word)
        kinds = field_of(words, coding.kind)
        chosen = np.isin(kinds, (TIME_LOW, TIME_HIGH, TRIGGER))
        words, kinds = words[chosen], kinds[chosen]
        highs = np.where(kinds == TIME_HIGH, field_of(words, coding.high), -1)
        highs = _forward(highs, high)
        before = np.concatenate([[high], highs[:-1]])
        turn = np.zeros_like(highs)
        count_turns(highs, state, coding.high[1], turn)
        if coding.low is None:
            # A new high time means its first µs until its low bits follow.
            lows = np.where(kinds == TIME_LOW, field_of(words, coding.high), -1)
            lows = np.where((kinds == TIME_HIGH) & (highs != before), 0, lows)
            lows = _forward(lows, low)
        else:
            lows = field_of(words, coding.low)
        here = (kinds == TRIGGER) & (highs >= 0)
        time = (turn << coding.high[1] | highs) << coding.low_bits | lows
        yield {
            "t": time[here],
            "channel": field_of(words, coding.channel)[here],
            "value": field_of(words, coding.value)[here],
        }
        if len(words):
            high, low = int(highs[-1]), int(lows[-1])


def field_of(words: NDArray[np.unsignedinteger], place: tuple[int, int]) -> Fields:
    """A field of words by its place: lowest bit, number of bits."""
    shift, bits = place
    return (words >> words.dtype.type(shift)).astype(np.int64) & ((1 << bits) - 1)


def _forward(values: Fields, first: int) -> Fields:
    """Values whose −1 are replaced by the last that is none."""
    places = np.where(values >= 0, np.arange(1, len(values) + 1), 0)
    return np.concatenate([[first], values])[np.maximum.accumulate(places)]


WordKernels: TypeAlias = Any
"""Module of the compiled loops of a format: the NumPy type `WORD` of the numbers that its functions
take (a word of the file may be two), the first `DECODER_STATE`, `count_events`, `decode_words`."""


class WordDecoder:
    """Turns consecutive blocks of words into events."""

    def __init__(self, kernels: WordKernels) -> None:
        self._kernels = kernels
        self._state = np.array(kernels.DECODER_STATE, dtype=np.int64)
        self.count = self.left_out = 0
        """Events in all words so far, and those of them that have no time or row."""

    def decode(self, words: Words) -> Columns:
        """Columns x, y, t, p of the events in these words."""
        numbers = np.frombuffer(words, self._kernels.WORD)
        room = int(self._kernels.count_events(numbers))
        columns = {name: np.empty(room, dtype=COLUMN_TYPES[name]) for name in "xytp"}
        count = self._kernels.decode_words(numbers, self._state, tuple(columns.values()))
        self.count += room
        self.left_out += room - int(count)
        return {name: column[:count] for name, column in columns.items()}


SAMPLE = 16
"""Number of words, one of which is looked at for types that the format does not have."""
FEW_EVENTS, FEW_SHARE = 10, 0.01
"""Most recordings begin between two times: so many events are left out without a word."""
MAX_SIDE = 2048
"""Coordinates have 11 bits."""
INTEGRATOR = "Prophesee"
"""OpenEB chooses the plug-in that decodes a file by this name."""


class EvtReader(BlockReader):
    """Reads RAW files of one event format; the subclasses say which."""

    extensions: ClassVar[tuple[str, ...]] = (".raw",)
    title: ClassVar[str]
    """The format as `% format` names it: `EVT3`."""
    word_bytes: ClassVar[int]
    trigger_coding: ClassVar[TriggerCoding]
    """Places of the fields of a trigger."""
    coding: ClassVar[str]
    """Module of the compiled loops; importing it brings Numba."""
    has_zeros: ClassVar[bool] = True
    """Whether a word of zeros is no event."""
    unknown: ClassVar[tuple[int, ...]] = (2, 3, 4, 5, 6, 7, 9, 11, 12, 13)
    """Types of words that the format does not have."""

    def recognises(self, path: Path) -> bool:
        """True if the header names this format."""
        try:
            return _format_name(_read_header(path)) == self.title
        except (OSError, FileFormatError):
            return False

    def make_decoder(self) -> WordDecoder:
        """A decoder of words as `in_order` gives them."""
        return WordDecoder(import_module(f"texvent.io.prophesee.{self.coding}"))

    def inspect(self, path: Path, options: ReadOptions) -> FileContents:
        """The header states size and metadata."""
        header = _read_header(path)
        named = _format_name(header)
        if named != self.title:
            what = f"its header names {shown(named)}" if named else "its header names no format"
            raise FileFormatError(
                f"{path} is not {self.title}: {what}; texvent reads RAW files of EVT2, EVT21, EVT3"
            )
        if not header.has_end and path.stat().st_size == header.length:
            raise FileFormatError(f"{path} ends inside its header; the file was cut off")
        size, metadata = header.stored_size(path), header.metadata(path)
        return FileContents(size, metadata, partial(self._read_blocks, path, header))

    def side_data(self, path: Path) -> SideData:
        """External triggers."""
        return {"triggers": partial(self._read_triggers, path)}

    def beside(self, path: Path) -> Iterator[str]:
        """Triggers, without their times."""
        word, kind = self.trigger_coding.word, self.trigger_coding.kind
        blocks = self._read_words(path, _read_header(path))
        if any((field_of(np.frombuffer(one, word), kind) == TRIGGER).any() for one in blocks):
            yield "triggers"

    def _read_triggers(self, path: Path) -> Iterator[Columns]:
        header = _read_header(path)
        return read_triggers(self._read_words(path, header), self.trigger_coding)

    def _read_words(self, path: Path, header: TextHeader) -> Iterator[Words]:
        for words in read_records(path, header.length, self.word_bytes, has_zeros=self.has_zeros):
            yield self.in_order(header, words)

    def in_order(self, header: TextHeader, words: bytes) -> Words:
        """The words of a file with this header, as the decoder takes them."""
        del header
        return words

    def _read_blocks(self, path: Path, header: TextHeader) -> Iterator[Columns]:
        decoder = self.make_decoder()
        coding = self.trigger_coding
        zeros = unknown = 0
        for words in self._read_words(path, header):
            zeros += len(zero_sectors(bytes(words)))
            sample = np.frombuffer(words, coding.word)[::SAMPLE]
            unknown += int(np.isin(field_of(sample, coding.kind), self.unknown).sum())
            yield decoder.decode(words)
        if zeros:
            warn(
                f"{path} holds {zeros * SECTOR_BYTES:,} bytes of zeros instead of words; a part of "
                "it was lost"
            )
        if unknown:
            warn(
                f"{path} holds {unknown:,} words of types that {self.title} does not have, among "
                f"every {SAMPLE}th; it may be damaged"
            )
        if decoder.left_out > max(FEW_EVENTS, FEW_SHARE * decoder.count):
            warn(
                f"{path}: left out {decoder.left_out:,} of {decoder.count:,} events, before which "
                "there is no time or row"
            )


def _read_header(path: Path) -> TextHeader:
    with path.open("rb") as file:
        return read_text_header(file, path)


def _format_name(header: TextHeader) -> str:
    """EVT2, EVT21, EVT3, another name, or nothing."""
    named = header.options()[0].upper()
    version = header.fields.get("evt", "")
    older = {"2.0": "EVT2", "2.1": "EVT21", "3.0": "EVT3"}
    return named or older.get(version, version)


class Evt2Codec(EvtReader):
    """RAW files of EVT2."""

    name: ClassVar[str] = "evt2"
    title: ClassVar[str] = "EVT2"
    word_bytes: ClassVar[int] = 4
    has_zeros: ClassVar[bool] = False
    trigger_coding: ClassVar[TriggerCoding] = EVT2
    coding: ClassVar[str] = "evt2_coding"


LEGACY = "legacy"
FIRST_LITTLE_SYSTEM = 0x37


class Evt21Codec(EvtReader):
    """RAW files of EVT2.1."""

    name: ClassVar[str] = "evt21"
    title: ClassVar[str] = "EVT21"
    word_bytes: ClassVar[int] = 8
    trigger_coding: ClassVar[TriggerCoding] = EVT21
    coding: ClassVar[str] = "evt21_coding"

    def in_order(self, header: TextHeader, words: bytes) -> Words:
        """Words whose upper half comes first: halves are exchanged where the lower one does."""
        numbers = np.frombuffer(words, "<u8")
        return words if is_legacy(header) else numbers << 32 | numbers >> 32


def is_legacy(header: TextHeader) -> bool:
    """True if the header says, or its camera implies, that the upper half of a word comes first."""
    stated = header.options()[1].get("endianness", header.fields.get("endianness"))
    if stated is not None:
        return stated == LEGACY
    system = header.fields.get("system_ID", "")
    maker = header.fields.get("plugin_integrator_name", header.fields.get("integrator_name"))
    known = system.isdecimal() and len(system) < 9
    return known and maker in (None, INTEGRATOR) and 0 < int(system) < FIRST_LITTLE_SYSTEM


class Evt3Codec(EvtReader, BlockCodec):
    """RAW files of EVT3."""

    name: ClassVar[str] = "evt3"
    title: ClassVar[str] = "EVT3"
    word_bytes: ClassVar[int] = 2
    unknown: ClassVar[tuple[int, ...]] = (9, 11, 12, 13)
    trigger_coding: ClassVar[TriggerCoding] = EVT3
    coding: ClassVar[str] = "evt3_coding"
    limits: ClassVar[FormatLimits] = FormatLimits("EVT3", MAX_SIDE, 1 << 42)

    def start(self, target: FileTarget, part: Path) -> AbstractContextManager[WriteBlock]:
        """Write the header and the words before the first event."""
        size = target.size
        fields = {
            "camera_integrator_name": INTEGRATOR,
            "evt": "3.0",
            "format": f"{self.title};height={size.height};width={size.width}",
            "geometry": str(size),
            "integrator_name": INTEGRATOR,
            "plugin_integrator_name": INTEGRATOR,
        }
        encoder = Evt3Encoder()
        header = make_text_header(fields, target.metadata, end=True)
        return write_records(part, header + encoder.start(), encoder.encode)


class Evt3Encoder:
    """Turns consecutive blocks of events into words."""

    def __init__(self) -> None:
        from texvent.io.prophesee import evt3_coding  # brings Numba

        self._coding = evt3_coding
        self._state = np.array(evt3_coding.ENCODER_STATE, dtype=np.int64)

    def start(self) -> bytes:
        """Words before the first event."""
        return np.array(self._coding.START, dtype=self._coding.WORD).tobytes()

    def encode(self, columns: Columns) -> memoryview:
        """Words of the events in columns x, y, t, p."""
        room = self._coding.count_words(columns["t"], self._state)
        words = np.empty(room, dtype=self._coding.WORD)
        ordered = tuple(columns[name] for name in "xytp")
        count = self._coding.encode_events(ordered, self._state, words)
        return words[:count].data.cast("B")
