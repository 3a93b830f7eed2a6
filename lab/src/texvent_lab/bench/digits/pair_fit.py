"""The physical model fitted to pairs of a recording and its digit.

Thresholds follow from the counts of ON and OFF events; the other options are searched one at a
time with steps that shrink, for the least distance between simulated and recorded events.
Recordings that are tested on are not looked at.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from texvent.calibrate.search import Distance, measure_distance
from texvent.events import EventStream
from texvent.run.prepare import prepare_video
from texvent.settings.resolution import Settings
from texvent_lab.bench.digits.sheet import DigitSheet

COORDINATES: Mapping[str, tuple[float, ...]] = {
    "refractory_period_us": (100, 1000, 2000),
    "cutoff_hz": (60, 120, 500, 0),
    "balance": (3, 20, 40, 80),
    "threshold_sigma": (0.0, 0.06, 0.1),
    "noise_scale": (0.0, 0.3, 3.0),
    "leak_rate_hz": (0.0, 0.05, 0.1, 0.3),
}
"""Options that are searched, in this order, and the values that are tried beside the first."""


COUNT_ROUNDS = 5
"""Simulations that may be spent on the thresholds of one candidate."""


COUNT_TOLERANCE = 0.03
"""Logarithm of a count ratio at which thresholds are good enough."""


COUNT_GAIN = 0.7
"""Step of the logarithm of a threshold per logarithm of a count ratio."""


THRESHOLD_LIMITS = (0.02, 2.0)


def fit_to_pairs(
    sheet: DigitSheet,
    recorded: Sequence[EventStream],
    settings: Settings,
    report: Callable[[str], None] = lambda line: None,
) -> tuple[dict[str, float], Distance, Distance]:
    """Options of the physical model with the least distance from recordings.

    Args:
        sheet: the digits of the pairs, with the measured motion.
        recorded: their recordings, in the same order.
        settings: of a simulation by the physical model, where the search starts.
        report: told of every step in one line.

    Returns:
        Option → value; the distance at the start, thresholds fitted, and at the end.
    """
    truth = sheet.lay_out(recorded)

    def measure(config: Any) -> tuple[Any, Distance]:
        return _match_counts(sheet, truth, dataclasses.replace(settings, simulate=config))

    start = best = measure(settings.simulate)
    for name, values in COORDINATES.items():
        for value in values:
            trial = measure(dataclasses.replace(best[0], **{name: value}))
            report(f"{name} {value:g}: distance {trial[1]}")
            if trial[1].total < best[1].total:
                best = trial
    names = ("contrast_threshold", "on_off_ratio", *COORDINATES)
    return {name: getattr(best[0], name) for name in names}, start[1], best[1]


def _match_counts(
    sheet: DigitSheet, truth: EventStream, settings: Settings
) -> tuple[Any, Distance]:
    """Options with thresholds at which the counts of ON and OFF events agree, and the distance."""
    config: Any = settings.simulate
    tried: list[tuple[Any, Distance]] = []
    for _ in range(COUNT_ROUNDS):
        run = dataclasses.replace(settings, simulate=config)
        events = sheet.inside(prepare_video(sheet, run).packets.collect())
        distance = measure_distance(events, truth)
        tried.append((config, distance))
        if max(abs(distance.log_on), abs(distance.log_off)) <= COUNT_TOLERANCE:
            break
        on = _limited(config.contrast_threshold_on * math.exp(COUNT_GAIN * distance.log_on))
        off = _limited(config.contrast_threshold_off * math.exp(COUNT_GAIN * distance.log_off))
        config = dataclasses.replace(
            config, contrast_threshold=math.sqrt(on * off), on_off_ratio=on / off
        )
    return min(tried, key=lambda one: one[1].total)


def _limited(threshold: float) -> float:
    return float(np.clip(threshold, *THRESHOLD_LIMITS))
