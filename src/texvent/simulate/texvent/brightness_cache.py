"""The brightness cache κ: the level each pixel compares with, and when it forgets it.

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
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.texvent.fired_pixels import EventFrame
from texvent.video import MICROSECONDS

CachePolicy = Literal["local", "global", "none"]
ResetRule = Literal["current", "step"]
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
