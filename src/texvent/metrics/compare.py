"""Comparison of two event streams by several metrics at once."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any

from texvent._registry import METRICS
from texvent.errors import ConfigError
from texvent.events import EventStream
from texvent.metrics.protocol import Metric, check_pair
from texvent.runtime.progress import NO_PROGRESS, Progress

GOOD = {"lower": "low", "higher": "high", "one": "near 1"}
"""`Metric.better` in words."""


def score_text(value: float) -> str:
    """A value with four digits after the point, or "undefined"."""
    return "undefined" if math.isnan(value) else f"{value:.4f}"


def compare(
    predicted: EventStream,
    reference: EventStream,
    metrics: str | Metric | Iterable[str | Metric] | None = None,
    *,
    span_us: tuple[int, int] | None = None,
    progress: Progress = NO_PROGRESS,
) -> dict[str, float]:
    """Scores of `predicted` against `reference`.

    Args:
        predicted: the stream to judge.
        reference: the true stream, or another recording of the same scene.
        metrics: a name from the registry, a metric with parameters of its own, or several of them;
            default: see `default_metrics`.
        span_us: compare only events with `start <= t < stop`, µs; default: all.
        progress: receives each metric.

    Returns:
        Name → value, NaN where a metric is undefined for these streams.

    Raises:
        InputError: the sensors differ in size, or a metric's weights are not here.
        ConfigError: an unknown metric, or a span that is not longer than 0.

    Example:
        >>> from texvent.sensor import SensorSize
        >>> a = EventStream([1, 2], [0, 0], [100, 900], [1, 0], SensorSize(4, 3))
        >>> compare(a, a, ["stpp", "nearest", "count_ratio"])
        {'stpp': 1.0, 'nearest': 0.0, 'count_ratio': 1.0}
    """
    check_pair(predicted, reference)
    if span_us is not None:
        if not span_us[0] < span_us[1]:
            raise ConfigError(f"span is {span_us} µs; its stop must come after its start")
        predicted, reference = predicted.between(*span_us), reference.between(*span_us)
    chosen: Iterable[str | Metric]
    if isinstance(metrics, str) or (metrics is not None and not isinstance(metrics, Iterable)):
        chosen = [metrics]
    else:
        chosen = default_metrics() if metrics is None else metrics
    built = [load_metric(metric) if isinstance(metric, str) else metric for metric in chosen]
    scores = {}
    for done, metric in enumerate(built):
        progress.advance("metrics", done, len(built))
        scores[metric.name] = metric(predicted, reference)
    return scores


def load_metric(name: str) -> Metric:
    """The metric called `name`, with its defaults.

    Raises:
        ConfigError: no metric has that name.
    """
    metric: Metric = METRICS.load(name)()
    return metric


def describe_metrics() -> Mapping[str, Metric]:
    """Name → metric with its defaults, for every registered metric."""
    return {name: load_metric(name) for name in METRICS.names()}


def default_metrics() -> list[Metric]:
    """Every registered metric with its defaults, without those whose weights are missing."""
    return [metric for metric in describe_metrics().values() if metric.missing() is None]


def plain_values(value: Any, *, digits: int | None = None) -> Any:
    """Values as JSON holds them: None for what is NaN or infinite.

    Args:
        value: numbers, texts, and mappings and sequences of them.
        digits: significant digits that numbers keep; None keeps all.
    """
    if isinstance(value, Mapping):
        return {key: plain_values(item, digits=digits) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain_values(item, digits=digits) for item in value]
    if not isinstance(value, float):
        return value
    if not math.isfinite(value):
        return None
    return float(value) if digits is None else float(f"{value:.{digits}g}")
