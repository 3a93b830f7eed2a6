"""What drawing noise by blocks of pixels takes and gives; `scan.py` tells the scheme."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.backend.select import Kernel


class NoisePlaces(NamedTuple):
    """Where noise would fire if all pixels were noisy, by pixel, then by p."""

    pixel: NDArray[np.int64]
    """[n] flat index y · W + x, ascending."""
    fraction: NDArray[np.float64]
    """[n] time as a fraction 0..1 of the interval; 1 is left out."""
    p: NDArray[np.uint8]
    """[n] 1 = ON, 0 = OFF."""


class NoiseBlock(NamedTuple):
    """What the noise of every block of a frame shares."""

    key: np.uint64
    """Of `draws.frame_key`."""
    cumulative: NDArray[np.float64]
    """[n] P(number ≤ k) of the number of events of a block, k = 0, 1, ...; a uniform number u draws
    how many entries are ≤ u. See `noise.poisson_cumulative`."""
    on_fraction: float
    """Probability of ON."""


PlaceNoise: TypeAlias = Callable[[NoiseBlock, int], NoisePlaces]
"""`place_noise(block, pixels)`, see `noise_blocks_reference.place_noise`."""
PLACE_NOISE = Kernel[PlaceNoise](__name__, "place_noise")
