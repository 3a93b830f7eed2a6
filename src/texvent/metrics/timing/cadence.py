"""Cadence energy: how strongly the event rate beats at the frame rate of the source video."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from texvent.events import EventStream
from texvent.metrics.protocol import UNDEFINED, Metric
from texvent.metrics.windows import bin_index
from texvent.video import MICROSECONDS

RATE_HZ = 4800
"""Bins per second of the event-rate histogram."""
HIGHEST_HZ = 600.0
WIDTH_BINS = 1.5
"""A line at k · fps is this many frequency bins (1/T) wide to each side: the Hann window's."""
LONGEST_SECONDS = 600.0
"""Longer recordings are refused rather than binned into huge histograms."""


def cadence_energy(
    events: EventStream, fps: Fraction = Fraction(24), *, span_us: tuple[int, int] | None = None
) -> float:
    """Share of the rate's spectrum, from fps/2 to 600 Hz, that lies at multiples of fps.

    Args:
        events: the stream.
        fps: frame rate of the video behind it.
        span_us: `[start, stop)` of the recording, µs; default: from the first event to the last.

    Returns:
        0..1: about 0.1 for an even spectrum over half a second; NaN if the span is empty, shorter
        than four frames, longer than ten minutes, or its rate constant.
    """
    first, stop = span_us or events.time_range or (0, 0)
    seconds = (stop - first) / MICROSECONDS
    if not 4 / fps <= seconds <= LONGEST_SECONDS:
        return UNDEFINED
    inside = events.cut(first, stop).t
    bins = -(-(stop - first) * RATE_HZ // MICROSECONDS)
    rate = np.bincount(bin_index(inside - first, Fraction(RATE_HZ)), minlength=bins).astype(float)
    energy = np.abs(np.fft.rfft((rate - rate.mean()) * np.hanning(rate.size))) ** 2
    frequency = np.fft.rfftfreq(rate.size, 1 / RATE_HZ)
    band = (frequency > float(fps) / 2) & (frequency < HIGHEST_HZ)
    offset = np.abs(frequency - np.rint(frequency / float(fps)) * float(fps))
    on_line = band & (offset <= WIDTH_BINS / seconds)
    total = float(energy[band].sum())
    # Rounding leaves traces of energy where the rate is constant.
    return float(energy[on_line].sum()) / total if total > 1e-9 * len(events) else UNDEFINED


@dataclass(frozen=True, kw_only=True)
class CadenceDifference(Metric):
    """Absolute difference of the cadence energies over the common span of both streams."""

    name = "cadence"
    needs = "any scene"
    blind_to = "everything but the beat of the total event rate: a diagnostic"

    fps: Fraction = Fraction(24)
    """Frame rate of the video behind the predicted stream."""

    def _score(self, predicted: EventStream, reference: EventStream) -> float:
        a, b = predicted.time_range, reference.time_range
        if a is None or b is None:
            return UNDEFINED
        span = (min(a[0], b[0]), max(a[1], b[1]))
        energies = (cadence_energy(one, self.fps, span_us=span) for one in (predicted, reference))
        return abs(next(energies) - next(energies))
