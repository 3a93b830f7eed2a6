"""What a backend offers: the two passes over all pixels, plain arrays in and out.

Everything else in a simulator works on the few pixels that fired, and is written once, in NumPy,
for all backends. So a new backend is these two functions, and a simulator that compares another
brightness with another reference (ESIM, for one) can use them as they are.
"""

from __future__ import annotations

from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray


class Crossings(NamedTuple):
    """The pixels that fired in one sub-interval, in row-major order."""

    pixel: NDArray[np.int64]
    """[n] flat index y · W + x, ascending."""
    change: NDArray[np.float64]
    """[n] brightness minus reference brightness, log units; its sign is the polarity."""


class Kernels(Protocol):
    """The functions of a backend. All backends return equal bits."""

    def find_crossings(
        self, brightness: NDArray[np.float64], reference: NDArray[np.float64], threshold: float
    ) -> Crossings:
        """Pixels whose brightness lies `threshold` or more from their reference (Eqs. 1 and 5).

        Args:
            brightness: L(α + I^j), [H, W], C order.
            reference: reference brightness of each pixel, [H, W], C order; not changed.
            threshold: δ, log units, above 0.
        """
        ...

    def find_noisy_pixels(
        self, mask: NDArray[np.bool_], key: np.uint64, draw: int, quiet: float
    ) -> NDArray[np.int64]:
        """Masked pixels whose uniform draw reaches `quiet`: those with noise (Eq. 6).

        Args:
            mask: where noise is allowed, [H, W], C order.
            key: of `draws.frame_key`.
            draw: number of the draw to look at.
            quiet: probability that a pixel has no noise event.

        Returns:
            [n] flat index y · W + x, ascending.
        """
        ...
