"""What an object does one after the other, as the pieces of one continuous path."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace

from texvent.scenes.description import SPIN_RATE_HZ, ObjectMotion
from texvent.scenes.models.people.activities import ON_GROUND, PERSON_NOUNS, TRAVELLING
from texvent.scenes.models.protocol import Model, Noun
from texvent.scenes.models.traits import nouns_with
from texvent.scenes.staging.trajectories.manoeuvres import (
    QUARTER,
    ZIGZAG_RAD,
    arc,
    centred,
    park,
    zigzag,
)
from texvent.scenes.staging.trajectories.schedule import Phase, schedule
from texvent.scenes.staging.trajectories.steered_path import (
    HOP_PAUSE_S,
    Piece,
    SteeredPath,
    flight_s,
)

PATH_KINDS = TRAVELLING | frozenset({"drive", "fly", "sail", "slide", "roll", "move", "drift"})
"""Motions from one place to another."""
GOING = PATH_KINDS | {"reverse", "enter", "leave", "appear"}
"""Those with a direction of travel."""
_STEERED_KINDS = frozenset({"turn", "reverse", "zigzag", "enter", "leave", "appear", "park", "jump",
                            "rise", "sink", "topple", "flip"})  # fmt: skip

YAWS = {
    "right": 0.0,
    "left": math.pi,
    "away": 0.5 * math.pi,
    "diagonal": 0.25 * math.pi,
    "up": 0.5 * math.pi,
    "towards": -0.5 * math.pi,
    "down": -0.5 * math.pi,
}
"""Direction → heading; up and down are along a slope for what moves on the ground."""
_STEERED_DIRECTIONS = frozenset({"backward", "around", "eight"})
NO_FLOOR_M = -1e4
"""Floor of a path that is not yet placed above the ground, m."""
TURN_SHARE = 0.6
"""Share of a turn's phase that it turns, where it is all that happens: it comes and goes on."""
ROAD_BEND_PER_M = 1.0 / 50.0
"""Curvature of a road that bends."""
MOST_HASTE = 2.5
"""Most multiple of its usual speed at which an object does what its time is short for."""
_RAMP_S = 0.3
_BRAKING_M_S2 = 6.0
_LONG = 0.8
"""Share of its height from which the length of what falls lays it onto its side."""
_CLIMB, _RUNWAY_CLIMB = 0.45, 0.32
"""Metres up per metre along, in general and from a runway."""
_LIFT_SHARE, _LANDING_SHARE = 0.3, 0.65
"""Shares of a phase after which wheels leave a runway, or meet it."""
_SUNK = 0.8
"""Share of its height that a vessel sinks."""
_CLOCKWISE = frozenset({"clockwise", "right"})
_REACHED = {"sit down": "sit", "stand up": "stand"}
"""Getting up and down after something else: the posture that the body goes over to."""


def needs_steering(motions: Sequence[ObjectMotion]) -> bool:
    """Whether these motions are a path of pieces, not one simple movement."""
    first = motions[0]
    return (
        len(motions) > 1
        or (first.end_pace is not None and first.kind not in ("spin", "work"))
        or bool(first.start_s)
        or first.kind in _STEERED_KINDS
        or (first.kind in PATH_KINDS and first.direction in _STEERED_DIRECTIONS)
    )


def least_radius(model: Model, noun: Noun) -> float:
    """The tightest curve, m: people turn on their heel, cars do not."""
    is_steered = noun.motion in ("drive", "sail") or noun.name in nouns_with("takes off")
    return 0.9 * model.length if is_steered else 0.0


def build_path(
    motions: Sequence[ObjectMotion],
    noun: Noun,
    model: Model,
    *,
    yaw: float,
    usual_m_s: float,
    duration_s: float,
) -> SteeredPath:
    """The path of several motions, its box centred over (0, 0).

    Args:
        motions: what it does, in order.
        noun: the object.
        model: its model, for its size.
        yaw: where it heads at first, radians.
        usual_m_s: speed at pace 1, m/s.
        duration_s: length of the clip, s.
    """
    phases = schedule(motions, duration_s)
    usual_m_s = _fast_enough(phases, noun, model, usual_m_s)
    if motions[0].kind == "reverse" and motions[0].direction is not None:
        yaw += math.pi
    builder = _Builder(noun, model, usual_m_s, yaw, is_single=len(phases) == 1)
    for phase in phases:
        builder.add(phase)
    is_flipping = any(phase.motion.kind == "flip" for phase in phases)
    is_toppling = model.length > _LONG * model.height and not is_flipping
    path = SteeredPath(
        (0.0, 0.0, builder.initial_height),
        yaw + builder.initial_yaw,
        tuple(builder.pieces),
        builder.initial_speed,
        builder.initial_turn,
        lean=1.0 if noun.habitat == "air" or noun.name in nouns_with("leans") else 0.0,
        usual_speed_m_s=usual_m_s,
        floor_m=0.0 if noun.habitat in ("ground", "fixed") else NO_FLOOR_M,
        side_m=0.5 * model.width if is_toppling else 0.0,
        pivot_m=0.5 * model.height if is_flipping else 0.0,
    )
    return centred(path, duration_s)


def _fast_enough(phases: Sequence[Phase], noun: Noun, model: Model, usual_m_s: float) -> float:
    """A usual speed at which every turn is a quarter circle of a plausible radius."""
    needed = usual_m_s
    radius = max(least_radius(model, noun), 0.3 * model.length)
    for phase in phases:
        motion = phase.motion
        if motion.speed_m_s is not None:
            continue
        if motion.kind == "park":
            needed = max(needed, QUARTER * radius / (0.45 * phase.duration_s))
        if motion.kind in ("enter", "leave"):
            needed = max(needed, 2.0 * model.length / phase.duration_s)
        if motion.kind == "turn" or motion.direction == "around":
            turning = phase.duration_s * (TURN_SHARE if len(phases) == 1 else 0.8)
            angle = math.pi if motion.direction == "around" else QUARTER
            needed = max(needed, radius * angle / turning)
    return min(needed, MOST_HASTE * usual_m_s)


class _Builder:
    """Collects pieces; knows the speed and height at the end of the last one."""

    def __init__(
        self, noun: Noun, model: Model, usual_m_s: float, yaw: float, *, is_single: bool
    ) -> None:
        self._noun, self._model, self._usual = noun, model, usual_m_s
        self._is_single = is_single
        self._is_free = noun.habitat in ("air", "water")
        self._height = 0.0
        self._heading = yaw
        self.pieces: list[Piece] = []
        self.initial_speed = 0.0
        self.initial_turn = 0.0
        self.initial_yaw = 0.0
        self.initial_height = 0.0

    def add(self, phase: Phase) -> None:
        """Append the pieces of one phase."""
        motion, span = phase.motion, phase.duration_s
        kind, is_path = motion.kind, motion.kind in PATH_KINDS
        if kind == "turn" or (is_path and motion.direction == "around"):
            self._turn(motion, span)
        elif is_path and motion.direction in ("circle", "eight"):
            self._round(motion, span)
        elif kind in GOING:
            self._go(motion, span)
        elif kind in ("zigzag", "park"):
            self._manoeuvre(motion, span)
        elif kind in ("rise", "sink"):
            self._climb(motion, span)
        elif kind == "spin":
            turn = 2.0 * math.pi * SPIN_RATE_HZ * motion.pace
            turn = -turn if motion.direction in _CLOCKWISE else turn
            self._start(0.0, turn)
            self._append(span, 0.0, turn, ramp=min(0.4, 0.5 * span))
        elif kind in ("jump", "bounce", "flip"):
            self._hop(motion, span)
        elif kind in ("fall", "topple"):
            self._fall(kind, span)
        else:
            self._rest(motion, span)

    def _speed(self, motion: ObjectMotion) -> float:
        """Signed speed at the beginning of a motion, m/s."""
        speed = self._usual * motion.pace if motion.speed_m_s is None else motion.speed_m_s
        if motion.kind == "run" and self._noun.motion == "walk" and motion.speed_m_s is None:
            speed *= 1.6 if self.pieces else 1.0
        is_back = motion.direction == "backward" or motion.kind == "reverse"
        return -speed if is_back else speed

    def _end_speed(self, motion: ObjectMotion, speed: float) -> float | None:
        if motion.end_pace is None:
            return None
        if motion.speed_m_s is not None:
            return speed * motion.end_pace / max(motion.pace, 1e-6)
        return math.copysign(self._usual * motion.end_pace, speed)

    def _carried(self) -> float:
        """Speed with which a jump begins: that of what went before."""
        return self.pieces[-1].speed_m_s if self.pieces else 0.0

    def _start(self, speed: float, turn: float = 0.0) -> None:
        """Let the clip begin in full motion."""
        if not self.pieces:
            self.initial_speed, self.initial_turn = speed, turn

    def _append(
        self, span: float, speed: float, turn: float = 0.0, climb: float = 0.0, *,
        ramp: float | None = None, activity: str = "move", hop: float = 0.0,
    ) -> None:  # fmt: skip
        ramp = min(_RAMP_S, 0.35 * span) if ramp is None else ramp
        self.pieces.append(Piece(span, speed, turn, climb, ramp, activity, hop))
        self._height += climb * span
        before = self.pieces[-2].turn_rad_s if len(self.pieces) > 1 else self.initial_turn
        self._heading += turn * span + 0.5 * (before - turn) * min(ramp, span)

    def _extend(self, pieces: Iterable[Piece]) -> None:
        for one in pieces:
            self._append(
                one.duration_s, one.speed_m_s, one.turn_rad_s, ramp=one.ramp_s,
                activity=one.activity,
            )  # fmt: skip

    def _go(self, motion: ObjectMotion, span: float) -> None:
        speed = self._speed(motion)
        end = self._end_speed(motion, speed)
        slope = {"up": _CLIMB, "down": -_CLIMB}.get(motion.direction or "", 0.0)
        climb = slope * abs(speed) if self._is_free else 0.0
        activity = activity_of(motion.kind)
        self._start(speed)
        span -= self._head_for(motion, speed, span)
        if end is None:
            self._append(span, speed, climb=climb, activity=activity)
            return
        # What brakes is seen going, and at rest or slow for a while.
        lead = (0.3 if abs(end) < abs(speed) else 0.12) * span
        rest = 0.3 * span if abs(end) < abs(speed) else 0.0
        self._append(lead, speed, climb=climb, activity=activity)
        self._append(span - lead, end, climb=climb, ramp=span - lead - rest, activity=activity)

    def _head_for(self, motion: ObjectMotion, speed: float, span: float) -> float:
        """Turn to the direction in the picture that a later motion has; s that it takes."""
        target = YAWS.get(motion.direction or "")
        if not self.pieces or target is None or motion.direction in ("up", "down"):
            return 0.0
        turn = math.remainder(target - self._heading, 2.0 * math.pi)
        if abs(turn) < 0.05:
            return 0.0
        turning = 0.45 * span
        self._arc(turning, speed, turn, activity_of(motion.kind))
        return turning

    def _round(self, motion: ObjectMotion, span: float) -> None:
        """In a circle; or in an eight: round to the left, then round to the right."""
        speed, activity = self._speed(motion), activity_of(motion.kind)
        if motion.direction == "eight":
            self._start(speed)
            for sign in (1.0, -1.0):
                self._arc(0.5 * span, speed, sign * 2.0 * math.pi, activity)
            return
        turn = speed / max(1.3 * max(self._model.length, self._model.width), 0.3)
        self._start(speed, turn)
        self._append(span, speed, turn, activity=activity)

    def _turn(self, motion: ObjectMotion, span: float) -> None:
        is_mobile = self._noun.speed_m_s > 0.0 and self._noun.habitat != "fixed"
        speed = self._speed(motion) if is_mobile else 0.0
        angle = math.pi if motion.direction == "around" else QUARTER
        angle = -angle if motion.direction in _CLOCKWISE else angle
        if motion.direction == "around" and is_mobile and self._noun.motion != "drive":
            speed *= 0.4
        self._start(speed)
        activity = activity_of(motion.kind)
        if self._is_single and is_mobile:
            lead = 0.5 * (1.0 - TURN_SHARE) * span
            self._append(lead, speed, activity=activity)
            self._arc(span - 2.0 * lead, speed, angle, activity)
            self._append(lead, speed, activity=activity)
        else:
            self._arc(span, speed, angle, activity)
        end = self._end_speed(motion, speed)
        if end is not None:
            last = self.pieces.pop()
            self.pieces.append(replace(last, speed_m_s=end, ramp_s=last.duration_s))

    def _arc(self, span: float, speed: float, angle: float, activity: str) -> None:
        """Turn by an angle, the rate rising and falling smoothly."""
        self._extend(arc(span, speed, angle, least_radius(self._model, self._noun), activity))

    def _manoeuvre(self, motion: ObjectMotion, span: float) -> None:
        """Zigzag or park."""
        speed, activity = self._speed(motion), activity_of(motion.kind)
        self._start(speed)
        if motion.kind == "zigzag":
            if not self.pieces:
                self.initial_yaw = -ZIGZAG_RAD
            self._extend(zigzag(span, speed, activity, is_first=not self.pieces))
            return
        angle = -QUARTER if motion.direction == "right" else QUARTER
        self._extend(park(span, speed, angle, least_radius(self._model, self._noun), activity))

    def _climb(self, motion: ObjectMotion, span: float) -> None:
        """Straight up or down; from a runway, along it first, or last."""
        is_up = motion.kind == "rise"
        if self._is_single and self._noun.name in nouns_with("takes off"):
            speed = self._speed(motion)
            climb = _RUNWAY_CLIMB * speed if is_up else -_RUNWAY_CLIMB * speed
            share = _LIFT_SHARE if is_up else _LANDING_SHARE
            self._start(speed)
            self._append(share * span, speed, climb=0.0 if is_up else climb, ramp=0.0)
            self._append(span - share * span, speed, climb=climb if is_up else 0.0, ramp=0.6)
            self.initial_height = 0.0 if is_up else -climb * (share * span + 0.3)
            return
        size = max(self._model.length, self._model.height)
        climb = min(max(self._usual, 0.3 * size), size) * motion.pace
        if not is_up and self._noun.motion == "sail":
            climb = -_SUNK * self._model.height / span
        elif not is_up and self._is_single:
            self.initial_height = climb * 0.85 * span
            climb = -climb
        elif not is_up:
            climb = -climb if self._is_free else -min(climb, self._height / span)
        # What rises alone starts slowly and gets faster all along.
        ramp = span if is_up and self._is_single else min(0.6, 0.6 * span)
        self._append(span, 0.0, climb=climb * (2.0 if ramp == span else 1.0), ramp=ramp)

    def _hop(self, motion: ObjectMotion, span: float) -> None:
        """Jump, bounce, or turn over in the air."""
        model, speed = self._model, self._carried()
        if motion.kind == "flip":
            height = min(max(1.2 * max(model.length, model.width, model.height), 0.3), 2.5)
            count = max(1, math.floor(span / (flight_s(height) + HOP_PAUSE_S)))
            for number in range(count):
                turned = 2.0 * math.pi * (number + 1)
                self.pieces.append(
                    Piece(span / count, ramp_s=flight_s(height), hop_m=height, pitch_rad=turned)
                )
            return
        height = max(1.5 * model.height, 0.4)
        if motion.kind == "jump":
            height = min(max(0.35 * model.height, 0.12), 1.5) * motion.pace
            if self._noun.habitat == "water":
                height = max(height, 0.7 * model.length)
            if not self.pieces and motion.direction is not None:
                speed = model.length / (flight_s(height) + HOP_PAUSE_S)
                self._start(speed)
        activity = "jump" if motion.kind == "jump" and not speed else "move"
        self._append(span, speed, hop=height, activity=activity)

    def _fall(self, kind: str, span: float) -> None:
        """Drop to the floor; or what stands there falls over."""
        is_standing = self._height < 0.1 * self._model.height and self._noun.habitat != "air"
        if kind == "topple" and not self.pieces:
            self._append(0.15 * span, 0.0, activity="stand")
            span *= 0.85
        if kind == "topple" or is_standing:
            piece = Piece(span, ramp_s=min(0.6, 0.8 * span), activity="stand", pitch_rad=QUARTER)
        else:
            piece = Piece(span, activity="stand", is_dropped=True)
        self.pieces.append(piece)
        self._height = 0.0

    def _rest(self, motion: ObjectMotion, span: float) -> None:
        """Come to rest, and act in place."""
        braking = max(0.25, abs(self._carried()) / _BRAKING_M_S2)
        activity = "stand" if motion.kind in ("stand", "hover", "work") else motion.kind
        if self.pieces:
            activity = _REACHED.get(activity, activity)
        if self._noun.name in PERSON_NOUNS:
            activity = ON_GROUND.get(activity, activity)
        if self.pieces and motion.kind == "stand":
            activity = self.pieces[-1].activity  # wheels and legs go on until it stands
        pitch = self.pieces[-1].pitch_rad if self.pieces else 0.0
        sway = 0.2 if motion.kind == "sway" else 0.0
        ramp = min(braking, 0.9 * span)
        self.pieces.append(
            Piece(span, ramp_s=ramp, activity=activity, pitch_rad=pitch, sway_rad=sway)
        )


def activity_of(kind: str) -> str:
    """What a body does that travels so."""
    if kind in TRAVELLING or kind == "fly":
        return kind
    return "stand" if kind == "slide" else "move"
