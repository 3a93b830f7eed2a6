"""Gestures of one hand: how far each finger is bent and how the hand turns, over time.

Their motion is in `data/hand_gestures.toml`.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

from texvent.scenes.models.people.activities import HAND_GESTURES
from texvent.scenes.models.people.tables import read_table
from texvent.scenes.models.people.track import Track, read_track


@dataclass(frozen=True)
class HandShape:
    """One instant of a hand: a right hand, fingers up, its palm to the front."""

    bent: tuple[float, float, float, float, float] = (0.0, 0.0, 0.0, 0.0, 0.0)
    """Thumb, index, middle, ring and little finger: 0 = straight .. 1 = in the fist."""
    spread: float = 0.3
    """0 = fingers side by side .. 1 = apart."""
    roll: float = 0.0
    """Turn in the plane of the palm, to its left (as seen from the front: clockwise), radians."""
    pitch: float = 0.0
    """Fingers to the front, radians."""
    yaw: float = 0.0
    """About the forearm, radians."""
    shift: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """Of the whole hand: front, left, up, m."""


def mix_shapes(first: HandShape, second: HandShape, share: float) -> HandShape:
    """Between two shapes: the first at share 0, the second at 1."""
    thumb, index, middle, ring, little = (
        a + share * (b - a) for a, b in zip(first.bent, second.bent, strict=True)
    )
    x, y, z = (a + share * (b - a) for a, b in zip(first.shift, second.shift, strict=True))
    numbers = {
        name: getattr(first, name) + share * (getattr(second, name) - getattr(first, name))
        for name in ("spread", "roll", "pitch", "yaw")
    }
    return HandShape((thumb, index, middle, ring, little), shift=(x, y, z), **numbers)


def find_shape(gesture: str, time_s: float) -> HandShape:
    """The shape of a gesture at a time, s; of an unknown one that of a hand at rest."""
    values = _find_track(gesture if gesture in HAND_GESTURES else "stand").at(time_s)
    return HandShape(**{name: numbers if name in _ROWS else numbers[0]
                        for name, numbers in values.items()})  # type: ignore[arg-type]  # fmt: skip


_ROWS = ("bent", "shift")
_CHANNELS = frozenset({"bent", "spread", "roll", "pitch", "yaw", "shift", "keys"})


@cache
def _find_track(gesture: str) -> Track:
    row = read_table("hand_gestures")[gesture]
    return read_track({key: value for key, value in row.items() if key in _CHANNELS})
