"""The brightness cache κ: the level each pixel compares with, and when it forgets it.

A pixel keeps its reference until it fires, as the reset of the circuit does, so that changes too
small for one sub-interval add up over several. How far back they may add up is the policy:

========  =========================================================================
none      one sub-interval: the reference is the previous frame, everywhere
local     one pair of source frames (the paper's)
leaky     at each source frame the reference moves to its brightness by a share
global    the whole stream, or `reset_pairs` pairs of source frames
========  =========================================================================
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.texvent.fired_pixels import EventFrame

CachePolicy = Literal["local", "global", "none", "leaky"]
ResetRule = Literal["current", "step"]
Renewal = Literal["keep", "leak", "renew"]
Float64Array = NDArray[np.float64]


class CacheSchedule:
    """When references are renewed: the policy, counted along the frames."""

    def __init__(self, policy: CachePolicy, reset_pairs: int = 0) -> None:
        """Begin before the first frame; arguments as for `BrightnessCache`."""
        self._policy = policy
        self._reset_pairs = reset_pairs
        self._pairs_seen = 0

    def renewal_after(self, *, is_source: bool) -> Renewal:
        """What happens to the references of all pixels once the next frame was compared with them.

        Args:
            is_source: whether it is a source frame, so that a pair begins with it.

        Equation: (5), section 3.2.2; local and global: supplement, Table 4; reset: Fig. 2.
        """
        if self._policy == "none" or (is_source and self._forgets()):
            return "renew"
        return "leak" if is_source and self._policy == "leaky" else "keep"

    def pass_frame(self, *, is_source: bool) -> Renewal:
        """The same, and count the frame."""
        renewal = self.renewal_after(is_source=is_source)
        self._pairs_seen += is_source
        return renewal

    def _forgets(self) -> bool:
        if self._policy == "local":
            return True
        return self._reset_pairs > 0 and self._pairs_seen % self._reset_pairs == 0


class BrightnessCache:
    """Reference brightness per pixel, with the policy that renews it."""

    def __init__(
        self,
        first: Float64Array,
        *,
        policy: CachePolicy = "local",
        leak: float = 0.0,
        reset_pairs: int = 0,
    ) -> None:
        """Start from the brightness of the first frame.

        Args:
            first: [H, W], log units; copied.
            policy: when the reference is renewed.
            leak: ρ of "leaky", 0..1: 0 is "global", 1 is "local".
            reset_pairs: with "leaky" and "global", forget everything every this many pairs of
                source frames; 0 = never.
        """
        self._reference = first.copy()
        self._leak = leak
        self._schedule = CacheSchedule(policy, reset_pairs)

    def calibrate(self, previous: Float64Array, *, is_source: bool) -> Float64Array:
        """The calibrated frame `κ ⋄ I^{j−1}`: what the next frame is compared with.

        Args:
            previous: brightness of the frame before, L(α + I^{j−1}), [H, W].
            is_source: whether that frame is a source frame, so that a pair begins with it.

        Returns:
            [H, W], log units: the cache's own array, changed by `update`.

        Equation: (5), section 3.2.2; see `CacheSchedule`.
        """
        renewal = self._schedule.pass_frame(is_source=is_source)
        if renewal == "renew":
            self._reference[...] = previous
        elif renewal == "leak":
            self._reference += self._leak * (previous - self._reference)
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
