"""Report of a calibration: the fitted model beside the recording, as a figure (matplotlib)."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent._require import require
from texvent.calibrate.events_only.flicker import Flicker
from texvent.calibrate.events_only.known_scenes import simulate_flicker, simulate_static
from texvent.calibrate.events_only.pixel_trains import PixelTrains
from texvent.calibrate.events_only.static_scene import StaticScene
from texvent.calibrate.fit import Fit
from texvent.events import EventStream
from texvent.io.atomic import atomic_file
from texvent.represent.event_frame import count_events
from texvent.sensor import SensorSize
from texvent.video import MICROSECONDS
from texvent.view.page.sample import rate_counts

FORMATS = (".png", ".svg", ".pdf")
RATE_BINS, VALUE_BINS = 120, 40
LONGEST_S = 10.0
"""Seconds of a scene at rest that are compared."""
SIDE, CYCLES = 64, 10
"""Side of the middle of a flickering field that is compared, pixels; and its cycles."""
UNKNOWN_RATIO = 4.0
"""Bright over dark if it is not known."""
Panel = Callable[[Any], None]
"""Draws into matplotlib axes."""


class Comparison(NamedTuple):
    """Events of the recording and of the fitted model, of the same pixels and span."""

    recorded: EventStream
    simulated: EventStream
    chosen: NDArray[np.bool_]
    """[H, W] pixels that are compared."""
    seconds: float
    caption: str
    """Compared pixels and span, in a sentence."""
    panel: Panel | None
    """A further panel: noise curve, event rates or thresholds."""


def compare_fit(fit: Fit) -> Comparison:
    """Held-out part of a fit to frames and events, and the noise curve."""
    recorded, simulated = fit.compared
    noise = fit.noise

    def draw(axes: Any) -> None:
        if noise is None:
            return
        rates = noise.curve.rates_hz
        low, high = noise.ends[:, :-1]
        error = np.maximum([rates - low, high - rates], 0)
        axes.errorbar(noise.curve.levels, rates, yerr=error, fmt="o-")
        axes.set(xscale="log", yscale="log", xlabel="linear intensity, 0..255")
        axes.set_title("noise, events per pixel and second")

    everywhere = np.ones(recorded.size.shape, np.bool_)
    caption = f"Held out, not fitted: {fit.held_out.seconds:.3g} s."
    panel = None if noise is None else draw
    return Comparison(recorded, simulated, everywhere, fit.held_out.seconds, caption, panel)


def compare_static(scene: StaticScene, events: EventStream) -> Comparison:
    """Pixels at rest, and the event rate of each."""
    first_us, stop_us = events.time_range or (0, 1)
    seconds = min((stop_us - first_us) / MICROSECONDS, LONGEST_S)
    recorded = events.cut(first_us, first_us + round(seconds * MICROSECONDS))
    config = dataclasses.replace(scene.config, gamma=1.0, threshold_map=None)
    simulated = simulate_static(config, events.size, seconds)
    recorded, simulated = (one[scene.rests[one.y, one.x]] for one in (recorded, simulated))
    rates = count_events(events).sum(axis=0) / ((stop_us - first_us) / MICROSECONDS)
    with np.errstate(divide="ignore"):
        decades = np.where(scene.rests & (rates > 0), np.log10(rates), np.nan)
    panel = _map("log10 of events per pixel and second", decades)
    caption = f"Pixels at rest, {seconds:.3g} s."
    return Comparison(recorded, simulated, scene.rests, seconds, caption, panel)


def compare_flicker(flicker: Flicker, events: EventStream, ratio: float | None) -> Comparison:
    """Middle of a flickering field for some cycles, and the threshold of each pixel."""
    cycles = flicker.cycles
    number = min(CYCLES, cycles.number)
    width, height = events.size
    size = SensorSize(min(SIDE, width), min(SIDE, height))
    first_us, seconds = int(cycles.start_us[1]), number / cycles.hz
    part = events.cut(first_us, first_us + round(seconds * MICROSECONDS)).crop(
        (width - size.width) // 2, (height - size.height) // 2, size.width, size.height
    )
    config = dataclasses.replace(flicker.config, gamma=1.0, threshold_map=None)
    simulated = simulate_flicker(
        config, size, cycles.hz, ratio=ratio or UNKNOWN_RATIO, number=number
    )
    caption = f"The middle of the field, {number} cycles"
    caption += "." if ratio else f"; the model sees a ratio of {UNKNOWN_RATIO:g}, none is given."
    panel = _map("threshold over the mean of all pixels", np.mean(flicker.thresholds, axis=0))
    everywhere = np.ones(size.shape, np.bool_)
    return Comparison(part, simulated, everywhere, seconds, caption, panel)


def write_report(comparison: Comparison, path: Path, *, overwrite: bool) -> Path:
    """Draw event rate, events per pixel, and intervals of both polarities; .png, .svg or .pdf.

    Raises:
        OutputError: the file exists already or cannot be written.
        MissingDependencyError: matplotlib is not installed.
    """
    figure = require("matplotlib.figure", extra="plot").Figure(
        figsize=(12, 7), layout="constrained"
    )
    axes = figure.subplots(2, 3).ravel()
    streams = comparison.recorded, comparison.simulated
    chosen = comparison.chosen.reshape(-1)
    trains = [PixelTrains.of(one).at(chosen) for one in streams]
    rates = [_rates(one, comparison.seconds) for one in streams]
    for values, style in zip(rates, _STYLES, strict=True):
        seconds = np.linspace(0, comparison.seconds, RATE_BINS)
        axes[0].plot(seconds, values, **style)
    axes[0].set(title="events per second", xlabel="s")
    axes[0].legend()
    _draw_values(axes[1], "events per pixel", [one.counts().sum(axis=0)[chosen] for one in trains])
    for place, polarity in ((2, "ON"), (3, "OFF")):
        title = f"intervals between {polarity} events of a pixel, s"
        _draw_values(axes[place], title, [_intervals(one, polarity == "ON") for one in trains])
    for one in axes[4:]:
        one.set_axis_off()
    if comparison.panel is not None:
        axes[4].set_axis_on()
        comparison.panel(axes[4])
    figure.suptitle(comparison.caption)
    with atomic_file(path, overwrite=overwrite) as part:
        figure.savefig(part, format=path.suffix[1:].lower())
    return path


_STYLES = ({"label": "recording", "color": "0.6"}, {"label": "model", "color": "C0"})


def _map(title: str, values: NDArray[np.float64]) -> Panel:
    def draw(axes: Any) -> None:
        axes.figure.colorbar(axes.imshow(values, interpolation="nearest"), ax=axes)
        axes.set_title(title)

    return draw


def _draw_values(axes: Any, title: str, values: list[NDArray[Any]]) -> None:
    """Distributions of the positive values in bins that grow by a factor."""
    positive = [one[one > 0] for one in values]
    both = np.concatenate(positive)
    axes.set(title=title, xscale="log", ylabel="share")
    if both.size:
        edges = np.geomspace(both.min(), max(both.max(), both.min() * 1.01), VALUE_BINS + 1)
        for one, style in zip(positive, _STYLES, strict=True):
            axes.stairs(np.histogram(one, edges)[0] / max(one.size, 1), edges, **style)


def _rates(events: EventStream, seconds: float) -> NDArray[np.float64]:
    """Events per second in equal bins."""
    first_us = (events.time_range or (0, 0))[0]
    span = first_us, first_us + round(seconds * MICROSECONDS)
    counts = rate_counts(events, span, RATE_BINS).sum(axis=0)
    return np.asarray(counts * RATE_BINS / seconds)


def _intervals(trains: PixelTrains, is_on: bool) -> NDArray[np.float64]:
    """Times between events of one polarity, s."""
    chosen = trains.is_on == is_on
    one = PixelTrains(trains.size, trains.pixel[chosen], trains.t[chosen], trains.is_on[chosen])
    waits = one.waits_us()
    return np.asarray(np.maximum(waits[np.isfinite(waits)], 1.0) / MICROSECONDS)
