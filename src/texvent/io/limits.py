"""What a file format cannot hold: refused before it is written, or left out; and which can."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from texvent.errors import InputError
from texvent.events import EventStream
from texvent.sensor import SensorSize

UNLIMITED = "hdf5 (.h5), npz (.npz) and ecd (.txt)"
"""Formats that hold every sensor size and time."""
LONGEST = "npz (.npz) or ecd (.txt)"
"""Formats that hold any span of time."""
LABELLED = "hdf5 (.h5), npz (.npz) and dsec"
"""Formats that keep labels."""


@dataclass(frozen=True)
class FormatLimits:
    """The largest sensor and time of a format."""

    name: str
    """As messages say it: `EVT3`."""
    max_side: int
    """Largest width and height, pixels."""
    stop_us: int
    """Events lie before this time, µs."""
    max_span_us: int | None = None
    """Longest time from the origin of the file's times to the last event, µs, where limited."""
    start_us: int = 0
    """Events lie at this time or later, µs."""
    keeps_labels: bool = False
    """Whether it has a place for the signal/noise label, the instance and the class of events; else
    they are left out, with a warning."""

    def check_size(self, path: Path, size: SensorSize) -> None:
        """Refuse a sensor that is too large.

        Raises:
            InputError: a side is longer than `max_side`.
        """
        if max(size) > self.max_side:
            raise InputError(
                f"cannot write {path}: {self.name} holds sensors up to "
                f"{self.max_side}x{self.max_side}, not {size}; {UNLIMITED} hold it"
            )

    def origin_us(self, first_us: int) -> int:
        """What the file's times count from, µs, for the span: the time of its first event."""
        return first_us

    def check_packet(self, path: Path, packet: EventStream, first_us: int) -> None:
        """Refuse times that do not fit.

        Args:
            path: the file, for the message.
            packet: at least one event.
            first_us: time of the first event of the file, µs.

        Raises:
            InputError: see above.
        """
        start_us, last_us = int(packet.t[0]), int(packet.t[-1])
        if start_us < self.start_us:
            raise InputError(f"an event has time {start_us} µs; event files start at 0 or later")
        if last_us >= self.stop_us:
            raise InputError(
                f"cannot write {path}: an event has time {last_us} µs; {self.name} holds times "
                f"below {self.stop_us} µs ({self.stop_us / 3.6e9:.3g} h). {UNLIMITED} hold it; or "
                "check the time unit, or start the recording near 0 (texvent convert --from-zero)"
            )
        span_us = last_us - self.origin_us(first_us)
        if self.max_span_us is not None and span_us > self.max_span_us:
            raise InputError(
                f"cannot write {path}: events span {span_us / 3.6e9:.3g} h; {self.name} holds up "
                f"to {self.max_span_us / 3.6e9:.3g} h. Split the recording, check its time unit, "
                f"or write {LONGEST}"
            )
