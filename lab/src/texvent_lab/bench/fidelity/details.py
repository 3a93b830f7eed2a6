"""Where a simulator's events are wrong: by pyramid level, by time, and by the motion they show."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream
from texvent.metrics.event_sharpness import estimate_velocities, flow_warp_sharpness
from texvent.metrics.spike_trains import Trains, time_to_nearest
from texvent.metrics.stpp import Stpp

CAP_US = 10_000
BIN_US = 500
BINS = 2 * CAP_US // BIN_US
"""Bins of the histogram of time errors: from −10 to +10 ms."""


@dataclass(frozen=True, kw_only=True)
class Details:
    """What lies behind one entry's score on one scene."""

    levels: list[list[float]]
    """STPP per level, mean over scoring seeds: rows 1, 2, 4, 8, 16 cells in time, columns 1 .. 32
    in space."""
    time_error: list[float]
    """Share of true events whose nearest simulated event (same pixel and polarity) is so much
    later: `BINS` bins of 0.5 ms from −10 to +10 ms, mean over seeds. What is missing from 1 has
    no partner within 10 ms."""
    sharpness: list[float]
    """Flow-warp sharpness along the known flow, per seed; NaN for scenes without one."""
    flow_error: list[float]
    """px/s between the known flow and what contrast maximisation finds in the events, per seed;
    NaN for scenes without a flow, or with too few events."""


def describe(
    predicted: Sequence[EventStream],
    references: Sequence[EventStream],
    velocity_px_s: tuple[float, float] | None,
) -> Details:
    """Details of simulated events against the true ones.

    Args:
        predicted: one stream per scoring seed.
        references: the true streams, in the same order.
        velocity_px_s: (vx, vy) of the whole scene, px/s, or None.
    """
    pairs = list(zip(predicted, references, strict=True))
    levels = [Stpp().levels(one, other) for one, other in pairs]
    errors = [time_errors(one, other) for one, other in pairs]
    known = velocity_px_s if velocity_px_s != (0.0, 0.0) else None
    return Details(
        levels=np.mean(levels, axis=0).tolist(),
        time_error=np.mean(errors, axis=0).tolist(),
        sharpness=[flow_warp_sharpness(one, known) if known else math.nan for one in predicted],
        flow_error=[_flow_error(one, known) if known else math.nan for one in predicted],
    )


def time_errors(predicted: EventStream, reference: EventStream) -> NDArray[np.float64]:
    """Histogram of the time from each true event to the nearest simulated one.

    Returns:
        [40] float64, shares of the true events; all 0 if either stream is empty.
    """
    if not len(predicted) or not len(reference):
        return np.zeros(BINS)
    error_us = time_to_nearest(Trains.of(reference), Trains.of(predicted), cap_us=CAP_US)
    near = error_us[error_us < CAP_US]
    counts = np.bincount((near + CAP_US) // BIN_US, minlength=BINS)
    return np.asarray(counts / len(reference))


def _flow_error(events: EventStream, known: tuple[float, float]) -> float:
    found = estimate_velocities(events)
    if not found:
        return math.nan
    return float(np.mean([math.hypot(vx - known[0], vy - known[1]) for vx, vy in found]))
