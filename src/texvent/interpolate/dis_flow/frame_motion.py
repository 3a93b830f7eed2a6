"""Motion of the whole frame, tried for every patch: a shift, a zoom, a turn, or a mixture.

The search looks `SEARCH_RADIUS` pixels around on the coarsest level, so a shift of more than a
tenth of the width is lost to it. `find_shift` correlates thumbnails of both frames at every shift.

Where the camera zooms or turns, the middle of the frame moves little, and its patches are found;
those near the borders are out of reach. `find_motions` fits an affine motion to the flow that both
directions confirm, and returns it if nearly all of that flow follows it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.interpolate.dis_flow.definitions import (
    MARGIN,
    PATCH,
    SEARCH_RADIUS,
    STEP,
    Floats,
    Mask,
    size_of,
    step_of,
)
from texvent.interpolate.dis_flow.refine import unconfirmed
from texvent.pairs.scene_change import correlate_shifts, detail

MOST_CELLS = 90
"""Longer side of a thumbnail, at most."""
IN_PLACE = 0.5
"""Frames whose detail agrees this well in place are not shifted."""
AGREEMENT = 0.5
"""Least correlation of a shift."""
ALIKE = 0.1
"""Shifts whose correlation is less than this below the best cannot be distinguished from it, as in
periodic texture: the shortest one counts."""
LEAST_VARIANCE = 4.0
"""Variance of detail below which agreement means nothing, squared levels."""

LEAST_UNCONFIRMED = 0.05
"""Share of the flow that may be unconfirmed where the search has found the motion."""
LEAST_CONFIRMED = 0.1
"""Share of the flow that must be confirmed to fit a motion."""
WITHIN = 1.0
"""Distance to the motion up to which flow has it, px."""
NEARLY_ALL = 0.9
"""Share of the confirmed flow that must have the motion."""
LEAST_MOTION = 1.0
"""A frame whose corners move by less rests, px."""
ROUNDS, FIRST_SCALE, LAST_SCALE = 8, 8.0, 0.5
"""The fit is repeated. Flow counts a quarter at a distance from the motion, px, that halves from
the one to the other."""

Flows = tuple[Floats, Floats]
"""From the one image to the other, and back, [2, H, W] px."""
Motions = tuple[Floats, Floats] | tuple[None, None]
"""From the one image to the other, and back. A motion is affine, [2, 3]: x and y of the middle of
the frame, px, then what they grow by per px to the right, and per px downwards."""
NO_MOTIONS: tuple[None, None] = None, None


def find_shift(start: list[Floats], stop: list[Floats]) -> Floats | None:
    """Shift of one frame to the other, if it exceeds the reach of the search.

    Args:
        start: pyramid of the one; see `estimator.make_pyramid`.
        stop: pyramid of the other.

    Returns:
        (x, y) float32, px of the finest level.
    """
    number = next(
        (k for k, level in enumerate(start) if max(level.shape) - 2 * MARGIN <= MOST_CELLS),
        len(start) - 1,
    )
    one, other = (detail(_image(pyramid[number])) for pyramid in (start, stop))
    if _agreement_in_place(one, other) >= IN_PLACE:
        return None
    agreement = correlate_shifts(one, other, LEAST_VARIANCE)
    around = np.pad(agreement, 1, constant_values=-1.0)
    near = np.maximum(np.maximum(around[:-2], around[2:]), around[1:-1])
    is_peak = agreement >= np.maximum(np.maximum(near[:, :-2], near[:, 2:]), near[:, 1:-1])
    is_peak &= agreement >= max(AGREEMENT, float(agreement.max()) - ALIKE)
    if not is_peak.any():
        return None
    shifts = np.argwhere(is_peak)[:, ::-1] - np.array(agreement.shape[::-1]) // 2
    shortest = shifts[np.argmin((shifts**2).sum(axis=1))]
    if np.abs(shortest).max() * 2**number <= SEARCH_RADIUS * 2 ** (len(start) - 1):
        return None
    return np.asarray(shortest * 2.0**number, np.float32)


def _image(level: Floats) -> NDArray[np.float64]:
    return level[0, MARGIN:-MARGIN, MARGIN:-MARGIN].astype(np.float64)


def _agreement_in_place(one: NDArray[np.float64], other: NDArray[np.float64]) -> float:
    product = float(np.mean(one * other) - one.mean() * other.mean())
    spread = max(float(one.var()), LEAST_VARIANCE) * max(float(other.var()), LEAST_VARIANCE)
    return float(product / spread**0.5)


def find_motions(start: Floats, stop: Floats, flows: Flows) -> Flows | None:
    """Affine motion of nearly all of the frame, both ways, if the flows leave much unexplained.

    Args:
        start: level of the one image.
        stop: level of the other.
        flows: from one to the other and back, [2, H, W] px.

    Returns:
        Two motions, [2, 3], px of the level; see `Motions`.
    """
    ahead, back = (np.ascontiguousarray(flow) for flow in flows)
    lost = unconfirmed(start, stop, ahead, back), unconfirmed(stop, start, back, ahead)
    if max(one.mean() for one in lost) < LEAST_UNCONFIRMED:
        return None
    first = fit_motion(flows[0], ~lost[0])
    second = None if first is None else fit_motion(flows[1], ~lost[1])
    return None if first is None or second is None else (first, second)


def fit_motion(flow: Floats, confirmed: Mask) -> Floats | None:
    """The motion of nearly all of a frame that does not rest, or None.

    Args:
        flow: [2, H, W] px.
        confirmed: [H, W], pixels whose flow counts.
    """
    if confirmed[::STEP, ::STEP].mean() < LEAST_CONFIRMED:
        return None
    height, width = confirmed.shape
    row, column = (STEP * places for places in np.nonzero(confirmed[::STEP, ::STEP]))
    x, y = column + 0.5 - width / 2, row + 0.5 - height / 2
    motion, distance2 = _fit(x, y, flow[:, row, column].T.astype(np.float64))
    if np.mean(distance2 <= WITHIN**2) < NEARLY_ALL:
        return None
    ends = np.array([-0.5, 0.5], np.float32)
    corners = vectors_at(motion, ends * np.float32(width), ends[:, np.newaxis] * np.float32(height))
    return motion if (corners**2).sum(axis=-1).max() >= LEAST_MOTION**2 else None


def _fit(
    x: NDArray[np.float64], y: NDArray[np.float64], seen: NDArray[np.float64]
) -> tuple[Floats, NDArray[np.float64]]:
    """The motion that fits vectors [n, 2] at places, robustly; their squared distances to it."""
    side = max(float(np.abs(x).max()), float(np.abs(y).max()))
    terms = np.stack([np.ones_like(x), x / side, y / side])
    weight = np.ones_like(x)
    for turn in range(ROUNDS):
        weighted = terms * weight
        found = np.linalg.solve(weighted @ terms.T + 1e-6 * np.eye(3), weighted @ seen)
        distance2 = ((terms.T @ found - seen) ** 2).sum(axis=1)
        weight = 1.0 / (1.0 + distance2 / max(FIRST_SCALE * 0.5**turn, LAST_SCALE) ** 2) ** 2
    return (found.T / np.array([1.0, side, side])).astype(np.float32), distance2


def shift_motion(shift: Floats) -> Floats:
    """The motion of a frame that is shifted, (x, y) px."""
    return np.array([[shift[0], 0, 0], [shift[1], 0, 0]], np.float32)


def scale_motion(motion: Floats, factor: float) -> Floats:
    """A motion, for an image that is larger by a factor."""
    return motion * np.array([factor, 1, 1], np.float32)


def vectors_at(motion: Floats, x: Floats, y: Floats) -> Floats:
    """Displacement under a motion at places, px from the middle of the frame; [..., 2] px."""
    return np.stack([own[0] + own[1] * x + own[2] * y for own in motion], axis=-1)


def patch_vectors(motion: Floats, level: Floats) -> Floats:
    """Displacement of the middle of each patch, [rows, columns, 2] px."""
    y, x = (
        np.arange(0, side - PATCH + 1, step_of(level)).astype(np.float32)
        + np.float32((PATCH - side) / 2)
        for side in size_of(level)
    )
    return vectors_at(motion, x, y[:, np.newaxis])


def pixel_vectors(motion: Floats, shape: tuple[int, int]) -> Floats:
    """Displacement of each pixel, [2, H, W] px."""
    height, width = shape
    x = np.arange(width, dtype=np.float32) + np.float32(0.5 - width / 2)
    y = np.arange(height, dtype=np.float32) + np.float32(0.5 - height / 2)
    return np.moveaxis(vectors_at(motion, x, y[:, np.newaxis]), -1, 0)


def leads_outside(flow: Floats) -> Mask:
    """Pixels whose flow leads out of the image, [H, W]."""
    _, height, width = flow.shape
    y, x = np.ogrid[:height, :width]
    to_x, to_y = x + flow[0], y + flow[1]
    outside: Mask = (to_x < 0) | (to_y < 0) | (to_x > width - 1) | (to_y > height - 1)
    return outside
