"""What a file format cannot hold is refused before it is written, with the formats that can."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from texvent.errors import InputError
from texvent.events import EventStream
from texvent.sensor import SensorSize

UNLIMITED = "hdf5 (.h5), npz (.npz) and ecd (.txt)"
"""Formats that hold every sensor size and time."""
LONGEST = "npz (.npz) or ecd (.txt)"
"""Formats that hold any span of time."""
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
    """Longest time from the origin of the file's times to the last event, µs, where limited."""
    start_us: int = 0
    """Events lie at this time or later, µs."""
    label: Literal["kept", "refused", "left out"] = "refused"
    """What becomes of the signal/noise label."""
    keeps_ids: bool = False
    """Whether it holds the instance and class of events; else they are left out."""

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
        """Refuse times that do not fit, and the signal/noise label.

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
        if packet.label is not None and self.label == "refused":
            raise InputError(
                f"cannot write {path}: {self.name} has no place for the signal/noise label; "
                f"{LABELLED} hold it, or drop it with without_label()"
            )
