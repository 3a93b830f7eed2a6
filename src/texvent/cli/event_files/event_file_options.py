"""Options of commands on event files: the file, `--time START,STOP` of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent.cli.option_types import REQUIRED
from texvent.errors import ConfigError, shown
from texvent.event_packets import EventPackets
from texvent.frames import MICROSECONDS
from texvent.io.files import open_events
from texvent.io.input_checks import refuse_missing
from texvent.io.reading import TimeUnit
from texvent.options.time_range import END_OF_TIME_US
from texvent.options.values import parse_fraction
from texvent.runtime.files.file_names import usable_path
from texvent.sensor import parse_sensor
from texvent.transform.edits import keep_time


@dataclass(frozen=True, kw_only=True)
class FileFactOptions:
    """Facts that a file does not state, and which of its recordings is meant."""

    short_flags: ClassVar[Mapping[str, str]] = {"stream": "--topic --group"}

    sensor: str | None = None
    """Sensor size, for formats that do not store it: WIDTHxHEIGHT or a name."""
    time_unit: TimeUnit | None = None
    """Unit of the times of text, npz, npy and HDF5, where the file does not state it."""
    columns: str | None = None
    """Columns of text, npz, npy and HDF5: their order (x,y,p,t) or names (t=stamp,x=col,...)."""
    stream: str | None = None
    """Recording of a file of several: HDF5 group, ROS topic or number of the camera."""
    repair: bool = False
    """Repair damage, and say how much, instead of refusing the file."""

    def open_file(self, path: Path, format: str | None) -> EventPackets:
        """Open a file.

        Raises:
            InputError: there is no such file, or it cannot be read.
        """
        refuse_missing(usable_path(path))
        return open_events(
            path,
            format=format,
            size=parse_sensor(self.sensor) if self.sensor else None,
            time_unit=self.time_unit,
            columns=self.columns,
            stream=self.stream,
            repair=self.repair,
        )


@dataclass(frozen=True, kw_only=True)
class EventFileOptions(FileFactOptions):
    """Event file to read."""

    positional: ClassVar[tuple[str, ...]] = ("path",)

    path: Path = REQUIRED
    """Event file, or folder of one format."""
    format: str | None = None
    """Event format, where neither extension nor content says."""

    def open(self) -> EventPackets:
        """Open the file; errors as of `open_file`."""
        return self.open_file(self.path, self.format)


@dataclass(frozen=True, kw_only=True)
class EventRangeOptions(EventFileOptions):
    """Event file to read, and the part of it."""

    time: str | None = None
    """Use START,STOP only, in seconds of the recording's clock. START is included; either may be
    left out."""

    def open(self) -> EventPackets:
        """Open the part of the file; errors as for the whole."""
        return keep_time_range(super().open(), self.time)


def keep_time_range(events: EventPackets, text: str | None) -> EventPackets:
    """The events of the part that `text` names; without one all of them.

    Raises:
        ConfigError: it is not two numbers.
        InputError: the stop is not after the start, or the recording lies elsewhere.
    """
    return events if text is None else keep_time(events, *parse_time_range(text))


def parse_time_range(text: str) -> tuple[int, int]:
    """`START,STOP` in seconds as µs, exactly; either may be left out.

    Example:
        >>> parse_time_range("0.5,9007199254.740993")
        (500000, 9007199254740993)

    Raises:
        ConfigError: it is not two numbers.
    """
    words = [word.strip() for word in text.split(",")]
    try:
        if len(words) != 2:
            raise ValueError(text)
        start = round(parse_fraction(words[0]) * MICROSECONDS) if words[0] else 0
        stop = round(parse_fraction(words[1]) * MICROSECONDS) if words[1] else END_OF_TIME_US
    except (ValueError, ZeroDivisionError) as error:
        raise ConfigError(
            f"time is {shown(text)}; give START,STOP in seconds, such as 0.5,2 or 0.5, or ,2"
        ) from error
    return start, stop
