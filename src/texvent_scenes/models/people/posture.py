"""Postures of people: channels of an activity, of the steps below it, and of hands that are held.

A posture is the value of every channel that the figure in `data/outfits.toml` follows; those of its
limbs are in `limbs.Limb`. Coordinates are those of `protocol`, for an adult of 1.75 m; angles are
radians, lengths metres.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import cache

from texvent_scenes.models.activities import (
    ACTIVITIES,
    SINGLE_ACTS,
    USUAL,
    ChannelTrack,
    Values,
    ease,
    flattened,
    motion_of,
    read_track,
)
from texvent_scenes.models.limbs import Gait, Steps, foot_path, step_amount
from texvent_scenes.models.protocol import Pose
from texvent_scenes.models.shapes import Point

Numbers = tuple[float, ...]
SEAT = 0.42
"""Height of the chair on which one sits, m: hips are a little above it."""
WALK = Gait(stride=1.25, duty=0.60, lift=0.12)
RUN = Gait(stride=2.40, duty=0.34, lift=0.32)
CRAWL = Gait(stride=0.60, duty=0.60, lift=0.07)
_HIP, _ANKLE = 0.95, 0.08
"""Heights of a standing person."""
_UPPER_ARM, _LOWER_ARM = 0.29, 0.35
_LIMBS: Mapping[str, tuple[str, str]] = {
    "left": ("arms", "hand"), "right": ("arms", "hand"),
    "left_leg": ("legs", "foot"), "right_leg": ("legs", "foot"),
}  # fmt: skip
"""Limb → name of both of its kind, and of its end, in the tables."""
_BENDS: Mapping[str, Point] = {"arms": (-0.6, 0.5, -0.6), "legs": (1.0, 0.1, 0.35)}
"""Usual directions of elbows and knees."""


def place_limb(
    name: str,
    end: Numbers,
    bend: Numbers | None = None,
    *,
    is_free: bool = False,
    pitch: float = 0.0,
) -> Values:
    """Channels of a limb whose end is at a point of the body, or that far from its root."""
    away, there = (end, (0.0,) * 3) if is_free else ((0.0,) * 3, end)
    bend = bend or _BENDS[_LIMBS[name][0]]
    found = {
        "reach": away,
        "spot": there,
        "free": (float(is_free),),
        "bend": bend,
        "pitch": (pitch,),
    }
    return {f"{name}.{channel}": value for channel, value in found.items()}


def find_posture(activity: str, time_s: float, act_s: float | None = None) -> Values | None:
    """Channels that an activity decides.

    Args:
        activity: a name of `ACTIVITIES`; of another one nothing is decided.
        time_s: time since it began, s.
        act_s: time since its instant of contact, if it happens once, s.

    Returns:
        Channels, of limbs all or none; None = those of standing and walking.
    """
    if activity not in ACTIVITIES:
        return None
    row = ACTIVITIES[activity]
    track = _find_track(row.moves_as or activity)
    if track is None:
        return None
    if act_s is not None and row.contact_s is not None:
        return _read_channels(track.at(act_s, once=True))
    return _read_channels(track.at(time_s - (row.contact_s or 0.0)))


@cache
def _find_track(activity: str) -> ChannelTrack | None:
    row = motion_of("activities", activity)
    return read_track(row) if row else None


def _read_channels(values: Values) -> Values:
    """Channels of the figure from those of the tables, which have names for both sides."""
    found = {name: numbers for name, numbers in values.items() if "." not in name}
    if "tool" in found:
        found["right.tool"] = found.pop("tool")
    for limb, (both, end) in _LIMBS.items():
        said = {
            name: values.get(f"{limb}.{name}", values.get(f"{both}.{name}"))
            for name in (end, "elbow", "knee", "pitch", "fixed")
        }
        if (at := said[end]) is not None:
            is_free = both == "arms" and said["fixed"] is None
            found |= place_limb(limb, at, said["elbow"] or said["knee"],
                                is_free=is_free, pitch=(said["pitch"] or (0.0,))[0])  # fmt: skip
    return found


STANDING: Values = {
    **_read_channels(read_track(motion_of("activities", USUAL)).at(0.0)),
    "left.tool": (0.0, 0.0, 1.0),
}
"""All channels of a standing person."""


def find_channels(pose: Pose, *, runs: bool) -> dict[str, float]:
    """All channels of a person at an instant: of an activity, or between two.

    Args:
        pose: the instant.
        runs: whether it runs where it moves.
    """
    posture = choose_posture(pose, runs=runs)
    if pose.before is not None:
        earlier = choose_posture(replace(pose, activity=pose.before), runs=runs)
        posture = blend(earlier, posture, pose.share)
    # One who lies has no direction in which the knees go along with the torso.
    stance = posture["turn"] if abs(posture["lean"][0]) < 1.0 else (0.0,)
    return flattened({**posture, "stance": stance})


def choose_posture(pose: Pose, *, runs: bool) -> Values:
    """The posture of the activity of a pose, held where the pose holds the body."""
    posture = dict(_act(pose, runs=runs))
    for name, (x, y, z) in pose.grips:
        word, _, end = name.partition(" ")
        if not end:
            posture[name] = (x, y, z)
            continue
        limb, side = word if end == "hand" else f"{word}_leg", 1.0 if word == "left" else -1.0
        posture |= place_limb(limb, (x, side * y, z), posture[f"{limb}.bend"])
    return posture


def _act(pose: Pose, *, runs: bool) -> Values:
    activity = pose.activity
    if activity == "crawl":
        return _crawl(pose)
    is_fast = activity == "run" or (runs and activity == "move")
    amount = 0.0 if activity.startswith("sit") else step_amount(activity, pose.speed_m_s, 0.5)
    base = step(RUN if is_fast else WALK, pose.distance_m, amount)
    act_s = pose.act_s if activity in SINGLE_ACTS else None
    seat, is_seated, doing = activity.partition(" and ")
    if is_seated:  # "sit on ground and read"
        base = {**fill(find_posture(seat, pose.time_s) or {}, base), "look": (0.0,)}
        activity = doing
    time_s = (pose.act_s or 0.0) if activity == "jump" else pose.time_s
    posture = fill(find_posture(activity, time_s, act_s) or {}, base)
    if act_s is not None and amount > 0.0:
        posture = blend(base, posture, ease(act_s, -0.50, -0.20))
    return posture


def fill(posture: Values, base: Values) -> Values:
    """A posture whose open channels are those of `base`; leans add up where its hips are open."""
    lean = posture.get("lean", (0.0,))[0]
    return {**base, **posture, "lean": (lean + (0.0 if "hips" in posture else base["lean"][0]),)}


def blend(first: Values, second: Values, share: float) -> Values:
    """Between two postures: the first at share 0, the second at 1."""
    share = min(max(share, 0.0), 1.0)
    return {
        name: tuple(a + share * (b - a) for a, b in zip(first[name], numbers, strict=True))
        for name, numbers in second.items()
    }


def step(gait: Gait, distance: float, amount: float) -> Values:
    """Walking or running: legs and arms by the distance covered; amount 0 = standing."""
    runs = gait is RUN
    turn = 2.0 * math.pi * distance / gait.stride
    # A walker is highest in mid-stance, a runner lowest; legs are nearly straight at both.
    bob = -0.03 * math.cos(2.0 * turn + 1.0) if runs else 0.03 * math.cos(2.0 * turn - 0.63)
    drop = 0.05 if runs else 0.02
    hips = (0.0, 0.0, _HIP - 0.005 + amount * (bob - drop))
    posture: Values = {**STANDING, "hips": hips, "lean": (amount * (0.16 if runs else 0.04),)}
    for side, offset in (("left", 0.0), ("right", 0.5)):
        x, z = foot_path(Steps(gait, distance / gait.stride, amount), offset + 0.25)
        foot, pitch = (x, 0.08, _ANKLE + z), 0.54 * z / gait.lift
        posture |= place_limb(f"{side}_leg", foot, (1.0, 0.0, 0.35), pitch=pitch)
        # Each arm swings with the opposite leg.
        swing = amount * (0.75 if runs else 0.42) * math.sin(turn + 2.0 * math.pi * offset)
        fold = swing + 0.12 + amount * (1.45 if runs else 0.18)
        forward = _UPPER_ARM * math.sin(swing) + _LOWER_ARM * math.sin(fold)
        up = -_UPPER_ARM * math.cos(swing) - _LOWER_ARM * math.cos(fold)
        posture |= place_limb(side, (forward, 0.03, up), (-1.0, 0.25, 0.2), is_free=True)
    return posture


def _crawl(pose: Pose) -> Values:
    """On hands and knees, which stay where they are set down."""
    posture: Values = {**STANDING, "hips": (-0.24, 0.0, 0.47), "lean": (1.40,), "nod": (-0.9,)}
    steps = Steps(CRAWL, pose.distance_m / CRAWL.stride, 1.0)
    for side, offset in (("left", 0.0), ("right", 0.5)):
        x, z = foot_path(steps, offset)
        posture |= place_limb(side, (0.34 + x, 0.18, 0.05 + z), (-0.4, 0.6, -0.6))
        x, z = foot_path(steps, offset + 0.5)
        foot = (-0.56 + x, 0.11, 0.09 + 0.6 * z)
        posture |= place_limb(f"{side}_leg", foot, (0.4, 0.1, -1.0), pitch=1.9)
    return posture
