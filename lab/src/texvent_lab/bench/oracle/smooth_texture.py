"""Value noise: a smooth random texture that is exact at any point, so it can move by any amount."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

TABLE = 64
"""Lattice points per side; the texture repeats after them."""
OCTAVES = ((16.0, 0.55), (5.0, 0.30), (2.3, 0.15))
"""Lattice spacing, px, and weight."""

Float64Array = NDArray[np.float64]


class ValueNoise:
    """Random lattices, interpolated with smoothstep, in three octaves."""

    def __init__(self, seed: int) -> None:
        """Draw the lattices.

        Args:
            seed: which texture.
        """
        self._lattices = [
            np.random.default_rng([seed, octave]).random((TABLE, TABLE))
            for octave in range(len(OCTAVES))
        ]

    def sample(self, x: Float64Array, y: Float64Array) -> Float64Array:
        """The texture on a grid of columns and rows.

        Args:
            x: position of each column, px, [W]; any numbers.
            y: position of each row, px, [H].

        Returns:
            [H, W], 0..1, mean near 0.5.
        """
        total = np.zeros((len(y), len(x)))
        for lattice, (spacing, weight) in zip(self._lattices, OCTAVES, strict=True):
            # Bilinear in smoothstep weights: one sparse matrix per axis, so two products.
            total += weight * (_weights(y / spacing) @ lattice @ _weights(x / spacing).T)
        return total


def _weights(position: Float64Array) -> Float64Array:
    """Share of each lattice line at each position, [n, TABLE]."""
    cell = np.floor(position)
    rest = position - cell
    upper = rest * rest * (3 - 2 * rest)
    first = cell.astype(np.int64) % TABLE
    weights = np.zeros((len(position), TABLE))
    row = np.arange(len(position))
    weights[row, first] = 1 - upper
    weights[row, (first + 1) % TABLE] = upper
    return weights
