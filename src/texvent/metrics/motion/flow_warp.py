"""Flow-warp sharpness: how much an image of the events sharpens when moved along a known flow."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from texvent.config import check_range
from texvent.events import EventStream
from texvent.metrics.motion.contrast_maximisation import estimate_velocity, splat_events
from texvent.metrics.protocol import UNDEFINED, Metric
from texvent.metrics.windows import occupied_windows, rate_of_window
from texvent.video import MICROSECONDS

WINDOW_US = 60_000
LEAST_EVENTS = 500


def flow_warp_sharpness(
    events: EventStream,
    velocity_px_s: tuple[float, float],
    *,
    window_us: int = WINDOW_US,
    least_events: int = LEAST_EVENTS,
) -> float:
    """Variance of the image of warped events over that of unwarped ones, mean over windows.

    Each event moves to `x − vx (t − t0), y − vy (t − t0)` and is splatted bilinearly, whatever its
    polarity, on a canvas padded so that nothing leaves it.

    Args:
        events: the stream.
        velocity_px_s: (vx, vy) of the whole scene, px/s.
        window_us: length of a window, µs; windows start at multiples of it.
        least_events: windows with fewer events are left out.

    Returns:
        1 where warping changes nothing, more where events lie on moving edges; NaN if no window
        has enough events. It rewards streams that are cleaner than a real sensor's.

    Source: Stoffregen et al., "Reducing the sim-to-real gap for event cameras" (ECCV 2020), FWL.
    """
    ratios = []
    for window in occupied_windows(events, events, rate_of_window(window_us)):
        if len(window.predicted) < least_events:
            continue
        seconds = (window.predicted.t % window_us) / MICROSECONDS
        reach = [abs(one) * window_us / MICROSECONDS for one in velocity_px_s]
        pad_x, pad_y = (int(np.ceil(one)) + 1 for one in reach)
        images = [
            splat_events(
                window.predicted.x - scale * velocity_px_s[0] * seconds + pad_x,
                window.predicted.y - scale * velocity_px_s[1] * seconds + pad_y,
                (events.size.height + 2 * pad_y, events.size.width + 2 * pad_x),
            )
            for scale in (1.0, 0.0)
        ]
        still = float(images[1].var())
        if still > 0:
            ratios.append(float(images[0].var()) / still)
    return float(np.mean(ratios)) if ratios else UNDEFINED


@dataclass(frozen=True, kw_only=True)
class FlowWarpRatio(Metric):
    """Flow-warp sharpness of the predicted events over that of the reference's.

    Both are warped along the one velocity that makes the reference sharpest, window by window.
    Evenly chosen windows are used of those in which both have enough events; NaN if there is none.
    """

    name = "fwl"
    better = "one"
    range = (0.0, float("inf"))
    blind_to = "polarity, a shift of all events; a scene of many motions"

    window_us: int = WINDOW_US
    """Length of a window, µs."""
    most_windows: int = 3
    """How many are used: the velocity of each has to be found."""

    def __post_init__(self) -> None:
        check_range("window_us", self.window_us, 1, 10**9)
        check_range("most_windows", self.most_windows, 1, 10**6)

    def _score(self, predicted: EventStream, reference: EventStream) -> float:
        usable = [
            window
            for window in occupied_windows(predicted, reference, rate_of_window(self.window_us))
            if min(len(window.predicted), len(window.reference)) >= LEAST_EVENTS
        ]
        last, most = len(usable) - 1, min(self.most_windows, len(usable))
        sharpness = []
        for number in np.linspace(0, last, most).round().astype(int):
            velocity = estimate_velocity(usable[number].reference, window_us=self.window_us)
            if velocity is not None:
                sharpness.append(
                    [
                        flow_warp_sharpness(events, velocity, window_us=self.window_us)
                        for events in usable[number]
                    ]
                )
        if not sharpness:
            return UNDEFINED
        judged, true = np.mean(sharpness, axis=0)
        return float(judged / true)
