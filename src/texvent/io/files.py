"""Open, load and save event files; the format follows from extension and content unless given."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from texvent._registry import CODECS, suggest
from texvent.errors import ConfigError, FileFormatError, InputError, shown
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.io.block_codec import BlockCodec, BlockReader
from texvent.io.block_writer import BlockWriter, SideData
from texvent.io.compressed import beginning_of_text
from texvent.io.input_checks import NotReadError, existing_file, refuse_other_kind
from texvent.io.reading import read_options
from texvent.runtime.files.file_names import usable_path
from texvent.runtime.work.worker_threads import BackgroundWriter
from texvent.sensor import SensorSize, SizeLike

FIRST_LINES = 8
"""Lines of a text among which its first row is."""


def codec_for(path: str | Path, format: str | None = None) -> BlockCodec:
    """The codec that writes `path`: the one called `format`, or the first of its extension.

    Raises:
        ConfigError: unknown format, unknown extension, a format that is only read, or an extension
            of other formats than the one given, by which the file could not be read.
        InputError: it is no path.
    """
    path = usable_path(path)
    extension = path.suffix.lower()
    candidates = _codecs_for(path, format, is_written=True)
    codec = next((one for one in candidates if isinstance(one, BlockCodec)), None)
    if codec is None or extension in codec.only_read:
        name = candidates[0].name if codec is None else extension
        raise ConfigError(
            f"cannot write {path}: {name} files are only read; write hdf5 (.h5), npz (.npz), "
            "evt3 (.raw), aedat4 (.aedat4) or ecd (.txt)"
        )
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


def codec_that_reads(path: str | Path, format: str | None = None) -> BlockReader:
    """The codec that reads `path`: called `format`, or the one that recognises its content.

    Those of its extension are asked first, then all others. Formats without a mark of their own
    (text, ATIS .bin) follow from the extension; any other text is taken for rows of events.

    Raises:
        ConfigError: unknown format, or neither extension nor content is that of an event file.
        InputError: a folder whose files no codec recognises, or a file of another kind.
    """
    path = usable_path(path)
    if format is not None:
        return _codecs_for(path, format)[0]
    if path.is_dir():
        found = find_folder_codec(path)
        if found is None:
            raise InputError(
                f"{path} is a folder, and not one of event files that texvent knows (esim, "
                "evreal, rosbag2); give the name of a file in it"
            )
        return found
    existing_file(path)
    extension = path.suffix.lower()
    codecs: list[BlockReader] = [codec() for codec in CODECS.load_all()]
    own = [codec for codec in codecs if extension in codec.extensions]
    for codec in own + codecs:
        if codec.recognises(path):
            return codec
    start = beginning_of_text(path)
    if own:
        unmarked = [codec for codec in own if codec.recognises(path) is None]
        return (unmarked or own)[0]
    refuse_other_kind(path)
    if has_rows(start):
        is_csv = ".csv" in path.suffixes
        return _codecs_for(path, "csv" if is_csv else "ecd")[0]
    return _codecs_for(path, None)[0]


def has_rows(start: bytes) -> bool:
    """True if the first lines of a text hold a row of four numbers."""
    lines = start.decode("latin-1").splitlines()[:FIRST_LINES]
    return any(len(re.findall(r"(?:^|[\s,;])[-+]?\d[\d.eE+-]*", line)) >= 3 for line in lines)


def is_event_path(path: Path) -> bool:
    """True if a file or folder is read as events: by its content, else by its extension."""
    if path.is_dir():
        return find_folder_codec(path) is not None
    if not path.is_file():
        return path.suffix.lower() in event_extensions()
    try:
        codec = codec_that_reads(path)
    except (NotReadError, FileFormatError):
        return True
    except InputError:
        return False
    is_npy = path.suffix.lower() == ".npy"  # most arrays are frames
    return not is_npy or bool(codec.recognises(path))


def side_data(path: str | Path, format: str | None = None) -> SideData:
    """Triggers and IMU samples beside the events of a file.

    Raises:
        ConfigError, InputError: as `codec_that_reads`.
    """
    return codec_that_reads(path, format).side_data(Path(path))


def find_folder_codec(path: Path) -> BlockReader | None:
    """The codec of formats made of several files that recognises those in a folder, or None."""
    codecs: list[BlockReader] = [codec() for codec in CODECS.load_all()]
    for codec in codecs:
        if not codec.extensions and codec.recognises(path):
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


def _codecs_for(
    path: str | Path, format: str | None, *, is_written: bool = False
) -> list[BlockReader]:
    """The codec called `format` alone, or all that share the path's extension, at least one.

    Without one, the error names all extensions, or with `is_written` those that are written.
    """
    if format is not None:
        return [CODECS.load(format)()]
    extension = Path(path).suffix.lower()
    codecs: list[BlockReader] = [codec() for codec in CODECS.load_all()]
    found = [codec for codec in codecs if extension in codec.extensions]
    if found:
        return found
    known = dict.fromkeys(
        one
        for codec in codecs
        for one in codec.extensions
        if not is_written or (isinstance(codec, BlockCodec) and one not in codec.only_read)
    )
    what = f"extension {shown(extension)}" if extension else "no extension"
    files = "event files that are written" if is_written else "event files"
    raise ConfigError(
        f"{path} has {what}; {files} end in {', '.join(known)}; or state the format "
        "(texvent doctor lists them)"
    )


def open_events(
    path: str | Path,
    *,
    format: str | None = None,
    size: SizeLike | None = None,
    time_unit: str | None = None,
    columns: str | Sequence[str] | None = None,
    stream: str | None = None,
    repair: bool = False,
    **unknown: Any,
) -> EventPackets:
    """Events of a file, which is read when they are asked for, with flat memory (npz excepted).

    Iterate over the packets, cut with `between(start_us, stop_us)`, ask for `size`, `metadata` and
    `time_range`, or take all with `collect()`. An HDF5 file finds a time without reading the events
    before; others are read from the start, and no further than needed.

    Args:
        path: the file or folder; see `texvent.formats()`.
        format: its format, where neither content nor extension says.
        size: sensor size, for formats that do not store it: (width, height), "346x260" or a name,
            such as "davis346".
        time_unit: of text, npz, npy and HDF5: s, ms, us or ns; default: as the file states, else
            µs of whole numbers and s of fractions.
        columns: of text, npz, npy and HDF5: their order ("x,y,p,t") or names ("t=stamp,x=col,...").
        stream: which recording of a file of several: group, topic, or number of the camera.
        repair: repair damage, and count it in `metadata["repair"]`, instead of refusing it.
        **unknown: refused by name.

    Raises:
        InputError: no such file, the size is neither stored nor given, or the file holds several
            recordings and none is chosen.
        FileFormatError: the file is damaged or of another format.
        ConfigError: unknown format or extension, or an option that the format does not take.

    Example:
        >>> import texvent
        >>> events = texvent.EventStream.from_columns([3, 4], [0, 0], [10, 20], [1, 0], size="8x6")
        >>> packets = texvent.open(events.save("two.h5"))
        >>> packets.size, packets.time_range, len(packets.between(15, 30).collect())
        (SensorSize(width=8, height=6), (10, 21), 1)
    """
    if unknown:
        known = ("format", "size", "time_unit", "columns", "stream", "repair")
        name = next(iter(unknown))
        hint = "it is called stream" if name in ("topic", "group") else suggest(name, known)
        raise ConfigError(f"events are read without an option {name!r}; {hint}")
    options = read_options(
        size=size, time_unit=time_unit, columns=columns, stream=stream, repair=repair
    )
    return codec_that_reads(path, format).read(Path(path), options)


def load(path: str | Path, **options: Any) -> EventStream:
    """Events of a file, in memory; options and errors as of `texvent.open`.

    Example:
        >>> import texvent
        >>> events = texvent.EventStream.from_columns([3, 4], [0, 0], [10, 20], [1, 0], size="8x6")
        >>> texvent.load(events.save("two.npz"))
        EventStream(2 events, 8x6, t 10..20 µs)
    """
    return open_events(path, **options).collect()


def open_writer(
    path: str | Path,
    *,
    size: SensorSize,
    metadata: Mapping[str, Any] | None = None,
    format: str | None = None,
    overwrite: bool = False,
) -> BlockWriter:
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
