"""Grip check: whether a machine's hand has a thing, and takes it up, leaves it or moves it."""

from __future__ import annotations

import numpy as np

from texvent_scenes.checks.clip.staged_clip import StagedClip
from texvent_scenes.description import Claim
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.staging.actors import Actor, size_of

_LEAST_SIZE = 0.15
"""Least size at which a thing still is one, and no toy of it."""
_AT_HAND, _MOVED, _APART = 0.3, 0.9, 0.02
"""Distance of a hand from the box of what it has, in sizes of that; least way of what is moved, and
from where the hand has it to where it has left it, in its sizes."""


def handles_by_hand(staged: StagedClip, claim: Claim) -> bool:
    """Whether the hand has one of the things at some time, and what comes of it is seen.

    What is lifted rises by its height in it; what is set down, lower; what is moved, elsewhere; and
    what is left rests at the end.
    """
    things = [one for n in claim.targets for one in staged.list_actors(n)]
    return all(
        any(_is_handled(staged, machine, one, str(claim.value)) for one in things)
        for machine in staged.own(claim)
    )


def _is_handled(staged: StagedClip, machine: Actor, thing: Actor, kind: str) -> bool:
    times, size = staged.fine_times, thing.model
    if size_of(size) < _LEAST_SIZE:
        return False
    middle = np.array([thing.middle(at) for at in times])
    hand = np.array([machine.anchor("hands", at)[:, 3] for at in times])
    least = min(size.length, size.width, size.height)
    is_held = _gaps(thing, hand, times) <= _AT_HAND * least
    if not is_held.any():
        return False
    if kind == "hold":
        return bool(is_held.all())
    risen = float(middle[-1, 2] - middle[0, 2])
    if kind == "lift":
        return float(np.ptp(middle[is_held, 2])) >= _MOVED * size.height
    off = np.linalg.norm(hand - middle, axis=1)
    is_left = off[-1] > off[is_held].min() + _APART * least
    if kind == "set down":
        return is_left and -risen >= _MOVED * size.height
    way = float(np.linalg.norm(middle[-1, :2] - middle[0, :2]))
    return is_left and way >= _MOVED * size.length


def _gaps(thing: Actor, places: Float64Array, times: list[float]) -> Float64Array:
    """[t] Distances of places [t, 3] from the box of a thing at these instants, m."""
    boxes = [thing.corners(at) for at in times]
    low, high = (np.array([getattr(each, way)(axis=0) for each in boxes]) for way in ("min", "max"))
    return np.asarray(np.linalg.norm(places - np.clip(places, low, high), axis=1))
