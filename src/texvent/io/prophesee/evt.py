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

from collections.abc import Mapping
from pathlib import Path
from typing import Any, ClassVar

from texvent.errors import FileFormatError
from texvent.event_packets import EventPackets
from texvent.io.columns import existing_file, stored_or_given_size
from texvent.io.limits import FormatLimits
from texvent.io.prophesee.text_header import TextHeader, make_text_header, read_text_header
from texvent.io.prophesee.word_coding import KernelDecoder, KernelEncoder, WordPackets, WordWriter
from texvent.sensor import SensorSize

MAX_SIDE = 2048
"""Coordinates have 11 bits."""
INTEGRATOR = "Prophesee"
"""OpenEB chooses the plug-in that decodes a file by this name."""


class EvtCodec:
    """Reads and writes RAW files of one event format; the subclasses say which."""

    name: ClassVar[str]
    extensions: ClassVar[tuple[str, ...]] = (".raw",)
    title: ClassVar[str]
    """The format as `% format` names it: `EVT3`."""
    version: ClassVar[str]
    """The format as `% evt` names it: `3.0`."""
    word: ClassVar[str]
    """NumPy type of one word."""
    kernels: ClassVar[str]
    limits: ClassVar[FormatLimits]
    options: ClassVar[Mapping[str, str]] = {}
    """More of the `% format` line; each has a line of its own too, for readers that look there."""

    def recognises(self, path: Path) -> bool:
        """True if the header names this format."""
        try:
            return _format_name(_read_header(path)) == self.title
        except (OSError, FileFormatError):
            return False

    def read(self, path: Path, *, size: SensorSize | None = None) -> EventPackets:
        """Events of a file, block by block.

        Raises:
            InputError: no such file, or it stores no sensor size and none is given.
            FileFormatError: the file is damaged or of another format.
        """
        path = existing_file(path)
        header = _read_header(path)
        named = _format_name(header)
        if named != self.title:
            what = f"its header names {named!r}" if named else "its header names no format"
            raise FileFormatError(
                f"{path} is not {self.title}: {what}; texvent reads RAW files of EVT2, EVT21, EVT3"
            )
        if not header.has_end and path.stat().st_size == header.length:
            raise FileFormatError(f"{path} ends inside its header; the file was cut off")
        metadata = header.metadata(path)
        final_size = stored_or_given_size(path, header.stored_size(path), size)
        packets = WordPackets(
            path,
            start=header.length,
            decoder=lambda: self.make_decoder(header),
            size=final_size,
            metadata=metadata,
        )
        return EventPackets(packets, final_size, metadata)

    def open_writer(
        self, path: Path, *, size: SensorSize, metadata: Mapping[str, Any], overwrite: bool
    ) -> WordWriter:
        """Start a file; see `EventCodec.open_writer`."""
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
        return WordWriter(
            path,
            header=make_text_header(fields, metadata, end=True),
            encoder=lambda: KernelEncoder(self.kernels),
            limits=self.limits,
            size=size,
            overwrite=overwrite,
        )

    def make_decoder(self, header: TextHeader) -> KernelDecoder:
        """The decoder for a file with this header."""
        return KernelDecoder(self.kernels, self.word)


def _read_header(path: Path) -> TextHeader:
    with path.open("rb") as file:
        return read_text_header(file, path)


def _format_name(header: TextHeader) -> str:
    """EVT2, EVT21, EVT3, another name, or nothing."""
    named = header.options()[0].upper()
    version = header.fields.get("evt", "")
    older = {"2.0": "EVT2", "2.1": "EVT21", "3.0": "EVT3"}
    return named or older.get(version, version)
