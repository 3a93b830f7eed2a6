"""Fields that repeat without a seam: noise, cells and strokes on a square grid of texels.

Every value comes from hashed integers through sums, products and square roots, which every machine
rounds alike, so tiles have the same bits everywhere.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float64]

SIDE = 256
"""Texels along a tile's side."""
_VALUE_NOISE_STD = 0.43
"""Standard deviation of value noise whose lattice numbers are uniform in [-1, 1]."""
_DIRECTIONS = 64
_FINE = 2
"""Strokes are painted this many times finer than texels, then averaged."""


def hashed(i: NDArray[np.int64], j: NDArray[np.int64], salt: int) -> Field:
    """A fixed pseudo-random number in [0, 1) for each pair of integers."""
    with np.errstate(over="ignore"):
        mixed = (
            i.astype(np.uint64) * np.uint64(0x9E3779B97F4A7C15)
            + j.astype(np.uint64) * np.uint64(0xC2B2AE3D27D4EB4F)
            + np.uint64(salt) * np.uint64(0x165667B19E3779F9)
        )
        for shift, factor in ((30, 0xBF58476D1CE4E5B9), (27, 0x94D049BB133111EB)):
            mixed = (mixed ^ (mixed >> np.uint64(shift))) * np.uint64(factor)
        mixed ^= mixed >> np.uint64(31)
    return (mixed >> np.uint64(40)).astype(np.float64) / float(1 << 24)


def hashed_row(count: int, salt: int) -> Field:
    """[count] fixed pseudo-random numbers in [0, 1)."""
    index = np.arange(count, dtype=np.int64)
    return hashed(index, np.zeros_like(index), salt)


def smooth_step(field: Field, low: float | Field, high: float | Field) -> Field:
    """0 below `low`, 1 above `high`, smooth between."""
    share = np.clip((field - low) / (high - low), 0.0, 1.0)
    return share * share * (3.0 - 2.0 * share)


def exponential(field: Field) -> Field:
    """About e^field, by products alone: (1 + field / 16)^16, for fields above -16."""
    power = np.maximum(1.0 + field / 16.0, 0.0)
    for _ in range(4):
        power = power * power
    return power


def grid() -> tuple[Field, Field]:
    """X and y of the texels' middles, [SIDE, SIDE] each, in [0, 1)."""
    middle = (np.arange(SIDE) + 0.5) / SIDE
    return np.broadcast_to(middle, (SIDE, SIDE)), np.broadcast_to(middle[:, None], (SIDE, SIDE))


def noise(columns: int, salt: int, rows: int | None = None) -> Field:
    """Value noise with that many lattice cells per tile; about unit standard deviation."""
    rows = columns if rows is None else rows
    i, j = np.meshgrid(np.arange(columns), np.arange(rows))
    return interpolated(2.0 * hashed(i, j, salt) - 1.0) / _VALUE_NOISE_STD


def interpolated(lattice: Field) -> Field:
    """A field, smooth between the numbers [rows, columns] of a lattice over the tile."""
    rows, columns = lattice.shape
    left, across = _lattice_places(columns)
    top, down = _lattice_places(rows)
    wide = lattice[:, left] * (1.0 - across) + lattice[:, (left + 1) % columns] * across
    down = down[:, None]
    return np.asarray(wide[top] * (1.0 - down) + wide[(top + 1) % rows] * down)


def _lattice_places(cells: int) -> tuple[NDArray[np.int64], Field]:
    """Left lattice point of every texel, and its smoothed share of the way to the next."""
    place = (np.arange(SIDE) + 0.5) / SIDE * cells
    left = np.floor(place).astype(np.int64)
    share = place - left
    return left % cells, share * share * share * (share * (6.0 * share - 15.0) + 10.0)


def fractal(cells: int, octaves: int, salt: int, *, gain: float = 0.8, stretch: int = 1) -> Field:
    """Octaves of noise, each twice as fine; about unit standard deviation.

    Args:
        cells: lattice cells of the first octave along y; `stretch` times as many along x.
        octaves: how many; those finer than two texels are left out.
        salt: which noise.
        gain: strength of an octave relative to the one before; 1 = the spectrum of natural images.
        stretch: how much finer it is along x: strands along y.

    Returns:
        [SIDE, SIDE].
    """
    total, power = np.zeros((SIDE, SIDE)), 0.0
    for octave in range(octaves):
        rows = cells << octave
        columns = rows * stretch
        if rows > SIDE // 2:
            break
        strength = gain**octave
        total += strength * noise(min(columns, SIDE // 2), salt + 101 * octave, rows)
        power += strength * strength
    return total / math.sqrt(power)


def cells(columns: int, salt: int, rows: int | None = None) -> tuple[Field, Field, Field]:
    """Cells around scattered points (Worley 1996), one point in every square of a lattice.

    Returns:
        Distance to the nearest point and to the second nearest, in lattice squares, and a random
        number in [0, 1) of the nearest one's cell; [SIDE, SIDE] each.
    """
    rows = columns if rows is None else rows
    middle = (np.arange(SIDE) + 0.5) / SIDE
    x, y = middle * columns, middle * rows
    column, row = np.floor(x).astype(np.int64), np.floor(y).astype(np.int64)
    lattice = np.meshgrid(np.arange(columns), np.arange(rows))
    right, low, name = (hashed(*lattice, salt + number) for number in range(3))
    nearest, second = np.full((SIDE, SIDE), 9.0), np.full((SIDE, SIDE), 9.0)
    names = np.zeros((SIDE, SIDE))
    for dj in (-1, 0, 1):
        for di in (-1, 0, 1):
            there = np.ix_((row + dj) % rows, (column + di) % columns)
            across = (column + di + 0.1) + 0.8 * right[there] - x
            down = (row + dj + 0.1)[:, None] + 0.8 * low[there] - y[:, None]
            distance = np.sqrt(across * across + down * down)
            is_nearer = distance < nearest
            second = np.where(is_nearer, nearest, np.minimum(second, distance))
            names = np.where(is_nearer, name[there], names)
            nearest = np.where(is_nearer, distance, nearest)
    return nearest, second, names


def strokes(
    count: int,
    salt: int,
    *,
    length: float,
    lean: float = 1.0,
    width: int = 1,
    ground: float = 0.0,
) -> Field:
    """Short strokes painted over each other in shades from 0 to 1: blades, hairs, needles.

    Args:
        count: how many.
        salt: which ones.
        length: of the longest, in tiles.
        lean: largest angle from y: 0 = all along y, 1 = any direction.
        width: in half texels.
        ground: shade where there is no stroke.

    Returns:
        [SIDE, SIDE].
    """
    side = _FINE * SIDE
    canvas = np.full((side, side), ground)
    turn = np.floor(hashed_row(count, salt) * _DIRECTIONS).astype(np.int64)
    angles = [
        lean * math.pi * (k + 0.5 - _DIRECTIONS / 2) / _DIRECTIONS for k in range(_DIRECTIONS)
    ]
    sine = np.array([round(math.sin(angle), 6) for angle in angles])[turn]
    cosine = np.array([round(math.cos(angle), 6) for angle in angles])[turn]
    reach = side * length * (0.5 + 0.5 * hashed_row(count, salt + 1))
    steps = max(int(side * length), 2)
    place = (np.arange(steps) / (steps - 1))[:, None]
    x = side * hashed_row(count, salt + 2) + place * reach * sine
    y = side * hashed_row(count, salt + 3) + place * reach * cosine
    # A stroke is dark at its foot and bright at its tip.
    shade = (0.15 + 0.85 * hashed_row(count, salt + 4)) * (0.45 + 0.55 * place)
    for side_step in range(width):
        column = np.floor(x + side_step * cosine).astype(np.int64) % side
        row = np.floor(y - side_step * sine).astype(np.int64) % side
        canvas[row.T.ravel(), column.T.ravel()] = shade.T.ravel()
    blocks = canvas.reshape(SIDE, _FINE, SIDE, _FINE)
    return np.asarray(
        (blocks[:, 0, :, 0] + blocks[:, 0, :, 1] + blocks[:, 1, :, 0] + blocks[:, 1, :, 1]) / 4.0
    )


def courses(
    columns: int, rows: int, joint: tuple[float, float], *, is_staggered: bool = True, salt: int
) -> tuple[Field, Field]:
    """Bricks, slabs or boards in rows.

    Args:
        columns: pieces along x.
        rows: pieces along y; even where they are staggered.
        joint: width of a joint as a share of a piece, along x and along y.
        is_staggered: whether every other row is moved by half a piece.
        salt: which random numbers.

    Returns:
        Share of a piece rather than a joint at each texel, and a random number in [0, 1) of each
        piece; [SIDE, SIDE] each.
    """
    x, y = grid()
    y = y * rows
    row = np.floor(y).astype(np.int64)
    x = x * columns + (0.5 * (row % 2) if is_staggered else 0.0)
    column = np.floor(x).astype(np.int64)
    edge_x = np.minimum(x - column, column + 1 - x) - 0.5 * joint[0]
    edge_y = np.minimum(y - row, row + 1 - y) - 0.5 * joint[1]
    soft_x, soft_y = 0.75 * columns / SIDE, 0.75 * rows / SIDE
    inside = np.minimum(smooth_step(edge_x, -soft_x, soft_x), smooth_step(edge_y, -soft_y, soft_y))
    return inside, hashed(column % columns, row, salt)
