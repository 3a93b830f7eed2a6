"""Controls of a similarity score: what it says of streams whose answer is known beforehand."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import TypeAlias

from texvent.bench.selftest.perturbations import perturb, split_halves
from texvent.events import EventStream
from texvent.metrics.protocol import Metric

CONTROLLED = ("lfs", "eqs")
"""Metrics that are reported with their controls: their numbers alone mislead."""

Pair: TypeAlias = tuple[EventStream, EventStream]
"""What is judged, and by which reference."""


def _perturb_copy(events: EventStream, *, perturbation: str) -> Pair:
    return perturb(events, perturbation), events


CONTROLS: Mapping[str, Callable[[EventStream], Pair]] = {
    "identity": lambda events: (events, events),
    "split half": partial(split_halves, seed=2026),
    "shuffle all times": partial(_perturb_copy, perturbation="shuffle all times"),
    "shuffle all pixels": partial(_perturb_copy, perturbation="shuffle all pixels"),
    "flip 100 %": partial(_perturb_copy, perturbation="flip 100 %"),
    "noise 30 %": partial(_perturb_copy, perturbation="noise 30 %"),
}
"""Name → the pair made of a reference. A score is worth something only between its split half and
its shuffles."""


def run_controls(metric: Metric, reference: EventStream) -> dict[str, float]:
    """Control → what the metric says of it.

    Args:
        metric: which metric.
        reference: the true stream; all controls are made of it.
    """
    return {name: metric(*pair(reference)) for name, pair in CONTROLS.items()}
