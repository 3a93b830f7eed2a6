"""A flat field that switches between two brightnesses: thresholds, bandwidth, refractory period.

`step_response_fit.py` gives bandwidth, refractory period and the thresholds of pixels up to a
factor per polarity, because the instant of the step is not known. The factors follow from the first
event of each burst. At the step, the output of a pixel is somewhere between its last reset and
the next opposite threshold, on average half of that away; so the first ON event comes when the
output has changed by θ_on + θ_off / 2, and the first OFF event likewise.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from texvent.calibrate.estimates import (
    Estimate,
    Float64Array,
    Measurement,
    UnidentifiedOption,
    bootstrap,
    with_estimates,
)
from texvent.calibrate.events_only.flicker_cycles import Bursts, Cycles, find_bursts, find_cycles
from texvent.calibrate.events_only.pixel_trains import PixelTrains
from texvent.calibrate.events_only.step_response_fit import (
    FITTED_PAIRS,
    WEIGHED_PAIRS,
    Pairs,
    StepResponseFit,
    find_influence,
    find_pairs,
    find_slowness,
    fit_step_response,
    pair_thresholds,
    pixel_means,
)
from texvent.errors import InputError
from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent.simulation.physical.circuit import WHITE
from texvent.simulation.physical.config import PhysicalConfig
from texvent.simulation.physical.threshold_map import ThresholdMap

WINDOWS, GROUPS = 10, 100
"""Windows of time and groups of pixels that the bootstrap draws."""
LEAST_PAIRS = 300
"""Pairs of events of a polarity without which nothing is measured."""
MOST_LOST = 1.0
"""Time constants of the bright half that the refractory period may last: of what changes after a
longer one, too little is left for a second event."""
SETTLED = 3.0
"""Time constants that half a cycle must have."""
WIDEST = 3.0
"""Upper over lower end of an interval from which on the old value stays."""
MUCH_BETTER = 0.5
"""Squared disagreement over that with the model's bandwidth in the dark half, below which the one
of the bursts is taken."""
NAMES = (
    "contrast_threshold",
    "on_off_ratio",
    "threshold_sigma",
    "cutoff_hz",
    "refractory_period_us",
)
UNITS = ("ln", "", "ln", "Hz", "µs")
SYSTEMATIC = np.array([0.02, 0.03, 0.05, 0.01, 0.01])
"""Relative error of each that more data do not remove, from simulated sensors: intervals are that
much wider on both sides."""


EXCESS_ERROR = 0.05
"""Relative error of the bandwidth of the dark half over that of the bright one."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Flicker(Measurement):
    """Measurement of a flickering field."""

    cycles: Cycles
    thresholds: ThresholdMap
    """Thresholds of every pixel, over the mean of all."""


class _Polarity(NamedTuple):
    """Bursts of one polarity."""

    pairs: Pairs
    first_s: Float64Array
    """[bursts] time of their first events, s."""
    first_cell: np.ndarray
    """[bursts] window · groups + group."""


def measure_flicker(
    events: EventStream, start: PhysicalConfig, *, hz: float, ratio: float | None
) -> Flicker:
    """Measure thresholds, bandwidth and refractory period in a flickering field.

    Args:
        events: of a sensor whose whole field switches between two brightnesses, bright and dark for
            half of each cycle.
        start: source of options that the recording cannot identify; its balance is taken for true.
        hz: frequency of the light, within 2 %.
        ratio: bright over dark; without it thresholds are known only relative to one another.

    Raises:
        InputError: the events do not follow the flicker, or bursts are too short.
    """
    cycles = find_cycles(events, hz)
    trains = PixelTrains.of(events)
    bursts = tuple(find_bursts(trains, cycles, p) for p in (0, 1))
    off, on = (find_pairs(one) for one in bursts)
    _check(off, on)
    fit = _fit(off, on, ratio, start.balance)
    dark = fit.pairs[0].slowness
    weighed = tuple(one.thinned(WEIGHED_PAIRS) for one in fit.pairs)
    sides = tuple(_polarity(one, bursts[p], cycles.number) for p, one in enumerate(weighed))
    fitted = fit._replace(pairs=tuple(one.thinned(FITTED_PAIRS) for one in fit.pairs))
    influence = find_influence(fitted, WINDOWS, GROUPS, cycles.number)

    def estimate(windows: Float64Array, groups: Float64Array) -> Float64Array:
        omega, dead_s = influence.parameters(fit, windows, groups)
        return _estimate(sides, omega, dead_s, windows, groups)

    values = _estimate(sides, fit.omega, fit.dead_s, np.ones(WINDOWS), np.ones(GROUPS))
    ends = bootstrap(estimate, (WINDOWS, GROUPS))
    scale = np.ones(len(NAMES))
    # Without the ratio, both thresholds have the mean that they start with.
    scale[[0, 2]] = (
        _contrast(ratio, start.balance) if ratio else start.contrast_threshold / values[0]
    )
    ends *= scale * (1 + np.outer([-1, 1], SYSTEMATIC))
    found, kept = _judge(values * scale, ends, start, ratio)
    if ratio is not None:
        start = dataclasses.replace(start, cutoff_limit_hz=0.0)
        found = _with_limit(found, dark / _modelled_slowness(ratio, start.balance))
    if fit.omega * fit.dead_s > MOST_LOST:
        found, kept = [], _lost(fit, start, kept)
    return Flicker(
        config=with_estimates(start, found),
        found=tuple(found),
        kept=tuple(kept),
        remarks=(*_settling(fit, cycles, dark), *_remark(dark, ratio, start.balance)),
        cycles=cycles,
        thresholds=_map_thresholds(fit, events.size),
    )


def _check(off: Pairs, on: Pairs) -> None:
    least = min(len(off.pixel), len(on.pixel))
    if least < LEAST_PAIRS:
        raise InputError(
            f"only {least} pairs of events in bursts of three and more; calibration needs "
            f"{LEAST_PAIRS} of each polarity. Make the bright half brighter against the dark one, "
            "record longer, or use less light if pixels are still in reset when the burst ends"
        )


def _fit(off: Pairs, on: Pairs, ratio: float | None, balance: float) -> StepResponseFit:
    """The fit with the bandwidth of the dark half that the model has for that ratio.

    Where the bandwidth of the bursts fits much better, it is taken.
    """
    free = fit_step_response([off._replace(slowness=find_slowness(off, on)), on])
    if ratio is None:
        return free
    modelled = fit_step_response([off._replace(slowness=_modelled_slowness(ratio, balance)), on])
    is_better = free.disagreement < MUCH_BETTER * modelled.disagreement
    return free if is_better else modelled


def _modelled_slowness(ratio: float, balance: float) -> float:
    """Bandwidth of the dark half over that of the bright one in the model."""
    return (WHITE / ratio + balance) / (WHITE + balance)


def _contrast(ratio: float, balance: float) -> float:
    """Change of ln(α + I) between the halves; the bright one is white."""
    return math.log((WHITE + balance) / (WHITE / ratio + balance))


def _polarity(pairs: Pairs, bursts: Bursts, cycles: int) -> _Polarity:
    first = np.ones(len(bursts.pixel), np.bool_)
    first[1:] = (np.diff(bursts.pixel) != 0) | (np.diff(bursts.cycle) != 0)
    first &= np.isin(bursts.pixel, pairs.where)
    window = np.minimum(bursts.cycle[first] * WINDOWS // cycles, WINDOWS - 1)
    cell = window * GROUPS + bursts.pixel[first] % GROUPS
    return _Polarity(pairs, bursts.since_us[first] / 1e6, cell)


def _estimate(
    sides: tuple[_Polarity, ...],
    omega: float,
    dead_s: float,
    windows: Float64Array,
    groups: Float64Array,
) -> Float64Array:
    """The constants of `NAMES`, thresholds over C."""
    cells = np.outer(windows, groups).reshape(-1)
    mean, spread, lacks = np.zeros(2), np.zeros(2), np.zeros(2)
    for p, side in enumerate(sides):
        theta = pair_thresholds(side.pairs, omega, dead_s)
        each = pixel_means(side.pairs, theta)
        weight = groups[side.pairs.where % GROUPS]
        if not weight.any() or not cells[side.first_cell].any():
            return np.full(len(NAMES), np.nan)
        mean[p] = np.average(each, weights=weight)
        within = pixel_means(side.pairs, (theta - each[side.pairs.pixel]) ** 2)
        number = np.bincount(side.pairs.pixel, minlength=len(each))
        noise = within / np.maximum(number - 1, 1)
        variance = np.average((each - mean[p]) ** 2 - noise, weights=weight)
        spread[p] = math.sqrt(max(variance, 0.0))
        left = np.exp(-omega * side.pairs.slowness * side.first_s)
        lacks[p] = np.average(left, weights=cells[side.first_cell])
    # (lacks + mean) g + other mean · other g / 2 = 1 for both polarities.
    matrix = np.diag(lacks + mean) + np.array([[0, mean[1]], [mean[0], 0]]) / 2
    factors = np.linalg.solve(matrix, np.ones(2))
    off, on = factors * mean
    if min(on, off) <= 0:
        return np.full(len(NAMES), np.nan)
    sigma = math.sqrt(float(((factors * spread) ** 2).mean()))
    return np.array([math.sqrt(on * off), on / off, sigma, omega / (2 * math.pi), dead_s * 1e6])


def _judge(
    values: Float64Array, ends: Float64Array, start: PhysicalConfig, ratio: float | None
) -> tuple[list[Estimate], list[UnidentifiedOption]]:
    """Constants that the bursts identify, and the other options."""
    found, kept = [], []
    for place, (name, unit) in enumerate(zip(NAMES, UNITS, strict=True)):
        low, high = ends[:, place]
        if name == "contrast_threshold" and ratio is None:
            kept.append(
                UnidentifiedOption(name, start.contrast_threshold, "--flicker-ratio is not given")
            )
        elif not math.isfinite(values[place]) or not high <= WIDEST * low:
            reason = f"bursts allow {low:.3g} to {high:.3g} {unit}".rstrip()
            kept.append(UnidentifiedOption(name, getattr(start, name), reason))
        else:
            found.append(Estimate(name, float(values[place]), low, high, unit))
    reason = "a flickering field cannot identify it"
    kept += [
        UnidentifiedOption(name, getattr(start, name), reason)
        for name in ("noise_curve", "leak_rate_hz", "hot_pixel_fraction")
    ]
    return found, kept


def _with_limit(found: list[Estimate], excess: float) -> list[Estimate]:
    """Bandwidths where that of the bright half is limited by more than the light.

    Args:
        found: constants, with the bandwidth of the bright half as that at white.
        excess: bandwidth of the dark half over that of the bright one, over what the model has.
    """
    if excess <= 1.0:
        return found
    limit = [one._replace(name="cutoff_limit_hz") for one in found if one.name == "cutoff_hz"]
    for place, one in enumerate(found):
        if one.name == "cutoff_hz":
            low, high = one.low * (1 - EXCESS_ERROR), one.high * (1 + EXCESS_ERROR)
            found[place] = Estimate(
                one.name, one.value * excess, low * excess, high * excess, one.unit
            )
    return [*found, *limit]


def _lost(
    fit: StepResponseFit, start: PhysicalConfig, kept: list[UnidentifiedOption]
) -> list[UnidentifiedOption]:
    """Options unidentified because most of the change falls into refractory periods."""
    reason = (
        f"the refractory period lasts {fit.omega * fit.dead_s:.1f} time constants of the "
        f"photoreceptor, at most {MOST_LOST:g} is measured; use less light"
    )
    others = [one for one in kept if one.name not in NAMES]
    return [*(UnidentifiedOption(name, getattr(start, name), reason) for name in NAMES), *others]


def _settling(fit: StepResponseFit, cycles: Cycles, slowness: float) -> list[str]:
    constants = fit.omega * slowness * 0.5 / cycles.hz
    if constants >= SETTLED:
        return []
    return [
        f"half a cycle lasts {constants:.1f} time constants of the dark half; pixels do not settle "
        f"in less than {SETTLED:g}, so thresholds come out too large: flicker slower"
    ]


def _remark(slowness: float, ratio: float | None, balance: float) -> list[str]:
    """Says so where the bandwidth falls faster with the light than the model's does."""
    if ratio is None or slowness >= (modelled := _modelled_slowness(ratio, balance)):
        return []
    return [
        f"the dark half has {slowness:.2f} of the bandwidth of the bright one, in the model "
        f"{modelled:.2f}: cutoff_hz holds for bright pixels"
    ]


def _map_thresholds(fit: StepResponseFit, size: SensorSize) -> ThresholdMap:
    off, on = np.full((2, size.width * size.height), np.nan)
    for one, pairs in zip((off, on), fit.pairs, strict=True):
        each = pixel_means(pairs, pair_thresholds(pairs, fit.omega, fit.dead_s))
        one[pairs.where] = each / each.mean()
    return ThresholdMap(on.reshape(size.shape), off.reshape(size.shape))
