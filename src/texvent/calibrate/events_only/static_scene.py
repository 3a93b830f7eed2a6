"""A scene at rest under steady light: noise, hot pixels, leak and the refractory period.

Without change of light, OFF events are noise, ON events noise or leak. Noise comes at random; leak
fires a pixel when nothing else has done so for the leak period. So the share of ON among the noise
is that among events that follow another one sooner than any leak does.
"""

from __future__ import annotations

import dataclasses
import math
from statistics import NormalDist
from typing import NamedTuple

import numpy as np

from texvent.calibrate.estimates import (
    Estimate,
    Measurement,
    UnidentifiedOption,
    bootstrap,
    with_estimates,
)
from texvent.calibrate.events_only.pixel_trains import (
    BoolArray,
    Float64Array,
    PixelTrains,
    find_dead_time,
)
from texvent.calibrate.events_only.stationary_blocks import (
    find_stationary,
    leak_rate,
    mains_flicker,
)
from texvent.errors import InputError, warn
from texvent.events import EventStream
from texvent.frames import MICROSECONDS
from texvent.simulation.physical.config import PhysicalConfig

WINDOWS, GROUPS = 10, 100
"""Windows of time and groups of pixels that the bootstrap draws."""
LEAST_EXPOSURE_S = 20.0
"""Pixel-seconds at rest without which nothing is measured."""
LEAST_REST = 0.5
"""Share of the sensor at rest below which something large moves."""
LEAST_COUNT = 50
"""Events without which a share or a spread is not measured."""
EARLY = 0.25
"""Part of the leak period in which no pixel leaks, whatever its spread."""
FIRST_CUT = 0.01
"""Share of the busiest pixels that the first look leaves out."""
HOT_CHANCE = 0.01
"""Expected number of pixels that pass for hot by chance."""
MOST_DECADES = 1.0
"""Spread of noise rates above which they are not noise."""
NOT_TOLD = (
    "contrast_threshold",
    "on_off_ratio",
    "threshold_sigma",
    "cutoff_hz",
    "leak_rate_decades",
)
"""Options that a scene at rest cannot identify."""
FLAT_LEVEL = 128
"""Level at which the curve of one point is written; it holds at every level."""


class _Counts(NamedTuple):
    """Sufficient counts of a recording; small, whatever its length."""

    sums: Float64Array
    """[windows, groups, 4] ON, OFF, early ON, early OFF events of pixels that are not hot."""
    seconds: float
    """Length of one window, s."""
    pixels: Float64Array
    """[groups, 5] pixels, those not hot, and of these Σ OFF, Σ OFF²; events of hot pixels."""
    dead_s: float
    """Refractory period, s; hot pixels fire often enough to lose events in it."""


class _Values(NamedTuple):
    """Estimates from counts."""

    noise_hz: float
    on_fraction: float
    decades: float
    leak_hz: float
    hot_fraction: float
    hot_rate_hz: float


def measure_static_scene(events: EventStream, start: PhysicalConfig) -> Measurement:
    """Measure noise, hot pixels, leak and refractory period in a recording at rest.

    Args:
        events: of a sensor that sees steady light, or little that moves.
        start: source of options that the recording cannot identify.

    Raises:
        InputError: less than 20 pixel-seconds are at rest.

    Warns:
        TexventWarning: less than half of the sensor is at rest.
    """
    first_us, stop_us = events.time_range or (0, 0)
    seconds = (stop_us - first_us) / MICROSECONDS
    rests = find_stationary(events)
    exposure_s = float(rests.sum()) * seconds
    if exposure_s < LEAST_EXPOSURE_S:
        raise InputError(
            f"{exposure_s:.3g} pixel-seconds of this recording are at rest; calibration needs "
            f"{LEAST_EXPOSURE_S:g}. Record a scene in which nothing moves, under steady light"
        )
    if rests.mean() < LEAST_REST:
        warn(
            f"only {rests.mean():.0%} of the sensor was at rest, so the camera or most of the "
            "scene moved, and its events may count as noise; record a scene in which nothing moves"
        )
    trains = PixelTrains.of(events).at(rests.reshape(-1))
    hot = find_hot_pixels(trains.counts().sum(axis=0), rests.reshape(-1))
    calm = trains.at(~hot)
    span = first_us, stop_us
    early_us = _early_us(calm, exposure_s, start)
    dead = find_dead_time(calm.waits_us())
    dead_us = start.refractory_period_us if isinstance(dead, str) else dead.value
    counts = _count(trains, hot, rests.reshape(-1), span, early_us, dead_us)
    values = _estimate(counts, start, np.ones(WINDOWS), np.ones(GROUPS))
    if values.decades > MOST_DECADES:
        raise InputError(
            f"pixels at rest differ by {values.decades:.2f} decades in rate, noise by at most "
            f"{MOST_DECADES:g}: something moves. Record a scene in which nothing "
            "does, for 5 s or more"
        )
    ends = bootstrap(
        lambda windows, groups: np.array(_estimate(counts, start, windows, groups)),
        (WINDOWS, GROUPS),
    )
    found, kept = _judge(counts, values, ends, start, exposure_s)
    if isinstance(dead, str):
        kept.append(UnidentifiedOption("refractory_period_us", start.refractory_period_us, dead))
    else:
        found.append(dead)
    reason = "a scene at rest cannot identify it"
    kept += [UnidentifiedOption(name, getattr(start, name), reason) for name in NOT_TOLD]
    return Measurement(
        config=_with(start, found, values.noise_hz),
        found=tuple(found),
        kept=tuple(kept),
        remarks=tuple(_remarks(events, rests)),
    )


def find_hot_pixels(counts: np.ndarray, chosen: BoolArray) -> BoolArray:
    """Pixels that fire more often than the spread of the others explains, [n].

    Rates are taken as log-normal and counts as Poisson; their spread is that of the pixels that
    are not hot, found by repetition.

    Args:
        counts: events of every pixel, [n].
        chosen: pixels that are looked at, [n].
    """
    number = int(chosen.sum())
    hot = chosen & (counts > np.quantile(counts[chosen], 1 - FIRST_CUT))
    sigmas = NormalDist().inv_cdf(1 - min(HOT_CHANCE / max(number, 1), 0.4))
    for _ in range(20):
        calm = counts[chosen & ~hot].astype(np.float64)
        mean = max(float(calm.mean()), 1 / number)
        spread = math.sqrt(math.log1p(_excess(mean, float((calm**2).mean()))))
        highest = mean * math.exp(sigmas * spread - spread**2 / 2)
        limit = highest + sigmas * math.sqrt(highest) + sigmas**2 / 3
        now = chosen & (counts > limit)
        if (now == hot).all():
            break
        hot = now
    return np.asarray(hot)


def _excess(mean: float, mean_square: float) -> float:
    """Squared relative spread of rates, from Poisson counts' mean and mean square."""
    return max(mean_square - mean * mean - mean, 0.0) / (mean * mean)


def _early_us(calm: PixelTrains, exposure_s: float, start: PhysicalConfig) -> float:
    """Waits below which no event is leak, µs; from the leak that a share of ON of ½ gives."""
    waits, share = calm.waits_us(), 0.5
    off = float((~calm.is_on).sum())
    early_us = math.inf
    for _ in range(4):
        noise_hz = off / (1 - share) / exposure_s
        surplus_hz = max((len(calm.t) - off - off * share / (1 - share)) / exposure_s, 0.0)
        leak_hz = leak_rate(noise_hz, surplus_hz, start.noise_decades, start.leak_rate_decades)
        early_us = EARLY * MICROSECONDS / leak_hz if leak_hz > 0 else math.inf
        early = waits < early_us
        if early.sum() < LEAST_COUNT:
            break
        share = min(float(calm.is_on[early].mean()), 0.99)
    return early_us


def _count(
    trains: PixelTrains,
    hot: BoolArray,
    rests: BoolArray,
    span: tuple[int, int],
    early_us: float,
    dead_us: float,
) -> _Counts:
    group = np.arange(len(rests)) % GROUPS
    calm = trains.at(~hot)
    window = (calm.t - span[0]) * WINDOWS // (span[1] - span[0])
    cell = np.minimum(window, WINDOWS - 1) * GROUPS + group[calm.pixel]
    early = calm.waits_us() < early_us
    kinds = (calm.is_on, ~calm.is_on, early & calm.is_on, early & ~calm.is_on)
    sums = [np.bincount(cell[kind], minlength=WINDOWS * GROUPS) for kind in kinds]
    off = calm.counts()[0].astype(np.float64)
    is_calm = rests & ~hot
    columns = (rests, is_calm, off * is_calm, off**2 * is_calm, trains.counts().sum(0) * hot)
    pixels = [np.bincount(group, weights=column, minlength=GROUPS) for column in columns]
    return _Counts(
        np.stack(sums, axis=-1).reshape(WINDOWS, GROUPS, 4).astype(np.float64),
        (span[1] - span[0]) / WINDOWS / MICROSECONDS,
        np.stack(pixels, axis=-1),
        dead_us / MICROSECONDS,
    )


def _estimate(
    counts: _Counts, start: PhysicalConfig, windows: Float64Array, groups: Float64Array
) -> _Values:
    on, off, early_on, early_off = np.einsum("w,g,wgk->k", windows, groups, counts.sums)
    pixels, calm, off_sum, off_squares, hot_events = groups @ counts.pixels
    if calm == 0:
        return _Values(*(math.nan,) * len(_Values._fields))
    seconds = counts.seconds * windows.sum()
    early = early_on + early_off
    share = early_on / early if early >= LEAST_COUNT else start.noise_on_fraction
    share = min(share, 0.99)
    noise_hz = off / (1 - share) / (calm * seconds)
    mean = off_sum / calm
    excess = _excess(mean, off_squares / calm) if mean > 0 else 0.0
    decades = math.sqrt(math.log1p(excess)) / math.log(10)
    surplus_hz = max((on - off * share / (1 - share)) / (calm * seconds), 0.0)
    hot = pixels - calm
    hot_hz = hot_events / (hot * counts.seconds * WINDOWS) if hot else math.nan
    # Events in the refractory period are lost; the usual noise comes on top; no leak in between.
    hot_hz = hot_hz / max(1 - hot_hz * counts.dead_s, 0.01) - noise_hz
    leak_hz = leak_rate(noise_hz, surplus_hz, decades, start.leak_rate_decades)
    return _Values(noise_hz, share, decades, leak_hz, hot / pixels, hot_hz)


def _judge(
    counts: _Counts,
    values: _Values,
    ends: Float64Array,
    start: PhysicalConfig,
    exposure_s: float,
) -> tuple[list[Estimate], list[UnidentifiedOption]]:
    """Estimates that rest on enough events, and the other options."""
    off, early = counts.sums[..., 1].sum(), counts.sums[..., 2:].sum()
    least_hz = 3.0 / exposure_s
    # Without an event, a rate of 3 per exposure would have shown one in 95 % of all cases.
    floor = np.array([least_hz, 0, 0, least_hz, 3.0 / counts.pixels[:, 0].sum(), 0])
    high = np.maximum(ends[1], floor)
    found = [
        Estimate("noise_rate_hz", values.noise_hz, ends[0, 0], high[0], "1/(px s)"),
        Estimate("hot_pixel_fraction", values.hot_fraction, ends[0, 4], high[4]),
    ]
    kept = []
    no_leak = f"indistinguishable from none; it is at most {high[3]:.2g}/s"
    is_leak = ends[0, 3] > 0 or start.leak_rate_hz > high[3]
    for place, name, is_enough, reason in (
        (3, "leak_rate_hz", is_leak, no_leak),
        (1, "noise_on_fraction", early >= LEAST_COUNT, "too few noise events follow one another"),
        (2, "noise_decades", off >= LEAST_COUNT and values.decades > 0, "too few noise events"),
        (5, "hot_pixel_rate_hz", values.hot_fraction > 0, "no pixel is hot"),
    ):
        if is_enough:
            unit = "1/(px s)" if name.endswith("_hz") else ""
            found.append(Estimate(name, values[place], ends[0, place], high[place], unit))
        else:
            kept.append(UnidentifiedOption(name, getattr(start, name), reason))
    return found, kept


def _with(start: PhysicalConfig, found: list[Estimate], noise_hz: float) -> PhysicalConfig:
    config = with_estimates(start, found)
    if noise_hz == 0:
        return dataclasses.replace(config, noise_scale=0.0)
    curve = f"{FLAT_LEVEL}:{noise_hz:.4g}"
    return dataclasses.replace(config, noise_curve=curve, noise_scale=1.0)


def _remarks(events: EventStream, rests: BoolArray) -> list[str]:
    remarks = ["noise is that of one light; the curve is flat until frames say how it falls"]
    if not rests.all():
        remarks.append(f"{rests.mean():.0%} of the sensor was at rest; the remainder is left out")
    hz = mains_flicker(events)
    if hz is not None:
        remarks.append(f"events follow a lamp at {hz:g} Hz: record under steady light instead")
    return remarks
