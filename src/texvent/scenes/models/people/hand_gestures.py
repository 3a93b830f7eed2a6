"""Gestures of one hand: how far each finger is bent and how the hand turns, over time."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

from texvent.scenes.models.people.timing import ease, follow_keys, pulse, swing


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


Gesture = Callable[[float], HandShape]
"""Shape as a function of time, s."""

OPEN = HandShape()
FIST = HandShape((0.9, 1.0, 1.0, 1.0, 1.0), 0.0)
PAPER = HandShape((0.1, 0.0, 0.0, 0.0, 0.0), 0.15)
SCISSORS = HandShape((0.9, 0.0, 0.0, 1.0, 1.0), 0.8)
_POINTING = HandShape((0.85, 0.0, 1.0, 1.0, 1.0), 0.0)
_THUMB_UP = HandShape((0.0, 1.0, 1.0, 1.0, 1.0), 0.0)


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


def _wave(t: float) -> HandShape:
    return replace(OPEN, roll=0.5 * swing(t, 1.6), spread=0.5)


def _open_and_close(t: float) -> HandShape:
    return mix_shapes(replace(OPEN, spread=0.6), FIST, pulse(t, 0.8))


def _grasp(t: float) -> HandShape:
    closed = HandShape((0.7, 0.62, 0.62, 0.62, 0.62), 0.1, pitch=0.5, shift=(0.06, 0.0, 0.0))
    share = ease(t % 2.0, 0.1, 0.7) - ease(t % 2.0, 1.3, 1.9)
    return mix_shapes(replace(OPEN, spread=0.6, pitch=0.2), closed, share)


def _fist(t: float) -> HandShape:
    share = ease(t % 2.4, 0.2, 0.7) - ease(t % 2.4, 1.8, 2.3)
    return mix_shapes(OPEN, FIST, share)


def _point(t: float) -> HandShape:
    jab = 0.05 * pulse(t, 0.9)
    return replace(_POINTING, roll=-1.35, shift=(0.0, -jab, 0.0))


def _count(t: float) -> HandShape:
    """One finger after the other comes up, half a second each; then the fist again."""
    step = (t % 3.4) / 0.5
    close = ease(t % 3.4, 2.8, 3.3)
    order = (5, 1, 2, 3, 4)  # when thumb, index, ... come up
    thumb, index, middle, ring, little = (
        min(1.0, 1.0 - ease(step, when - 0.6, when) + close) for when in order
    )
    return HandShape((thumb, index, middle, ring, little), 0.5)


def _thumb(up: float) -> Gesture:
    def move(t: float) -> HandShape:
        nod = 0.04 * swing(t, 1.0)
        return replace(_THUMB_UP, roll=-up * 0.5 * math.pi, shift=(0.0, 0.0, nod))

    return move


def _shown(bent: tuple[float, float, float, float, float]) -> Gesture:
    """Fingers held up."""
    return lambda t: HandShape(bent, 0.8, roll=0.12 * swing(t, 0.7))


def _rotate(t: float) -> HandShape:
    return replace(OPEN, yaw=1.6 * swing(t, 0.6), spread=0.5)


def _swipe(left: float, up: float) -> Gesture:
    """Fast one way with the flat hand, then back with bent fingers."""

    def move(t: float) -> HandShape:
        phase = t % 1.4
        way, bent = follow_keys(
            phase, [(0.0, (-1.0, 0.0)), (0.2, (-0.8, 0.0)), (0.5, (0.9, 0.0)), (0.7, (1.0, 0.4)),
                    (1.1, (-0.6, 0.6))], 1.4,
        )  # fmt: skip
        flat = (0.3, bent, bent, bent, bent)
        return HandShape(flat, 0.1, roll=0.35 * left * way, pitch=-0.4 * up * way,
                         shift=(0.0, 0.14 * left * way, 0.12 * up * way))  # fmt: skip

    return move


def _pinch(t: float) -> HandShape:
    near = pulse(t, 0.9)
    return HandShape((0.25 + 0.35 * near, 0.25 + 0.33 * near, 0.45, 0.55, 0.6), 0.3, yaw=0.5)


def _snap(t: float) -> HandShape:
    go = ease(t % 1.2, 0.5, 0.58) - ease(t % 1.2, 0.8, 1.15)
    return HandShape((0.6 + 0.3 * go, 0.15, 0.5 + 0.5 * go, 0.8, 0.9), 0.2, roll=0.2 * go, yaw=0.5)


def _tap(t: float) -> HandShape:
    down = pulse(t, 1.6) ** 2
    return replace(_POINTING, pitch=0.5 + 0.45 * down, shift=(0.03 * down, 0.0, -0.02 * down))


def _type(t: float) -> HandShape:
    index, middle, ring, little = (
        0.30 + 0.28 * pulse(t, 2.6, phase) for phase in (0.0, 0.55, 0.25, 0.8)
    )
    return HandShape((0.3, index, middle, ring, little), 0.4, pitch=1.0,
                     shift=(0.0, 0.03 * swing(t, 0.5), 0.0))  # fmt: skip


def _play(t: float) -> HandShape:
    """Three shakes of the fist, then rock, paper or scissors, in turn."""
    number, phase = divmod(t, 1.9)
    shape = (PAPER, SCISSORS, FIST)[int(number) % 3]
    share = ease(phase, 0.95, 1.15) - ease(phase, 1.6, 1.85)
    shakes = 1.0 - ease(phase, 0.9, 1.05) if phase < 1.6 else 0.0
    shake = 0.06 * swing(phase, 3.0 / 1.05) * shakes
    return replace(mix_shapes(FIST, shape, share), roll=-0.3, shift=(0.0, 0.0, shake))


HAND_MOVEMENTS: Mapping[str, Gesture] = MappingProxyType(
    {
        "stand": lambda t: replace(OPEN, roll=0.03 * swing(t, 0.3)),
        "wave": _wave,
        "open and close": _open_and_close,
        "grasp": _grasp,
        "fist": _fist,
        "point": _point,
        "count": _count,
        "thumbs up": _thumb(1.0),
        "thumbs down": _thumb(-1.0),
        "victory": lambda t: replace(SCISSORS, roll=0.15 * swing(t, 0.7)),
        "one": _shown((0.9, 0.0, 1.0, 1.0, 1.0)),
        "three": _shown((0.9, 0.0, 0.0, 0.0, 1.0)),
        "four": _shown((0.9, 0.0, 0.0, 0.0, 0.0)),
        "five": _shown((0.0, 0.0, 0.0, 0.0, 0.0)),
        "horns": _shown((0.9, 0.0, 1.0, 1.0, 0.0)),
        "shaka": _shown((0.0, 1.0, 1.0, 1.0, 0.0)),
        "ok": lambda t: HandShape((0.62, 0.60, 0.12, 0.06, 0.0), 0.8, roll=0.12 * swing(t, 0.7)),
        "rotate": _rotate,
        "swipe left": _swipe(-1.0, 0.0),
        "swipe right": _swipe(1.0, 0.0),
        "swipe up": _swipe(0.0, 1.0),
        "swipe down": _swipe(0.0, -1.0),
        "pinch": _pinch,
        "snap": _snap,
        "tap": _tap,
        "type": _type,
        "rock paper scissors": _play,
    }
)
"""Gesture → shape over time."""
