"""Oscillations of a kind of motion: bobbing, drifting, swaying, tilting."""

from __future__ import annotations

import math

from texvent_scenes.models.protocol import Model
from texvent_scenes.spec.scene import Motion
from texvent_scenes.staging.tracks.track import Term

_BOB = (Term("z", 0.04, 0.4, 1.0),)
_DRIFT = (
    Term("x", 0.072, 0.23, 0.23), Term("z", 0.12, 0.4, 0.4),
    Term("yaw", 0.12, 0.31, 0.31), Term("roll", 0.05, 0.23, 0.23),
)  # fmt: skip
_WAVES = {
    "fly": _BOB, "sail": _BOB, "paddle": _BOB, "swim": (Term("yaw", 0.08, 0.68, 1.0),),
    "hover": _DRIFT, "float": _DRIFT, "sway": (Term("roll", 0.14),), "tilt": (Term("pitch", 0.4),),
}  # fmt: skip
"""Kind of motion → its oscillations: amplitudes in rad or in the body's size, phases as shares of
that of the body; without a rate they have that of the motion."""
LEANING = frozenset({"sway", "tilt"})
"""Those of a body that stays upright on average."""
_MOST_DRIFTING_M = 2.5
"""Size from which on what hovers drifts no further."""


def oscillations(motion: Motion, model: Model, phase: float) -> tuple[Term, ...]:
    """Oscillations of a kind of motion, for a body of that size."""
    size = model.height
    if motion.kind in ("hover", "float"):
        size = min(max(model.length, model.width, size), _MOST_DRIFTING_M) * motion.pace
    rate_hz = motion.rate_hz or 0.5 * motion.pace
    return tuple(
        one._replace(
            amplitude=one.amplitude * (size if one.channel in "xyz" else 1.0),
            rate_hz=one.rate_hz or rate_hz,
            phase=one.phase * phase,
        )
        for one in _WAVES.get(motion.kind, ())
    )


def between(terms: tuple[Term, ...], begin_s: float, end_s: float) -> tuple[Term, ...]:
    """Oscillations that begin and, where the time allows it, end at their middle."""
    found = []
    for one in terms:
        halves = math.floor(2.0 * (end_s - begin_s) * one.rate_hz + 1e-9)
        last_s = begin_s + 0.5 * halves / one.rate_hz if halves else end_s
        phase = -2.0 * math.pi * one.rate_hz * begin_s
        found.append(one._replace(phase=phase, begin_s=begin_s, end_s=last_s))
    return tuple(found)
