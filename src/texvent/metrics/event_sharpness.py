"""Motion of events by contrast maximisation, and flow-warp sharpness."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_range
from texvent.events import EventStream
from texvent.metrics.protocol import UNDEFINED
from texvent.metrics.windows import bin_index, occupied_windows, rate_of_window
from texvent.video import MICROSECONDS

WINDOW_US = 40_000
"""Length of the windows in which motion is taken to be constant, µs."""
LEAST_EVENTS = 300
"""Windows with fewer events have no velocity."""
MOST_EVENTS = 5_000
"""Of more events, evenly spaced ones are used: the peak is as sharp."""
MOST_SPEED = 1_000.0
"""Velocities are sought in ±this, px/s, along both axes."""
COARSE_PX = 2
"""Pixels of the coarse image, and steps of the grid in px per window."""
FINE_STEPS = (1.0, 0.5, 0.25, 0.125)
"""Steps of the pattern search, px per window."""

FloatPair = tuple[float, float]


def estimate_velocity(
    events: EventStream, *, window_us: int = WINDOW_US, most_speed_px_s: float = MOST_SPEED
) -> FloatPair | None:
    """Velocity of all events, as if everything moved as one.

    Args:
        events: a short span; times count from its first event.
        window_us: length of the span, µs.
        most_speed_px_s: the search goes to ± this along both axes, px/s.

    Returns:
        (vx, vy), px/s; None if there are fewer than 300 events.

    Raises:
        ConfigError: the window or the speed is not above 0.
    """
    check_range("window_us", window_us, 1)
    check_range("most_speed_px_s", most_speed_px_s, 1e-6)
    if len(events) < LEAST_EVENTS:
        return None
    chosen = events[:: -(-len(events) // MOST_EVENTS)]
    share = (chosen.t - chosen.t[0]) / window_us
    # From the first column and row, so that the place in the image changes nothing.
    x, y = (column.astype(np.float64) - column.min() for column in (chosen.x, chosen.y))
    reach = most_speed_px_s * window_us / MICROSECONDS
    steps = np.arange(-np.floor(reach / COARSE_PX), reach / COARSE_PX + 1) * COARSE_PX
    grid = itertools.product(steps.tolist(), repeat=2)
    best = max(grid, key=lambda shift: _coarse_contrast(x, y, share, shift))
    for step in FINE_STEPS:
        around = itertools.product((-step, 0.0, step), repeat=2)
        nearby = [(best[0] + dx, best[1] + dy) for dx, dy in around]
        best = max(nearby, key=lambda shift: _contrast(x, y, share, shift))
    return best[0] * MICROSECONDS / window_us, best[1] * MICROSECONDS / window_us


def estimate_velocities(
    events: EventStream, *, window_us: int = WINDOW_US, most_windows: int = 4
) -> list[FloatPair]:
    """Velocity of the whole image in evenly chosen windows.

    Args:
        events: the stream.
        window_us: length of a window, µs; windows start at multiples of it.
        most_windows: how many are used of those that have enough events.

    Returns:
        One (vx, vy) per window used, px/s; empty if none has enough events.
    """
    index = bin_index(events.t, rate_of_window(window_us))
    numbers, counts = np.unique(index, return_counts=True)
    usable = numbers[counts >= LEAST_EVENTS]
    if usable.size > most_windows:
        usable = usable[np.linspace(0, usable.size - 1, most_windows).round().astype(int)]
    found = (estimate_velocity(events[index == number], window_us=window_us) for number in usable)
    return [one for one in found if one is not None]


def estimate_patch_flow(
    events: EventStream,
    *,
    patch_px: int = 60,
    window_us: int = WINDOW_US,
    most_speed_px_s: float = MOST_SPEED,
) -> NDArray[np.float64]:
    """Velocity of each patch of the image, one per square of `patch_px`.

    Args:
        events: a short span, as long as the window.
        patch_px: side of a patch, px; a last row or column narrower than half of it is left out.
        window_us: length of the span, µs.
        most_speed_px_s: the search goes to ± this along both axes, px/s.

    Returns:
        [rows, columns, 2] float64, (vx, vy) in px/s; NaN where a patch has too few events.

    Raises:
        ConfigError: the patch, the window or the speed is not above 0.
    """
    check_range("patch_px", patch_px, 1)
    rows, columns = (max((side + patch_px // 2) // patch_px, 1) for side in events.size.shape)
    flow = np.full((rows, columns, 2), np.nan)
    row, column = events.y // patch_px, events.x // patch_px
    for place in itertools.product(range(rows), range(columns)):
        inside = events[(row == place[0]) & (column == place[1])]
        found = estimate_velocity(inside, window_us=window_us, most_speed_px_s=most_speed_px_s)
        if found is not None:
            flow[place] = found
    return flow


def splat_events(
    x: NDArray[np.float64], y: NDArray[np.float64], shape: tuple[int, int]
) -> NDArray[np.float64]:
    """Weight 1 per event, shared bilinearly between the four pixels around it.

    Args:
        x: column of each event, px, [n]; 0 <= x < width - 1.
        y: row of each event, px, [n]; 0 <= y < height - 1.
        shape: (height, width) of the image.

    Returns:
        [height, width] float64.
    """
    left, top = np.floor(x).astype(np.int64), np.floor(y).astype(np.int64)
    right_share, lower_share = x - left, y - top
    image = np.zeros(shape[0] * shape[1])
    for down, across in ((0, 0), (0, 1), (1, 0), (1, 1)):
        weight = (lower_share if down else 1 - lower_share) * (
            right_share if across else 1 - right_share
        )
        index = (top + down) * shape[1] + left + across
        image += np.bincount(index, weights=weight, minlength=image.size)
    return image.reshape(shape)


def _coarse_contrast(
    x: NDArray[np.float64], y: NDArray[np.float64], share: NDArray[np.float64], shift: FloatPair
) -> int:
    """Sum of squared counts in squares of `COARSE_PX`, of events moved by `shift · share`."""
    column = np.floor((x - shift[0] * share) / COARSE_PX).astype(np.int64)
    row = np.floor((y - shift[1] * share) / COARSE_PX).astype(np.int64)
    column -= column.min()
    row -= row.min()
    counts = np.bincount(row * (int(column.max()) + 1) + column)
    return int(counts @ counts)


def _contrast(
    x: NDArray[np.float64], y: NDArray[np.float64], share: NDArray[np.float64], shift: FloatPair
) -> float:
    """Sum of squares of the image of events moved by `shift · share`, smoothed by (1 2 1)."""
    moved_x, moved_y = x - shift[0] * share, y - shift[1] * share
    # Whole pixels, so that how events fall between pixels does not depend on the canvas.
    left, top = np.floor(moved_x.min()) - 1, np.floor(moved_y.min()) - 1
    shape = (int(moved_y.max() - top) + 3, int(moved_x.max() - left) + 3)
    image = splat_events(moved_x - left, moved_y - top, shape)
    # Events between two pixels are spread thinner than events on one; smoothing evens that out.
    image = image[:-2] + 2 * image[1:-1] + image[2:]
    image = image[:, :-2] + 2 * image[:, 1:-1] + image[:, 2:]
    return float((image * image).sum())


SHARPNESS_WINDOW_US = 60_000
LEAST_SHARPNESS_EVENTS = 500


def flow_warp_sharpness(
    events: EventStream,
    velocity_px_s: tuple[float, float],
    *,
    window_us: int = SHARPNESS_WINDOW_US,
    least_events: int = LEAST_SHARPNESS_EVENTS,
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
        1 where warping changes nothing, more where events are on moving edges; NaN if no window
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
