"""People: one body that walks, runs, rests, gestures, works and does sports."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import cache, partial
from typing import Any

from texvent_scenes.models.activities import (
    ACTIVITIES,
    SEATED,
    SINGLE_ACTS,
    Track,
    Values,
    ease,
    motion_of,
    read_track,
)
from texvent_scenes.models.limbs import Gait, Steps, foot_path, step_amount
from texvent_scenes.models.people.figure import draw_figure, locate_anchor
from texvent_scenes.models.people.outfit import KINDS, PersonKind, dress_person, put_on
from texvent_scenes.models.people.posture import (
    ANKLE,
    DOWN,
    HIP,
    LOWER_ARM,
    OUT,
    SIDES,
    UPPER_ARM,
    Arm,
    Leg,
    Posture,
    blend,
    fill,
    solve,
)
from texvent_scenes.models.protocol import ModelPart, Noun, Pose
from texvent_scenes.models.shapes import Affine, ArticulatedModel, Point, point
from texvent_scenes.models.surfaces import Painted
from texvent_scenes.models.tables import read_table
from texvent_scenes.rendered_scene import Colour

_ELBOWS: Mapping[str, Point] = {"down": DOWN, "out": OUT}


def find_posture(activity: str, time_s: float, act_s: float | None = None) -> Posture | None:
    """Posture that an activity decides.

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


WALK = Gait(stride=1.25, duty=0.60, lift=0.12)
RUN = Gait(stride=2.40, duty=0.34, lift=0.32)
CRAWL = Gait(stride=0.60, duty=0.60, lift=0.07)


def build_person(
    kind: PersonKind, *, colour: Colour | None, scale: float, seed: int
) -> ArticulatedModel:
    """Make a person; `colour` is the shirt or dress."""
    draw = partial(_draw, kind, dress_person(kind, colour=colour, seed=seed))
    return _usual_person(kind).scaled(scale * kind.height, draw)


@cache
def _usual_person(kind: PersonKind) -> ArticulatedModel:
    """A person in any clothes: all of a kind have the same shapes."""

    def anchor(name: str, pose: Pose) -> Affine:
        return locate_anchor(name, solve(choose_posture(kind, pose)), kind.head)

    outfit = dress_person(kind, colour=None, seed=0)
    return ArticulatedModel([], articulate=partial(_draw, kind, outfit), anchor=anchor)


def _draw(kind: PersonKind, outfit: Painted, pose: Pose) -> list[ModelPart]:
    return draw_figure(kind, outfit, solve(choose_posture(kind, pose)))


def choose_posture(kind: PersonKind, pose: Pose) -> Posture:
    """The complete posture at an instant: of an activity, or between two."""
    if pose.before is None:
        return _choose_posture(kind, pose)
    first = _choose_posture(kind, replace(pose, activity=pose.before, before=None))
    return blend(first, _choose_posture(kind, pose), pose.share)


def _choose_posture(kind: PersonKind, pose: Pose) -> Posture:
    activity = pose.activity
    if activity == "crawl":
        return _grip(_crawl(pose), pose)
    runs = activity == "run" or (kind.runs and activity == "move")
    amount = 0.0 if activity.startswith("sit") else step_amount(activity, pose.speed_m_s, 0.5)
    base = step(RUN if runs else WALK, pose.distance_m, amount)
    if activity == "jump":
        return _grip(fill(_jump(pose.act_s), base), pose)
    act_s = pose.act_s if activity in SINGLE_ACTS else None
    if activity.startswith(SEATED):
        base = fill(find_posture("sit", pose.time_s) or base, base)
        activity = activity.removeprefix(SEATED)
    posture = find_posture(activity, pose.time_s, act_s)
    if posture is None:
        return _grip(base, pose)
    posture = fill(posture, base)
    if act_s is not None and amount > 0.0:
        posture = blend(base, posture, ease(act_s, -0.50, -0.20))
    return _grip(posture, pose)


def step(gait: Gait, distance: float, amount: float) -> Posture:
    """Walking or running: legs and arms by the distance covered; amount 0 = standing."""
    runs = gait is RUN
    turn = 2.0 * math.pi * distance / gait.stride
    # A walker is highest in mid-stance, a runner lowest; legs are nearly straight at both.
    bob = -0.03 * math.cos(2.0 * turn + 1.0) if runs else 0.03 * math.cos(2.0 * turn - 0.63)
    drop = 0.05 if runs else 0.02
    legs, arms = [], []
    for offset in (0.0, 0.5):
        x, z = foot_path(Steps(gait, distance / gait.stride, amount), offset + 0.25)
        pitch = 0.54 * z / gait.lift
        legs.append(Leg((x, 0.08, ANKLE + z), (1.0, 0.0, 0.35), pitch))
        # Each arm swings with the opposite leg.
        swing = amount * (0.75 if runs else 0.42) * math.sin(turn + 2.0 * math.pi * offset)
        fold = swing + 0.12 + amount * (1.45 if runs else 0.18)
        forward = UPPER_ARM * math.sin(swing) + LOWER_ARM * math.sin(fold)
        up = -UPPER_ARM * math.cos(swing) - LOWER_ARM * math.cos(fold)
        arms.append(Arm((forward, 0.03, up), (-1.0, 0.25, 0.2)))
    return Posture(
        hips=(0.0, 0.0, HIP - 0.005 + amount * (bob - drop)),
        lean=amount * (0.16 if runs else 0.04),
        left=arms[0], right=arms[1], left_leg=legs[0], right_leg=legs[1],
    )  # fmt: skip


def _jump(act_s: float | None) -> Posture:
    """Crouched at take-off and landing, stretched with raised arms at the top (`act_s` 0)."""
    away = abs(act_s) if act_s is not None else 0.0
    crouch, tuck = ease(away, 0.18, 0.40), 1.0 - ease(away, 0.02, 0.26)
    arm = Arm(
        (0.16 - 0.20 * crouch, 0.22 * (1.0 - crouch), 0.48 - 0.90 * crouch), (-0.6, 0.8, -0.4)
    )
    leg = Leg((-0.10 * tuck, 0.09, ANKLE + 0.16 * tuck), pitch=0.7 * tuck)
    return Posture(hips=(-0.14 * crouch, 0.0, HIP - 0.26 * crouch), lean=0.5 * crouch, left=arm,
                   right=arm, left_leg=leg, right_leg=leg)  # fmt: skip


def _crawl(pose: Pose) -> Posture:
    """On hands and knees, which stay where they are set down."""
    arms, legs = [], []
    steps = Steps(CRAWL, pose.distance_m / CRAWL.stride, 1.0)
    for side, offset in ((1.0, 0.0), (-1.0, 0.5)):
        x, z = foot_path(steps, offset)
        arms.append(Arm((0.34 + x, side * 0.18, 0.05 + z), (-0.4, 0.6, -0.6), True))
        x, z = foot_path(steps, offset + 0.5)
        legs.append(Leg((-0.56 + x, 0.11, 0.09 + 0.6 * z), (0.4, 0.1, -1.0), 1.9))
    return Posture(hips=(-0.24, 0.0, 0.47), lean=1.40, nod=-0.9, left=arms[0], right=arms[1],
                   left_leg=legs[0], right_leg=legs[1])  # fmt: skip


def _grip(posture: Posture, pose: Pose) -> Posture:
    """The posture with hands, feet or hips where the pose holds them."""
    if not pose.grips:
        return posture
    held = dict(pose.grips)
    changes: dict[str, Posture | Arm | Leg | tuple[float, float, float]] = {}
    for name, arm in (("left", posture.left), ("right", posture.right)):
        if f"{name} hand" in held:
            elbow = (-0.4, 0.8, -0.8) if arm is None else arm.elbow
            changes[name] = Arm(held[f"{name} hand"], elbow, True)
    for name, leg, side in (("left", posture.left_leg, 1.0), ("right", posture.right_leg, -1.0)):
        if f"{name} foot" in held:
            x, y, z = held[f"{name} foot"]
            knee = (1.0, 0.5, 0.3) if leg is None else leg.knee
            changes[f"{name}_leg"] = Leg((x, side * y, z), knee)
    if "hips" in held:
        changes["hips"] = held["hips"]
    return replace(posture, **changes)  # type: ignore[arg-type]


def dress(noun: Noun, worn: Iterable[tuple[str, Colour | None]]) -> Noun:
    """The noun of a person in what it wears.

    Args:
        noun: a person; its builder is made of its `PersonKind`.
        worn: nouns of `outfit.CLOTHES` with their colours; None = the usual one.
    """
    build: Any = noun.build
    return replace(noun, build=partial(build.func, put_on(build.args[0], worn)))


def _read_noun(name: str, row: Mapping[str, Any]) -> Noun:
    return Noun(
        name,
        partial(build_person, KINDS[name]),
        "ground",
        0.0,
        row.get("motion", "walk"),
        tuple(row.get("names", ())),
        tuple(row.get("plurals", ())),
    )


NOUNS = tuple(_read_noun(name, row) for name, row in read_table("outfits")["people"].items())
