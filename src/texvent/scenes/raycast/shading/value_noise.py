"""Smooth noise and filtered patterns that stay calm when they shrink (compiled by Numba).

Every pattern takes its footprint, the pattern length that one pixel covers, and fades to its mean
as the footprint approaches the pattern's own detail. Detail finer than a pixel would flicker as
objects move, and an event simulator would report the flicker.
"""

from __future__ import annotations

import math

from texvent.runtime.jit import jit


@jit(error_model="numpy", inner=True)
def lattice(x: int, y: int, z: int) -> float:
    """A fixed pseudo-random number in [0, 1) for each lattice point."""
    mixed = x * 0x2545F4914F6CDD1D + y * 0x369DEA0F31A53F85 + z * 0x27BB2EE687B0B0FD
    mixed ^= mixed >> 31
    mixed *= 0x1B8735939E3779B9
    mixed ^= mixed >> 29
    mixed *= 0x38495AB5A4C1FE5D
    mixed ^= mixed >> 33
    return (mixed & 0xFFFFFF) / 16777216.0


@jit(error_model="numpy", inner=True)
def smooth(x: float) -> float:
    """0 below 0, 1 above 1, smooth between (continuous second derivative)."""
    if x <= 0.0:
        return 0.0
    if x >= 1.0:
        return 1.0
    return x * x * x * (x * (6.0 * x - 15.0) + 10.0)


@jit(error_model="numpy")
def detail_fade(footprint: float) -> float:
    """Share of a pattern of period 1 to show: all if a pixel covers little of it, none from 1/2."""
    return smooth((0.5 - footprint) * 4.0)


@jit(error_model="numpy")
def noise_2d(x: float, y: float, layer: int) -> float:
    """Value noise in [-1, 1], lattice spacing 1."""
    column, row = math.floor(x), math.floor(y)
    i, j = int(column), int(row)
    u, v = smooth(x - column), smooth(y - row)
    top = lattice(i, j, layer) * (1.0 - u) + lattice(i + 1, j, layer) * u
    bottom = lattice(i, j + 1, layer) * (1.0 - u) + lattice(i + 1, j + 1, layer) * u
    return 2.0 * (top * (1.0 - v) + bottom * v) - 1.0


@jit(error_model="numpy")
def noise_3d(x: float, y: float, z: float) -> float:
    """Value noise in [-1, 1], lattice spacing 1."""
    floor_z = math.floor(z)
    k, w = int(floor_z), smooth(z - floor_z)
    return noise_2d(x, y, k) * (1.0 - w) + noise_2d(x, y, k + 1) * w


@jit(error_model="numpy")
def fractal_2d(x: float, y: float, octaves: int, footprint: float) -> float:
    """Sum of noise octaves (each twice as fine and half as strong), about [-1, 1]."""
    total, strength = 0.0, 0.5
    for octave in range(octaves):
        share = detail_fade(footprint)
        if share == 0.0:
            break
        # Each octave is turned by 37°, so that no lattice direction stands out.
        x, y = 0.8 * x - 0.6 * y + 17.1, 0.6 * x + 0.8 * y + 5.3
        total += strength * share * noise_2d(x, y, octave)
        x, y = 2.03 * x, 2.03 * y
        footprint *= 2.03
        strength *= 0.5
    return 1.6 * total


@jit(error_model="numpy", inner=True)
def _square_integral(x: float) -> float:
    """Integral from 0 to x of the square wave that is 1 on [0, 1/2) and 0 on [1/2, 1)."""
    whole = math.floor(x)
    return 0.5 * whole + min(x - whole, 0.5)


@jit(error_model="numpy")
def square_wave(x: float, footprint: float) -> float:
    """Average over `footprint` of the wave that is 1 on [0, 1/2), 0 on [1/2, 1), and repeats."""
    width = max(footprint, 1e-6)
    return (_square_integral(x + 0.5 * width) - _square_integral(x - 0.5 * width)) / width


@jit(error_model="numpy")
def box_coverage(x: float, low: float, high: float, footprint: float) -> float:
    """Share of the stretch of length `footprint` around x that lies in [low, high]."""
    width = max(footprint, 1e-9)
    start, stop = max(x - 0.5 * width, low), min(x + 0.5 * width, high)
    return max(stop - start, 0.0) / width
