"""Event frames (Eq. 5) and the brightness cache κ, the level that each pixel compares with.

A pixel keeps its reference until it fires, as the reset of the circuit does, so that changes too
small for one sub-interval add up over several. How far back they may add up is the policy:

========  =========================================================================
none      one sub-interval: the reference is the previous frame, everywhere
local     one pair of source frames (the paper's)
global    the whole stream, or as long as the residual decay leaves of it
========  =========================================================================

The residual decay is a rate per second: over a time t a reference covers the share
1 − exp(−decay · t) of its distance to the brightness. It is applied at source frames, as soon as
the share since the last time is `LEAST_SHARE`, so that neither the frame rate nor the number of
intermediate frames changes what is forgotten, and high-speed video pays no more for it.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.texvent.config import CachePolicy
from texvent.video import MICROSECONDS


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


def find_triggered_pixels(
    brightness: NDArray[np.float64], reference: NDArray[np.float64], threshold: float
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Pixels whose brightness differs by `threshold` or more from their reference.

    Args:
        brightness: L(α + I^j), [H, W], log units.
        reference: reference brightness of each pixel, [H, W], log units.
        threshold: δ, log units, above 0.

    Returns:
        Flat indices y · W + x, ascending, [n]; and brightness minus reference, [n] log units, whose
        sign is the polarity.

    Equation: (1) for a pixel, (5), section 3.2.2.
    Deviation: Eq. 5 fires above δ, Eq. 1 from δ on, and Eq. 6 calls everything below δ background;
        `≥` makes events and background exact complements.
    """
    change = brightness - reference
    fired = np.abs(change) >= threshold
    return np.flatnonzero(fired), change[fired]


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
    """Number of events of each change of a threshold or more: floor(|change| / δ), or one."""
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


Float64Array = NDArray[np.float64]

LEAST_SHARE = 0.01
"""Share of a residual that decays at a time, at least."""


class CacheSchedule:
    """Shares by which references move to the brightness, followed along the frames."""

    def __init__(self, policy: CachePolicy, decay_hz: float = 0.0) -> None:
        """Begin before the first frame; arguments as for `BrightnessCache`."""
        self._policy, self._decay_hz = policy, decay_hz
        self._decayed_us: int | None = None

    def share_after(self, t_us: int, *, is_source: bool) -> float:
        """Share by which every reference moves to a frame once it was compared with that frame.

        Args:
            t_us: time of the frame.
            is_source: whether it is a source frame, so that a pair begins with it.

        Returns:
            0 keeps the references, 1 replaces them; in between they decay.

        Equation: (5), section 3.2.2; local and global: supplement, Table 4.
        """
        if self._policy == "none" or (is_source and self._policy == "local"):
            return 1.0
        if not is_source or self._policy == "local" or self._decayed_us is None:
            return 0.0
        share = -math.expm1(-self._decay_hz * (t_us - self._decayed_us) / MICROSECONDS)
        return share if share >= LEAST_SHARE else 0.0

    def pass_frame(self, t_us: int, *, is_source: bool) -> float:
        """The same, and remember the frame."""
        share = self.share_after(t_us, is_source=is_source)
        if share or self._decayed_us is None:
            self._decayed_us = t_us
        return share


class BrightnessCache:
    """Reference brightness per pixel, with the policy that renews it."""

    def __init__(
        self, first: Float64Array, *, policy: CachePolicy = "local", decay_hz: float = 0.0
    ) -> None:
        """Start from the brightness of the first frame.

        Args:
            first: [H, W], log units; copied.
            policy: when the reference is renewed.
            decay_hz: rate at which "global" references decay towards the brightness, 1/s.
        """
        self._reference = first.copy()
        self._schedule = CacheSchedule(policy, decay_hz)

    def calibrate(self, previous: Float64Array, t_us: int, *, is_source: bool) -> Float64Array:
        """The calibrated frame `κ ⋄ I^{j−1}`: what the next frame is compared with.

        Args:
            previous: brightness of the frame before, L(α + I^{j−1}), [H, W].
            t_us: its time.
            is_source: whether that frame is a source frame, so that a pair begins with it.

        Returns:
            [H, W], log units: the cache's own array, changed by `update`.

        Equation: (5), section 3.2.2; see `CacheSchedule`.
        """
        share = self._schedule.pass_frame(t_us, is_source=is_source)
        if share == 1:
            self._reference[...] = previous
        elif share:
            self._reference += share * (previous - self._reference)
        return self._reference

    def update(self, fired: EventFrame, brightness: Float64Array, *, step: float | None) -> None:
        """Renew the reference at the pixels that fired, and only there.

        Args:
            fired: the events of the sub-interval.
            brightness: L(α + I^j), [H, W]: the new reference where a pixel fired (the paper's
                reading), unless `step` is given.
            step: δ: move the reference by δ per event instead, as the circuit and ESIM do; what
                a change exceeds its threshold by is then kept for the next sub-interval.
        """
        reference = self._reference.reshape(-1)
        if step is None:
            reference[fired.pixel] = brightness.reshape(-1)[fired.pixel]
        else:
            reference[fired.pixel] += np.sign(fired.change) * (fired.number * step)
