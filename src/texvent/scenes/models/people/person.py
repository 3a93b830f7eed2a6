"""People: one body that walks, runs, rests, gestures, works and does sports."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from types import MappingProxyType

from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.limb_kinematics import Gait, foot_path, step_amount
from texvent.scenes.models.people.activities import SEATED
from texvent.scenes.models.people.acts.at_head import AT_HEAD_MOVEMENTS
from texvent.scenes.models.people.acts.chores import CHORE_MOVEMENTS
from texvent.scenes.models.people.acts.everyday import EVERYDAY_MOVEMENTS
from texvent.scenes.models.people.acts.exercises import EXERCISE_MOVEMENTS
from texvent.scenes.models.people.acts.getting import GETTING_MOVEMENTS
from texvent.scenes.models.people.acts.music import MUSIC_MOVEMENTS
from texvent.scenes.models.people.acts.pairs import PAIR_MOVEMENTS
from texvent.scenes.models.people.acts.play import PLAY_MOVEMENTS
from texvent.scenes.models.people.anchors import locate_anchor
from texvent.scenes.models.people.daily import DAILY
from texvent.scenes.models.people.figure import draw_figure
from texvent.scenes.models.people.gestures import GESTURES, Movement
from texvent.scenes.models.people.outfit import (
    ADULT,
    CHILD,
    GIRL,
    RUNNER,
    WOMAN,
    WORKER,
    PersonKind,
    dress_person,
)
from texvent.scenes.models.people.pastimes.care import CARE_MOVEMENTS
from texvent.scenes.models.people.pastimes.crafts import CRAFT_MOVEMENTS
from texvent.scenes.models.people.pastimes.feats import FEAT_MOVEMENTS
from texvent.scenes.models.people.pastimes.meals import MEAL_MOVEMENTS
from texvent.scenes.models.people.posture import (
    ANKLE,
    HIP,
    LOWER_ARM,
    UPPER_ARM,
    Arm,
    Leg,
    Posture,
    blend,
    fill,
    solve,
)
from texvent.scenes.models.people.sports import SINGLE_ACTS, SPORTS
from texvent.scenes.models.people.timing import ease
from texvent.scenes.models.people.work.bench import list_grips, usual_bench
from texvent.scenes.models.people.work.verbs import HANDWORK
from texvent.scenes.models.protocol import ModelPart, Noun, Pose
from texvent.scenes.models.shapes import Affine, Point
from texvent.scenes.scene import Colour

WALK = Gait(stride=1.25, duty=0.60, lift=0.12)
RUN = Gait(stride=2.40, duty=0.34, lift=0.32)
CRAWL = Gait(stride=0.60, duty=0.60, lift=0.07)
RUN_UP = WALK
"""Gait of a run-up."""

MOVEMENTS: Mapping[str, Movement] = MappingProxyType(
    {
        **GESTURES,
        **SPORTS,
        **DAILY,
        **GETTING_MOVEMENTS,
        **CHORE_MOVEMENTS,
        "mop": DAILY["sweep"],
        "climb down": lambda t: SPORTS["climb"](-t),
        **AT_HEAD_MOVEMENTS,
        **EXERCISE_MOVEMENTS,
        **PLAY_MOVEMENTS,
        **MUSIC_MOVEMENTS,
        **PAIR_MOVEMENTS,
        **EVERYDAY_MOVEMENTS,
        **FEAT_MOVEMENTS,
        **CARE_MOVEMENTS,
        **CRAFT_MOVEMENTS,
        **MEAL_MOVEMENTS,
    }
)
"""Activity → posture over time; what is not here walks or runs."""


_LEANING = {"push along": 0.30, "pull along": 0.16}
"""How far who pushes or pulls while walking leans forward, radians."""


def build_person(
    kind: PersonKind, *, colour: Colour | None, scale: float, seed: int
) -> ArticulatedModel:
    """Make a person; `colour` is the shirt or dress."""
    outfit = dress_person(kind, colour=colour, seed=seed)

    def articulate(pose: Pose) -> list[ModelPart]:
        return draw_figure(kind, outfit, solve(choose_posture(kind, pose)))

    def anchor(name: str, pose: Pose) -> Affine:
        return locate_anchor(name, solve(choose_posture(kind, pose)), kind.head)

    return ArticulatedModel([], scale=scale * kind.height, articulate=articulate, anchor=anchor)


def choose_posture(kind: PersonKind, pose: Pose) -> Posture:
    """The complete posture at an instant: of an activity, or between two."""
    posture = _choose_over_time(kind, pose)
    if kind.stoop == 0.0 or posture.lean > kind.stoop or posture.lean < -0.2:
        return posture
    return replace(posture, lean=kind.stoop, nod=posture.nod - 0.6 * kind.stoop)


def _choose_over_time(kind: PersonKind, pose: Pose) -> Posture:
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
    if pose.act_s is not None and activity in SINGLE_ACTS:
        act = fill(SINGLE_ACTS[activity](pose.act_s), base)
        share = ease(pose.act_s, -0.50, -0.20) if amount > 0.0 else 1.0
        return _grip(blend(base, act, share), pose)
    if activity in _LEANING:
        return _grip(fill(Posture(lean=_LEANING[activity]), base), pose)
    if activity.startswith(SEATED):
        base = fill(MOVEMENTS["sit"](pose.time_s), base)
        activity = activity.removeprefix(SEATED)
    movement = MOVEMENTS.get(activity)
    if movement is None and activity in HANDWORK:
        work = HANDWORK[activity]
        grips = list_grips(work, usual_bench(work), pose.time_s)
        return _grip(base, replace(pose, grips=grips + pose.grips))
    if movement is None:
        return _grip(base, pose)
    return _grip(fill(movement(pose.time_s), base), pose)


def step(gait: Gait, distance: float, amount: float) -> Posture:
    """Walking or running: legs and arms by the distance covered; amount 0 = standing."""
    runs = gait is RUN
    turn = 2.0 * math.pi * distance / gait.stride
    # A walker is highest in mid-stance, a runner lowest; legs are nearly straight at both.
    bob = -0.03 * math.cos(2.0 * turn + 1.0) if runs else 0.03 * math.cos(2.0 * turn - 0.63)
    drop = 0.05 if runs else 0.02
    legs, arms = [], []
    for offset in (0.0, 0.5):
        x, z = foot_path(gait, distance, offset + 0.25, amount)
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
    for side, offset in ((1.0, 0.0), (-1.0, 0.5)):
        x, z = foot_path(CRAWL, pose.distance_m, offset, 1.0)
        arms.append(Arm((0.34 + x, side * 0.18, 0.05 + z), (-0.4, 0.6, -0.6), True))
        x, z = foot_path(CRAWL, pose.distance_m, offset + 0.5, 1.0)
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
    gripped = Posture(**{**posture.__dict__, **changes})
    return _bow_to(gripped, held) if "neck" in held else gripped


def _bow_to(posture: Posture, held: Mapping[str, Point]) -> Posture:
    """The torso bends to where its neck is held; the tool and the head point to their places."""
    (x, _, z), (neck_x, _, neck_z) = held["hips"], held["neck"]
    lean = math.atan2(neck_x - x, neck_z - z)
    c, s = math.cos(lean), math.sin(lean)
    ahead, left, up = (a - b for a, b in zip(held["tip"], held["right hand"], strict=True))
    look_x, look_y, look_z = held["gaze"]
    head_x, head_z = x + 0.70 * s, z + 0.70 * c
    down = math.atan2(head_z - look_z, max(look_x - head_x, 0.15))
    return replace(
        posture,
        lean=lean,
        turn=0.0,
        tilt=0.0,
        tool=(c * ahead - s * up, -left, s * ahead + c * up),
        nod=min(max(0.8 * down - lean, -0.6), 0.6),
        look=min(max(math.atan2(look_y, max(look_x, 0.2)), -0.6), 0.6),
    )


NOUNS = (
    Noun(
        "person", partial(build_person, ADULT), "ground", 1.4, "walk",
        ("pedestrian", "human", "walker", "somebody"), ("people",),
    ),
    Noun(
        "man", partial(build_person, ADULT), "ground", 1.4, "walk",
        ("guy", "gentleman", "father", "dad", "husband", "brother", "uncle", "young man",
         "dude", "bloke"),
    ),
    Noun("woman", partial(build_person, WOMAN), "ground", 1.3, "walk",
         ("lady", "mother", "mom", "mum", "aunt", "wife", "young woman"), ("ladies", "wives")),
    Noun(
        "child", partial(build_person, CHILD), "ground", 1.1, "walk",
        ("kid", "boy", "son", "little boy", "young boy", "youngster"), ("children",),
    ),
    Noun("girl", partial(build_person, GIRL), "ground", 1.1, "walk",
         ("daughter", "sister", "little girl", "young girl")),
    Noun(
        "runner", partial(build_person, RUNNER), "ground", 3.5, "run",
        ("jogger", "sprinter", "marathon runner"),
    ),
    Noun(
        "worker", partial(build_person, WORKER), "ground", 1.2, "walk",
        ("construction worker", "builder", "workman"),
    ),
)  # fmt: skip
