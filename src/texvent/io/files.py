"""Open, load and save event files; the format follows from the extension unless given."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from texvent._registry import CODECS
from texvent.errors import ConfigError
from texvent.events import EventPackets, EventStream
from texvent.io.protocol import EventCodec, EventWriter
from texvent.sensor import SensorSize, checked_size


def codec_for(path: str | Path, format: str | None = None) -> EventCodec:
    """The codec called `format`, or the one that the path's extension belongs to.

    Raises:
        ConfigError: unknown format, or unknown extension; the message lists the known ones.
    """
    if format is not None:
        codec: EventCodec = CODECS.load(format)()
        return codec
    extension = Path(path).suffix.lower()
    known: list[str] = []
    for name in CODECS.names():
        codec = CODECS.load(name)()
        if extension in codec.extensions:
            return codec
        known += [f"{one} ({name})" for one in codec.extensions]
    what = f"extension {extension!r}" if extension else "no extension"
    raise ConfigError(
        f"{path} has {what}; event files end in {', '.join(known)}, or state the format"
    )


def open_events(
    path: str | Path, *, format: str | None = None, size: tuple[int, int] | None = None
) -> EventPackets:
    """Events of a file, packet by packet, with flat memory (npz excepted).

    Args:
        path: the file.
        format: name of a codec; default: from the extension.
        size: (width, height), pixels, for files that do not store it.

    Raises:
        InputError: no such file, or the size is neither stored nor given.
        FileFormatError: the file is damaged or of another format.
        ConfigError: unknown format or extension.
    """
    given = None if size is None else checked_size(*size)
    return codec_for(path, format).read(Path(path), size=given)


def load(
    path: str | Path, *, format: str | None = None, size: tuple[int, int] | None = None
) -> EventStream:
    """All events of a file, in memory; arguments and errors as in `open_events`."""
    return open_events(path, format=format, size=size).collect()


def open_writer(
    path: str | Path,
    *,
    size: SensorSize,
    metadata: Mapping[str, Any] | None = None,
    format: str | None = None,
    overwrite: bool = False,
) -> EventWriter:
    """A writer to use in a `with` block; the file appears when the block ends without error.

    Args:
        path: the file.
        size: sensor size, pixels.
        metadata: how the events are made (JSON-serialisable), stored with them.
        format: name of a codec; default: from the extension.
        overwrite: whether an existing file may be replaced.

    Raises:
        OutputError: it exists already, or its folder cannot be written.
        ConfigError: unknown format or extension.
    """
    codec = codec_for(path, format)
    return codec.open_writer(Path(path), size=size, metadata=metadata or {}, overwrite=overwrite)


def save(
    path: str | Path,
    events: EventStream | EventPackets,
    *,
    format: str | None = None,
    overwrite: bool = False,
) -> Path:
    """Write events, whole or packet by packet, with their metadata.

    Returns:
        The path written.

    Raises:
        OutputError: it exists already, its folder cannot be written, or the disk is full.
        ConfigError: unknown format or extension.
    """
    packets: Iterable[EventStream] = (events,) if isinstance(events, EventStream) else events
    writer = open_writer(
        path, size=events.size, metadata=events.metadata, format=format, overwrite=overwrite
    )
    with writer:
        for packet in packets:
            writer.append(packet)
    return Path(path)
