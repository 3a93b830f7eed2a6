"""Fired pixels and noise into a packet, in NumPy, by the functions of the definition."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.simulate.packets.interval import FrameInterval, place_in
from texvent.simulate.packets.sorting import SortedEvents
from texvent.simulate.packets.sorting_reference import sort_events
from texvent.simulate.packets.unsorted_events import UnsortedEvents
from texvent.simulate.texvent.fired_pixels import EventFrame, count_events, list_threshold_crossings
from texvent.simulate.texvent.kernels.noise_blocks import NoisePlaces
from texvent.simulate.texvent.kernels.scan import Fired, join_fired
from texvent.simulate.texvent.kernels.timestamping import Timing
from texvent.simulate.texvent.noise import is_background
from texvent.simulate.texvent.timestamps import SubInterval, reconstruct_timestamps


def timestamp_events(
    bands: Sequence[Fired],
    noise: NoisePlaces,
    timing: Timing,
    span: FrameInterval,
    shape: tuple[int, int],
) -> SortedEvents:
    """Give every event its time (Eq. 7) and put signal and noise in the order of a packet.

    Args:
        bands: the pixels that fired, of bands that follow each other, at least one.
        noise: the noise events in dark pixels.
        timing: the rules.
        span: the sub-interval.
        shape: (height, width).
    """
    fired = join_fired(bands)
    number = count_events(fired.change, timing.threshold, multi_event=timing.multi_event)
    crossings = list_threshold_crossings(EventFrame(fired.pixel, fired.change, number))
    t = reconstruct_timestamps(
        crossings,
        SubInterval(span, shape[1], fired.pixel, (fired.start, fired.stop, fired.reference)),
        timestamp_rule=timing.timestamp_rule,
        threshold=timing.threshold,
        scale=timing.scale,
    )
    signal = UnsortedEvents.signal(crossings.pixel, t, crossings.polarity)
    added = UnsortedEvents.noise(noise.pixel, place_in(span, noise.fraction), noise.p)
    if timing.noise_at_rest:
        added = added.take(is_background(noise.pixel, fired.pixel))
    return sort_events(UnsortedEvents.concat((signal, added)), (span.start_us, span.stop_us), shape)
