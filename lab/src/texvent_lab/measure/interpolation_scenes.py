"""Moving images whose every instant is known: textures, and scenes of the embedded generator."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.generate.procedural import ProceduralConfig, ProceduralGenerator

FloatArray = NDArray[np.float64]
TEXTURES = {
    "sharp": ((16.0, 0.55), (5.0, 0.3), (2.3, 0.15)),
    "smooth": ((32.0, 0.6), (16.0, 0.4)),
}
"""Octaves of value noise: (cell size, px; weight)."""
SPEEDS = {"slow": 14_000, "medium": 42_000, "fast": 126_000}
"""Name → interval between the two given frames, µs: one drive, three times as slow and as fast."""
PROMPT = "a red car drives left past two trees"
START_US = 1_000_000
"""Time of the first of them; the car is in the image."""


def embedded_scene(speed: str) -> Callable[[float], NDArray[Any]]:
    """The luma of an embedded scene at every position between two frames, 0..1.

    Args:
        speed: a name in `SPEEDS`.
    """
    stream = ProceduralGenerator(ProceduralConfig()).generate(PROMPT)

    def render(position: float) -> NDArray[Any]:
        return stream.at(START_US + round(position * SPEEDS[speed])).luma

    return render


def moving_scene(position: float, texture: str, width: int = 346, height: int = 260) -> FloatArray:
    """A panning texture with a counter-moving disc, 3×3 samples per pixel, float levels.

    Args:
        position: how far both have moved, px.
        texture: a name in `TEXTURES`.
        width: px.
        height: px.
    """
    samples = 3
    total = np.zeros((height, width))
    rows, columns = np.mgrid[:height, :width].astype(np.float64)
    for k in range(samples * samples):
        x = columns + (k % samples + 0.5) / samples - 0.5
        y = rows + (k // samples + 0.5) / samples - 0.5
        ground = value_noise(x + position, y + 0.3 * position, 1, texture)
        disc = value_noise(x - position, y - 0.2 * position, 20, texture)
        from_centre = np.hypot(x - width / 2 - position, y - height / 2 - 0.2 * position)
        total += np.where(from_centre < height / 4, disc, ground)
    return total / samples**2


def value_noise(x: FloatArray, y: FloatArray, seed: int, texture: str) -> FloatArray:
    """Random levels on a lattice, joined smoothly; 0..255."""
    total = np.zeros_like(x)
    for octave, (cell, weight) in enumerate(TEXTURES[texture]):
        lattice = np.random.default_rng(seed + octave).random((64, 64))
        u, v = x / cell, y / cell
        column, row = np.floor(u).astype(int), np.floor(v).astype(int)
        fx, fy = (f * f * (3 - 2 * f) for f in (u - column, v - row))
        left, right, top, bottom = column % 64, (column + 1) % 64, row % 64, (row + 1) % 64
        upper = lattice[top, left] * (1 - fx) + lattice[top, right] * fx
        lower = lattice[bottom, left] * (1 - fx) + lattice[bottom, right] * fx
        total += weight * (upper * (1 - fy) + lower * fy)
    return np.asarray(255 * np.clip((total - 0.5) * 1.6 + 0.5, 0, 1))
