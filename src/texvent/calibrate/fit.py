"""Fit the `physical` model to a recording: thresholds, balance, cutoff and noise curve.

The noise curve is measured directly. For any balance and cutoff, the two thresholds follow from
the counts of ON and OFF events; balance and cutoff are those with the least distance, searched
one at a time with steps that shrink. Options that the recording cannot identify stay.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Collection, Mapping
from dataclasses import dataclass

from texvent._version import full_version
from texvent.calibrate.estimates import Measurement, UnidentifiedOption
from texvent.calibrate.noise import LEAST_EXPOSURE_S, MeasuredNoise, measure_noise
from texvent.calibrate.recording import CalibrationRecording, TimeSpan, simulate_span
from texvent.calibrate.search import COORDINATES, Distance, Report, Search, measure_distance
from texvent.calibrate.uncertainty import judge_fit
from texvent.events import EventStream
from texvent.simulation.physical.config import PhysicalConfig

MOST_ON = 0.95
"""Share of ON among noise above which OFF events no longer measure it."""
LEAST_EVENTS = 100
"""Fewer recorded events than this of either polarity fit no threshold."""
NOT_FITTED = (
    "threshold_sigma",
    "refractory_period_us",
    "noise_decades",
    "noise_on_fraction",
    "leak_rate_decades",
)
"""Options that frames and events of a moving scene cannot identify."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Fit(Measurement):
    """Fitted model, its noise and its distance to the recording."""

    offset_us: int
    """Offset added to the frame times, µs; it belongs to the recording, not to the sensor."""
    noise: MeasuredNoise | None
    """Noise and leak of still pixels; None if they are those the fit started with."""
    span: TimeSpan
    """The part that was fitted."""
    held_out: TimeSpan
    """The part that was not."""
    distances: Mapping[str, tuple[Distance, Distance]]
    """"start" and "fitted" → distance on the fitted and on the held-out part."""


def fit_sensor(
    recording: CalibrationRecording,
    *,
    start: PhysicalConfig,
    seconds: float = 1.0,
    keep: Collection[str] = (),
    report: Report = lambda line: None,
) -> Fit:
    """Fit the physical model to the first half of a recording and score it on the second.

    Args:
        recording: frames and events.
        start: where the search starts; options that are not searched keep their value.
        seconds: how much of each half is simulated.
        keep: of `COORDINATES`, those that another recording measured better.
        report: receives one line per step.

    Raises:
        InputError: the recording is too short.
    """
    halves = recording.halves()
    span, held_out = (half.first(seconds) for half in halves)
    truth = {part: recording.events.cut(*part) for part in (span, held_out)}
    noise = measure_noise(
        recording,
        halves[0],
        gamma=start.gamma,
        on_fraction=min(start.noise_on_fraction, MOST_ON),
    )
    first = start if noise is None else _with_noise(start, noise)
    report("too few still pixels to measure noise" if noise is None else f"noise {noise.curve}")
    dense = {part: recording.dense_frames(part, start) for part in truth}
    search = Search(dense[span], truth[span], span, report, keep=keep)
    fitted = _fit_circuit(search, truth[span], span, first, start)
    events = {
        (name, part): simulate_span(dense[part], part, config, offset_us=search.offset_us)
        for name, config in (("start", start), ("fitted", fitted.config))
        for part in (span, held_out)
    }
    return Fit(
        config=fitted.config,
        offset_us=search.offset_us,
        noise=noise,
        span=span,
        held_out=held_out,
        distances={
            name: (
                measure_distance(events[name, span], truth[span]),
                measure_distance(events[name, held_out], truth[held_out]),
            )
            for name in ("start", "fitted")
        },
        found=(*fitted.found, *(() if noise is None else noise.estimates())),
        kept=(*fitted.kept, *_noise_kept(noise, start)),
    )


def _fit_circuit(
    search: Search,
    truth: EventStream,
    span: TimeSpan,
    first: PhysicalConfig,
    start: PhysicalConfig,
) -> Measurement:
    """Thresholds, balance and cutoff, if there are events enough."""
    on = int(truth.p.sum())
    off = len(truth) - on
    if min(on, off) < LEAST_EVENTS:
        names = ("contrast_threshold", "on_off_ratio", *COORDINATES)
        reason = f"{on} ON and {off} OFF events; {LEAST_EVENTS} of each are needed"
        kept = (UnidentifiedOption(name, getattr(start, name), reason) for name in names)
        return Measurement(config=first, found=(), kept=tuple(kept))
    search.find_offset(search.match_counts(first).config)
    best = search.run(search.match_counts(first))
    return judge_fit(search, truth, span, best.config, start)


def _with_noise(config: PhysicalConfig, noise: MeasuredNoise) -> PhysicalConfig:
    return dataclasses.replace(
        config,
        noise_curve=str(noise.curve),
        noise_scale=1.0,
        leak_rate_hz=noise.leak_rate_hz,
    )


def _noise_kept(noise: MeasuredNoise | None, start: PhysicalConfig) -> list[UnidentifiedOption]:
    """Why other options of noise and leak stay."""
    reasons = dict.fromkeys(NOT_FITTED, "needs a recording without frames")
    if noise is None:
        reason = f"no still pixels for {LEAST_EXPOSURE_S:g} pixel-seconds in two ranges of light"
        reasons |= dict.fromkeys(("noise_curve", "leak_rate_hz"), reason)
    return [UnidentifiedOption(name, getattr(start, name), one) for name, one in reasons.items()]


def describe_fit(fit: Fit, source: str) -> list[str]:
    """The fitted span, distances to it and to the held-out part, and the constants."""
    lines = [
        f"Fitted to {' '.join(source.split())} by texvent {full_version()}.",
        f"Frame times were moved by {fit.offset_us} µs; noise was "
        + (
            "measured at still pixels."
            if fit.noise is not None
            else "not measured: too few still pixels."
        ),
        "Distance to the recording: 1-STPP + intervals (decades) + |ln| of both count ratios.",
    ]
    for title, span, place in (("fitted  ", fit.span, 0), ("held out", fit.held_out, 1)):
        lines.append(
            f"{title} {span.start_us / 1e6:.3f}..{span.stop_us / 1e6:.3f} s: "
            f"{fit.distances['start'][place]} before, {fit.distances['fitted'][place]} after"
        )
    return [*lines, *fit.lines()]
