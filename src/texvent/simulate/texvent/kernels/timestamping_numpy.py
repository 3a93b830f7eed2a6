"""Fired pixels and noise into a packet, in NumPy, by the functions of the definition."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.simulate.packets.interval import SparseInterval, place_in
from texvent.simulate.packets.order import Columns, Unordered
from texvent.simulate.packets.order_reference import order_events
from texvent.simulate.packets.unsorted_events import Firings, Interval
from texvent.simulate.texvent.event_frame import EventFrame, count_events, list_activations
from texvent.simulate.texvent.kernels.noise_blocks import NoisePlaces
from texvent.simulate.texvent.kernels.scan import Fired, join_fired
from texvent.simulate.texvent.kernels.timestamping import Timing
from texvent.simulate.texvent.noise import is_background
from texvent.simulate.texvent.timestamps import reconstruct_timestamps


def stamp_events(
    bands: Sequence[Fired],
    noise: NoisePlaces,
    timing: Timing,
    span: Interval,
    shape: tuple[int, int],
) -> Columns:
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
    activations = list_activations(EventFrame(fired.pixel, fired.change, number))
    t = reconstruct_timestamps(
        activations,
        SparseInterval(span, shape[1], fired.pixel, (fired.start, fired.stop, fired.reference)),
        stamp=timing.stamp,
        threshold=timing.threshold,
        scale=timing.scale,
    )
    signal = Firings.signal(activations.pixel, t, activations.polarity)
    added = Firings.noise(noise.pixel, place_in(span, noise.fraction), noise.p)
    if timing.noise_at_rest:
        added = added.where(is_background(noise.pixel, fired.pixel))
    return order_events(Unordered(*signal.joined(added)), (span.start_us, span.stop_us), shape)
