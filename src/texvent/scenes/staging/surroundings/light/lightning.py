"""When lightning flashes, and how bright it is: a function of time alone."""

from __future__ import annotations

import math

FLASH_EVERY_S = 0.85
"""Time from one flash to the next."""
FIRST_S = 0.3
STROKES = ((0.0, 1.0), (0.09, 0.55), (0.20, 0.85))
"""Strokes of one flash: seconds after its start, and brightness."""
DECAY_S = 0.09
STROKE_HZ = 11.0
"""Strokes that follow each other fastest, per second."""


def flash_number(time_s: float) -> int:
    """Number of the last flash that has begun; -1 = none."""
    return math.floor((time_s - FIRST_S) / FLASH_EVERY_S)


def lightning_level(time_s: float) -> float:
    """Light of lightning at that instant, 0 = dark .. 1 = the brightest stroke.

    Example:
        >>> lightning_level(0.0), lightning_level(0.3)
        (0.0, 1.0)
    """
    number = flash_number(time_s)
    if number < 0:
        return 0.0
    age = time_s - FIRST_S - number * FLASH_EVERY_S
    levels = (
        bright * math.exp(-(age - start) / DECAY_S) for start, bright in STROKES if age >= start
    )
    return max(levels)
