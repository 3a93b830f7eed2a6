"""Keys of falls, hops and rests: the state of a body at its last key, and what follows of it."""

from __future__ import annotations

import math
from dataclasses import replace

from texvent_scenes.description import STANDING
from texvent_scenes.models.activities import (
    ACTIVITIES,
    DONE_SEATED,
    ON_GROUND,
    PERSON_NOUNS,
    TRAVELLING,
)
from texvent_scenes.models.protocol import Model, Noun, Pose
from texvent_scenes.models.shapes import bounds
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.spec.scene import Motion
from texvent_scenes.staging.tracks.corners import centre_change
from texvent_scenes.staging.tracks.keys import GRAVITY_M_S2, HOP_PAUSE_S, RAMP_S, Key, flight_s
from texvent_scenes.staging.tracks.track import Term

NO_FLOOR_M = -1e4
"""Floor of a path that is not yet placed above the ground, m."""
QUARTER = 0.5 * math.pi
_TIPPING = 0.9
"""Height over length from which on a body that stands on the ground can fall over."""
BOUNCY, DULL = 0.82, 0.3
"""Shares of its upward speed that a bounce keeps: of what bounces, and of what falls."""
_PLUNGED, _LEAPT, _STOOD, _GONE = 1.0, 0.15, 0.62, 1.4
"""Height above the water of who leaps into it, in its own; rise of the leap, as a share of that;
how deep who walks stands there, and how deep others go, in their own heights."""
_BRAKING_M_S2 = 6.0
_AT_REST = frozenset({"sit", "lie"})
"""Motions of bodies with legs at rest, beside acts of their own."""
_REACHED = {"sit down": "sit", "stand up": "stand"}
"""Getting up and down after something else: the posture that the body goes over to."""


def falls_sideways(noun: Noun) -> bool:
    """Whether it falls onto its side, as what stands on four legs or on wheels does."""
    is_carried = noun.motion in ("walk", "drive") and noun.habitat == "ground"
    is_carried |= noun.name in nouns_with("falls onto its side")
    return is_carried and noun.name not in PERSON_NOUNS


def fallen_m(model: Model, duration_s: float) -> float:
    """Usual height from which something falls, m."""
    height = 0.5 * GRAVITY_M_S2 * (0.45 * duration_s) ** 2
    return min(max(height, model.height), max(1.2 * model.height, 0.5))


_STANDING_JUMP = 0.45
"""Height of a person's jump on the spot, who draws up the feet too, as a share of a leap's."""


class FlightKeys:
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
        self._is_beginning = True
        self._was_spinning = self._is_spinning = False
        self._acts = ACTIVITIES.keys() if noun.name in PERSON_NOUNS else noun.acts | _AT_REST
        self.keys = [Key(0.0)]
        self.terms: list[Term] = []
        self.pivot_m = self.edge_m = 0.0
        self.floor_m = 0.0 if noun.habitat in ("ground", "fixed") else NO_FLOOR_M
        self.initial_height = self._height

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

    @property
    def _now_s(self) -> float:
        """End of the last key, s."""
        return sum(key.duration_s for key in self.keys)

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
        if activity == "jump" and self._noun.name in PERSON_NOUNS:
            height *= _STANDING_JUMP
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
            if self._noun.name not in nouns_with("branches give way"):
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
