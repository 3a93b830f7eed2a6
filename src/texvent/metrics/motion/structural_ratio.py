"""Event structural ratio: how concentrated events are, a measure of noise."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from texvent.events import EventStream
from texvent.metrics.protocol import UNDEFINED, Metric
from texvent.represent.event_frame import event_frame

PACKET_EVENTS = 30_000
REFERENCE_EVENTS = 20_000


def structural_ratio(
    events: EventStream,
    *,
    packet_events: int = PACKET_EVENTS,
    reference_events: int = REFERENCE_EVENTS,
) -> float:
    """Mean `sqrt(NTSS · L_N)` over packets of a fixed number of events.

    `NTSS = Σ n_i (n_i − 1) / (N (N − 1))` is the share of event pairs on one pixel, and
    `L_N = K − Σ (1 − M/N)^(n_i)` the pixels expected to be active among M of the N events.

    Args:
        events: the stream.
        packet_events: N; a shorter last packet is left out.
        reference_events: M, at most N.

    Returns:
        0 or more, higher for events on few edges, lower for scattered noise; NaN if there is no
        complete packet. Depends on the size of the sensor and the texture of the scene.

    Source: S. Ding et al., "E-MLB: multilevel benchmark for event-based camera denoising", IEEE
        Transactions on Multimedia (2023).
    """
    ratios = []
    for first in range(0, len(events) - packet_events + 1, packet_events):
        packet = events[first : first + packet_events]
        counts = event_frame(packet, "count").sum(axis=0).astype(np.float64)
        pairs = float((counts * (counts - 1)).sum()) / (packet_events * (packet_events - 1))
        left_out = 1 - reference_events / packet_events
        active = counts.size - float((left_out**counts).sum())
        ratios.append(math.sqrt(pairs * active))
    return float(np.mean(ratios)) if ratios else UNDEFINED


@dataclass(frozen=True, kw_only=True)
class StructuralRatioQuotient(Metric):
    """Event structural ratio of the predicted stream over that of the reference.

    NaN if a stream has fewer than two events, or the reference never two on one pixel.

    Deviation: where a stream has fewer than 30,000 events, packets of both are as long as it is,
        and M shrinks with them; a quotient of two ratios does not depend on the length as they do.
    """

    name = "esr"
    better = "one"
    range = (0.0, float("inf"))
    blind_to = "polarity, where the events are, times inside a packet"

    def _score(self, predicted: EventStream, reference: EventStream) -> float:
        length = min(PACKET_EVENTS, len(predicted), len(reference))
        if length < 2:
            return UNDEFINED
        judged, true = (
            structural_ratio(
                events,
                packet_events=length,
                reference_events=length * REFERENCE_EVENTS // PACKET_EVENTS,
            )
            for events in (predicted, reference)
        )
        return judged / true if true > 0 else UNDEFINED
