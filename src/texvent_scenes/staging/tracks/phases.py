"""Kinds of motion: their oscillations; phases of an object's motion, times and usual speeds."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from texvent_scenes.description import STANDING
from texvent_scenes.models.activities import (
    DONE_SEATED,
    ON_FOOT,
    PERSON_NOUNS,
    TRAVELLING,
)
from texvent_scenes.models.protocol import Model, Noun
from texvent_scenes.models.tables import nouns_with, trait_value
from texvent_scenes.spec.scene import Motion
from texvent_scenes.staging.tracks.track import Term
from texvent_scenes.staging.tracks.turning import work_sign

PATH_KINDS = TRAVELLING | frozenset({"drive", "fly", "sail", "paddle", "slide", "roll", "move"})
"""Motions from one place to another."""
GOING = PATH_KINDS | {"reverse"}
"""Those with a direction of travel."""
STEERED = GOING | {"turn"}
SWINGS = frozenset({"to and fro", "up and down"})
"""Directions of what comes back."""
_KEYED = STEERED - PATH_KINDS | {"jump", "rise", "sink", "topple", "plunge"}

_UNTIED = GOING | _KEYED | {"bounce", "fall", "throw", "orbit", "break", "blow", "climb"}
"""Motions of what no hand holds."""
_ALOFT = frozenset({"float", "hover", "fly", "glide"})
"""Motions of what hangs in the air, which in a hand are rest."""
ASTRAY = frozenset({"to and fro", "up and down", "around"})
"""Directions that lead away from a place, whatever the motion is; a board may sway to and fro."""

YAWS = {
    "right": 0.0,
    "left": math.pi,
    "away": 0.5 * math.pi,
    "up": 0.5 * math.pi,
    "towards": -0.5 * math.pi,
    "down": -0.5 * math.pi,
    "diagonal": -0.25 * math.pi,
}
"""Direction → heading; up and down are along a slope for what moves on the ground."""
_STEERED_DIRECTIONS = frozenset({"backward", "around"})
COMING_DOWN = frozenset({"fall", "bounce", "throw", "sink"})
"""Motions that begin at a height that is said, and lead to the ground."""
_RUNNING = 2.5
"""Running over walking speed of nouns without a number for it."""

_BOB = (Term("z", 0.04, 0.4, 1.0),)
_DRIFT = (
    Term("x", 0.072, 0.23, 0.23), Term("z", 0.12, 0.4, 0.4),
    Term("yaw", 0.12, 0.31, 0.31), Term("roll", 0.05, 0.23, 0.23),
)  # fmt: skip
_WAVES = {
    "fly": _BOB, "glide": _BOB, "sail": _BOB, "paddle": _BOB,
    "swim": (Term("yaw", 0.08, 0.68, 1.0),),
    "hover": _DRIFT, "float": _DRIFT, "sway": (Term("roll", 0.14),), "tilt": (Term("pitch", 0.4),),
}  # fmt: skip
"""Kind of motion → its oscillations: amplitudes in rad or in the body's size, phases as shares of
that of the body; without a rate they have that of the motion."""
_LEANS, _LEANT_S = {"towards": 0.4, "away": -0.4}, 1.7
"""Rates at which what tilts to one side does so, its front at the camera, rad/s; and until when."""
LEANING = frozenset({"sway", "tilt"})
"""Those of a body that stays upright on average."""
_GROWTH = {"grow": (-0.6, 0.4), "shrink": (0.0, -0.4)}
"""Growth: change of the size at first, and per second, in sizes; it goes on for 2 s."""
_MOST_DRIFTING_M = 2.5
"""Size from which on what hovers drifts no further."""
_CLEAR, _LEAST_CLEAR_M = 3.0, 0.2
"""Height of what hovers, in its ways down; least height, m."""


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


def done_on_the_way(motions: Sequence[Motion], noun: Noun) -> str:
    """The act of the arms that a person does all along the way: "walks, waving"; "" = none."""
    if len(motions) != 2 or motions[1].start_s != 0.0 or noun.name not in PERSON_NOUNS:
        return ""
    way, act = motions
    return act.kind if way.kind in ON_FOOT and act.kind in DONE_SEATED else ""


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


def goes_straight_up(motion: Motion, noun: Noun) -> bool:
    """Whether what flies goes straight up or down, as all do but aircraft with wings.

    So does what swims from a stated time on.
    """
    is_free = motion.kind in ("fly", "glide") and noun.habitat == "air"
    is_free |= motion.kind == "swim" and motion.start_s is not None
    is_free &= noun.name not in nouns_with("takes off")
    return is_free and motion.direction in ("up", "down") and motion.end_pace is None


def fits_in_hand(motion: Motion, noun: Noun) -> bool:
    """Whether what is held does this in the hand: it tilts, turns or works, and goes nowhere."""
    if motion.kind == "turn":  # what drives goes along as it turns
        return noun.speed_m_s == 0.0 or noun.habitat == "fixed"
    is_going = motion.direction in ASTRAY and motion.kind != "sway"
    return motion.kind not in _UNTIED | _ALOFT and not is_going


def rests_in_hand(motion: Motion, noun: Noun) -> bool:
    """Whether it says no more than that the thing is held."""
    return motion.kind in ("stand", "hang", "sit", "lie", "move") or (
        motion.kind in _ALOFT and noun.habitat == "air"
    )


def ends_at_rest(motions: Sequence[Motion]) -> bool:
    """Whether a body that goes comes to rest in the end: it brakes or stops there."""
    goes = any(one.kind in PATH_KINDS for one in motions)
    return goes and (motions[-1].end_pace == 0.0 or motions[-1].kind == "stand")


def usual_speed(noun: Noun, kind: str) -> float:
    """Usual speed in a kind of motion, m/s: 1 of what usually stands."""
    own = noun.speed_m_s if noun.speed_m_s > 0.0 else 1.0
    known = speeds_of(noun)
    if kind in known:
        return float(own * known[kind] / known.get(noun.motion, own))
    return own * _RUNNING if kind == "run" and noun.motion == "walk" else own


def haste_of(noun: Noun, motion: Motion) -> float:
    """Speed of a motion as a multiple of the usual one of its kind."""
    if motion.speed_m_s is None:
        return motion.pace
    return motion.speed_m_s / usual_speed(noun, motion.kind)


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


def oscillations(motion: Motion, model: Model, phase: float) -> tuple[Term, ...]:
    """Oscillations of a kind of motion, for a body of that size."""
    size, lean = model.height, _LEANS.get(motion.direction or "", 0.0)
    if motion.kind == "tilt" and lean and motion.rate_hz is None:
        return (Term("pitch", drift=lean * motion.pace, begin_s=0.0, end_s=_LEANT_S),)
    if motion.kind in _GROWTH:
        offset, drift = _GROWTH[motion.kind]
        end_s = 2.0 / max(motion.pace, 1e-3)
        return (Term("scale", drift=drift * motion.pace, offset=offset, begin_s=0.0, end_s=end_s),)
    rise = size
    if motion.kind in ("hover", "float"):
        size = min(max(model.length, model.width, size), _MOST_DRIFTING_M) * motion.pace
        rise = size if motion.kind == "hover" else min(rise * motion.pace, size)
    sizes = {"x": size, "y": size, "z": rise}
    rate_hz = motion.rate_hz or 0.5 * motion.pace
    return tuple(
        one._replace(
            amplitude=one.amplitude * sizes.get(one.channel, 1.0),
            rate_hz=one.rate_hz or rate_hz,
            phase=one.phase * phase,
        )
        for one in _WAVES.get(motion.kind, ())
    )


def hovering_m(model: Model, motion: Motion) -> float:
    """Height at which what hovers over the ground stays clear of it, m."""
    drift = {one.channel: one.amplitude for one in oscillations(motion, model, 0.0)}
    lean_m = 0.5 * max(model.length, model.width) * drift.get("roll", 0.0)
    return max(_CLEAR * (drift.get("z", 0.0) + lean_m), _LEAST_CLEAR_M)


def between(terms: tuple[Term, ...], begin_s: float, end_s: float) -> tuple[Term, ...]:
    """Oscillations that begin and end at their middle; in a short time small ones, once to a side.

    So what hovers between two legs is where the second one begins.
    """
    found, span_s = [], max(end_s - begin_s, 1e-9)
    for one in terms:
        if one.rate_hz and (least := 0.5 / span_s) > one.rate_hz:
            one = one._replace(amplitude=one.amplitude * one.rate_hz / least, rate_hz=least)
        halves = math.floor(2.0 * (end_s - begin_s) * one.rate_hz + 1e-9)
        last_s = begin_s + 0.5 * halves / one.rate_hz if halves else end_s
        phase = -2.0 * math.pi * one.rate_hz * begin_s
        offset = one.offset - one.drift * begin_s
        found.append(one._replace(phase=phase, offset=offset, begin_s=begin_s, end_s=last_s))
    return tuple(found)


def works_in_turn(motions: Sequence[Motion]) -> bool:
    """Whether something works at one pace after the other, or rests from a time on or up to it."""
    kinds = {one.kind for one in motions}
    is_list = len(motions) > 1 or bool(motions[0].start_s)
    return is_list and "work" in kinds and kinds <= {"work", "stand"}


def paces_of_work(
    motions: Sequence[Motion], model: Model, duration_s: float
) -> Iterator[tuple[Phase, float, float]]:
    """Phases of what works in turn, with the pace at the start and at the end of each.

    A negative pace runs backwards.
    """
    for phase in schedule(motions, duration_s):
        motion = phase.motion
        sign = work_sign(motion.direction, model) if motion.kind == "work" else 0.0
        end = motion.pace if motion.end_pace is None else motion.end_pace
        yield phase, sign * motion.pace, sign * end


def time_of_work(
    motions: Sequence[Motion], model: Model, duration_s: float
) -> tuple[Term, ...]:  # fmt: skip
    """Time of the parts of what works in turn beside that of the clip: its rates are the paces."""
    terms = []
    for phase, pace, end in paces_of_work(motions, model, duration_s):
        begin_s, rate, gain = phase.start_s, pace - 1.0, (end - pace) / phase.duration_s
        is_last = phase.end_s >= duration_s and not gain
        terms.append(Term(
            "run_s", offset=(0.5 * gain * begin_s - rate) * begin_s, drift=rate - gain * begin_s,
            gain=gain, begin_s=begin_s, end_s=math.inf if is_last else phase.end_s,
        ))  # fmt: skip
    return tuple(terms)
