"""The definition of threshold crossings on linear segments, one at a time in float64."""

from __future__ import annotations

import math

import numpy as np

from texvent.simulate.esim.crossings import CrossingRules, CrossingState, SegmentCrossings, Segments


def cross_segments(
    segments: Segments, rules: CrossingRules, state: CrossingState
) -> SegmentCrossings:
    """Every threshold that brightness crosses on its segments, at the time it crosses it.

    On a segment the change is d(u) = start + u · (stop − start), u in 0..1, log units. The
    k-th ON event happens where d reaches k · θ_on, the k-th OFF event where it reaches −k · θ_off,
    for every k that the stop has reached; a level that the start had reached fires at once.
    The reference then moves by k · θ, also over crossings that fell into the refractory period.

    Args:
        segments: linear segments, by pixel and then in time.
        rules: thresholds and refractory period.
        state: updated in place.

    Returns:
        The events, times rounded down, never the stop of their segment.

    Source: Rebecq, Gehrig and Scaramuzza, "ESIM: an open event camera simulator", CoRL 2018,
        section 3.1.
    """
    events = []
    for row, segment in enumerate(zip(*(one.tolist() for one in segments), strict=True)):
        i, start_us, stop_us, before, now = segment
        first, last = before - float(state.reference[i]), now - float(state.reference[i])
        sign = 1 if last > 0 else -1
        threshold = rules.threshold_on if sign > 0 else rules.threshold_off
        first, last = sign * first, sign * last
        k = 0
        while last >= (k + 1) * threshold:
            k += 1
            level = k * threshold
            fraction = (level - first) / (last - first) if first < level else 0.0
            t = min(start_us + math.floor(fraction * (stop_us - start_us)), stop_us - 1)
            if rules.refractory_us:
                if t - int(state.fired_us[i]) < rules.refractory_us:
                    continue
                state.fired_us[i] = t
            events.append((row, t, sign > 0))
        state.reference[i] += sign * k * threshold
    row_of, t_of, p_of = np.array(events, np.int64).reshape(-1, 3).T
    return SegmentCrossings(row_of, t_of, p_of.astype(np.uint8))
