"""The definition of the two passes, in NumPy float64. Other backends must return equal bits."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.draws import draw_uniforms
from texvent.simulate.kernels.interface import Crossings


def find_crossings(
    brightness: NDArray[np.float64], reference: NDArray[np.float64], threshold: float
) -> Crossings:
    """Pixels with `|L(α + I^j) − reference| ≥ δ`; see `interface.Kernels`.

    Equation: (5), section 3.2.2.
    Deviation: Eq. 5 fires above δ, Eq. 1 from δ on, and Eq. 6 calls everything below δ background;
        `≥` makes events and background exact complements.
    """
    change = brightness - reference
    fired = np.abs(change) >= threshold
    return Crossings(np.flatnonzero(fired), change[fired])


def find_noisy_pixels(
    mask: NDArray[np.bool_], key: np.uint64, draw: int, quiet: float
) -> NDArray[np.int64]:
    """Masked pixels whose Poisson number is not zero; see `interface.Kernels`.

    Equation: (6), section 3.2.2: where M · Poisson(λ1 λ2) > 0.
    """
    height, width = mask.shape
    y, x = np.ogrid[:height, :width]
    return np.flatnonzero(mask & (draw_uniforms(key, y, x, draw) >= quiet))
