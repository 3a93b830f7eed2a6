"""Hands alone that lift, set down or drop a thing, and come to where that was placed."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from texvent_scenes.models.shapes import point, shift
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.interactions.holding import carried, held_at, moving
from texvent_scenes.staging.tracks.keys import Key
from texvent_scenes.staging.tracks.track import Term, Track, ballistic, steady

BY_HAND = ("lift", "set down", "drop")
"""Acts of a hand that has no body."""
_RAISED_M, _RAISED_S = 0.35, 0.7
"""Height to which a hand lifts a thing, and the time that it takes."""
_REACHING_RAD, _HIGH_M = 2.0, 0.09
"""Turn of a hand whose arm comes from the camera and from above; its least height over what the
thing is on."""
_DROPPED = 0.2
"""Share of its speed that what is dropped keeps where it lands."""


def act_by_hand(kind: str, hand: Actor, thing: Actor, contact_s: float) -> tuple[Actor, Actor]:
    """Both, the thing at its place at first where it is lifted, at last where it is left.

    Args:
        kind: one of `BY_HAND`.
        hand: a hand without a body.
        thing: where it was placed, at rest.
        contact_s: instant at which the hand begins to rise or to go down, or lets go.
    """
    rest, home = thing.track.at(0.0), hand.track.at(0.0)
    thing = replace(thing, track=steady(rest.position, rest.yaw, activity="stand"))
    side = math.copysign(_REACHING_RAD, -math.cos(home.yaw))
    reaching = (Term("roll", offset=side),)
    still = replace(hand, track=Track(home.position, home.yaw, (Key(1.0),), reaching))
    off = np.subtract(rest.position, _beside_palm(still, thing).track.at(0.0).position)
    raised = np.array([0.0, 0.0, 0.0 if kind == "lift" else _RAISED_M])
    start = point(np.add(home.position, off) + raised)
    climb_m_s = {"lift": 1.0, "set down": -1.0}.get(kind, 0.0) * _RAISED_M / _RAISED_S
    keys = (Key(contact_s, activity="stand"), Key(_RAISED_S, climb_m_s=climb_m_s, ramp_s=0.0,
            activity="stand"), Key(1.0, ramp_s=0.0, activity="stand"))  # fmt: skip
    hand = moving(hand, Track(start, home.yaw, keys, reaching))
    held = _beside_palm(hand, thing)
    if kind != "drop":
        return hand, held
    let_go = held.track.at(contact_s)
    fall = ballistic(
        let_go.position, let_go.yaw, 0.0, 0.0, wait_s=contact_s, restitution=_DROPPED,
        floor_m=rest.position[2],
    )  # fmt: skip
    return hand, moving(thing, replace(fall, anchor=held.track.anchor, release_s=contact_s))


def _beside_palm(hand: Actor, thing: Actor) -> Actor:
    """The thing upright before a palm, which has it at its middle, or as high as a hand is wide."""
    high_m = max(0.5 * thing.model.height, min(thing.model.height, _HIGH_M))
    offset = shift(0.5 * thing.model.length, 0.0, thing.foot_m - high_m)
    return carried(thing, held_at(hand, "palm", offset, is_upright=True), hand)
