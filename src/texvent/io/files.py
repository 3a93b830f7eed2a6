"""Open, load and save event files; the format follows from extension and content unless given."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from texvent._registry import CODECS
from texvent.errors import ConfigError, InputError, shown
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.io.input_checks import refuse_other_kind
from texvent.io.protocol import EventCodec, EventReader, EventWriter, RecognisingCodec
from texvent.runtime.background_writer import BackgroundWriter
from texvent.runtime.file_names import usable_path
from texvent.sensor import SensorSize, SizeLike, as_size


def codec_for(path: str | Path, format: str | None = None) -> EventCodec:
    """The codec that writes `path`: the one called `format`, or the first of its extension.

    Raises:
        ConfigError: unknown format, unknown extension, a format that is only read, or an extension
            of other formats than the one given, by which the file could not be read.
        InputError: it is no path.
    """
    path = usable_path(path)
    candidates = _codecs_for(path, format)
    codec = next((one for one in candidates if isinstance(one, EventCodec)), None)
    if codec is None:
        raise ConfigError(
            f"cannot write {path}: {candidates[0].name} files are only read; write hdf5 (.h5), "
            "npz (.npz), evt3 (.raw), aedat4 (.aedat4) or ecd (.txt)"
        )
    extension = path.suffix.lower()
    own = _extensions_of(type(codec))
    if extension in event_extensions() and extension not in own:
        raise ConfigError(
            f"{path} is named as another format: {extension} files are not read as {codec.name}; "
            f"name it {path.with_suffix(own[0]).name}, or give another --format"
        )
    return codec


def writable_formats() -> list[str]:
    """Names of the formats that are written, in the order of the registry."""
    return [name for name in CODECS.names() if hasattr(CODECS.load(name), "open_writer")]


def codec_that_reads(path: str | Path, format: str | None = None) -> EventReader:
    """The codec that reads `path`: called `format`, or of its extension.

    Where formats share an extension, the content decides: the first codec that recognises the
    file, else the first of those that take any file of that extension.

    Raises:
        ConfigError: unknown format, or unknown extension; the message lists the known ones.
        InputError: a folder whose files no codec recognises, or a file of another kind.
    """
    usable_path(path)
    if format is None and Path(path).is_dir():
        found = find_folder_codec(Path(path))
        if found is None:
            raise InputError(
                f"{path} is a folder, and not one of event files that texvent knows (esim, "
                "evreal); give the name of a file in it"
            )
        return found
    if format is None and Path(path).suffix.lower() not in event_extensions():
        refuse_other_kind(Path(path))
    codecs = _codecs_for(path, format)
    if len(codecs) == 1:
        return codecs[0]
    others = []
    for codec in codecs:
        if not isinstance(codec, RecognisingCodec):
            others.append(codec)
        elif codec.recognises(Path(path)):
            return codec
    return (others or codecs)[0]


def has_checksums(path: str | Path, format: str | None = None) -> bool:
    """Whether the format of a file notices events that were changed by damage.

    Raises:
        ConfigError, InputError: as `codec_that_reads`.
    """
    return bool(getattr(codec_that_reads(path, format), "has_checksums", False))


def find_folder_codec(path: Path) -> EventReader | None:
    """The codec of formats made of several files that recognises those in a folder, or None."""
    codecs: list[EventReader] = [codec() for codec in CODECS.load_all()]
    for codec in codecs:
        if not codec.extensions and isinstance(codec, RecognisingCodec) and codec.recognises(path):
            return codec
    return None


def extension_of(format: str) -> str:
    """The usual extension of a format: its own, else that of the format it is a variant of.

    Example:
        >>> extension_of("evt3"), extension_of("dsec")
        ('.raw', '.h5')
    """
    return next(iter(_extensions_of(CODECS.load(format))), "")


def _extensions_of(codec: type) -> tuple[str, ...]:
    """Extensions of a format: its own, else those of the format it is a variant of."""
    found = (getattr(kind, "extensions", ()) for kind in codec.__mro__)
    return next((tuple(one) for one in found if one), ())


def event_extensions() -> set[str]:
    """Extensions of all event formats, in lower case with the dot."""
    return {extension for name in CODECS.names() for extension in CODECS.load(name).extensions}


def _codecs_for(path: str | Path, format: str | None) -> list[EventReader]:
    """The codec called `format` alone, or all that share the path's extension, at least one."""
    if format is not None:
        return [CODECS.load(format)()]
    extension = Path(path).suffix.lower()
    codecs: list[EventReader] = [codec() for codec in CODECS.load_all()]
    found = [codec for codec in codecs if extension in codec.extensions]
    if found:
        return found
    known = dict.fromkeys(one for codec in codecs for one in codec.extensions)
    what = f"extension {shown(extension)}" if extension else "no extension"
    raise ConfigError(
        f"{path} has {what}; event files end in {', '.join(known)}; or state the format "
        "(docs/files.md lists them)"
    )


def open_events(
    path: str | Path, *, format: str | None = None, size: SizeLike | None = None
) -> EventPackets:
    """Events of a file, packet by packet, with flat memory (npz excepted).

    Args:
        path: the file.
        format: name of a codec; default: from the extension.
        size: for files that do not store it: (width, height), "346x260" or "davis346".

    Raises:
        InputError: no such file, or the size is neither stored nor given.
        FileFormatError: the file is damaged or of another format.
        ConfigError: unknown format or extension.
    """
    given = None if size is None else as_size(size)
    return codec_that_reads(path, format).read(Path(path), size=given)


def load(
    path: str | Path, *, format: str | None = None, size: SizeLike | None = None
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
    writer = open_writer(
        path, size=events.size, metadata=events.metadata, format=format, overwrite=overwrite
    )
    if isinstance(events, EventStream):
        with writer:
            writer.append(events)
    else:
        with writer, BackgroundWriter(writer) as behind:
            for packet in events:
                behind.append(packet)
    return Path(path)
