"""Postures of four-legged animals: how trunk, head, tail and feet stand in gaits and acts."""

from __future__ import annotations

import math

from texvent.scenes.models.animals.acts import STANDING, Stance
from texvent.scenes.models.animals.build import Build
from texvent.scenes.models.shapes import Affine, turn_y

LOWEST = -1.15
"""Angle of a neck that is let down, rad."""
_DROOP = 0.12
"""How far the head of a lying animal is let down."""
_LEVEL = 0.35
"""The same of who sits with its chest up, and looks ahead."""


def tail_lift(build: Build, stance: Stance, sits: float, lies: float) -> float:
    """How far the tail is turned up, rad; of who sits or lies it is along the ground."""
    lift = 0.0 if stance is STANDING else 0.4 * stance.wag
    return lift - lies * (build.tail[1] + 0.25) - sits * (build.tail[1] - _seated_pitch(build))


def tip(build: Build, stance: Stance, sits: float) -> Affine:
    """[3, 4] turn of the trunk: down about the hips for a low head; who sits has its chest up."""
    length, _, height = build.body_size
    hips = (-0.30 * length, 0.0, build.shoulder - 0.5 * height)
    low = lowered_head(build, stance) * (1.0 - sits)
    return turn_y(_bow(build) * low - _seated_pitch(build) * sits, hips)


def lowered_head(build: Build, stance: Stance) -> float:
    """How low the head is, 0 to 1: what has a trunk lets down that instead."""
    return 0.1 * stance.head_down if build.trunk_length > 0.0 else stance.head_down


def curled_trunk(stance: Stance) -> float:
    """How far a trunk is curled towards the mouth, 0 to 0.4."""
    return 0.38 * min(max(0.5 + 7.0 * (stance.head_down - 0.93), 0.0), 1.0)


def _bow(build: Build) -> float:
    """How far the trunk bows for the mouth to reach the ground, rad."""
    left = _lowest_nose(build) - 0.04 * build.shoulder - 0.12 * build.head[0]
    return min(max(left / max(0.66 * build.body_size[0], 1e-6), 0.0), 0.34)


def _lowest_nose(build: Build) -> float:
    """Height of the nose with neck and head as low as they go, m."""
    height = build.body_size[2]
    long = (build.neck[0] + 0.2 * height) * math.sin(LOWEST)
    return build.shoulder - 0.36 * height + long - 0.9 * (build.head[1] + 0.35 * build.head[0])


def sit_drop(build: Build) -> float:
    """How far the hips come down, m: until the rump is on the ground."""
    _, _, height = build.body_size
    return max(build.shoulder - 0.5 * height - 0.48 * build.waist * height, 0.0)


def _seated_pitch(build: Build) -> float:
    """How far the trunk of who sits is turned up, rad: until the fore legs are straight."""
    length, _, height = build.body_size
    leg = build.shoulder - 0.52 * height
    low = build.shoulder - 0.5 * height - sit_drop(build)
    return math.asin(min(max((0.97 * leg - low) / (0.60 * length), 0.12), 0.60))


def bob(build: Build, turn: float, runs: bool) -> float:
    """Rise of the trunk at an angle of its cycle of steps, m."""
    if build.hop > 0.0:
        return build.hop * (0.5 - 0.5 * math.cos(turn)) * 0.8
    if runs:
        return 0.05 * build.shoulder * math.sin(turn)
    return 0.012 * build.shoulder * math.cos(2.0 * turn)


def offset(index: int, runs: bool) -> float:
    """Share of a cycle by which a leg is ahead: fore left, fore right, hind left, hind right."""
    # A walk sets down hind left, fore left, hind right, fore right; a gallop both of a pair.
    return ((0.0, 0.12, 0.5, 0.62) if runs else (0.0, 0.5, 0.75, 0.25))[index]


def droop(build: Build, sits: float, lies: float) -> float:
    """How far who sits or lies lets its head down; a body near the ground has no way to."""
    return _DROOP * lies + _LEVEL * sits * min(1.0, 2.0 * build.shoulder / build.body_size[0])


def lying_drop(build: Build) -> float:
    """How far the trunk of who lies moves up, m: it is negative."""
    return build.body_size[2] - 0.98 * build.shoulder
