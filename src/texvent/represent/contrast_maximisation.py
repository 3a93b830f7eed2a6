"""Motion from events alone: the velocity along which their image is sharpest.

Velocities are (vx, vy) in px/s; events are warped to the time of the first one.

Source: G. Gallego, H. Rebecq, D. Scaramuzza, "A unifying contrast maximization framework for event
cameras", CVPR 2018; S. Shiba et al., "Secrets of event-based optical flow, depth and ego-motion
estimation by contrast maximization", TPAMI 2024, for motion by patches.
Deviations: the contrast is the sum of squares of the image, which has the maximum of its variance;
a search over a grid of velocities, then around the best one, in place of gradient ascent: nothing
is to be initialised. Patches do not know of each other.
"""

from __future__ import annotations

import itertools
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_range
from texvent.errors import InputError
from texvent.events import EventStream
from texvent.frames import MICROSECONDS
from texvent.options.arrays import as_array

Float64Array: TypeAlias = NDArray[np.float64]

LEAST_EVENTS, MOST_EVENTS = 100, 5_000
"""Fewer events have no velocity; of more, evenly spaced ones are used: the peak is as sharp."""
FASTEST_PX_S, FARTHEST_PX = 1_000.0, 100.0
"""Velocities are sought in ± the first along both axes; longest way in the time of the events."""
COARSE_PX, FINE_PX = 2, (1.0, 0.5, 0.25, 0.125)
"""Cells of the coarse image and steps of its grid; steps of the search around the best one."""


def find_velocity(
    events: EventStream, *, fastest_px_s: float = FASTEST_PX_S
) -> Float64Array | None:
    """The one velocity of all events, [2], px/s; None if they are fewer than 100.

    Args:
        events: a slice so short that its motion is constant.
        fastest_px_s: velocities are sought in ± this along both axes, px/s.

    Raises:
        ConfigError: the speed is not above 0.
        InputError: at that speed things would move farther than 100 px in the slice.
    """
    check_range("fastest_px_s", fastest_px_s, 1e-6)
    if len(events) < LEAST_EVENTS:
        return None
    span_us = int(events.t[-1] - events.t[0])
    reach = fastest_px_s * span_us / MICROSECONDS
    if reach > FARTHEST_PX:
        raise InputError(
            f"these events are of {span_us / 1000:g} ms, in which things move {reach:,.0f} px at "
            f"{fastest_px_s:g} px/s; motion is found over at most {FARTHEST_PX:g} px: take a "
            "shorter window"
        )
    chosen = events[:: -(-len(events) // MOST_EVENTS)]
    share = (chosen.t - events.t[0]) / max(span_us, 1)
    # Places count from the first pixel with an event: where a thing is does not change its motion.
    place = np.stack([chosen.x, chosen.y]).astype(np.float64)
    place -= place.min(axis=1, keepdims=True)
    best = _search_grid(place, share, reach)
    for step in FINE_PX:
        around = itertools.product((0.0, -step, step), repeat=2)
        best = max((best + one for one in around), key=lambda way: _contrast(place, share, way))
    return best * (MICROSECONDS / max(span_us, 1))


def find_flow(
    events: EventStream, *, patch_px: int = 32, fastest_px_s: float = FASTEST_PX_S
) -> Float64Array:
    """Velocity of each pixel, [H, W, 2], px/s: of its patch, mixed linearly with the next ones.

    Args:
        events: a slice so short that its motion is constant.
        patch_px: side of the squares that move by themselves; the last row and column of them also
            have the pixels left over. One as large as the sensor: one motion.
        fastest_px_s: as for `find_velocity`.

    Returns:
        NaN in patches with fewer than 100 events.

    Raises:
        ConfigError, InputError: as `find_velocity`, or a patch is narrower than 4 px.
    """
    check_range("patch_px", patch_px, 4)
    counts = [max(side // patch_px, 1) for side in events.size.shape]
    owners = [
        np.minimum(np.arange(side) // patch_px, count - 1)
        for side, count in zip(events.size.shape, counts, strict=True)
    ]
    number = owners[0][events.y] * counts[1] + owners[1][events.x]
    mixed = np.zeros((counts[0] * counts[1], 3))  # velocity, and whether it is known
    for patch in range(len(mixed)):
        found = find_velocity(events[number == patch], fastest_px_s=fastest_px_s)
        mixed[patch] = 0.0 if found is None else (*found, 1.0)
    mixed = mixed.reshape(*counts, 3)
    known = mixed[..., 2][np.ix_(*owners)] > 0
    for axis, side in enumerate(events.size.shape):
        place = np.clip((np.arange(side) + 0.5) / patch_px - 0.5, 0, counts[axis] - 1)
        low = place.astype(np.int64)
        high = np.minimum(low + 1, counts[axis] - 1)
        share = np.expand_dims(place - low, (1 - axis, 2))
        mixed = mixed.take(low, axis) * (1 - share) + mixed.take(high, axis) * share
    mixed[~known] = np.nan
    return mixed[..., :2] / mixed[..., 2:]


def warp_events(events: EventStream, flow: Float64Array) -> EventStream:
    """The events where they were at the time of the first one, in the nearest pixels.

    Their counts are the image of warped events. Those that leave the sensor are left out.

    Args:
        events: the slice.
        flow: one velocity, [2], or one per pixel, [H, W, 2], px/s; NaN is taken as rest.

    Raises:
        InputError: the flow has another shape.
    """
    x, y = np.floor(_warp(events, flow) + 0.5).astype(np.int64)
    height, width = events.size.shape
    inside = (x >= 0) & (x < width) & (y >= 0) & (y < height)
    return EventStream(x[inside], y[inside], events.t[inside], events.p[inside], events.size)


def flow_warp_loss(events: EventStream, flow: Float64Array) -> float:
    """Variance of the image of warped events over that of the events as they are (FWL).

    1 where the flow changes nothing, above 1 where it sharpens; NaN without events. Arguments and
    errors are those of `warp_events`.

    Source: T. Stoffregen et al., "Reducing the sim-to-real gap for event cameras", ECCV 2020, whose
        program loses events that leave the sensor; here both images are larger where it takes that.
    """
    warped, still = _warp(events, flow), _warp(events, np.zeros(2))
    both = np.concatenate(
        [warped, still, [[0, events.size.width - 1], [0, events.size.height - 1]]], 1
    )
    sharp, blurred = (_splat(one, both).var() for one in (warped, still))
    return float(sharp / blurred) if blurred else float("nan")


def _warp(events: EventStream, flow: Float64Array) -> Float64Array:
    """Column and row of each event at the time of the first one, [2, n], px."""
    flow = as_array(flow, "flow").astype(np.float64)
    dense = (*events.size.shape, 2)
    if flow.shape not in ((2,), dense):
        raise InputError(f"flow has shape {list(flow.shape)}; give [2] or {list(dense)}, px/s")
    velocity = np.nan_to_num(flow if flow.ndim == 1 else flow[events.y, events.x])
    seconds = (events.t - events.t[:1].sum()) / MICROSECONDS
    return np.asarray([events.x, events.y] - velocity.reshape(-1, 2).T * seconds)


def _search_grid(place: Float64Array, share: Float64Array, reach: float) -> Float64Array:
    """Displacement of a grid, px, with the sharpest coarse image; of equals, the shortest."""
    steps = np.arange(-(reach // COARSE_PX), reach // COARSE_PX + 1) * COARSE_PX
    # Rounded down, as a cast to whole numbers would double the cells around 0.
    column, row = (
        np.floor((one - steps[:, None] * share) / COARSE_PX).astype(np.int64) for one in place
    )
    column, row = column - column.min(), row - row.min()
    ways, rows, columns = len(steps), int(row.max()) + 1, int(column.max()) + 1
    contrast = np.empty((ways, ways))
    for number in range(ways):
        image = (np.arange(ways)[:, None] * rows + row[number]) * columns + column
        counts = np.bincount(image.ravel(), minlength=ways * rows * columns)
        contrast[number] = np.square(counts.reshape(ways, -1)).sum(1)
    length = np.hypot(steps, steps[:, None])
    length[contrast < contrast.max()] = np.inf
    down, across = np.unravel_index(length.argmin(), length.shape)
    return np.array([steps[across], steps[down]])


def _contrast(place: Float64Array, share: Float64Array, way: Float64Array) -> float:
    """Sum of squares of the image of events moved back along a way, smoothed by (1 2 1)."""
    moved = place - way[:, None] * share
    image = np.pad(_splat(moved, moved), 2)
    # Events between two pixels are spread thinner than events on one; smoothing evens that out.
    image = image[:-2] + 2 * image[1:-1] + image[2:]
    image = image[:, :-2] + 2 * image[:, 1:-1] + image[:, 2:]
    return float(np.square(image).sum())


def _splat(place: Float64Array, covered: Float64Array) -> Float64Array:
    """Image of 1 per event, shared bilinearly by the four pixels around it.

    Args:
        place: column and row of each event, [2, n], px.
        covered: places that the image is as large as, [2, m], px.
    """
    corner = np.floor(covered.min(axis=1, keepdims=True))
    width, height = (np.floor(covered.max(axis=1)) - corner[:, 0] + 2).astype(np.int64)
    left, top = np.floor(place - corner).astype(np.int64)
    across, down = (place - corner) % 1
    image = np.zeros(height * width)
    for x, y in itertools.product((0, 1), repeat=2):
        weight = (across if x else 1 - across) * (down if y else 1 - down)
        image += np.bincount((top + y) * width + left + x, weights=weight, minlength=image.size)
    return image.reshape(height, width)
