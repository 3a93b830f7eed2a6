"""Count ratio, ON difference, active IoU: totals that any simulator can be tuned to.

They are reported with the other metrics and never optimised alone: in the self-test
(docs/metrics.md) each of them misses more than half of the perturbations.
"""

from __future__ import annotations

import numpy as np

from texvent.events import EventStream
from texvent.metrics.protocol import UNDEFINED, Metric
from texvent.represent.event_frame import event_frame


class CountRatio(Metric):
    """Events predicted per event of the reference; NaN if the reference is empty."""

    name = "count_ratio"
    better = "one"
    range = (0.0, float("inf"))
    blind_to = "everything but the number of events"

    def _score(self, predicted: EventStream, reference: EventStream) -> float:
        return len(predicted) / len(reference) if len(reference) else UNDEFINED


class OnDifference(Metric):
    """Absolute difference of the shares of ON events; NaN if a stream is empty."""

    name = "on_difference"
    blind_to = "everything but the balance of polarities"

    def _score(self, predicted: EventStream, reference: EventStream) -> float:
        if not len(predicted) or not len(reference):
            return UNDEFINED
        return abs(float(predicted.p.mean()) - float(reference.p.mean()))


class ActiveIou(Metric):
    """Pixels active in both streams per pixel active in either; NaN if there is none."""

    name = "active_iou"
    better = "higher"
    blind_to = "time, polarity, counts; saturates in long recordings"

    def _score(self, predicted: EventStream, reference: EventStream) -> float:
        a, b = event_frame(predicted, "binary"), event_frame(reference, "binary")
        union = int(np.count_nonzero(a | b))
        return int(np.count_nonzero(a & b)) / union if union else UNDEFINED
