"""Motion of the whole frame, which every patch tries: a shift, a zoom, a turn, or a mixture.

Where the camera zooms or turns, the middle of the frame moves little, and its patches are found;
those near the borders are out of reach. So once the flow is known on a level, an affine motion is
fitted to what both directions confirm. If it is the motion of nearly all of that, every patch of
this and the finer levels tries it (`try_vectors` in `flow_reference`), and what leaves the view
follows it.
"""

from __future__ import annotations

from types import ModuleType

import numpy as np
from numpy.typing import NDArray

from texvent.interpolate.dis_flow.confirmation import Flows, both_unconfirmed
from texvent.interpolate.dis_flow.definitions import STEP, Floats, Mask, scale_motion, vectors_at

LEAST_UNCONFIRMED = 0.05
"""Where a smaller share of the flow is not confirmed, the search has found the motion."""
LEAST_CONFIRMED = 0.1
"""Share of the flow that must be confirmed to tell a motion."""
WITHIN = 1.0
"""Distance to the motion up to which flow has it, px."""
NEARLY_ALL = 0.9
"""Share of the confirmed flow that must have the motion."""
LEAST_MOTION = 1.0
"""A frame whose corners move by less rests, px."""
ROUNDS, FIRST_SCALE, LAST_SCALE = 8, 8.0, 0.5
"""The fit is repeated. Flow counts a quarter at a distance from the motion, px, that halves from
the one to the other."""


Motions = tuple[Floats, Floats] | tuple[None, None]
"""From the one image to the other, and back, [2, 3] each; see `definitions.scale_motion`."""
NO_MOTIONS: tuple[None, None] = None, None


def shift_motion(shift: Floats) -> Floats:
    """The motion of a frame that is shifted, (x, y) px."""
    return np.array([[shift[0], 0, 0], [shift[1], 0, 0]], np.float32)


def scale(motions: Motions, factor: float) -> Motions:
    """Both motions, of an image that is larger by a factor."""
    one, other = motions
    if one is None or other is None:
        return NO_MOTIONS
    return scale_motion(one, factor), scale_motion(other, factor)


def find_motions(
    start: Floats, stop: Floats, flows: Flows, kernels: ModuleType
) -> tuple[Floats, Floats] | None:
    """How nearly all of the frame moves, both ways, if the flows leave much unexplained.

    Args:
        start: level of the one image.
        stop: level of the other.
        flows: from one to the other and back, [2, H, W] px.
        kernels: `flow_reference` or `flow_cpu`.

    Returns:
        px of the level; see `definitions.scale_motion`.
    """
    unconfirmed = both_unconfirmed(start, stop, flows, kernels)
    if max(one.mean() for one in unconfirmed) < LEAST_UNCONFIRMED:
        return None
    ahead = fit_motion(flows[0], ~unconfirmed[0])
    back = None if ahead is None else fit_motion(flows[1], ~unconfirmed[1])
    return None if ahead is None or back is None else (ahead, back)


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
