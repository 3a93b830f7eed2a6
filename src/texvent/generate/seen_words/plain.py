"""Which things are plainly seen though they are small, or lie in part beyond the frame.

The search for a take (`takes`) asks for things that are large and whole. What the best take still
lacks of that is no loss, where the picture tells the thing all the same.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from texvent.generate.seen_words.people import is_portrait
from texvent.generate.seen_words.picture import Picture, lies_around
from texvent.generate.seen_words.things import BUILDING_M
from texvent.generate.sights import ALL_AROUND, LEAST_INSTANTS, Glimpse, Sight
from texvent.scenes.evidence import TOO_SMALL
from texvent.scenes.staging.actors import Actor

PLAIN_CONTRAST = 0.25
"""Difference of colour from what is around it by which a small thing meets the eye, of white."""
PLAIN_SIZE = 0.04
"""Extent of such a thing, as a share of the picture's width or height, at least."""
LEAST_SURFACE = 0.25
"""Share of the picture from which on a thing is told by a quarter of it: a desk top from near."""
LEAST_PIECE, LEAST_PIECE_POINTS = 0.25, 0.004
"""Share of a thing that is told beside a whole one of its kind, and share of the picture that this
piece covers."""
_SMALL = frozenset({TOO_SMALL, "in view too briefly"})
_PARTLY = frozenset({"cut off", "mostly hidden", "in view too briefly"})


def ease_faults(
    picture: Picture, faults: Mapping[int, str | None], sights: Mapping[int, Sight]
) -> dict[int, str | None]:
    """Instance → why it is not shown, without the faults of what is plainly seen.

    Args:
        picture: of the staged scene.
        faults: the same with them.
        sights: of each instance.
    """
    bodies = {one.instance: one for one in picture.scene.actors}
    nouns = picture.scene.class_names
    whole = {nouns[one] for one, fault in faults.items() if fault is None}
    surface, piece, wall = (
        share * len(picture.points) for share in (LEAST_SURFACE, LEAST_PIECE_POINTS, ALL_AROUND)
    )
    eased = dict(faults)
    for one, fault in faults.items():
        is_plain = fault in _SMALL and stands_out(picture, one)
        if fault in _PARTLY and one in sights:
            glimpses = sights[one].glimpses
            body = bodies.get(one)
            is_plain = (
                is_plain
                or _is_seen_often(glimpses, surface)
                or (nouns[one] in whole and _is_seen_often(glimpses, piece))
                or (_is_building(body) and _is_seen_often(glimpses, wall, 0.0))
                or is_portrait(picture, body)
            )
        if is_plain:
            eased[one] = None
    return eased


def ease_names(
    picture: Picture, qualities: Mapping[tuple[str, int], str]
) -> dict[tuple[str, int], str]:
    """Aspect and object → why it is not seen, without small things that are plainly seen."""
    of = picture.scene.object_of
    plain = {
        index
        for aspect, index in qualities
        if aspect == "name" and any(stands_out(picture, one) for one in of if of[one] == index)
    }
    return {
        (aspect, index): fault
        for (aspect, index), fault in qualities.items()
        if not (aspect == "name" and fault == TOO_SMALL and index in plain)
    }


def stands_out(picture: Picture, instance: int) -> bool:
    """Whether its colour is far from that of its surroundings where most of it is seen."""
    edge = np.array([picture.size.width, picture.size.height])
    step = np.sqrt(np.prod(edge) / len(picture.points))
    where = [view.instance == instance for view in picture.views]
    best = sorted(range(len(where)), key=lambda one: -int(where[one].sum()))[:LEAST_INSTANTS]
    for number in best:
        own = where[number]
        if not own.any() or not (around := lies_around(picture, own)).any():
            return False
        extent = (np.ptp(picture.points[own], axis=0) + step) / edge
        colours = picture.colours(number)
        between = colours[own].mean(axis=0) - colours[around].mean(axis=0)
        if extent.max() < PLAIN_SIZE or np.abs(between).max() < PLAIN_CONTRAST:
            return False
    return True


def _is_seen_often(glimpses: list[Glimpse], points: float, inside: float = LEAST_PIECE) -> bool:
    """Whether at two instants so many image points show it, and that share of it is in view."""
    return (
        sum(
            one.points >= points and one.inside >= inside and one.unhidden >= LEAST_PIECE
            for one in glimpses
        )
        >= LEAST_INSTANTS
    )


def _is_building(actor: Actor | None) -> bool:
    """Whether it is told by its windows, wherever its edges are."""
    return actor is not None and actor.noun.habitat == "fixed" and actor.model.height >= BUILDING_M
