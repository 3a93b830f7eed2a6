"""Count ratio, ON difference, active IoU: totals that any simulator can be tuned to.

They are reported with the other metrics and never optimised alone: in the self-test
(docs/metrics.md) each of them misses more than half of the perturbations.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from texvent.events import EventStream
from texvent.metrics.protocol import UNDEFINED, Better, Needs, check_pair
from texvent.represent.event_frame import event_frame


@dataclass(frozen=True, kw_only=True)
class CountRatio:
    """Events predicted per event of the reference; NaN if the reference is empty."""

    name: ClassVar[str] = "count_ratio"
    unit: ClassVar[str] = ""
    better: ClassVar[Better] = "one"
    needs: ClassVar[Needs] = "same scene"
    range: ClassVar[tuple[float, float]] = (0.0, float("inf"))
    blind_to: ClassVar[str] = "everything but the number of events"

    def __call__(self, predicted: EventStream, reference: EventStream) -> float:
        """Predicted over reference; see `metrics.protocol.Metric`."""
        check_pair(predicted, reference)
        return len(predicted) / len(reference) if len(reference) else UNDEFINED


@dataclass(frozen=True, kw_only=True)
class OnDifference:
    """Absolute difference of the shares of ON events; NaN if a stream is empty."""

    name: ClassVar[str] = "on_difference"
    unit: ClassVar[str] = ""
    better: ClassVar[Better] = "lower"
    needs: ClassVar[Needs] = "same scene"
    range: ClassVar[tuple[float, float]] = (0.0, 1.0)
    blind_to: ClassVar[str] = "everything but the balance of polarities"

    def __call__(self, predicted: EventStream, reference: EventStream) -> float:
        """|ON share of predicted − of reference|; see `metrics.protocol.Metric`."""
        check_pair(predicted, reference)
        if not len(predicted) or not len(reference):
            return UNDEFINED
        return abs(float(predicted.p.mean()) - float(reference.p.mean()))


@dataclass(frozen=True, kw_only=True)
class ActiveIou:
    """Pixels active in both streams per pixel active in either; NaN if there is none."""

    name: ClassVar[str] = "active_iou"
    unit: ClassVar[str] = ""
    better: ClassVar[Better] = "higher"
    needs: ClassVar[Needs] = "same scene"
    range: ClassVar[tuple[float, float]] = (0.0, 1.0)
    blind_to: ClassVar[str] = "time, polarity, counts; saturates in long recordings"

    def __call__(self, predicted: EventStream, reference: EventStream) -> float:
        """Intersection over union; see `metrics.protocol.Metric`."""
        check_pair(predicted, reference)
        a, b = event_frame(predicted, "binary"), event_frame(reference, "binary")
        union = int(np.count_nonzero(a | b))
        return int(np.count_nonzero(a & b)) / union if union else UNDEFINED
