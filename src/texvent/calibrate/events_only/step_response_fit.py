"""Step response: bandwidth and refractory period from bursts after a step of light.

After a step of brightness by C, the output of a first-order photoreceptor lacks `C exp(−ω s)` at
the time s. A pixel that fires at s and next at s + d was held in reset for the refractory period r,
so its threshold is what the output changed from s + r to s + d:

    θ = C exp(−ω s) (exp(−ω r) − exp(−ω d))

Every pair of neighbouring events of a burst gives the threshold of its pixel. Bandwidth ω and
refractory period r are those with which the pairs of a pixel agree best, early and late in the
burst. A shift of s only changes the factor C, so the instant of the step is not needed.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from texvent.calibrate.estimates import Float64Array
from texvent.calibrate.events_only.flicker_cycles import Bursts
from texvent.calibrate.events_only.pixel_trains import BoolArray, Int64Array

BANDWIDTHS_HZ = np.geomspace(3.0, 10_000.0, 40)
"""Bandwidths at white that the search begins with."""
NEAR = np.array([0.5, 0.7, 1.0, 1.4, 2.0])
"""Factors on a bandwidth that is known roughly."""
SLOWNESSES = np.geomspace(0.03, 1.0, 15)
"""Bandwidths of the dark half over that of the bright one that its search begins with."""
DEAD_STEPS = 8
"""Refractory periods that it begins with, from 0 to the shortest intervals."""
SHORTEST = 0.002
"""Share of the intervals that may be shorter than the refractory period."""
FITTED_PAIRS, WEIGHED_PAIRS = 8_000, 60_000
"""Pairs of a polarity that bandwidth and refractory period are fitted to, and those that the
thresholds come from; of more, those of every n-th pixel."""
OUTLIER = 0.25
"""Relative deviation from the median of its pixel at which a pair has noise in it."""
ROUNDS = 5
"""Times that the fit is repeated without them."""
ROUNDED_US = 0.5
"""Mean amount by which times are rounded down, µs; a refractory period begins at the rounded
time."""
GOLDEN = (math.sqrt(5) - 1) / 2
STEP = 1e-3
"""Step of numerical derivatives, in the logarithm of both parameters."""


class Pairs(NamedTuple):
    """Neighbouring events of bursts of one polarity, of pixels with two pairs or more."""

    pixel: Int64Array
    """[n] 0..number of pixels − 1."""
    where: Int64Array
    """[pixels] y · W + x."""
    since_s: Float64Array
    """[n] time of the first of the two since the half began, s."""
    wait_s: Float64Array
    """[n] time between them, s."""
    cycle: Int64Array
    """[n]."""
    slowness: float
    """Bandwidth at this brightness over that at white."""

    def take(self, chosen: BoolArray) -> Pairs:
        """Some of the pairs, of pixels that keep two or more."""
        pixel = self.pixel[chosen]
        several = np.bincount(pixel, minlength=len(self.where))[pixel] >= 2
        place = np.flatnonzero(chosen)[several]
        numbers, pixel = np.unique(self.pixel[place], return_inverse=True)
        return self._replace(
            pixel=pixel,
            where=self.where[numbers],
            since_s=self.since_s[place],
            wait_s=self.wait_s[place],
            cycle=self.cycle[place],
        )

    def thinned(self, most: int) -> Pairs:
        """About `most` pairs: those of every n-th pixel."""
        every = -(-len(self.pixel) // most)
        return self.take(self.pixel % every == 0) if every > 1 else self


class StepResponseFit(NamedTuple):
    """Bandwidth and refractory period, and the pairs that agree."""

    omega: float
    """2π times the bandwidth at white, 1/s."""
    dead_s: float
    """Refractory period, s."""
    pairs: tuple[Pairs, ...]
    """All pairs without noise in them."""

    @property
    def disagreement(self) -> float:
        """Mean squared deviation of pairs from the mean of their pixel, of both polarities."""
        each = (disagreements(one, self.omega, self.dead_s) for one in self.pairs)
        return sum(float((one**2).mean()) for one in each)


def find_pairs(bursts: Bursts) -> Pairs:
    """Neighbouring events of bursts of one polarity, of pixels that have two pairs or more."""
    second = np.flatnonzero(bursts.follows)
    where, pixel = np.unique(bursts.pixel[second], return_inverse=True)
    since_us = bursts.since_us[second - 1]
    wait_us = bursts.since_us[second] - since_us + ROUNDED_US
    pairs = Pairs(pixel, where, since_us / 1e6, wait_us / 1e6, bursts.cycle[second], 1.0)
    return pairs.take(np.ones(len(pixel), np.bool_))


def pair_thresholds(pairs: Pairs, omega: float, dead_s: float) -> Float64Array:
    """Threshold of every pair over C, up to one factor for all, [n].

    Args:
        pairs: of one polarity.
        omega: 2π times the bandwidth at white, 1/s.
        dead_s: refractory period, s.
    """
    omega *= pairs.slowness
    remaining = math.exp(-omega * dead_s) - np.exp(-omega * pairs.wait_s)
    return np.asarray(np.exp(-omega * pairs.since_s) * remaining)


def pixel_means(pairs: Pairs, values: Float64Array) -> Float64Array:
    """Mean of a value of pairs over each pixel's, [pixels]."""
    number = np.bincount(pairs.pixel, minlength=len(pairs.where))
    return np.asarray(np.bincount(pairs.pixel, values, len(pairs.where)) / number)


def disagreements(pairs: Pairs, omega: float, dead_s: float) -> Float64Array:
    """Relative deviation of every pair from the mean of its pixel, [n]."""
    theta = pair_thresholds(pairs, omega, dead_s)
    mean = pixel_means(pairs, theta)
    return np.asarray((theta - mean[pairs.pixel]) / math.sqrt(max(float((mean**2).mean()), 1e-300)))


def fit_step_response(pairs: Sequence[Pairs]) -> StepResponseFit:
    """Bandwidth and refractory period at which pixels' pairs of OFF and of ON events agree best."""
    fitted = [one.thinned(FITTED_PAIRS) for one in pairs]
    kept, known = fitted, None
    for _ in range(ROUNDS):
        longest = float(np.quantile(np.concatenate([one.wait_s for one in kept]), SHORTEST))
        omega, dead_s = _search(kept, longest, known)
        known = omega
        kept = [one.take(~_outliers(one, omega, dead_s)) for one in fitted]
    calm = tuple(one.take(~_outliers(one, omega, dead_s)) for one in pairs)
    return StepResponseFit(omega, dead_s, calm)


def find_slowness(dark: Pairs, bright: Pairs) -> float:
    """Bandwidth in the dark half over that in the bright one.

    Args:
        dark: pairs of OFF events.
        bright: pairs of ON events, which give bandwidth and refractory period of their half.
    """
    fit = fit_step_response([bright])
    kept = dark = dark.thinned(FITTED_PAIRS)
    slowness = 1.0
    for _ in range(ROUNDS):

        def loss(log_slowness: float, pairs: Pairs = kept) -> float:
            slower = pairs._replace(slowness=math.exp(log_slowness))
            return float((disagreements(slower, fit.omega, fit.dead_s) ** 2).mean())

        around = min(np.log(SLOWNESSES).tolist(), key=loss)
        slowness = math.exp(golden(loss, around - 0.3, around + 0.3, 12)[0])
        dark = dark._replace(slowness=slowness)
        kept = dark.take(~_outliers(dark, fit.omega, fit.dead_s))
    return slowness


def _outliers(pairs: Pairs, omega: float, dead_s: float) -> BoolArray:
    theta = pair_thresholds(pairs, omega, dead_s)
    order = np.lexsort((theta, pairs.pixel))
    count = np.bincount(pairs.pixel, minlength=len(pairs.where))
    middle = theta[order][np.cumsum(count) - count + count // 2]
    return np.asarray(np.abs(theta / middle[pairs.pixel] - 1) > OUTLIER)


def _search(pairs: Sequence[Pairs], longest_s: float, known: float | None) -> tuple[float, float]:
    """Refractory periods on a grid, then by golden section; for each, the best bandwidth.

    Args:
        pairs: of both polarities.
        longest_s: the longest refractory period, s.
        known: ω near the best one, 1/s; by default anywhere.
    """

    def loss(omega: float, dead_s: float) -> float:
        return sum(float((disagreements(one, omega, dead_s) ** 2).mean()) for one in pairs)

    def best_omega(dead_s: float) -> tuple[float, float]:
        grid = BANDWIDTHS_HZ * 2 * math.pi if known is None else known * NEAR
        around = min(grid, key=lambda omega: loss(omega, dead_s))
        low, high = math.log(around / 1.3), math.log(around * 1.3)
        place, value = golden(lambda one: loss(math.exp(one), dead_s), low, high, 12)
        return math.exp(place), value

    step = longest_s / DEAD_STEPS
    around = step * min(range(DEAD_STEPS + 1), key=lambda number: best_omega(number * step)[1])
    low, high = max(around - step, 0.0), min(around + step, longest_s)
    dead_s, _ = golden(lambda one: best_omega(one)[1], low, high, 8)
    return best_omega(dead_s)[0], dead_s


def golden(
    function: Callable[[float], float], low: float, high: float, steps: int
) -> tuple[float, float]:
    """Minimum of a function on an interval by golden section: place and value.

    Example:
        >>> place, _ = golden(lambda x: (x - 2) ** 2, 0.0, 5.0, 30)
        >>> round(place, 4)
        2.0
    """
    left, right = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    at_left, at_right = function(left), function(right)
    for _ in range(steps):
        if at_left < at_right:
            high, right, at_right = right, left, at_left
            left = high - GOLDEN * (high - low)
            at_left = function(left)
        else:
            low, left, at_left = left, right, at_right
            right = low + GOLDEN * (high - low)
            at_right = function(right)
    return (left, at_left) if at_left < at_right else (right, at_right)


class InfluenceFunction(NamedTuple):
    """First-order change of the fit with the weights of parts of the data."""

    gradient: Float64Array
    """[windows, groups, 2] of half the squared disagreement, by (ln ω, r in units of its scale)."""
    curvature: Float64Array
    """[windows, groups, 2, 2]."""
    scale_s: float

    def parameters(
        self, fit: StepResponseFit, windows: Float64Array, groups: Float64Array
    ) -> tuple[float, float]:
        """ω and r of a resample."""
        gradient = np.einsum("w,g,wgk->k", windows, groups, self.gradient)
        whole = self.gradient.sum(axis=(0, 1))
        curvature = np.einsum("w,g,wgkl->kl", windows, groups, self.curvature)
        # The search ends near the minimum, not at it: what is left of the gradient there is none.
        share = float(np.trace(curvature) / np.trace(self.curvature.sum(axis=(0, 1))))
        step = np.linalg.lstsq(curvature, share * whole - gradient, rcond=None)[0]
        omega = fit.omega * math.exp(min(max(float(step[0]), -3.0), 3.0))
        return omega, max(fit.dead_s + self.scale_s * float(step[1]), 0.0)


def find_influence(
    fit: StepResponseFit, windows: int, groups: int, cycles: int
) -> InfluenceFunction:
    """The influence of windows of time and groups of pixels on a fit."""
    scale_s = float(np.median(np.concatenate([one.wait_s for one in fit.pairs])))
    gradient = np.zeros((windows * groups, 2))
    curvature = np.zeros((windows * groups, 2, 2))
    for pairs in fit.pairs:
        window = np.minimum(pairs.cycle * windows // max(cycles, 1), windows - 1)
        cell = window * groups + pairs.where[pairs.pixel] % groups
        size = windows * groups
        here = disagreements(pairs, fit.omega, fit.dead_s)
        slopes = (
            (disagreements(pairs, fit.omega * math.exp(STEP), fit.dead_s) - here) / STEP,
            (disagreements(pairs, fit.omega, fit.dead_s + STEP * scale_s) - here) / STEP,
        )
        for row, slope in enumerate(slopes):
            gradient[:, row] += np.bincount(cell, slope * here, size) / len(here)
            for column, other in enumerate(slopes):
                product = np.bincount(cell, slope * other, size) / len(here)
                curvature[:, row, column] += product
    shape = windows, groups
    return InfluenceFunction(gradient.reshape(*shape, 2), curvature.reshape(*shape, 2, 2), scale_s)
