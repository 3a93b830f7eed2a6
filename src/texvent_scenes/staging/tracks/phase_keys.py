"""Keys of one continuous track through the phases of an object's motion."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import zip_longest

from texvent_scenes.description import SPIN_RATE_HZ, STANDING
from texvent_scenes.models.activities import (
    ACTIVITIES,
    ANIMAL_ACTIVITIES,
    DONE_SEATED,
    ON_GROUND,
    PERSON_NOUNS,
    TRAVELLING,
)
from texvent_scenes.models.protocol import Model, Noun, Pose
from texvent_scenes.models.shapes import bounds
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.spec.scene import Motion
from texvent_scenes.staging.tracks.corners import centre_change, corner
from texvent_scenes.staging.tracks.keys import GRAVITY_M_S2, HOP_PAUSE_S, RAMP_S, Key, arc, flight_s
from texvent_scenes.staging.tracks.phases import (
    PATH_KINDS,
    STEERED,
    SWINGS,
    YAWS,
    Phase,
    activity_of,
    between,
    least_radius,
    oscillations,
    schedule,
    speeds_of,
    usual_speed,
)
from texvent_scenes.staging.tracks.track import Term, Track, centred
from texvent_scenes.staging.tracks.turning import CLOCKWISE, axle_of, spin_sign

NO_FLOOR_M = -1e4
"""Floor of a path that is not yet placed above the ground, m."""
QUARTER = 0.5 * math.pi
_TURN_SHARE, _HEADING_SHARE = 0.6, 0.45
"""Shares of a phase that a turn takes where it is all that happens, for it comes and goes on; and
that the turn to another direction takes: more where its radius asks for that, but not all."""
_MOST_TURNING = 0.95
MOST_HASTE = 2.5
"""Most multiple of its usual speed at which an object does what its time is short for."""
_TIPPING = 0.9
"""Height over length from which on a body that stands on the ground can fall over."""
BOUNCY, DULL = 0.82, 0.3
"""Shares of its upward speed that a bounce keeps: of what bounces, and of what falls."""
_SKID, _SUNK = 1.1, 0.95
"""Angle by which the rear of what skids comes round, rad; share of its
height by which what floats goes down as it sinks."""
_PLUNGED, _LEAPT, _STOOD, _GONE = 1.0, 0.15, 0.62, 1.4
"""Height above the water of who leaps into it, in its own; rise of the leap, as a share of that;
how deep who walks stands there, and how deep others go, in their own heights."""
_BRAKING_M_S2 = 6.0
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
_AT_REST = frozenset({"sit", "lie"})
"""Motions of bodies with legs at rest, beside acts of their own."""
_REACHED = {"sit down": "sit", "stand up": "stand"}
"""Getting up and down after something else: the posture that the body goes over to."""


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
    builder = _KeyBuilder(
        noun, model, stated_m_s, yaw, is_single=len(phases) == 1, spin_axis=spin_axis,
        start_m=start_m, has_times=any(one.start_s is not None for one in motions),
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

    What rests before its `first` motion is in the state from which it switches.
    """
    for one, after in zip_longest(phases, phases[1:]):
        now = ANIMAL_ACTIVITIES.get(one.motion.kind)
        later = ANIMAL_ACTIVITIES.get(after.motion.kind) if after is not None else None
        kind = one.motion.kind
        if now is not None and now.to_state and one.motion.start_s is not None:
            kind = now.to_state
        elif one is phases[0] and one.motion is not first and later is not None:
            kind = later.from_state or kind
        yield replace(one, motion=replace(one.motion, kind=kind))


def falls_sideways(noun: Noun) -> bool:
    """Whether it falls onto its side, as what stands on four legs or on wheels does."""
    is_carried = noun.motion in ("walk", "drive") and noun.habitat == "ground"
    return is_carried and noun.name not in PERSON_NOUNS


def spin_lift(model: Model) -> float:
    """Height at which the corners of a flat shape that turns in the picture are above ground, m."""
    axle = axle_of(model, "roll")
    return max(axle.reach_m - axle.height_m, 0.0)


def fallen_m(model: Model, duration_s: float) -> float:
    """Usual height from which something falls, m."""
    height = 0.5 * GRAVITY_M_S2 * (0.45 * duration_s) ** 2
    return min(max(height, model.height), max(1.2 * model.height, 0.5))


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


class _KeyBuilder:
    """Collects keys, the first without duration; knows heading and height at the last one."""

    def __init__(
        self, noun: Noun, model: Model, stated_m_s: float | None, yaw: float, *, is_single: bool,
        spin_axis: str, start_m: float | None, has_times: bool = False,
    ) -> None:  # fmt: skip
        """For a body that heads there at first."""
        self._noun, self._model = noun, model
        self._spin_axis, self._start_m = spin_axis, start_m
        self._stated_m_s, self._haste = stated_m_s, 1.0
        self._is_single = is_single
        self._is_free = noun.habitat in ("air", "water")
        self._has_legs = has_times and self._is_free and noun.name not in nouns_with("takes off")
        self._is_mobile = noun.speed_m_s > 0.0 and noun.habitat != "fixed"
        self._height = start_m or 0.0
        self._heading = yaw
        self._is_beginning, self._is_spinning = True, False
        self._acts = ACTIVITIES.keys() if noun.name in PERSON_NOUNS else noun.acts | _AT_REST
        self.keys = [Key(0.0)]
        self.terms: list[Term] = []
        self.pivot_m = self.edge_m = 0.0
        self.floor_m = 0.0 if noun.habitat in ("ground", "fixed") else NO_FLOOR_M
        self.initial_height = self._height

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
        is_leg = self._has_legs and motion.kind in ("fly", "swim")
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

    @property
    def _is_first(self) -> bool:
        return len(self.keys) == 1

    def _start(self, speed: float, turn: float = 0.0) -> None:
        """Let the clip begin in full motion."""
        if self._is_first:
            self.keys = [Key(0.0, speed, turn)]

    def _append(self, key: Key) -> None:
        before = self.keys[-1].turn_rad_s
        span, turn, ramp = key.duration_s, key.turn_rad_s, key.ramp_s
        self._height += key.climb_m_s * span
        turned, stated = turn * span + 0.5 * (before - turn) * min(ramp, span), key
        if self._is_beginning and not self._is_first:
            is_act = key.activity != self.keys[-1].activity and key.activity in self._acts
            is_spin = self._is_spinning or self._was_spinning
            self.keys[-2:], key = centre_change(self.keys[-2:], key, is_act=is_act, is_spin=is_spin)
        self._heading += turned if key is stated else turn * span
        self._is_beginning = False
        self.keys.append(key)

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

    @property
    def _now_s(self) -> float:
        """End of the last key, s."""
        return sum(key.duration_s for key in self.keys)

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

    def _hop(self, motion: Motion, span: float) -> None:
        """Jump or bounce; what falls bounces on where it lands."""
        last = self.keys[-1]
        is_high = self._start_m is not None and self._height > 0.0
        if motion.kind == "bounce" and (last.restitution is not None or is_high):
            self._append(Key(span, last.speed_m_s, restitution=BOUNCY))
            if last.restitution is not None:
                both_s = last.duration_s + span
                self.keys[-2:] = [replace(last, duration_s=both_s, restitution=BOUNCY)]
            self._height = 0.0
            return
        model, speed = self._model, self.keys[-1].speed_m_s
        height = max(1.5 * model.height, 0.4)
        if motion.kind == "jump":
            height = min(max(0.35 * model.height, 0.12), 1.5) * motion.pace
            if self._noun.habitat == "water":
                height = max(height, 0.7 * model.length)
            if self._is_first and motion.direction is not None:
                speed = model.length / (flight_s(height) + HOP_PAUSE_S)
                self._start(speed)
        if motion.speed_m_s is not None:
            speed = motion.speed_m_s
            self._start(speed)
        activity = "jump" if motion.kind == "jump" and not speed else "move"
        ramp = min(RAMP_S, 0.35 * span)
        self._append(Key(span, speed, 0.0, 0.0, ramp, activity, height))

    def _plunge(self, span: float) -> None:
        """Through the air into the water, whose surface is at height 0; who walks stands in it."""
        tall = self._model.height
        self.floor_m = -2.0 * tall
        from_m = min(max(_PLUNGED * tall, 0.5), 2.0)
        up_m = _LEAPT * from_m
        flown_s = min(0.5 * (flight_s(up_m) + flight_s(up_m + from_m)), 0.6 * span)
        speed = from_m / flown_s
        self._start(speed)
        if self._is_first:
            self.initial_height = self._height = from_m
        hop_m = GRAVITY_M_S2 * flown_s**2 / 8.0
        self._append(Key(flown_s, speed, 0.0, -from_m / flown_s, 0.0, "stand", hop_m))
        deep_m = tall * (_STOOD if self._noun.motion == "walk" else _GONE)
        sunk_s = min(0.4, 0.5 * (span - flown_s))
        self._append(Key(sunk_s, 0.3 * speed, 0.0, -deep_m / sunk_s, 0.0, "stand"))
        self._append(Key(span - flown_s - sunk_s, ramp_s=0.01, activity="stand"))

    def _fall(self, kind: str, span: float) -> None:
        """Drop to the floor; what stands there falls over, unless it is low or round."""
        is_standing = self._height < 0.1 * self._model.height and self._noun.habitat != "air"
        is_low = self._model.height < _TIPPING * self._model.length or self._noun.motion == "roll"
        if kind == "fall" and is_standing and is_low:
            self._rest(STANDING, span)
            return
        if kind == "topple" and self._is_first:
            self._append(Key(0.15 * span, ramp_s=0.05 * span, activity="stand"))
            span *= 0.85
        if kind == "topple" and falls_sideways(self._noun):
            self._fall_sideways(span)
            return
        key = Key(span, activity="stand", restitution=DULL)
        if kind == "topple" or is_standing:
            if self._noun.name not in nouns_with("falls over"):  # those stand on a small foot
                standing = self._model.parts(Pose(0.0, 0.0, 0.0, "stand"))
                self.edge_m = float(bounds(standing)[1][0])
            key = Key(span, ramp_s=min(0.6, 0.8 * span), activity="stand", pitch_rad=QUARTER)
        self._append(key)
        self._height = 0.0

    def _fall_sideways(self, span: float) -> None:
        """Over to its left, onto its side: what stands on legs or wheels."""
        begin_s, fallen_s = self._now_s, min(0.7, 0.8 * span)
        drift, times = QUARTER / fallen_s, {"begin_s": begin_s, "end_s": begin_s + fallen_s}
        self.terms += [
            Term("roll", drift=-drift, offset=drift * begin_s, **times),
            Term("z", 0.5 * self._model.width, 0.25 / fallen_s, -drift * begin_s, **times),
        ]
        self._append(Key(span, ramp_s=fallen_s, activity="stand"))

    def _rest(self, motion: Motion, span: float) -> None:
        """Come to rest, and act in place."""
        last = self.keys[-1]
        activity = "stand" if motion.kind in ("stand", "hover", "work") else motion.kind
        if not self._is_first:
            activity = _REACHED.get(activity, activity)
            is_low = last.activity.startswith(("sit", "lie")) and activity in DONE_SEATED
            activity = f"{ON_GROUND['sit']} and {activity}" if is_low else activity
        if self._noun.name in PERSON_NOUNS:
            activity = ON_GROUND.get(activity, activity)
        is_done = last.activity in ACTIVITIES and last.activity not in TRAVELLING
        if not self._is_first and motion.kind == "stand" and not is_done:
            activity = last.activity  # wheels and legs go on until it stands
        braking = max(0.25, abs(last.speed_m_s) / _BRAKING_M_S2)
        ramp = min(braking, 0.9 * span)
        self._append(Key(span, ramp_s=ramp, activity=activity, pitch_rad=last.pitch_rad))
