"""Pieces: as much of a large thing as it takes to recognise it beside a small one."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from texvent.scenes.description import SceneDescription
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor, corners_over
from texvent.scenes.models.traits import nouns_with

KEPT_TOGETHER = frozenset(
    {"at", "on", "in", "above", "under", "behind", "front", "beside", "between", "around",
     "left of", "right of", "look at"}
)  # fmt: skip
"""Relations of which both things must be in the picture."""
_MUCH_LARGER = 6.0
_LARGER_TABLE = 1.5
"""The same of a table, of whose top a piece is enough."""
_PIECE = 0.3
_REACH = 4.0
"""How much of a much larger thing must be seen each way from what is beside it: the lesser of a
share of its own size and a multiple of the other's."""


def list_partners(
    description: SceneDescription, actors: Sequence[Actor], times: Float64Array
) -> dict[int, Actor]:
    """Object at rest → the smallest thing that the prompt places with respect to it.

    Or an object that carries the smaller thing along.
    """
    by_object = {actor.object_index: actor for actor in reversed(actors)}
    partners: dict[int, Actor] = {}
    for relation in description.relations:
        if relation.kind not in KEPT_TOGETHER:
            continue
        for one, other in [(relation.subject, t) for t in relation.targets]:
            for large, small in ((one, other), (other, one)):
                if not {large, small} <= set(by_object):
                    continue
                if not by_object[large].is_mover or (
                    relation.kind in _BORNE
                    and goes_along(by_object[large], by_object[small], times)
                ):
                    known = partners.get(large, by_object[small])
                    partners[large] = min(known, by_object[small], key=lambda actor: actor.size_m)
    return partners


_BORNE = frozenset({"on", "in"})
_STRAYS = 0.3
"""How far, in its sizes, what goes along with another may stray from it."""


def goes_along(one: Actor, other: Actor, times: Float64Array) -> bool:
    """Whether two keep their places relative to each other."""
    first, last = float(times[0]), float(times[-1])
    ways = [actor.middle(last) - actor.middle(first) for actor in (one, other)]
    return float(np.linalg.norm(ways[0] - ways[1])) < _STRAYS * max(one.size_m, other.size_m)


def piece_beside(actor: Actor, partner: Actor, times: Float64Array) -> Float64Array:
    """[n, 3] the whole of an object at rest, or of a much larger one a piece by its partner, m."""
    is_table = actor.noun.name in nouns_with("table") and _is_above(partner, actor, times)
    if actor.size_m <= (_LARGER_TABLE if is_table else _MUCH_LARGER) * partner.size_m:
        return corners_over([actor], times)
    reach = min(_PIECE * actor.size_m, _REACH * partner.size_m)
    piece = near_piece(actor, partner, times, reach)
    if is_table:
        piece[:, 2] = np.maximum(piece[:, 2], actor.corners(float(times[0]))[:, 2].max())
    return piece


def _is_above(one: Actor, other: Actor, times: Float64Array) -> bool:
    """Whether one is on top of the other, at the beginning."""
    low, high = (actor.corners(float(times[0]))[:, 2] for actor in (one, other))
    return bool(low.min() > high.max() - 0.1 * one.size_m)


def near_piece(
    actor: Actor, main: Actor, times: Float64Array, reach: float, *, is_before: bool = False
) -> Float64Array:
    """[8, 3] the piece of an object's box that is nearest to the subject's way, m.

    Of what stands before the subject all the way to its front, so that the camera stays before it.
    """
    box = actor.corners(float(times[0]))
    low, high = box.min(axis=0), box.max(axis=0)
    ways = np.array([main.middle(float(time)) for time in times])
    nearest = np.clip(ways, low, high)
    point = nearest[int(np.argmin(np.linalg.norm(nearest - ways, axis=1)))]
    front = low[1]
    low, high = np.maximum(low, point - reach), np.minimum(high, point + reach)
    low[1] = front if is_before else low[1]
    return np.array([[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1])
                     for z in (low[2], high[2])])  # fmt: skip
