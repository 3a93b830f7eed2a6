"""Reach of a machine's hand, which two settings move ahead and up."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable

import numpy as np

from texvent_scenes.rendered_scene import Float64Array

REACHED_M = 0.03
"""Most that is left of the way of a hand to a thing."""
_SEARCHED = (25, 5, 5, 5)
"""Values of each setting that are tried, each time closer to the best ones."""


class OutOfReachError(Exception):
    """A thing is not where a machine's hand gets, which is at two distances and between them."""

    def __init__(self, near_m: float, far_m: float, way_rad: float) -> None:
        super().__init__(near_m, far_m)
        self.near_m, self.far_m, self.way_rad = near_m, far_m, way_rad


def search(
    hand: Callable[[float, float], Float64Array],
    spans: tuple[tuple[float, float], tuple[float, float]],
    ahead_m: float,
    up_m: float,
) -> tuple[float, float, tuple[float, float, float]]:
    """Nearest and furthest place of a hand at a height, and how it gets closest to one.

    Args:
        hand: both settings -> [3] its place, body coordinates.
        spans: least and greatest value of both.
        ahead_m: how far ahead it has to get, m.
        up_m: how high, m.

    Returns:
        Both distances, m; both settings, and what is left of the way, m.
    """
    near_m, far_m, best = math.inf, -math.inf, (0.0, 0.0, math.inf)
    for steps in _SEARCHED:
        axes = [np.linspace(*span, steps if span[1] > span[0] else 1) for span in spans]
        for first, second in itertools.product(*axes):
            x, _, z = hand(float(first), float(second))
            off = math.hypot(x - ahead_m, z - up_m)
            best = min(best, (float(first), float(second), off), key=lambda one: one[2])
            if steps == _SEARCHED[0] and abs(z - up_m) < REACHED_M:
                near_m, far_m = min(near_m, float(x)), max(far_m, float(x))
        spans = _closer(spans[0], best[0], steps), _closer(spans[1], best[1], steps)
    return near_m, far_m, best


def _closer(span: tuple[float, float], at: float, steps: int) -> tuple[float, float]:
    """The part of a span about a value."""
    step = (span[1] - span[0]) / (steps - 1)
    return max(at - step, span[0]), min(at + step, span[1])
