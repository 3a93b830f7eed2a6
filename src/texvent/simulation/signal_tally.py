"""Signal and noise of a run counted apart, and the reason where change in the video fires nothing.

A pixel whose brightness ranges over several thresholds must have fired, however slowly it changed
and whatever the frame rate: a run with hardly an event for each such pixel has lost its signal.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream
from texvent.frames import Frame

SAMPLE = 1 << 14
"""Pixels whose range is followed, about: a grid over the sensor."""
SEVERAL = 2.0
"""A pixel that ranges over so many thresholds has fired in any model that remembers."""
LOST_BELOW = 0.1
"""Signal events for each such pixel, below which the signal counts as lost."""
STILL_LEVELS = 2.0
"""Change that a codec makes of a video at rest, of 255."""
NOISY_ABOVE = 0.95
"""Share of noise from which a run is nearly all noise."""
HELD_BACK = (
    "filters, leak or refractory period of the simulator hold it back; give a lower "
    "contrast_threshold={lower:.2g}, another preset or another simulator"
)
"""Why and what to do, of a simulator that does not say it itself (`slow_change`)."""


class SignalTally:
    """Tally of one pass of a run: levels seen and events fired, with flat memory."""

    def __init__(self) -> None:
        self.begin(None)

    def begin(self, simulator: Any) -> None:
        """Forget everything; the next frames go to this simulator."""
        self.signal = self.noise = 0
        self._simulator = simulator
        self._low: NDArray[Any] = np.empty(0)
        self._high: NDArray[Any] = np.empty(0)
        self._pixels = 0

    def see(self, frame: Frame) -> None:
        """Note the levels of a source frame."""
        pixels = frame.size.width * frame.size.height
        sample = frame.sampled_luma(math.ceil(math.sqrt(pixels / SAMPLE)))
        if self._pixels == 0:
            self._low = self._high = sample
            self._pixels = pixels
        self._low, self._high = np.minimum(self._low, sample), np.maximum(self._high, sample)

    def count(self, packet: EventStream) -> None:
        """Count the events of a packet; without a label they are signal."""
        noise = 0 if packet.label is None else int(np.count_nonzero(packet.label))
        self.signal += len(packet) - noise
        self.noise += noise

    def warning(self, kept: str = "all") -> str | None:
        """Warning of a result hardly meant, its reason and the option that helps; else None.

        Options are written as keywords: `cache='global'`.

        Args:
            kept: which events the run keeps: "all", "signal" or "noise".
        """
        if kept == "noise":
            return None if self.noise else "no events: the run keeps those of noise alone"
        if self._pixels == 0:
            return None
        threshold = float(self._simulator.contrast_threshold)
        ranges = self._ranges()
        moved = float(np.mean(ranges >= SEVERAL * threshold))
        if self.signal < LOST_BELOW * moved * self._pixels:
            lower = HELD_BACK.format(lower=threshold / 2)
            reason = getattr(self._simulator, "slow_change", None) or lower
            return (
                f"{self._head()}, though {moved:.0%} of the pixels range over {SEVERAL:g} contrast "
                f"thresholds ({threshold:g} each) or more: {reason}"
            )
        if self.signal and self.noise <= NOISY_ABOVE * (self.signal + self.noise):
            return None
        return f"{self._head()}: {self._stillness(ranges, threshold)}"

    def _head(self) -> str:
        if self.signal:
            return f"only {self.signal:,} of {self.signal + self.noise:,} events are signal"
        return f"all {self.noise:,} events are noise" if self.noise else "no events"

    def _stillness(self, ranges: NDArray[Any], threshold: float) -> str:
        """Words for how little changes, and a threshold below the largest change, if any."""
        most_levels = float((self._high - self._low).max(initial=0.0))
        if most_levels <= STILL_LEVELS:
            return (
                f"the video stands still, no pixel changes by more than {most_levels:.0f} of 255 "
                f"levels; {self._dimness()}see `texvent check VIDEO`"
            )
        share = float(np.mean(ranges >= threshold))
        what = "nothing changed" if share == 0 else f"{share:.2%} of the pixels changed"
        advice, most = "check the video", float(ranges.max())
        if most > 0:
            lower = min(most, threshold) / 2
            advice = f"lower it, such as contrast_threshold={lower:.2g}, or check the video"
        return f"{what} by more than the contrast threshold ({threshold:g}); {advice}"

    def _dimness(self) -> str:
        is_mask = 0 < float(self._high.max(initial=0.0)) <= STILL_LEVELS
        return "give white_level=1 if they are masks of 0 and 1; " if is_mask else ""

    def _ranges(self) -> NDArray[Any]:
        """From the lowest to the highest brightness of each pixel followed, log units."""
        balance = float(self._simulator.balance)
        low, high = (one.astype(np.float64) + balance for one in (self._low, self._high))
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.asarray(np.nan_to_num(np.log(high / low), nan=0.0))
