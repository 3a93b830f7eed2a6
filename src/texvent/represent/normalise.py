"""Bring the values of a sparse grid to a common scale."""

from __future__ import annotations

from texvent.represent.array_ops import Array, ArrayOps


def normalise_nonzero(grid: Array, ops: ArrayOps) -> Array:
    """The grid with its non-zero values at mean 0 and standard deviation 1 (n − 1); zeros stay 0.

    Values that are all equal become 0.

    Args:
        grid: any shape, float32.
        ops: operations of the library that holds it.

    Returns:
        A new array, float32, standard deviations.

    Source: `EventPreprocessor` of rpg_e2vid and `VoxelGrid` of DSEC.
    """
    is_filled = grid != 0
    values = ops.cast(grid[is_filled], "float64")
    if not len(values):
        return ops.cast(grid, "float32")
    mean = values.mean()
    spread = values - mean
    # Compared by value: rounding in the mean can leave equal values a tiny deviation.
    is_constant = bool(values.min() == values.max())
    deviation = 1.0 if is_constant else float((spread * spread).sum() / (len(values) - 1)) ** 0.5
    wide = ops.cast(grid, "float64")
    scaled = (wide - (values[0] if is_constant else mean)) / deviation
    return ops.cast(ops.xp.where(is_filled, scaled, wide * 0.0), "float32")
