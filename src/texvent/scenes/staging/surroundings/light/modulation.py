"""Modulation of light over time: waves of lamps, and strokes of lightning."""

from __future__ import annotations

import math

ON_SHARES = {"square": 0.5, "switch": 0.5, "strobe": 0.35}
"""Wave that goes on and off → share of a period that it is on."""
DEPTHS = {"sine": 0.8, "switch": 0.9, "strobe": 0.96}
"""Wave of the light of a place → share of it that is gone at its darkest."""
FLAME_SHARES = ((1.0, 0.13), (1.83, 0.09), (3.17, 0.06))
"""Sines that make a flame flicker: multiple of its frequency, and amplitude."""
STROKE_HZ = 11.0
"""Strokes of lightning that follow each other fastest, per second."""
_FLASH_EVERY_S, _FIRST_S, _DECAY_S = 0.85, 0.3, 0.09
_STROKES = ((0.0, 1.0), (0.09, 0.55), (0.20, 0.85))
"""Strokes of one flash: seconds after its start, and brightness."""


def wave_level(wave: str, cycles: float, *, phase: float = 0.0, number: int = 0) -> float:
    """Share of full light after so many periods; 1 at their beginning.

    Args:
        wave: "sine", "square", "switch", "strobe", "flame", or "rotating": a beam that turns.
        cycles: periods since t = 0.
        phase: of a flame, 0..1.
        number: every second lamp of an object is seen when a rotating beam is half a turn on.
    """
    turn = 2.0 * math.pi
    if wave in ON_SHARES:
        return float(cycles % 1.0 < ON_SHARES[wave])
    if wave == "flame":
        return 1.0 + sum(
            share * math.sin(turn * (multiple * cycles + phase * (1.0 + multiple)))
            for multiple, share in FLAME_SHARES
        )
    if wave == "rotating":
        return max(math.cos(turn * cycles + math.pi * number), 0.0) ** 2
    return 0.5 + 0.5 * math.cos(turn * cycles)


def flash_number(time_s: float) -> int:
    """Number of the last flash of lightning that has begun; -1 = none."""
    return math.floor((time_s - _FIRST_S) / _FLASH_EVERY_S)


def lightning_level(time_s: float) -> float:
    """Light of lightning at that instant, 0 = dark .. 1 = the brightest stroke.

    Example:
        >>> lightning_level(0.0), lightning_level(0.3)
        (0.0, 1.0)
    """
    number = flash_number(time_s)
    age = time_s - _FIRST_S - number * _FLASH_EVERY_S
    levels = (light * math.exp((start - age) / _DECAY_S) for start, light in _STROKES
              if age >= start)  # fmt: skip
    return max(levels) if number >= 0 else 0.0
