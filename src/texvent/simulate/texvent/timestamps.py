"""Time stamp reconstruction (Eq. 7): where inside its sub-interval an event happened.

Every rule gives a fraction 0..1 of the sub-interval per event; `place_in` makes it µs.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.packets.interval import FrameInterval, place_in
from texvent.simulate.random.draws import Purpose, draw_uniforms
from texvent.simulate.texvent.fired_pixels import ThresholdCrossings

TimestampRule = Literal["eq7", "random", "linear", "hyperbolic", "even", "end"]
Float64Array = NDArray[np.float64]


class SubInterval(NamedTuple):
    """Time between two neighbouring frames, and the brightness of the pixels that fired in it."""

    span: FrameInterval
    """Time of both frames, and the key of the random draws between them."""
    width: int
    """Of the frame, pixels."""
    pixel: NDArray[np.int64]
    """[n] flat index y · W + x of the pixels that fired, ascending."""
    brightness: tuple[Float64Array, Float64Array, Float64Array]
    """Previous brightness, brightness and reference of each, [n] log units."""


def reconstruct_timestamps(
    crossings: ThresholdCrossings,
    interval: SubInterval,
    *,
    timestamp_rule: TimestampRule,
    threshold: float,
    scale: float = 1.0,
) -> NDArray[np.int64]:
    """Times of the events of one sub-interval.

    Args:
        crossings: the events.
        interval: the sub-interval they belong to.
        timestamp_rule: how.
        threshold: δ, log units.
        scale: γ of Eq. 7, 0..1; other rules do not use it.

    Returns:
        [n] µs, in `[start_us, stop_us)`.
    """
    if timestamp_rule == "eq7":
        return place_in(interval.span, scale * larger_change_earlier(crossings.change))
    return place_in(interval.span, _RULES[timestamp_rule](crossings, interval, threshold))


def larger_change_earlier(change: Float64Array) -> Float64Array:
    """The paper's rule: the largest change at the start, the smallest at the end.

    Args:
        change: brightness minus reference of every event pixel of the sub-interval, log units.

    Returns:
        u = 1 − (Δ − min Δ) / (max Δ − min Δ) with Δ = |change|.

    Equation: (7), section 3.2.2.
    Deviation: the range of Δ is that of the event pixels of this sub-interval (the paper does not
        say); where all Δ are equal, and the paper divides by zero, u = 1/2.

    Example:
        >>> larger_change_earlier(np.array([0.25, -0.30, 0.45])).round(3).tolist()
        [1.0, 0.75, 0.0]
    """
    if change.size == 0:
        return np.empty(0)
    size = np.abs(change)
    smallest, largest = size.min(), size.max()
    if largest == smallest:
        return np.full(change.shape, 0.5)
    return np.asarray(1.0 - (size - smallest) / (largest - smallest))


def random_time(
    crossings: ThresholdCrossings, interval: SubInterval, threshold: float
) -> Float64Array:
    """Uniform in the sub-interval: the paper's ablation E12."""
    y, x = np.divmod(crossings.pixel, interval.width)
    return draw_uniforms(interval.span.key, y, x, Purpose.TIMESTAMP.draw(crossings.order))


def linear_crossing(
    crossings: ThresholdCrossings, interval: SubInterval, threshold: float
) -> Float64Array:
    """When a straight line from the previous brightness to this one crosses the k-th threshold.

    (R ± kδ − L^{j−1}) / (L^j − L^{j−1}): exact for linear ramps, with any residual carried over.
    A crossing that lies before the sub-interval (left over from it) is put at its start.

    Source: ESIM (Rebecq, Gehrig and Scaramuzza, CoRL 2018).
    """
    row = np.searchsorted(interval.pixel, crossings.pixel)
    start, stop, reference = (column[row] for column in interval.brightness)
    sign = np.sign(crossings.change)
    level = reference + sign * (crossings.order * threshold)
    is_over = sign * (start - level) >= 0
    fraction = np.ones(level.shape)
    np.divide(level - start, stop - start, out=fraction, where=~is_over & (stop != start))
    fraction[is_over] = 0.0
    return np.clip(fraction, 0.0, 1.0)


def hyperbolic_crossing(
    crossings: ThresholdCrossings, interval: SubInterval, threshold: float
) -> Float64Array:
    """When a ramp that starts at the reference crosses the k-th threshold: kδ / Δ."""
    return np.minimum(crossings.order * threshold / np.abs(crossings.change), 1.0)


def even_spacing(
    crossings: ThresholdCrossings, interval: SubInterval, threshold: float
) -> Float64Array:
    """The k-th of n events of a pixel at k / n."""
    return np.asarray(crossings.order / crossings.number)


def interval_end(
    crossings: ThresholdCrossings, interval: SubInterval, threshold: float
) -> Float64Array:
    """All events at the end, as an event frame has them."""
    return np.ones(crossings.pixel.shape)


_RULES: Mapping[str, Callable[[ThresholdCrossings, SubInterval, float], Float64Array]] = {
    "random": random_time,
    "linear": linear_crossing,
    "hyperbolic": hyperbolic_crossing,
    "even": even_spacing,
    "end": interval_end,
}
