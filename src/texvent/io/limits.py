"""What a file format cannot hold is refused before it is written, with the formats that can."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from texvent.errors import InputError
from texvent.events import EventStream
from texvent.sensor import SensorSize

UNLIMITED = "hdf5 (.h5), npz (.npz) and ecd (.txt)"
"""Formats that hold every sensor size and time."""
LABELLED = "hdf5 (.h5) and npz (.npz)"
"""Formats that hold the signal/noise label."""


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
    """Longest time from the first event to the last, µs, where it is limited."""

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

    def check_packet(self, path: Path, packet: EventStream, start_us: int | None = None) -> None:
        """Refuse times that do not fit, and the signal/noise label.

        Args:
            path: the file, for the message.
            packet: at least one event.
            start_us: time of the first event of the file, µs; None: that of this packet.

        Raises:
            InputError: see above.
        """
        first, last = int(packet.t[0]), int(packet.t[-1])
        if first < 0:
            raise InputError(f"an event has time {first} µs; event files start at 0 or later")
        if last >= self.stop_us:
            raise InputError(
                f"cannot write {path}: an event has time {last} µs; {self.name} holds times below "
                f"{self.stop_us} µs ({self.stop_us / 3.6e9:.3g} h). {UNLIMITED} hold it; or check "
                "the time unit, or start the recording near 0 (texvent convert --from-zero)"
            )
        span = last - (first if start_us is None else start_us)
        if self.max_span_us is not None and span > self.max_span_us:
            raise InputError(
                f"cannot write {path}: events span {span / 3.6e9:.3g} h; {self.name} holds up to "
                f"{self.max_span_us / 3.6e9:.3g} h. Split the recording, or write {UNLIMITED}"
            )
        if packet.label is not None:
            raise InputError(
                f"cannot write {path}: {self.name} has no place for the signal/noise label; "
                f"{LABELLED} hold it, or drop it with without_label()"
            )
