"""Keys of one continuous track through the phases of an object's motion."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

from texvent_scenes.description import SPIN_RATE_HZ, STANDING
from texvent_scenes.models.activities import (
    ANIMAL_ACTIVITIES,
)
from texvent_scenes.models.protocol import Model, Noun
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.spec.scene import Motion
from texvent_scenes.staging.tracks.corners import corner
from texvent_scenes.staging.tracks.flight_keys import (
    QUARTER,
    FlightKeys,
    fallen_m,
)
from texvent_scenes.staging.tracks.keys import RAMP_S, Key, arc
from texvent_scenes.staging.tracks.phases import (
    PATH_KINDS,
    STEERED,
    SWINGS,
    YAWS,
    Phase,
    activity_of,
    between,
    goes_straight_up,
    least_radius,
    oscillations,
    schedule,
    speeds_of,
    usual_speed,
)
from texvent_scenes.staging.tracks.track import Term, Track, centred
from texvent_scenes.staging.tracks.turning import CLOCKWISE, axle_of, spin_sign

_TURN_SHARE, _HEADING_SHARE = 0.6, 0.45
"""Shares of a phase that a turn takes where it is all that happens, for it comes and goes on; and
that the turn to another direction takes: more where its radius asks for that, but not all."""
_MOST_TURNING = 0.95
MOST_HASTE = 2.5
"""Most multiple of its usual speed at which an object does what its time is short for."""
_SKID, _SUNK = 1.1, 0.95
"""Angle by which the rear of what skids comes round, rad; share of its
height by which what floats goes down as it sinks."""
_ON_SPOT_S, _LEAST_TURN_S = 0.4, 0.04
"""Duration of a turn on the spot before a leg, and its least, s."""
_UPRIGHT = {"up": "rise", "down": "sink"}
_CLIMB, _TAKE_OFF, _LANDING = 0.45, 0.32, 0.12
"""Metres up or down per metre along: in general, from a runway, and to it."""
_ALONG_GROUND = frozenset({"walk", "run", "crawl", "drive", "roll", "slide"})
"""Motions for which "up and down" means to and fro."""
_SWUNG, _LIFT = 0.3, 0.5
"""Usual reach to and fro, in ways that it would go in that time; greatest usual one up and down, in
sizes of a body."""
_LIFT_SHARE, _LANDING_SHARE = 0.3, 0.65
"""Shares of a phase after which wheels leave a runway, or meet it."""
_OF_CAMERA = ("towards", "away")
"""Directions to which something turns that say where it heads then, and not to which side."""


def build_path(
    motions: Sequence[Motion],
    noun: Noun,
    model: Model,
    *,
    yaw: float,
    stated_m_s: float | None,
    duration_s: float,
    spin_axis: str = "yaw",
    start_m: float | None = None,
) -> Track:
    """The path of several motions, its box centred over (0, 0).

    Args:
        motions: what it does, in order.
        noun: the object.
        model: its model, for its size.
        yaw: where it heads at first, radians.
        stated_m_s: speed at pace 1 that takes the place of usual ones, m/s.
        duration_s: length of the clip, s.
        spin_axis: channel of a spin.
        start_m: height above the ground from which it comes down, if it is said, m.
    """
    phases = schedule(motions, duration_s)
    active = (one.kind for one in motions if one.kind != "stand")
    if start_m is None and next(active, "") == "fall":
        spans = [one.duration_s for one in phases if one.motion.kind == "fall"]
        start_m = fallen_m(model, spans[0] if spans else duration_s)
    if any(one.kind == "swim" and one.direction in _UPRIGHT for one in motions):
        noun = replace(noun, habitat="water")  # who dives goes up and down as fish do
    builder = _KeyBuilder(
        noun, model, stated_m_s, yaw, is_single=len(phases) == 1, spin_axis=spin_axis,
        start_m=start_m, has_times=any(one.start_s is not None for one in motions)
        or any(goes_straight_up(one, noun) for one in motions[:1]),
    )  # fmt: skip
    builder.hurry(phases)
    for phase in _switched(phases, motions[0]):
        builder.add(phase)
    first = replace(builder.keys[0], activity=builder.keys[1].activity)
    path = Track(
        (0.0, 0.0, builder.initial_height),
        yaw,
        (first, *builder.keys[1:]),
        tuple(builder.terms),
        usual_speed_m_s=builder.usual(motions[0]),
        floor_m=builder.floor_m,
        pivot_m=builder.pivot_m,
        edge_m=builder.edge_m,
    )
    return centred(path, duration_s)


def _switched(phases: Sequence[Phase], first: Motion) -> Iterator[Phase]:
    """The phases; what switches to another state at a stated time is in it from then on.

    What rests before its `first` motion is in the state from which it switches, also where the
    clip ends before.
    """
    before = ANIMAL_ACTIVITIES.get(first.kind)
    for one in phases:
        now, kind = ANIMAL_ACTIVITIES.get(one.motion.kind), one.motion.kind
        if now is not None and now.to_state and one.motion.start_s is not None:
            kind = now.to_state
        elif one is phases[0] and one.motion is not first and before is not None:
            kind = before.from_state or kind
        yield replace(one, motion=replace(one.motion, kind=kind))


def spin_lift(model: Model) -> float:
    """Height at which the corners of a flat shape that turns in the picture are above ground, m."""
    axle = axle_of(model, "roll")
    return max(axle.reach_m - axle.height_m, 0.0)


def to_and_fro(motion: Motion, speed_m_s: float, span_s: float, model: Model) -> Key:
    """Swing along the heading, or up and down: of a stated rate and greatest speed, else once."""
    reach = max(_SWUNG * speed_m_s * span_s, 0.4 * model.height)
    is_vertical = motion.direction == "up and down" and motion.kind not in _ALONG_GROUND
    if is_vertical:
        reach = min(reach, _LIFT * max(model.length, model.width, model.height))
    rate = motion.rate_hz or 1.0 / max(span_s, 1.0)
    speed = motion.speed_m_s if motion.speed_m_s is not None else 2.0 * math.pi * rate * reach
    along, up = (0.0, speed) if is_vertical else (speed, 0.0)
    return Key(span_s, along, climb_m_s=up, activity=activity_of(motion.kind), swing_hz=rate)


class _KeyBuilder(FlightKeys):
    """Keys of all motions of a body."""

    def add(self, phase: Phase) -> None:
        """Append the keys of one phase."""
        motion, span = self._upright(phase.motion), phase.duration_s
        self._is_beginning = True
        self._was_spinning, self._is_spinning = self._is_spinning, motion.kind == "spin"
        if motion.direction in SWINGS and motion.kind in STEERED:
            key = to_and_fro(motion, abs(self._speed(motion)), span, self._model)
            self._start(key.speed_m_s)
            self.keys.append(key)
        elif motion.kind in STEERED:
            self._travel(motion, span)
        elif motion.kind in ("rise", "sink"):
            self._climb(motion, span)
            if phase.motion.kind == "swim":
                self.keys[-1] = replace(self.keys[-1], activity=activity_of("swim"))
        elif motion.kind == "spin" and self._spin_axis != "yaw":
            self._spin_on(phase)
        elif motion.kind == "spin":
            turn = 2.0 * math.pi * SPIN_RATE_HZ * motion.pace
            turn *= spin_sign(motion.direction, "yaw", 0.0)
            self._start(0.0, turn)
            self._append(Key(span, 0.0, turn, ramp_s=min(0.4, 0.5 * span)))
        elif motion.kind in ("jump", "bounce"):
            self._hop(motion, span)
        elif motion.kind in ("fall", "topple"):
            self._fall(motion.kind, span)
        elif motion.kind == "plunge":
            self._plunge(span)
        else:
            waves = oscillations(motion, self._model, 0.0) if motion.kind not in PATH_KINDS else ()
            self.terms += between(waves, phase.start_s, phase.end_s)
            self._rest(motion, span)

    def _upright(self, motion: Motion) -> Motion:
        """The motion of a leg: of what flies or swims up or down, straight up or down."""
        is_leg = self._has_legs and motion.kind in ("fly", "glide", "swim")
        kind = _UPRIGHT.get(motion.direction or "")
        if not is_leg or kind is None or motion.end_pace is not None:
            return motion
        return replace(motion, kind=kind, direction=None, speed_m_s=abs(self._speed(motion)))

    def _turn_on_the_spot(self, motion: Motion, angle: float) -> bool:
        """Turn in the time before a leg, of what is at rest or goes straight up or down then.

        Tell whether there is room for it.
        """
        *_, before, last = [Key(0.0), *self.keys]
        speed, turn, _, pitch = last.rates
        is_plain = last.restitution is None and not (last.hop_m or last.swing_hz)
        is_plain &= speed == turn == pitch == 0.0
        if motion.start_s is None or not is_plain or least_radius(self._model, self._noun):
            return False
        is_even = before.rates == last.rates
        room_s = last.duration_s if is_even else last.duration_s - last.ramp_s
        turn_s = min(_ON_SPOT_S, 0.55 * room_s)
        rest_s = min(RAMP_S, 0.4 * room_s)
        if turn_s < _LEAST_TURN_S:
            return False
        still = replace(last, duration_s=0.5 * turn_s, ramp_s=0.5 * turn_s)
        self.keys[-1:] = [
            replace(last, duration_s=last.duration_s - turn_s - rest_s),
            replace(still, turn_rad_s=2.0 * angle / turn_s),
            still,
            replace(last, duration_s=rest_s, ramp_s=0.0),
        ]
        self._heading += angle
        return True

    def _spin_on(self, phase: Phase) -> None:
        """Turn a wheel about its axle, or a flat shape in the picture."""
        model, begin_s, axis = self._model, phase.start_s, self._spin_axis
        rate = 2.0 * math.pi * SPIN_RATE_HZ * phase.motion.pace
        rate *= spin_sign(phase.motion.direction, axis, self._heading)
        times = {"begin_s": begin_s, "end_s": phase.end_s}
        self.terms.append(Term(axis, drift=rate, offset=-rate * begin_s, **times))
        self.pivot_m = axle_of(model, axis).height_m
        if axis == "roll":  # its corners stay above the ground
            self.initial_height = max(self.initial_height, spin_lift(model))
        self._rest(STANDING, phase.duration_s)

    def usual(self, motion: Motion) -> float:
        """Speed at pace 1, m/s."""
        own = self._stated_m_s
        return self._haste * usual_speed(self._noun, motion.kind) if own is None else own

    def hurry(self, phases: Sequence[Phase]) -> None:
        """Raise the speed until every turn is a quarter circle of a plausible radius."""
        haste, radius = 1.0, max(least_radius(self._model, self._noun), 0.3 * self._model.length)
        for phase in phases:
            motion = phase.motion
            is_turn = motion.kind == "turn" or motion.direction == "around"
            if is_turn and motion.speed_m_s is None:
                turning_s = phase.duration_s * (_TURN_SHARE if self._is_single else 0.8)
                angle = math.pi if motion.direction == "around" else QUARTER
                haste = max(haste, radius * angle / turning_s / max(self.usual(motion), 0.01))
        self._haste = min(haste, MOST_HASTE)

    def _speed(self, motion: Motion) -> float:
        """Signed speed at the beginning of a motion, m/s."""
        speed = self.usual(motion) * motion.pace if motion.speed_m_s is None else motion.speed_m_s
        if motion.kind == "turn" and not self._is_mobile:
            return 0.0
        is_back = motion.direction == "backward" or motion.kind == "reverse"
        return -speed if is_back else speed

    def _end_speed(self, motion: Motion, speed: float) -> float | None:
        if motion.end_pace is None:
            return None
        if motion.speed_m_s is not None:
            return speed * motion.end_pace / max(motion.pace, 1e-6)
        return math.copysign(self.usual(motion) * motion.end_pace, speed)

    def _travel(self, motion: Motion, span: float) -> None:
        """Along segments, straight or turning, at the end of which it may change its speed."""
        speed, activity = self._speed(motion), activity_of(motion.kind)
        end = self._end_speed(motion, speed)
        slope = {"up": _CLIMB, "down": -_CLIMB}.get(motion.direction or "", 0.0)
        climb = slope * abs(speed) if self._is_free else 0.0
        if motion.kind == "slide" and self._noun.motion == "drive":
            self._swing_round(span)
        segments = self._choose_segments(motion, span)
        is_leg = motion.kind in PATH_KINDS and len(segments) == 2 and motion.direction in YAWS
        if is_leg and self._turn_on_the_spot(motion, segments[0][1]):
            segments = [(1.0, 0.0)]
        if end is None and not climb and self._go_round_corner(motion, segments, speed, span):
            return
        self._start(speed)
        if end is not None and segments[-1][1]:
            segments = [(0.65 * share, turn) for share, turn in segments] + [(0.35, 0.0)]
        last_s = segments.pop()[0] * span if end is not None else 0.0
        for share, turn in segments:
            if turn:
                for one in arc(share * span, speed, turn, least_radius(self._model, self._noun)):
                    self._append(replace(one, activity=activity))
            else:
                ramp = min(RAMP_S, 0.35 * share * span)
                self._append(Key(share * span, speed, 0.0, climb, ramp, activity))
        if end is not None:
            # What brakes is seen going, and at rest or slow for a while.
            lead, ramp = (0.3, 0.4) if abs(end) < abs(speed) else (0.12, 0.88)
            first_ramp = min(RAMP_S, 0.35 * lead * last_s)
            self._append(Key(lead * last_s, speed, 0.0, climb, first_ramp, activity))
            rest_s = (1.0 - lead) * last_s
            self._append(Key(rest_s, end, 0.0, climb, ramp * last_s, activity))

    def _go_round_corner(
        self, motion: Motion, segments: Sequence[tuple[float, float]], speed: float, span: float
    ) -> bool:
        """Go another way from a time that is said, and tell whether there is room for it."""
        before = self.keys[-1]
        is_straight = before.rates[1:] == (0.0, 0.0, 0.0) and not (before.hop_m or before.swing_hz)
        is_leg = motion.kind in PATH_KINDS and motion.direction in YAWS and len(segments) == 2
        is_flying = before.restitution is not None
        if motion.start_s is None or is_flying or not (is_straight and is_leg):
            return False
        last = Key(span, speed, activity=activity_of(motion.kind))
        least_m = least_radius(self._model, self._noun)
        if self.keys[-2:-1] and self.keys[-2].rates == before.rates:
            before = replace(before, ramp_s=0.0)  # at that speed all along
        keys = corner(before, last, segments[0][1], span, least_m)
        if not keys:
            return False
        self.keys[-1], self._is_beginning = keys[0], False
        for key in keys[1:]:
            self._append(key)
        return True

    def _swing_round(self, span: float) -> None:
        """Skid: the rear comes round while it goes straight on."""
        begin_s, end_s = self._now_s + 0.25 * span, self._now_s + 0.8 * span
        drift = _SKID / (end_s - begin_s)
        self.terms.append(
            Term("yaw", drift=drift, offset=-drift * begin_s, begin_s=begin_s, end_s=end_s)
        )

    def _choose_segments(self, motion: Motion, span: float) -> list[tuple[float, float]]:
        """Shares of the time, and by what angle each one turns, rad."""
        direction = motion.direction or ""
        angle = math.pi if direction == "around" else QUARTER
        angle = -angle if direction in CLOCKWISE else angle
        if motion.kind == "turn" and direction in _OF_CAMERA:
            angle = math.remainder(YAWS[direction] - self._heading, 2.0 * math.pi)
        if motion.kind == "turn" or direction == "around":
            lead = 0.5 * (1.0 - _TURN_SHARE) if self._is_single and self._is_mobile else 0.0
            return [(lead, 0.0), (1.0 - 2.0 * lead, angle), (lead, 0.0)] if lead else [(1.0, angle)]
        target = YAWS.get(direction)
        if self._is_first or target is None or direction in ("up", "down"):
            return [(1.0, 0.0)]
        turn = math.remainder(target - self._heading, 2.0 * math.pi)
        if abs(turn) < 0.05:
            return [(1.0, 0.0)]
        radius, speed = least_radius(self._model, self._noun), abs(self._speed(motion))
        needed = (abs(turn) * radius / max(speed, 0.01) + RAMP_S) / span
        share = min(max(_HEADING_SHARE, needed), _MOST_TURNING)
        return [(share, turn), (1.0 - share, 0.0)]

    def _climb(self, motion: Motion, span: float) -> None:
        """Straight up or down; from a runway, along it first, or last."""
        is_up = motion.kind == "rise"
        if self._is_single and self._noun.name in nouns_with("takes off"):
            speed = self._speed(motion)
            climb = _TAKE_OFF * speed if is_up else -_LANDING * speed
            first_s = span * (_LIFT_SHARE if is_up else _LANDING_SHARE)
            self._start(speed)
            self._append(Key(first_s, speed, 0.0, 0.0 if is_up else climb, 0.0))
            self._append(Key(span - first_s, speed, 0.0, climb if is_up else 0.0, 0.6))
            self.initial_height = 0.0 if is_up else -climb * (first_s + 0.3)
            return
        size = max(self._model.length, self._model.height)
        climb = self.usual(motion)
        if motion.kind not in speeds_of(self._noun):
            climb = min(max(climb, 0.3 * size), size)
        climb *= motion.pace
        if motion.speed_m_s is not None:
            climb = motion.speed_m_s
        if not is_up and self._noun.motion in ("sail", "paddle"):  # down from where it floats
            climb, self.floor_m = -_SUNK * self._model.height / span, -2.0 * self._model.height
        elif self._start_m is not None and not is_up:
            climb = -min(climb, self._height / span)
        elif not is_up and self._is_single:
            self.initial_height = climb * 0.85 * span
            climb = -climb
        elif not is_up:
            climb = -climb if self._is_free else -min(climb, self._height / span)
        # What rises alone starts slowly and gets faster all along.
        if self._is_first and motion.speed_m_s is not None:
            self.keys = [Key(0.0, climb_m_s=climb)]
        is_slow = is_up and self._is_single and motion.speed_m_s is None
        ramp, factor = (span, 2.0) if is_slow else (min(0.6, 0.6 * span), 1.0)
        self._append(Key(span, climb_m_s=factor * climb, ramp_s=ramp))
