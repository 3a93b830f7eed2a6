"""What the report of each kind of recording shows."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence

import numpy as np

from texvent.calibrate.events_only.flicker import Flicker
from texvent.calibrate.events_only.replay import replay_flicker, replay_static
from texvent.calibrate.events_only.static_scene import StaticScene
from texvent.calibrate.fit import Fit
from texvent.calibrate.report.charts import map_chart, noise_chart
from texvent.calibrate.report.page import Comparison, Report
from texvent.events import EventStream
from texvent.represent.event_frame import count_events
from texvent.sensor import SensorSize
from texvent.simulate.physical.config import PhysicalConfig
from texvent.video import MICROSECONDS

LONGEST_S = 10.0
"""Seconds of a scene at rest that are compared."""
SIDE = 64
"""Side of the middle of a flickering field that is compared, pixels."""
CYCLES = 10
"""Cycles of it."""
UNKNOWN_RATIO = 4.0
"""Bright over dark if it is not known."""


def report_fit(fit: Fit, start: PhysicalConfig, source: str, lines: Sequence[str]) -> Report:
    """Of a fit to frames and events: its held-out part.

    Args:
        fit: what was found.
        start: where the fit started.
        source: of the recording, in words.
        lines: what is said of the fit.
    """
    recorded, simulated = fit.compared
    size = recorded.size
    charts = []
    if fit.noise is not None:
        curve = fit.noise.curve
        charts.append(noise_chart(curve.levels, curve.rates_hz, fit.noise.ends[:, :-1]))
    comparison = Comparison(
        recorded,
        simulated,
        np.ones((size.height, size.width), np.bool_),
        fit.held_out.seconds,
        f"Held out, not fitted: {fit.held_out.seconds:.3g} s.",
    )
    return Report(source, start, fit.found, fit.kept, lines[1:], comparison, charts)


def report_static(
    scene: StaticScene, events: EventStream, start: PhysicalConfig, source: str
) -> Report:
    """Of a scene at rest."""
    first_us, stop_us = events.time_range or (0, 1)
    seconds = min((stop_us - first_us) / MICROSECONDS, LONGEST_S)
    recorded = events.cut(first_us, first_us + round(seconds * MICROSECONDS))
    recorded = recorded[scene.rests[recorded.y, recorded.x]]
    simulated = replay_static(_linear(scene.config), events.size, seconds)
    simulated = simulated[scene.rests[simulated.y, simulated.x]]
    rates = count_events(events).sum(axis=0) / ((stop_us - first_us) / MICROSECONDS)
    with np.errstate(divide="ignore"):
        decades = np.where(scene.rests & (rates > 0), np.log10(rates), np.nan)
    title = "log10 of the events per pixel and second; red: hot, grey: none, or not at rest"
    comparison = Comparison(
        recorded, simulated, scene.rests, seconds, f"Pixels at rest, {seconds:.3g} s."
    )
    charts = [map_chart(title, decades, scene.is_hot)]
    return Report(source, start, scene.found, scene.kept, scene.remarks, comparison, charts)


def report_flicker(
    flicker: Flicker,
    events: EventStream,
    start: PhysicalConfig,
    source: str,
    *,
    ratio: float | None,
) -> Report:
    """Of a flickering field: the middle of it, some cycles."""
    cycles = flicker.cycles
    number = min(CYCLES, cycles.number)
    width, height = events.size
    size = SensorSize(min(SIDE, width), min(SIDE, height))
    first_us = int(cycles.start_us[1])
    seconds = number / cycles.hz
    part = events.cut(first_us, first_us + round(seconds * MICROSECONDS)).crop(
        (width - size.width) // 2, (height - size.height) // 2, size.width, size.height
    )
    config = _linear(flicker.config)
    replayed = replay_flicker(config, size, cycles.hz, ratio=ratio or UNKNOWN_RATIO, number=number)
    chosen = np.ones((size.height, size.width), np.bool_)
    caption = f"The middle of the field, {number} cycles"
    caption += "." if ratio else f"; the model sees a ratio of {UNKNOWN_RATIO:g}, none is given."
    comparison = Comparison(part, replayed, chosen, seconds, caption)
    charts = [
        map_chart(
            "Threshold over the mean of all pixels; grey: unknown", np.mean(flicker.thresholds, 0)
        )
    ]
    return Report(source, start, flicker.found, flicker.kept, flicker.remarks, comparison, charts)


def _linear(config: PhysicalConfig) -> PhysicalConfig:
    return dataclasses.replace(config, gamma=1.0, threshold_map=None)
