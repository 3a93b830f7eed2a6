"""A moving texture that is known at every position, so in-between frames have an exact answer."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from texvent.config import InterpolateConfig
from texvent.video import Frame, Video


def _texture(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Waves of many directions and lengths (6 px and longer): smooth, and nowhere repeating."""
    rng = np.random.default_rng(7)
    total = np.zeros_like(x)
    for _ in range(24):
        length, angle = rng.uniform(6, 40), rng.uniform(0, 2 * np.pi)
        phase = rng.uniform(0, 2 * np.pi)
        total += np.sin(2 * np.pi * (x * np.cos(angle) + y * np.sin(angle)) / length + phase)
    return 128.0 + 20.0 * total


@pytest.fixture(scope="session")
def moving_texture() -> Callable[..., np.ndarray]:
    """`moving_texture(dx, dy, width=, height=)`: float32 picture of the texture moved by that."""

    def render(dx: float, dy: float = 0.0, *, width: int = 160, height: int = 120) -> np.ndarray:
        y, x = np.mgrid[:height, :width].astype(np.float64)
        return np.clip(_texture(x - dx, y - dy), 0, 255).astype(np.float32)

    return render


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


@pytest.fixture
def config() -> Callable[..., InterpolateConfig]:
    """`config(**options)`: the default options with some replaced."""
    return lambda **options: replace(InterpolateConfig(), **options)
