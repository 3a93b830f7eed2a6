"""How N-MNIST's sensor moved: three saccades, measured on pairs of a digit and its recording.

A digit of 28×28 px lies on a sensor of 34×34 px; its corner moves. The benchmark of digits and the
camera path `saccade` over still images use the same numbers.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Float64Array = NDArray[np.float64]


class Segment(NamedTuple):
    """A movement along one axis; those of an axis add up."""

    start_ms: float
    stop_ms: float
    distance: float
    """px."""


START = np.array([0.3, 0.4])
"""x and y of the digit's corner at rest, px."""
SEGMENTS: tuple[tuple[Segment, ...], tuple[Segment, ...]] = (
    (Segment(33, 74, 1.1), Segment(62, 204, 3.9), Segment(216, 303, -4.45)),
    (Segment(2, 86, 5.5), Segment(110, 189, -5.0), Segment(216, 303, -0.6)),
)
"""Along x and y. Fitted to the positions of 100 pairs in windows of 10 ms: images of events,
correlated with the gradients of their digit; 0.1 px rms away from them."""
DURATION_US = 315_000
"""Three movements of 105 ms, as the camera's program made them."""


def digit_corner(t_us: float, speed: Float64Array, amplitude: Float64Array) -> Float64Array:
    """Where the corner of digits is.

    Args:
        t_us: since the recording began, µs.
        speed: of each recording, 1 is the measured one, [n].
        amplitude: of each recording's movement, 1 is the measured one, [n].

    Returns:
        [n, 2] x and y, px.

    Source of the shape: minimum jerk, T. Flash and N. Hogan, "The coordination of arm movements",
        J. Neurosci. 1985.
    """
    t_ms = t_us / 1000 * speed
    moved = np.zeros((2, len(t_ms)))
    for axis, segments in enumerate(SEGMENTS):
        for one in segments:
            part = (t_ms - one.start_ms) / (one.stop_ms - one.start_ms)
            moved[axis] += one.distance * _minimum_jerk(part)
    return START + amplitude[:, None] * moved.T


def _minimum_jerk(part: Float64Array) -> Float64Array:
    """Share of the way after a share of the time."""
    u = np.clip(part, 0.0, 1.0)
    return np.asarray(u**3 * (10 - 15 * u + 6 * u**2))
