"""Which events of a packet a run keeps."""

from __future__ import annotations

from texvent.config import RunConfig
from texvent.events import NOISE, SIGNAL, EventStream


def select_events(packet: EventStream, run: RunConfig) -> EventStream:
    """The events of a packet that the run keeps, with the label only if it is wanted."""
    if packet.label is not None and run.events != "all":
        packet = packet[packet.label == (SIGNAL if run.events == "signal" else NOISE)]
    return packet if run.label_noise else packet.without_label()
