"""Frames and streams that the tests of all interpolators share."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from texvent.frames import Frame, Video


@pytest.fixture(scope="session")
def psnr() -> Callable[[np.ndarray, np.ndarray], float]:
    """Peak signal-to-noise ratio, dB, peak 255."""

    def measure(a: np.ndarray, b: np.ndarray) -> float:
        error = np.mean((a.astype(np.float64) - b) ** 2)
        return float(10 * np.log10(255**2 / error))

    return measure


@pytest.fixture
def pair() -> Callable[..., tuple[Frame, Frame]]:
    """`pair(a, b)`: two frames 1000 µs apart."""

    def build(first: np.ndarray, second: np.ndarray, interval_us: int = 1000) -> Any:
        return Frame(first, 0), Frame(second, interval_us)

    return build


@pytest.fixture
def stream() -> Video:
    """Frames that no interpolator looks at: constructors want a stream."""
    return Video(np.zeros((2, 4, 4), np.uint8), [0, 1000])
