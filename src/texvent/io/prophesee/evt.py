"""What the three event formats in RAW files (.raw) share: the header that tells them apart.

A RAW file is a text header (`% format EVT3;height=720;width=1280`, …, `% end`) and words of the
format it names. Older recordings have only `% evt 3.0` and `% geometry 1280x720`, or no size.

All three split time into a word TIME_HIGH, sent when it changes, and low bits at each event.
OpenEB takes the first TIME_HIGH as the start and subtracts it from every time; a file of texvent
therefore begins with TIME_HIGH 0, and times stay exact. Reading does not shift time. Events
before the first TIME_HIGH have no time and are left out, as OpenEB does; triggers and other
words are skipped.

Source: Prophesee, "Data Encoding Formats" of the Metavision documentation.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator, Mapping
from contextlib import AbstractContextManager
from functools import partial
from pathlib import Path
from typing import ClassVar

from texvent.errors import FileFormatError, shown
from texvent.io.block_codec import BlockCodec, FileContents, read_records, write_records
from texvent.io.block_writer import FileTarget, WriteBlock
from texvent.io.prophesee.text_header import TextHeader, make_text_header, read_text_header
from texvent.io.prophesee.word_coding import WordDecoder, WordEncoder, WordKernels
from texvent.io.protocol import Columns

MAX_SIDE = 2048
"""Coordinates have 11 bits."""
INTEGRATOR = "Prophesee"
"""OpenEB chooses the plug-in that decodes a file by this name."""


class EvtCodec(BlockCodec):
    """Reads and writes RAW files of one event format; the subclasses say which."""

    extensions: ClassVar[tuple[str, ...]] = (".raw",)
    title: ClassVar[str]
    """The format as `% format` names it: `EVT3`."""
    version: ClassVar[str]
    """The format as `% evt` names it: `3.0`."""
    word_bytes: ClassVar[int]
    options: ClassVar[Mapping[str, str]] = {}
    """More of the `% format` line; each has a line of its own too, for readers that look there."""

    def recognises(self, path: Path) -> bool:
        """True if the header names this format."""
        try:
            return _format_name(_read_header(path)) == self.title
        except (OSError, FileFormatError):
            return False

    @abstractmethod
    def kernels(self) -> WordKernels:
        """The compiled loops; importing them brings Numba."""

    def make_decoder(self, header: TextHeader | None = None) -> WordDecoder:
        """A decoder for a file with this header; None: with the header that texvent writes."""
        del header
        return WordDecoder(self.kernels())

    def make_encoder(self) -> WordEncoder:
        """An encoder for one file."""
        return WordEncoder(self.kernels())

    def inspect(self, path: Path) -> FileContents:
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

    def start(self, target: FileTarget, part: Path) -> AbstractContextManager[WriteBlock]:
        """Write the header and the words before the first event."""
        size = target.size
        facts = {**self.options, "height": str(size.height), "width": str(size.width)}
        fields = {
            **self.options,
            "camera_integrator_name": INTEGRATOR,
            "evt": self.version,
            "format": ";".join([self.title, *(f"{key}={value}" for key, value in facts.items())]),
            "geometry": str(size),
            "integrator_name": INTEGRATOR,
            "plugin_integrator_name": INTEGRATOR,
        }
        encoder = self.make_encoder()
        header = make_text_header(fields, target.metadata, end=True)
        return write_records(part, header + encoder.start(), encoder.encode)

    def _read_blocks(self, path: Path, header: TextHeader) -> Iterator[Columns]:
        decoder = self.make_decoder(header)
        for words in read_records(path, header.length, self.word_bytes):
            yield decoder.decode(words)


def _read_header(path: Path) -> TextHeader:
    with path.open("rb") as file:
        return read_text_header(file, path)


def _format_name(header: TextHeader) -> str:
    """EVT2, EVT21, EVT3, another name, or nothing."""
    named = header.options()[0].upper()
    version = header.fields.get("evt", "")
    older = {"2.0": "EVT2", "2.1": "EVT21", "3.0": "EVT3"}
    return named or older.get(version, version)
