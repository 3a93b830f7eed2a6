"""The definition of ESIM's crossing times, in NumPy float64."""

import numpy as np
from tests.simulation.references.ramp import Ramp, cross_ramp
from tests.simulation.references.sorting import sort_events

from texvent.events import SIGNAL
from texvent.simulation.crossing.ramp import RefractoryPeriod
from texvent.simulation.esim.crossings import CrossingState, RampPixels
from texvent.simulation.packets import SortedEvents, UnsortedEvents


def cross_thresholds(
    pixels: RampPixels,
    references: CrossingState,
    span_us: tuple[int, int],
    refractory: RefractoryPeriod,
    shape: tuple[int, int],
) -> SortedEvents:
    """As `esim.crossings.cross_thresholds`."""
    pixel, before, now, table, thresholds = pixels
    if table is not None:
        before, now = table[before], table[now]
    reference = references.reference[pixel]
    on, off = (np.broadcast_to(one, pixel.shape) for one in thresholds)
    ramp = Ramp(pixel, before - reference, now - reference, on, off)
    crossings = cross_ramp(ramp, references.fired_us, span_us, refractory)
    steps = crossings.steps
    references.reference[pixel] = reference + steps * np.where(steps > 0, on, off)
    fired, t, p, _ = crossings
    label = np.full(len(t), SIGNAL, np.uint8)
    return sort_events(UnsortedEvents(fired, t, p, label), span_us, shape)
