"""The options that say which event file a command reads, and how."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent.cli.event_files.time_option import keep_time_range
from texvent.cli.option_types import REQUIRED
from texvent.event_packets import EventPackets
from texvent.io.files import open_events
from texvent.io.input_checks import refuse_missing
from texvent.runtime.file_names import usable_path
from texvent.sensor import parse_sensor


@dataclass(frozen=True, kw_only=True)
class EventFileOptions:
    """Which event file."""

    positional: ClassVar[tuple[str, ...]] = ("path",)

    path: Path = REQUIRED
    """Event file, or folder of one format."""
    format: str | None = None
    """Event format, where neither extension nor content says."""
    sensor: str | None = None
    """Sensor size, for formats that do not store it: WIDTHxHEIGHT or a name."""

    def open(self) -> EventPackets:
        """Open the file.

        Raises:
            InputError: there is no such file, or it cannot be read.
        """
        refuse_missing(usable_path(self.path))
        size = parse_sensor(self.sensor) if self.sensor else None
        return open_events(self.path, format=self.format, size=size)


@dataclass(frozen=True, kw_only=True)
class EventRangeOptions(EventFileOptions):
    """Which event file, and which part of it."""

    time: str | None = None
    """Use START,STOP only, in seconds of the recording's clock. START is included; either may be
    left out."""

    def open(self) -> EventPackets:
        """Open the part of the file; errors as for the whole."""
        return keep_time_range(super().open(), self.time)
