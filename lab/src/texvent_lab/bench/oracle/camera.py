"""The benchmark's camera: from linear radiance to levels and back."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

EXPOSURE = 0.9
GAMMA = 2.2
WHITE = 255.0


def camera_level(radiance: NDArray[np.float64]) -> NDArray[np.float64]:
    """Radiance as the camera records it: exposed, clipped, gamma-coded, 0..255, not rounded."""
    return np.asarray(WHITE * np.clip(EXPOSURE * radiance, 0.0, 1.0) ** (1 / GAMMA))


def radiance_of(level: NDArray[np.float32]) -> NDArray[np.float64]:
    """Radiance that the camera records as these levels, 0..255: the inverse of `camera_level`."""
    return np.asarray((level.astype(np.float64) / WHITE) ** GAMMA / EXPOSURE)
