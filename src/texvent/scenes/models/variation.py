"""Details that differ from one seed to the next, keyed by (seed, detail), never by call order."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar
from zlib import crc32

from texvent.scenes.scene import Colour

T = TypeVar("T")

_MASK = (1 << 64) - 1


def fraction(seed: int, detail: str) -> float:
    """A number in [0, 1) that depends on nothing but the seed and the detail's name."""
    bits = (seed * 0x9E3779B97F4A7C15 + crc32(detail.encode())) & _MASK
    # SplitMix64's finaliser (Steele, Lea, Flood 2014): neighbouring seeds look unrelated.
    bits = ((bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9) & _MASK
    bits = ((bits ^ (bits >> 27)) * 0x94D049BB133111EB) & _MASK
    bits ^= bits >> 31
    return (bits >> 11) / float(1 << 53)


def between(seed: int, detail: str, low: float, high: float) -> float:
    """A number in [low, high)."""
    return low + (high - low) * fraction(seed, detail)


def paint(colour: Colour | None, seed: int, detail: str, usual: Sequence[Colour]) -> Colour:
    """The colour asked for, or one of the usual ones."""
    return colour if colour is not None else choose(seed, detail, usual)


def choose(seed: int, detail: str, options: Sequence[T]) -> T:
    """One of the options."""
    return options[int(fraction(seed, detail) * len(options))]
