"""What an object does one after the other, as the pieces of one continuous path."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace

from texvent.scenes.description import SPIN_RATE_HZ, ObjectMotion
from texvent.scenes.models.people.activities import ON_GROUND, PERSON_NOUNS, TRAVELLING
from texvent.scenes.models.protocol import Model, Noun
from texvent.scenes.staging.trajectories.manoeuvres import (
    LANE_M,
    QUARTER,
    ZIGZAG_RAD,
    arc,
    change_lane,
    park,
    sample_places,
    zigzag,
)
from texvent.scenes.staging.trajectories.schedule import Phase, schedule
from texvent.scenes.staging.trajectories.steered_path import Piece, SteeredPath

PATH_KINDS = TRAVELLING | frozenset({"drive", "fly", "sail", "paddle", "slide", "roll", "move",
                                       "wheelie", "drift"})  # fmt: skip
"""Motions from one place to another."""
_STEERED_KINDS = frozenset({"turn", "reverse", "zigzag", "enter", "leave", "appear", "change lane",
                            "park"})  # fmt: skip
_GOING = _STEERED_KINDS - {"turn", "zigzag", "change lane", "park"}

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
_STEERED_DIRECTIONS = frozenset({"backward", "around"})
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
_CLIMB = 0.45
"""Metres up per metre along."""
_CLOCKWISE = frozenset({"clockwise", "right"})
_LEANING = frozenset({"bicycle", "motorcycle"})
_REACHED = {"sit down": "sit", "lie down": "lie", "stand up": "stand", "kneel down": "kneel",
            "crouch down": "crouch"}  # fmt: skip
"""Getting up and down after something else: the posture that the body goes over to."""


def needs_steering(motions: Sequence[ObjectMotion]) -> bool:
    """Whether these motions are a path of several pieces, not one simple movement."""
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
    is_steered = noun.motion in ("drive", "sail") or noun.name == "airplane"
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
    builder = _Builder(noun, model, usual_m_s, yaw)
    builder.is_single = len(phases) == 1
    for phase in phases:
        builder.add(phase)
    path = SteeredPath(
        (0.0, 0.0, 0.0),
        yaw + builder.initial_yaw,
        tuple(builder.pieces),
        builder.initial_speed,
        builder.initial_turn,
        lean=1.0 if noun.habitat == "air" or noun.name in _LEANING else 0.0,
        usual_speed_m_s=usual_m_s,
        floor_m=0.0 if noun.habitat in ("ground", "fixed") else NO_FLOOR_M,
        side_m=0.5 * model.width if model.length > _LONG * model.height else 0.0,
    )
    places = sample_places(path, duration_s)
    middle = 0.5 * (places.min(axis=0) + places.max(axis=0))
    return replace(path, start=(-float(middle[0]), -float(middle[1]), 0.0))


def _fast_enough(phases: Sequence[Phase], noun: Noun, model: Model, usual_m_s: float) -> float:
    """A usual speed at which every turn is a quarter circle of a plausible radius."""
    needed = usual_m_s
    for phase in phases:
        motion = phase.motion
        if motion.speed_m_s is not None:
            continue
        if motion.kind == "change lane":
            needed = max(needed, 6.0 * LANE_M / phase.duration_s)
        if motion.kind == "park":
            turning = QUARTER * max(least_radius(model, noun), 0.3 * model.length)
            needed = max(needed, turning / (0.45 * phase.duration_s))
        if motion.kind in ("enter", "leave"):
            needed = max(needed, 2.0 * model.length / phase.duration_s)
        if motion.kind == "turn" or motion.direction == "around":
            turning = phase.duration_s * (TURN_SHARE if len(phases) == 1 else 0.8)
            angle = math.pi if motion.direction == "around" else QUARTER
            radius = max(least_radius(model, noun), 0.3 * model.length)
            needed = max(needed, radius * angle / turning)
    return min(needed, MOST_HASTE * usual_m_s)


class _Builder:
    """Collects pieces; knows the speed and height at the end of the last one."""

    def __init__(self, noun: Noun, model: Model, usual_m_s: float, yaw: float) -> None:
        self._noun, self._model, self._usual = noun, model, usual_m_s
        self.is_single = False
        self._height = 0.0
        self._heading = yaw
        self.pieces: list[Piece] = []
        self.initial_speed = 0.0
        self.initial_turn = 0.0
        self.initial_yaw = 0.0

    def add(self, phase: Phase) -> None:
        """Append the pieces of one phase."""
        motion, span = phase.motion, phase.duration_s
        is_path = motion.kind in PATH_KINDS
        if motion.kind == "turn" or (is_path and motion.direction == "around"):
            self._turn(motion, span)
        elif is_path and motion.direction == "circle":
            self._circle(motion, span)
        elif is_path and motion.direction == "eight":
            self._eight(motion, span)
        elif is_path or motion.kind in _GOING:
            self._go(motion, span)
        elif motion.kind in ("zigzag", "change lane", "park"):
            self._manoeuvre(motion, span)
        elif motion.kind in ("rise", "sink"):
            self._climb(motion, span)
        else:
            self._act(motion, span)

    def _act(self, motion: ObjectMotion, span: float) -> None:
        if motion.kind == "spin":
            turn = 2.0 * math.pi * SPIN_RATE_HZ * motion.pace
            turn = -turn if motion.direction in _CLOCKWISE else turn
            self._start(0.0, turn)
            self._append(span, 0.0, turn, ramp=min(0.4, 0.5 * span))
        elif motion.kind == "jump":
            height = max(0.35 * self._model.height, 0.15) * motion.pace
            speed = self._carried()
            self._append(span, speed, hop=height, activity="move" if speed else "jump")
        elif motion.kind == "bounce":
            self._append(span, self._carried(), hop=max(1.5 * self._model.height, 0.4))
        elif motion.kind == "fall":
            self._fall(span)
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

    def _go(self, motion: ObjectMotion, span: float) -> None:
        speed = self._speed(motion)
        end = self._end_speed(motion, speed)
        slope = {"up": _CLIMB, "down": -_CLIMB}.get(motion.direction or "", 0.0)
        is_free = self._noun.habitat in ("air", "water")
        climb = slope * abs(speed) if is_free else 0.0
        activity = _activity(motion)
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
        self._arc(turning, speed, turn, _activity(motion))
        return turning

    def _eight(self, motion: ObjectMotion, span: float) -> None:
        """Round to the left, then round to the right."""
        self._start(self._speed(motion))
        for sign in (1.0, -1.0):
            self._arc(0.5 * span, self._speed(motion), sign * 2.0 * math.pi, _activity(motion))

    def _circle(self, motion: ObjectMotion, span: float) -> None:
        speed = self._speed(motion)
        turn = speed / max(1.3 * max(self._model.length, self._model.width), 0.3)
        self._start(speed, turn)
        self._append(span, speed, turn, activity=_activity(motion))

    def _turn(self, motion: ObjectMotion, span: float) -> None:
        is_mobile = self._noun.speed_m_s > 0.0 and self._noun.habitat != "fixed"
        speed = self._speed(motion) if is_mobile else 0.0
        angle = math.pi if motion.direction == "around" else QUARTER
        sign = -1.0 if motion.direction in ("right", "clockwise") else 1.0
        if motion.direction == "around" and is_mobile and self._noun.motion != "drive":
            speed *= 0.4
        self._start(speed)
        activity = _activity(motion)
        if self.is_single and is_mobile:
            lead = 0.5 * (1.0 - TURN_SHARE) * span
            self._append(lead, speed, activity=activity)
            self._arc(span - 2.0 * lead, speed, sign * angle, activity)
            self._append(lead, speed, activity=activity)
        else:
            self._arc(span, speed, sign * angle, activity)
        end = self._end_speed(motion, speed)
        if end is not None:
            last = self.pieces.pop()
            self.pieces.append(replace(last, speed_m_s=end, ramp_s=last.duration_s))

    def _arc(self, span: float, speed: float, angle: float, activity: str) -> None:
        """Turn by an angle, the rate rising and falling smoothly."""
        least = least_radius(self._model, self._noun)
        self._extend(arc(span, speed, angle, least, activity))

    def _manoeuvre(self, motion: ObjectMotion, span: float) -> None:
        """Zigzag, change lanes or park."""
        speed, activity = self._speed(motion), _activity(motion)
        self._start(speed)
        if motion.kind == "zigzag":
            if not self.pieces:
                self.initial_yaw = -ZIGZAG_RAD
            self._extend(zigzag(span, speed, activity, is_first=not self.pieces))
            return
        sign = -1.0 if motion.direction == "right" else 1.0
        make = change_lane if motion.kind == "change lane" else park
        self._extend(make(span, speed, sign, least_radius(self._model, self._noun), activity))

    def _extend(self, pieces: Iterable[Piece]) -> None:
        for one in pieces:
            self._append(
                one.duration_s, one.speed_m_s, one.turn_rad_s, ramp=one.ramp_s,
                activity=one.activity,
            )  # fmt: skip

    def _climb(self, motion: ObjectMotion, span: float) -> None:
        size = max(self._model.length, self._model.height)
        climb = min(max(self._usual, 0.3 * size), size) * motion.pace
        if motion.kind == "sink":
            is_free = self._noun.habitat in ("air", "water")
            climb = -climb if is_free else -min(climb, self._height / span)
        self._append(span, 0.0, climb=climb, ramp=min(0.6, 0.6 * span))

    def _fall(self, span: float) -> None:
        falls_over = self._height < 0.1 * self._model.height and self._noun.habitat != "air"
        if not falls_over:
            self.pieces.append(Piece(span, 0.0, activity="stand", is_dropped=True))
        else:
            ramp = min(0.6, 0.8 * span)
            piece = Piece(span, 0.0, ramp_s=ramp, activity="stand", pitch_rad=QUARTER)
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
        if motion.kind == "dance":
            self._append(span, 0.0, hop=0.08 * self._model.height, activity="move")
            return
        pitch = self.pieces[-1].pitch_rad if self.pieces else 0.0
        sway = 0.2 if motion.kind == "sway" else 0.0
        ramp = min(braking, 0.9 * span)
        piece = Piece(span, 0.0, ramp_s=ramp, activity=activity, pitch_rad=pitch, sway_rad=sway)
        self.pieces.append(piece)


def _activity(motion: ObjectMotion) -> str:
    if motion.kind in TRAVELLING or motion.kind == "fly":
        return motion.kind
    return "stand" if motion.kind == "slide" else "move"
