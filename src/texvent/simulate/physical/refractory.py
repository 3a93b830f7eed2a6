"""The refractory period: what an event does to its pixel besides resetting it.

`reference.py` (`_fire`) applies these rules, and `circuit_segments_cpu.py` in compiled form.
"""

from __future__ import annotations

from typing import NamedTuple


class ResetRules(NamedTuple):
    """What an event does to its pixel besides resetting it."""

    refractory_us: int
    """The refractory period: how long the pixel is held in reset, and change is lost; 0 is none."""
    by_noise: bool
    """Whether noise events reset their pixels too."""
