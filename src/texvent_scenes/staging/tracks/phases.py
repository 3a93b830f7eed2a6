"""Kinds of motion, and the phases of an object's motion: times and usual speeds."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from texvent_scenes.description import STANDING
from texvent_scenes.models.activities import (
    TRAVELLING,
)
from texvent_scenes.models.protocol import Model, Noun
from texvent_scenes.models.tables import nouns_with, trait_value
from texvent_scenes.spec.scene import Motion

PATH_KINDS = TRAVELLING | frozenset({"drive", "fly", "sail", "paddle", "slide", "roll", "move"})
"""Motions from one place to another."""
GOING = PATH_KINDS | {"reverse"}
"""Those with a direction of travel."""
STEERED = GOING | {"turn"}
_KEYED = STEERED - PATH_KINDS | {"jump", "rise", "sink", "topple"}

YAWS = {
    "right": 0.0,
    "left": math.pi,
    "away": 0.5 * math.pi,
    "up": 0.5 * math.pi,
    "towards": -0.5 * math.pi,
    "down": -0.5 * math.pi,
}
"""Direction → heading; up and down are along a slope for what moves on the ground."""
_STEERED_DIRECTIONS = frozenset({"backward", "around"})
COMING_DOWN = frozenset({"fall", "bounce", "throw", "sink"})
"""Motions that begin at a height that is said, and lead to the ground."""
_RUNNING = 2.5
"""Running over walking speed of nouns without a number for it."""


@dataclass(frozen=True)
class Phase:
    """One motion and when it happens, s."""

    motion: Motion
    start_s: float
    end_s: float

    @property
    def duration_s(self) -> float:
        """Length of the phase, s."""
        return self.end_s - self.start_s


def schedule(motions: Sequence[Motion], duration_s: float) -> list[Phase]:
    """Times of motions: those that the prompt says, else even shares of the clip.

    Motions that would begin at the end of the clip or later are left out.
    """
    motions = list(motions)
    if motions[0].start_s:
        motions.insert(0, STANDING)
    known = {0: 0.0, len(motions): duration_s}
    for number, motion in enumerate(motions):
        if number and motion.start_s is not None:
            known[number] = min(motion.start_s, duration_s)
    numbers = sorted(known)
    shares = np.interp(range(len(motions) + 1), numbers, [known[number] for number in numbers])
    times = [float(time) for time in np.maximum.accumulate(shares)]
    shown = [
        Phase(motion, begin, max(end, begin))
        for motion, begin, end in zip(motions, times, times[1:], strict=False)
    ]
    return [phase for phase in shown if phase.duration_s > 1e-6 * duration_s]


def needs_steering(motions: Sequence[Motion]) -> bool:
    """Whether these motions are a track of keys, not one simple movement."""
    first = motions[0]
    return (
        len(motions) > 1
        or (first.end_pace is not None and first.kind not in ("spin", "work"))
        or bool(first.start_s)
        or first.kind in _KEYED
        or (first.kind in PATH_KINDS and first.direction in _STEERED_DIRECTIONS)
    )


def usual_speed(noun: Noun, kind: str) -> float:
    """Usual speed in a kind of motion, m/s: 1 of what usually stands."""
    own = noun.speed_m_s if noun.speed_m_s > 0.0 else 1.0
    known = speeds_of(noun)
    if kind in known:
        return float(own * known[kind] / known.get(noun.motion, own))
    return own * _RUNNING if kind == "run" and noun.motion == "walk" else own


def speeds_of(noun: Noun) -> Mapping[str, float]:
    """Kind of motion → the usual speed that is known of it, m/s."""
    return trait_value("speeds", noun.name) or {}


def least_radius(model: Model, noun: Noun) -> float:
    """The tightest curve, m: people turn on their heel, cars do not."""
    is_steered = noun.motion in ("drive", "sail") or noun.name in nouns_with("takes off")
    return 0.9 * model.length if is_steered else 0.0


def activity_of(kind: str) -> str:
    """Activity of the body in a travelling motion."""
    if kind in TRAVELLING or kind == "fly":
        return kind
    return "stand" if kind == "slide" else "move"
