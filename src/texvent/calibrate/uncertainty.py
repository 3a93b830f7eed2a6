"""Uncertainty of options fitted to frames and events.

The fitted part is cut into 20 blocks, fewer of 10 ms if it is short, and the bootstrap draws
blocks. Thresholds follow from counts: an interval of the count ratio is one of the threshold, by
the power with which the count falls. For balance and cutoff, the least distance is at the vertex
of a parabola through the distances at half, once and twice the value. Thresholds change with both:
how far they would, from end to end of those intervals, adds to their own in quadrature.
"""

from __future__ import annotations

import dataclasses
import math
from typing import NamedTuple

import numpy as np

from texvent.calibrate.estimates import (
    Estimate,
    Float64Array,
    Measurement,
    UnidentifiedOption,
    bootstrap,
)
from texvent.calibrate.recording import TimeSpan
from texvent.calibrate.search import COORDINATES, STEPS, Search, measure_distance
from texvent.events import EventStream
from texvent.simulation.physical.config import PhysicalConfig

BLOCK_US = 10_000
"""Shortest block."""
MOST_BLOCKS = 20
FACTOR = 2.0
"""Factor of balance and cutoff in the search for a rise of the distance."""
FARTHEST = 1.5 * math.log(FACTOR)
"""A vertex farther away, in the logarithm, is at no known place."""
NEAREST = math.log(STEPS[-1]) / 2
"""Half of the last step of the search, in the logarithm: no interval is shorter."""
THRESHOLD_FACTOR = 1.1
"""Factor of the thresholds in the measurement of falling counts."""
LEAST_POWER = 0.3
"""The least power with which counts fall that is believed."""


class OptionInterval(NamedTuple):
    """Interval of an option, in the logarithm, and its effect on the thresholds."""

    low: float
    """Lower end of the 95 % interval from the value, 0 or less; −∞ where the distance does not
    rise."""
    high: float
    slopes: Float64Array
    """[2] change of the logarithms of threshold and ON/OFF ratio with that of the option, counts
    matched."""

    @property
    def is_unknown(self) -> bool:
        """Whether the distance rises to neither side."""
        return math.isinf(self.low) and math.isinf(self.high)

    def threshold_ends(self) -> Float64Array:
        """[2 ends, 2] how much lower and higher the thresholds may be because of this option."""
        ends = np.clip([self.low, self.high], -FARTHEST, FARTHEST)[:, None] * self.slopes
        return np.array([np.minimum(ends.min(0), 0.0), np.maximum(ends.max(0), 0.0)])


def judge_fit(
    search: Search, truth: EventStream, span: TimeSpan, best: PhysicalConfig, start: PhysicalConfig
) -> Measurement:
    """Intervals of thresholds, balance and cutoff."""
    blocks = cut_blocks(span)
    found: list[Estimate] = []
    kept: list[UnidentifiedOption] = []
    others = np.zeros((2, 2))
    for name in search.coordinates:
        option = _judge_option(search, truth, blocks, best, name)
        others += option.threshold_ends() ** 2
        value = getattr(best, name)
        if option.is_unknown:
            best = dataclasses.replace(best, **{name: getattr(start, name)})
            reason = "half and twice the value fit as well"
            kept.append(UnidentifiedOption(name, getattr(start, name), reason))
        else:
            unit = "Hz" if name.endswith("hz") else ""
            low, high = value * math.exp(option.low), value * math.exp(option.high)
            found.append(Estimate(name, value, low, high, unit))
    if kept:
        best = search.match_counts(best).config
    kept += [
        UnidentifiedOption(name, getattr(best, name), "as asked")
        for name in COORDINATES
        if name not in search.coordinates
    ]
    thresholds = _thresholds(search, truth, blocks, best, others)
    return Measurement(config=best, found=(*thresholds, *found), kept=tuple(kept))


def cut_blocks(span: TimeSpan) -> list[TimeSpan]:
    """Equal blocks of a span, 10 ms or longer if the span is, at most 20.

    Example:
        >>> [block.start_us for block in cut_blocks(TimeSpan(0, 35_000))]
        [0, 11666, 23333]
    """
    length = span.stop_us - span.start_us
    number = min(max(length // BLOCK_US, 1), MOST_BLOCKS)
    edges = [span.start_us + length * place // number for place in range(number + 1)]
    return [TimeSpan(*edges[place : place + 2]) for place in range(number)]


def _judge_option(
    search: Search,
    truth: EventStream,
    blocks: list[TimeSpan],
    best: PhysicalConfig,
    name: str,
) -> OptionInterval:
    """The 95 % interval of an option, and what thresholds do along it."""
    value = getattr(best, name)
    if value == 0:  # unlimited
        return OptionInterval(-math.inf, math.inf, np.zeros(2))
    distances, thresholds = np.empty((3, len(blocks))), []
    for row, factor in enumerate((1 / FACTOR, 1.0, FACTOR)):
        config = dataclasses.replace(best, **{name: value * factor})
        if factor != 1.0:
            config = search.match_counts(config).config
        distances[row] = _block_distances(search.simulate(config), truth, blocks)
        thresholds.append(np.log([config.contrast_threshold, config.on_off_ratio]))
    slopes = (thresholds[2] - thresholds[0]) / (2 * math.log(FACTOR))
    if (distances == distances[1]).all():  # it has no effect here
        return OptionInterval(-math.inf, math.inf, slopes)
    shifts = bootstrap(lambda weights: np.array([vertex(distances @ weights)]), (len(blocks),))
    low, high = shifts[:, 0].tolist()
    return OptionInterval(
        -math.inf if low <= -FARTHEST else min(low, -NEAREST),
        math.inf if high >= FARTHEST else max(high, NEAREST),
        slopes,
    )


def vertex(distances: Float64Array) -> float:
    """Vertex of a parabola through distances at −ln 2, 0 and ln 2.

    Args:
        distances: [3].

    Returns:
        The place, at most `FARTHEST` from 0; there, too, without a minimum.

    Example:
        >>> round(vertex(np.array([4.0, 1.0, 0.0])), 3)  # y = (x / ln 2 - 1)²
        0.693
    """
    left, middle, right = map(float, distances)
    bend = left - 2 * middle + right
    if bend <= 0:
        return math.copysign(FARTHEST, left - right)
    shift = 0.5 * math.log(FACTOR) * (left - right) / bend
    return min(max(shift, -FARTHEST), FARTHEST)


def _block_distances(
    simulated: EventStream, truth: EventStream, blocks: list[TimeSpan]
) -> Float64Array:
    """Overlap and intervals, by block; the counts are matched as a whole."""
    parts = [measure_distance(simulated.cut(*block), truth.cut(*block)) for block in blocks]
    return np.array([one.overlap + one.intervals for one in parts])


def _thresholds(
    search: Search,
    truth: EventStream,
    blocks: list[TimeSpan],
    best: PhysicalConfig,
    others: Float64Array,
) -> list[Estimate]:
    """Threshold and ratio of ON and OFF, from counts by block.

    `others`: [2 ends, 2] squared shifts of both that follow from the intervals of other options.
    """
    wider = dataclasses.replace(best, contrast_threshold=best.contrast_threshold * THRESHOLD_FACTOR)
    streams = search.simulate(best), search.simulate(wider), truth
    counts = np.array([[_counts(one.cut(*block)) for block in blocks] for one in streams])
    powers = np.log(counts[0].sum(0) / counts[1].sum(0)) / math.log(THRESHOLD_FACTOR)
    powers = np.maximum(powers, LEAST_POWER)

    def estimate(weights: Float64Array) -> Float64Array:
        simulated, _, recorded = np.maximum(np.einsum("b,sbp->sp", weights, counts), 0.5)
        off, on = np.log(simulated / recorded) / powers
        return np.array([(on + off) / 2, on - off])

    own = bootstrap(estimate, (len(blocks),)) - estimate(np.ones(len(blocks)))
    shifts = widen(own, others)
    return [
        Estimate(name, value, value * math.exp(low), value * math.exp(high), unit)
        for name, unit, value, (low, high) in zip(
            ("contrast_threshold", "on_off_ratio"),
            ("ln", ""),
            (best.contrast_threshold, best.on_off_ratio),
            shifts.T.tolist(),
            strict=True,
        )
    ]


def widen(own: Float64Array, others: Float64Array) -> Float64Array:
    """Ends of intervals below and above, [2, k], with independent squared shifts added."""
    return np.sign([[-1], [1]]) * np.sqrt(own**2 + others)


def _counts(events: EventStream) -> tuple[int, int]:
    """OFF and ON events."""
    on = int(events.p.sum())
    return len(events) - on, on
