"""Movements of people: postures over time, from the tracks of `data/activities.toml`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache
from typing import Any

from texvent.scenes.models.people.activities import ACTIVITIES, motion_of
from texvent.scenes.models.people.posture import DOWN, OUT, SIDES, Arm, Leg, Posture
from texvent.scenes.models.people.track import Track, Values, read_track
from texvent.scenes.models.shapes import Point, point

_ELBOWS: Mapping[str, Point] = {"down": DOWN, "out": OUT}


def find_posture(activity: str, time_s: float, act_s: float | None = None) -> Posture | None:
    """What an activity decides of the posture.

    Args:
        activity: a name of `ACTIVITIES`; of another one nothing is decided.
        time_s: time since it began, s.
        act_s: time since its instant of contact, if it happens once, s.

    Returns:
        A posture whose open fields are those of the legs' gait; None = all of them.
    """
    if activity not in ACTIVITIES:
        return None
    row = ACTIVITIES[activity]
    track = find_track(row.moves_as or activity)
    if track is None:
        return None
    if act_s is not None and row.contact_s is not None:
        return _pose(track.at(act_s, once=True))
    return _pose(track.at(time_s - (row.contact_s or 0.0)))


@cache
def find_track(activity: str) -> Track | None:
    """The channels that an activity decides; None = those of standing and walking."""
    row = motion_of("activities", activity)
    return read_track(_with_elbows(row)) if row else None


def _with_elbows(row: Mapping[str, Any]) -> dict[str, Any]:
    """The row with directions in place of their names."""
    return {
        key: _with_elbows(value) if isinstance(value, Mapping)
        else _ELBOWS[value] if isinstance(value, str) else value
        for key, value in row.items()
    }  # fmt: skip


def _pose(values: Values) -> Posture:
    """A posture of its channels."""
    angles = {name: _number(values.get(name)) for name in
              ("lean", "tilt", "turn", "nod", "look", "heading")}  # fmt: skip
    return Posture(
        hips=point(values["hips"]) if "hips" in values else None,
        left=_arm(values, "left", SIDES[0]),
        right=_arm(values, "right", SIDES[1]),
        left_leg=_leg(values, "left_leg"),
        right_leg=_leg(values, "right_leg"),
        tool=point(values["tool"]) if "tool" in values else Posture.tool,
        **angles,
    )


def _arm(values: Values, name: str, side: float) -> Arm | None:
    hand = _of_limb(values, name, "arms", "hand")
    if hand is None:
        return None
    elbow = _of_limb(values, name, "arms", "elbow")
    is_fixed = _of_limb(values, name, "arms", "fixed") is not None
    x, y, z = point(hand)
    return Arm((x, side * y if is_fixed else y, z), point(elbow) if elbow else Arm.elbow, is_fixed)


def _leg(values: Values, name: str) -> Leg | None:
    foot = _of_limb(values, name, "legs", "foot")
    if foot is None:
        return None
    knee = _of_limb(values, name, "legs", "knee")
    pitch = _number(_of_limb(values, name, "legs", "pitch"))
    return Leg(point(foot), point(knee) if knee else Leg.knee, pitch)


def _of_limb(values: Values, name: str, both: str, what: str) -> tuple[float, ...] | None:
    """A limb's own channel, or that of both limbs."""
    return values.get(f"{name}.{what}", values.get(f"{both}.{what}"))


def _number(numbers: Sequence[float] | None) -> float:
    return numbers[0] if numbers else 0.0
