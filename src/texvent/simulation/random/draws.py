"""Keyed random draws: numbers that depend on what they are for, never on when they are drawn.

A draw is a hash of (seed, frame, y, x, draw): the same five numbers give the same 64 bits in any
order, on any number of threads, in NumPy here and in the compiled twin `compiled_draws`. So a
clip can be tiled or run on another backend without moving one noise event. Pixel models identify a
frame by the time since the first, so shifting a clip in time shifts its events and nothing else.

The hash is two rounds of the SplitMix64 finaliser (Steele, Lea and Flood, "Fast splittable
pseudorandom number generators", OOPSLA 2014). The second round mixes the key in again; without
it, two frames would read the same sequence at two offsets.
"""

from __future__ import annotations

import math
from enum import IntEnum
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

Uint64Array: TypeAlias = NDArray[np.uint64]
Float64Array: TypeAlias = NDArray[np.float64]

GOLDEN = 0x9E3779B97F4A7C15
"""2⁶⁴ divided by the golden ratio, odd: spreads neighbouring counters over all 64 bits."""
MULTIPLIER_1 = 0xBF58476D1CE4E5B9
MULTIPLIER_2 = 0x94D049BB133111EB
MASK_64 = 0xFFFF_FFFF_FFFF_FFFF
UNIT = 2.0**-53
"""Spacing of the uniform numbers: the top 53 bits of a word fill a float64 exactly."""
HALF_UNIT = 2.0**-32
"""Spacing of the uniform numbers that are made of half a word."""


class Purpose(IntEnum):
    """Purposes of a pixel's draws. Each has draws 0, 1, 2, ... of its own in every frame."""

    NOISE_COUNT = 0
    NOISE_POLARITY = 1
    NOISE_TIME = 2
    VOLTAGE = 3
    TIMESTAMP = 4
    THRESHOLD_ON = 5
    THRESHOLD_OFF = 6
    LEAK_RATE = 7
    HOT_PIXEL = 8
    FIRST_PASSAGE = 9
    PHASE = 10
    NOISE_RATE = 11
    NOISE_PLACE = 15

    def draw(self, order: Any = 0) -> Any:
        """Number of this purpose's draw `order` (0..2²⁸−1, one or an array), for `draw_words`."""
        return order + (int(self) << 28)


def frame_key(seed: int, frame: int) -> np.uint64:
    """Key of all draws of one frame.

    Args:
        seed: 0..2⁶³−1; 0 is as good as any.
        frame: identifies this frame in the run, any integer: its index, or its time since the
            first frame, µs.

    Returns:
        64 bits, different for each frame of a seed.
    """
    start = _mix_integer(int(seed) + GOLDEN)
    return np.uint64(_mix_integer(start + (int(frame) & MASK_64) * GOLDEN))


def frame_keys(seed: int, frames: ArrayLike) -> Uint64Array:
    """`frame_key` of many frames of a seed, of the shape of `frames`, int64."""
    start = np.uint64(_mix_integer(int(seed) + GOLDEN))
    steps = np.asarray(frames, np.int64).view(np.uint64) * np.uint64(GOLDEN)
    return np.asarray(_mix(start + steps))


def draw_words(key: np.uint64, y: ArrayLike, x: ArrayLike, draw: ArrayLike) -> Uint64Array:
    """64 random bits per pixel.

    Args:
        key: of `frame_key`.
        y: rows, 0..65535, any shape that broadcasts with `x` and `draw`.
        x: columns, 0..65535.
        draw: which of the pixel's draws in this frame, 0..2³²−1.

    Returns:
        Words, uint64, of the broadcast shape.
    """
    rows, columns, draws = (_unsigned(one) for one in (y, x, draw))
    counter = (draws << np.uint64(32)) | (rows << np.uint64(16)) | columns
    # Wrapping around 2⁶⁴ is meant; NumPy warns of it for single numbers only.
    with np.errstate(over="ignore"):
        word = _mix(counter * np.uint64(GOLDEN) + key)
        return np.asarray(_mix(word ^ key))


def draw_uniforms(key: np.uint64, y: ArrayLike, x: ArrayLike, draw: ArrayLike) -> Float64Array:
    """Uniform numbers in [0, 1), multiples of 2⁻⁵³; arguments as for `draw_words`."""
    words = draw_words(key, y, x, draw)
    return np.asarray((words >> np.uint64(11)).astype(np.float64) * UNIT)


def draw_normals(key: np.uint64, y: ArrayLike, x: ArrayLike, draw: ArrayLike) -> Float64Array:
    """Normal numbers, mean 0, sd 1, by the Box-Muller transform of draws `draw` and `draw + 1`.

    Their last bit may differ between NumPy builds, because those of log and cos do.
    """
    # 1 - u lies in (0, 1], so the logarithm exists.
    radius = np.sqrt(-2.0 * np.log(1.0 - draw_uniforms(key, y, x, draw)))
    angle = 2.0 * math.pi * draw_uniforms(key, y, x, np.asarray(draw) + 1)
    return np.asarray(radius * np.cos(angle))


def _unsigned(value: ArrayLike) -> Uint64Array:
    return np.asarray(value).astype(np.uint64, copy=False)


def _mix(word: Any) -> Any:
    """SplitMix64 finaliser, a bijection on 64 bits, for arrays."""
    word = (word ^ (word >> np.uint64(30))) * np.uint64(MULTIPLIER_1)
    word = (word ^ (word >> np.uint64(27))) * np.uint64(MULTIPLIER_2)
    return word ^ (word >> np.uint64(31))


def _mix_integer(word: int) -> int:
    """The same for one Python integer."""
    word &= MASK_64
    word = (word ^ (word >> 30)) * MULTIPLIER_1 & MASK_64
    word = (word ^ (word >> 27)) * MULTIPLIER_2 & MASK_64
    return word ^ (word >> 31)
