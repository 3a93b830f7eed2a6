"""What falls from the crown of a tree."""

from __future__ import annotations

import math

import numpy as np

from texvent.scenes.description import ObjectMotion
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.hand_work.surface_points import sample_surface
from texvent.scenes.staging.acts.transits.surfaces import rest_height
from texvent.scenes.staging.acts.transits.tops import with_path
from texvent.scenes.staging.trajectories.legs import Leg, Legs, flight_s

CROWNED = frozenset({"tree", "pine", "palm", "bush", "apple tree", "cherry tree"})
"""Nouns with a crown of leaves."""
_BAND = (0.35, 0.7)
"""Heights between which a thing hangs, as shares of the tree's."""


def fall_from_crown(
    subject: Actor, target: Actor, motion: ObjectMotion, duration_s: float, turn: float
) -> tuple[Actor, Actor]:
    """From the front of the crown down to the ground, where it lies.

    Args:
        subject: what falls.
        target: the tree.
        motion: of the subject.
        duration_s: length of the clip, s.
        turn: 0 for the first of several .. 1 for the last, which falls later.
    """
    if motion.kind != "fall":
        return subject, target
    points = sample_surface(target, 0.0).points
    tall, ground = float(points[:, 2].max()), float(target.trajectory.at(0.0).position[2])
    is_there = (points[:, 2] > _BAND[0] * tall) & (points[:, 2] < _BAND[1] * tall)
    crown = points[is_there] if is_there.any() else points
    middle = crown[:, :2].mean(axis=0)
    aside = np.abs(crown[:, 0] - middle[0] - (turn - 0.5) * 0.6 * np.ptp(crown[:, 0]))
    spot = crown[int(np.argmin(crown[:, 1] + 0.5 * aside))]
    half, lift = 0.5 * subject.model.height, rest_height(subject)
    begin = (float(spot[0]), float(spot[1]) - 0.4 * half, float(spot[2]) - half + lift)
    end = (begin[0], begin[1] - 0.3, ground + lift)
    wait = min(0.25 * duration_s, 0.7) * (1.0 + turn)
    legs = (
        Leg(begin, wait, "stand"),
        Leg(end, flight_s(begin[2], end[2], begin[2]), "stand", is_flight=True,
            tumble_rad=0.5 * math.pi),
        Leg((end[0], end[1] - 0.05, end[2]), duration_s, "stand", slows=True),
    )  # fmt: skip
    return with_path(subject, Legs(begin, 0.0, legs, pivot_m=half, turns=False)), target
