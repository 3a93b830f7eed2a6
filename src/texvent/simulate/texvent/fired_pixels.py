"""Event frame generation (Eq. 5): which pixels fire in a sub-interval, and how often."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class EventFrame(NamedTuple):
    """The events of one sub-interval, a row per pixel, in row-major order."""

    pixel: NDArray[np.int64]
    """[n] flat index y · W + x."""
    change: NDArray[np.float64]
    """[n] brightness minus reference brightness, log units; |change| ≥ δ, sign = polarity."""
    number: NDArray[np.int64]
    """[n] how many events it fires, at least 1."""


class ThresholdCrossings(NamedTuple):
    """The same with a row per event; those of a pixel follow each other."""

    pixel: NDArray[np.int64]
    change: NDArray[np.float64]
    number: NDArray[np.int64]
    order: NDArray[np.int64]
    """[n] which of its pixel's events this is: 1..number."""

    @property
    def polarity(self) -> NDArray[np.uint8]:
        """1 = ON, 0 = OFF, [n]."""
        return (self.change > 0).astype(np.uint8)


class TriggeredPixels(NamedTuple):
    """The pixels that fired in one sub-interval, in row-major order."""

    pixel: NDArray[np.int64]
    """[n] flat index y · W + x, ascending."""
    change: NDArray[np.float64]
    """[n] brightness minus reference brightness, log units; its sign is the polarity."""


def find_triggered_pixels(
    brightness: NDArray[np.float64], reference: NDArray[np.float64], threshold: float
) -> TriggeredPixels:
    """Pixels whose brightness lies `threshold` or more from their reference.

    Args:
        brightness: L(α + I^j), [H, W], log units.
        reference: reference brightness of each pixel, [H, W], log units.
        threshold: δ, log units, above 0.

    Equation: (1) for a pixel, (5), section 3.2.2.
    Deviation: Eq. 5 fires above δ, Eq. 1 from δ on, and Eq. 6 calls everything below δ background;
        `≥` makes events and background exact complements.
    """
    change = brightness - reference
    fired = np.abs(change) >= threshold
    return TriggeredPixels(np.flatnonzero(fired), change[fired])


def generate_event_frame(
    brightness: NDArray[np.float64],
    reference: NDArray[np.float64],
    *,
    threshold: float,
    multi_event: bool = False,
) -> EventFrame:
    """Compare brightness with the reference and let pixels fire.

    Args:
        brightness: L(α + I^j), [H, W], log units.
        reference: L(α + κ ⋄ I^{j−1}), [H, W], log units.
        threshold: δ, log units.
        multi_event: floor(|change| / δ) events per pixel instead of one.

    Equation: (5), section 3.2.2; and (1) for a pixel.
    Deviation: fires at δ itself (see `find_triggered_pixels`); the paper does not say how many
        events a change of several δ makes: one, unless `multi_event` is set.
    """
    pixel, change = find_triggered_pixels(brightness, reference, threshold)
    return EventFrame(pixel, change, count_events(change, threshold, multi_event=multi_event))


def count_events(
    change: NDArray[np.float64], threshold: float, *, multi_event: bool
) -> NDArray[np.int64]:
    """How many events each change of a threshold or more makes: floor(|change| / δ), or one."""
    if multi_event:
        return np.floor(np.abs(change) / threshold).astype(np.int64)
    return np.ones(change.size, np.int64)


def list_threshold_crossings(frame: EventFrame) -> ThresholdCrossings:
    """An event frame with a row per event.

    Example:
        >>> frame = EventFrame(np.array([4, 9]), np.array([0.25, -0.7]), np.array([1, 3]))
        >>> crossings = list_threshold_crossings(frame)
        >>> crossings.pixel.tolist(), crossings.order.tolist(), crossings.polarity.tolist()
        ([4, 9, 9, 9], [1, 1, 2, 3], [1, 0, 0, 0])
    """
    pixel, change, number = frame
    if int(number.sum()) == pixel.size:
        return ThresholdCrossings(pixel, change, number, number)
    first = np.cumsum(number) - number
    order = np.arange(int(number.sum())) - np.repeat(first, number) + 1
    return ThresholdCrossings(
        np.repeat(pixel, number), np.repeat(change, number), np.repeat(number, number), order
    )
