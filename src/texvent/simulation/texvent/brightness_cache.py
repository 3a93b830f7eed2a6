"""The brightness cache κ (Eq. 5): how long a pixel keeps the reference that it compares with.

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

from texvent.frames import MICROSECONDS
from texvent.simulation.texvent.config import CachePolicy

LEAST_SHARE = 0.01
"""Share of a residual that decays at a time, at least."""


class CacheSchedule:
    """Shares by which references move to the brightness, followed along the frames."""

    def __init__(self, policy: CachePolicy, decay_hz: float = 0.0) -> None:
        """Begin before the first frame.

        Args:
            policy: when references are renewed.
            decay_hz: rate at which "global" references decay towards the brightness, 1/s.
        """
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
