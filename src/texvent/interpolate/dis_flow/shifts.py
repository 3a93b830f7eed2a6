"""Shifts of the whole frame that are too large for the search of patches.

The search looks `SEARCH_RADIUS` pixels around on the coarsest level: a shift of more than a tenth
of the width is lost to it. Here both frames are correlated at every shift, on thumbnails; every
patch then tries the shift that agrees best (`try_vectors` in `flow_reference`).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.interpolate.dis_flow.definitions import MARGIN, SEARCH_RADIUS, Floats
from texvent.pairs.shift_correlation import correlate_shifts, detail

MOST_CELLS = 90
"""Longer side of a thumbnail, at most."""
IN_PLACE = 0.5
"""Frames whose detail agrees this well where it is are not shifted."""
AGREEMENT = 0.5
"""Least correlation of a shift."""
ALIKE = 0.1
"""Shifts whose correlation is less than this below the best cannot be told from it, as in a texture
that repeats: the shortest one counts."""
LEAST_VARIANCE = 4.0
"""Variance of detail below which agreement means nothing, squared levels."""


def find_shift(start: list[Floats], stop: list[Floats]) -> Floats | None:
    """How one frame is shifted to the other, if by more than patches are searched for.

    Args:
        start: pyramid of the one; see `definitions.make_pyramid`.
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
