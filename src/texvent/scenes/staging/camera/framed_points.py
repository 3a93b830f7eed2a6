"""What the image must hold: the subject over the clip, and what belongs to it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from texvent.scenes.description import CameraMove, SceneDescription
from texvent.scenes.models.people.activities import HAND_NOUNS, PERSON_NOUNS
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor, corners_over
from texvent.scenes.staging.camera.camera_path import share_followed
from texvent.scenes.staging.camera.laid_table import FILL as FILL_OF_TABLE
from texvent.scenes.staging.camera.laid_table import list_laid
from texvent.scenes.staging.camera.pieces import (
    list_partners,
    near_piece,
    piece_beside,
)
from texvent.scenes.staging.camera.prominence import GOALS
from texvent.scenes.staging.still_life import is_still_life

FILL = 0.88
"""Share of the image that what matters may fill."""
LIMIT = 0.7
"""What a mover passes counts for the framing up to this multiple of the mover's size."""
WHOLE = 3.5
"""Other objects must fit as a whole if they are at most this many times as large as the mover."""
INSTANTS = 13
_FILL_BY_MOVE = {"pan": 0.62, "tilt": 0.7, "truck": 0.66, "pedestal": 0.7, "orbit": 0.66,
                 "crane": 0.7, "handheld": 0.78, "roll": 0.7, "dolly zoom": 0.6}  # fmt: skip
_LARGE_IN_WIDE = 0.75
"""How much less prominent the subject is in a wide shot."""
_LARGE_AIM = 1.3
"""Prominence of what a camera moves in on, at least."""
_HARDLY_SEEN = 0.4
"""Prominence below which even what belongs to the subject may leave the image in part."""
_WIDE_FILL, _FOLLOWED_FILL = 0.7, 0.75
_CALM = 0.5
"""Pace below which a camera in a hand hardly shakes."""
_FAR_FILL = 1.3
"""The same at the near end of a move in: at the far end all fits."""
_APPROACHES = frozenset({"zoom", "dolly", "dolly zoom"})
TYING = frozenset({"follow", "orbit"})
"""Moves that go along with the subject."""
_TURNING = frozenset({"behind", "front"})


class View(NamedTuple):
    """What the image is to hold."""

    points: Float64Array
    """[n, 3] m."""
    fill: float
    """Share of the image that they may fill."""
    goal: float = 1.0
    """Prominence of the subject for which the image may hold no more than this."""


def list_views(
    description: SceneDescription,
    actors: Sequence[Actor],
    main: Actor,
    moves: Sequence[CameraMove],
    times: Float64Array,
) -> list[View]:
    """What the image may hold, from all there is to the subject alone.

    Args:
        description: what the prompt says of the camera.
        actors: the objects of the prompt.
        main: the subject.
        moves: of the camera.
        times: instants at which it must fit, s.
    """
    laid = list_laid(description, {one.object_index: one.noun for one in actors})
    if laid:
        on_top = [one for one in actors if one.object_index in laid]
        return [View(corners_over(on_top, times), FILL_OF_TABLE)]
    if is_still_life(description):
        return [View(corners_over(actors, times), FILL)]
    shot = description.shot
    tying = moves if any(move.kind in TYING for move in moves) and main.is_mover else ()
    aims = is_aimed(description, main, moves)
    is_medium = shot.framing == "medium" or shot.view == "shoulder"
    is_person = main.noun.name in PERSON_NOUNS
    if aims or shot.framing == "close" or (is_medium and is_person):
        is_still = bool(tying) and not aims
        near = corners_over([main], times[:1] if is_still else times)
        if not aims:
            return [_close_view(description, actors, main, near, times)]
        # At the far end of the move the image shows what else there is, about the subject.
        rest = _points_of(description, actors, main, times, ())
        aim = 0.5 * (near.min(axis=0) + near.max(axis=0))
        return [View(np.vstack([rest, 2.0 * aim - rest]), _FAR_FILL), View(near, 0.55, _LARGE_AIM)]
    fill = min([FILL, *(_fill_for(move) for move in moves)])
    if tying and share_followed(tying) == 1.0:
        fill = min(fill, _FOLLOWED_FILL)
    fill = _WIDE_FILL if shot.framing == "wide" else fill
    partners = _list_partners_of(description, actors, main, times)
    group = [actor for actor in actors if actor.object_index == main.object_index]
    others = [actor for actor in actors if actor not in group]
    kept = [a for a in partners if _goes(a, times) and a.size_m <= WHOLE * main.size_m]
    if main.is_mover:
        others = [actor for actor in others if actor in kept or _goes(actor, times)]
    views = [list(actors), [*group, *others], [*group, *kept]]
    choices = [_points_of(description, some, main, times, tying) for some in (*views, group)]
    if not tying:
        pieces = _pieces_of(description, [a for a in partners if a not in kept], main, times)
        choices = [choices[0], *(np.vstack([points, *pieces]) for points in choices[1:])]
    least = _LARGE_IN_WIDE if shot.framing == "wide" else 1.0
    goals = (1.0, *GOALS, _HARDLY_SEEN)
    return [View(points, fill, least * goal) for points, goal in zip(choices, goals, strict=True)]


def _fill_for(move: CameraMove) -> float:
    """Share of the image that things may fill while the camera makes a move."""
    is_calm = move.kind == "handheld" and move.pace < _CALM
    return FILL if is_calm else _FILL_BY_MOVE.get(move.kind, FILL)


def _close_view(
    description: SceneDescription,
    actors: Sequence[Actor],
    main: Actor,
    near: Float64Array,
    times: Float64Array,
) -> View:
    """A close or medium view: of people the bust and what they hold, of a hand no forearm."""
    if main.noun.name in HAND_NOUNS:
        near = upper_part(near, FOREARM)
    if main.noun.name not in PERSON_NOUNS:
        return View(near, 0.95)
    framing = "close" if description.shot.framing == "close" else "medium"
    held = [
        one.corners(float(t))
        for one in _list_partners_of(description, actors, main, times)
        if one.size_m < _IN_HAND * main.size_m
        for t in times
    ]
    return View(np.vstack([_bust(near, framing), *held]), 0.95)


_UPPER = {"close": 0.62, "medium": 0.42}
"""Framing → share of a person's height below which the image may end."""
_BREADTH = {"close": 0.24, "medium": 0.32}
"""Framing → how far to each side of the middle it must hold the person, in heights."""


FOREARM = 0.28
"""Share of a hand with its forearm below which the image may end: it comes from outside."""
_IN_HAND = 0.25
"""Size of what is in a person's hands, as a multiple of the person's, at most."""


def upper_part(points: Float64Array, share: float) -> Float64Array:
    """[n, 3] corners of boxes, m, without what is below a share of their height."""
    low, high = float(points[:, 2].min()), float(points[:, 2].max())
    cut = points.copy()
    cut[:, 2] = np.maximum(cut[:, 2], low + share * (high - low))
    return cut


def _bust(points: Float64Array, framing: str) -> Float64Array:
    """[n, 3] of a person in a close or medium shot: no legs, no arm that reaches out."""
    cut = upper_part(points, _UPPER[framing])
    reach = _BREADTH[framing] * float(np.ptp(points[:, 2]))
    middle = 0.5 * (cut[:, :2].min(axis=0) + cut[:, :2].max(axis=0))
    cut[:, :2] = np.clip(cut[:, :2], middle - reach, middle + reach)
    return cut


def is_aimed(description: SceneDescription, main: Actor, moves: Sequence[CameraMove]) -> bool:
    """Whether the camera moves in on the subject, or out from it."""
    approaches = any(move.kind in _APPROACHES for move in moves)
    return approaches and main.object_index == description.shot.target


def _points_of(
    description: SceneDescription,
    actors: Sequence[Actor],
    main: Actor,
    times: Float64Array,
    tying: Sequence[CameraMove],
) -> Float64Array:
    """[n, 3] what must fit, m: movers whole, the rest up to a multiple of their size.

    Where the camera goes along with the subject, places are those relative to it.
    """
    near = [actor for actor in actors if description.objects[actor.object_index].side != "far"]
    movers = [actor for actor in near if actor.is_mover] or near or list(actors)
    largest = max(actor.size_m for actor in movers)
    passed = {
        target
        for relation in description.relations
        if relation.kind in ("past", "among", "overtake")
        for target in relation.targets
    }
    partners = list_partners(description, actors, times)
    points = []
    for actor in actors:
        is_far = description.objects[actor.object_index].side == "far"
        if actor is not main and (is_far or (tying and not actor.is_mover)):
            continue
        if actor is not main and actor.object_index in partners:
            partner = partners[actor.object_index]
            for some in [[time] for time in times] if actor.is_mover else [times]:
                piece = piece_beside(actor, partner, np.array(some))
                points.append(to_subject(piece, main, float(some[0]), tying) if tying else piece)
            continue
        limit = math.inf if actor in movers else _limit_extent(actor, passed, largest)
        for time in times:
            corners = actor.corners(float(time), limit)
            points.append(to_subject(corners, main, float(time), tying) if tying else corners)
    return np.vstack(points)


def to_subject(
    points: Float64Array, main: Actor, time_s: float, tying: Sequence[CameraMove]
) -> Float64Array:
    """Points as a camera that goes along with the subject sees them, at the start's place, m."""
    state, start = main.trajectory.at(time_s), main.trajectory.at(0.0)
    now, then = np.array(state.position), np.array(start.position)
    now = then + share_followed(tying) * (now - then)
    if main.noun.habitat == "ground":
        now[2] = then[2]
    points = points - now
    is_turning = any(m.kind == "follow" and m.direction in _TURNING for m in tying)
    if is_turning:
        angle = start.yaw - state.yaw
        cosine, sine = math.cos(angle), math.sin(angle)
        turn = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])
        points = points @ turn.T
    return np.asarray(points + then)


_RECOGNISED = 0.35
_REACH_OF_PARTNER = 0.8
"""How much of a partner must be seen each way from the subject: the lesser of a share of its own
size and a multiple of the subject's."""
_STIRS = 0.25
"""How far, in its own sizes, a thing that works in its place may stir."""
_CLOSE = 2.0
"""What is named next belongs to the subject within this multiple of the subject's size."""


def _goes(actor: Actor, times: Float64Array) -> bool:
    """Whether it moves from where it is; a lighthouse and a swing only work there."""
    if not actor.is_mover or actor.noun.habitat != "fixed":
        return actor.is_mover
    places = [actor.middle(float(time)) for time in times]
    return float(np.ptp(places, axis=0).max()) > _STIRS * actor.size_m


_BACKDROP, _BACKDROP_M = 6.0, 6.0
"""What stands is a backdrop of what is so many times smaller, from this size on, m."""


def is_backdrop(actor: Actor, main: Actor) -> bool:
    """Whether it is too large to be shown whole with the subject, and can stand far behind it."""
    is_large = actor.size_m > max(_BACKDROP * main.size_m, _BACKDROP_M)
    return is_large and actor.noun.habitat in ("fixed", "air") and not actor.is_mover


_ANYWHERE = frozenset({"beside", "look at", "past", "towards", "away from", "from"})
"""Relations that a backdrop far behind fulfils; "behind" too, where it is what stands behind."""


def may_stand_back(description: SceneDescription, actor: Actor, main: Actor) -> bool:
    """Whether it is a backdrop of the subject that no relation puts close to something."""
    return is_backdrop(actor, main) and all(
        relation.kind in _ANYWHERE
        or (relation.kind == "behind" and relation.subject == actor.object_index)
        for relation in description.relations
        if actor.object_index in (relation.subject, *relation.targets)
    )


def list_related(description: SceneDescription, main: Actor) -> set[int]:
    """The objects that a relation ties to the subject."""
    related = {
        index
        for relation in description.relations
        if main.object_index in (relation.subject, *relation.targets)
        for index in (relation.subject, *relation.targets)
    }
    return related - {main.object_index}


def _list_partners_of(
    description: SceneDescription, actors: Sequence[Actor], main: Actor, times: Float64Array
) -> list[Actor]:
    """What a relation ties to the subject, or what is named next, close and not much larger."""
    related = list_related(description, main)

    def belongs(actor: Actor) -> bool:
        is_next = actor.object_index == main.object_index + 1
        is_next = is_next and actor.size_m <= WHOLE * main.size_m
        return is_next and _gap(actor, main, times) < _CLOSE * main.size_m

    return [
        actor
        for actor in actors
        if description.objects[actor.object_index].side != "far"
        and not may_stand_back(description, actor, main)
        and (actor.object_index in related or belongs(actor))
    ]


def _gap(actor: Actor, main: Actor, times: Float64Array) -> float:
    """Least distance between the subject's middle and the other's box, m."""
    gaps = []
    for time in map(float, times):
        box, middle = actor.corners(time), main.middle(time)
        nearest = np.clip(middle, box.min(axis=0), box.max(axis=0))
        gaps.append(float(np.linalg.norm(nearest - middle)))
    return min(gaps)


def _pieces_of(
    description: SceneDescription, partners: Sequence[Actor], main: Actor, times: Float64Array
) -> list[Float64Array]:
    """As much of the nearest copy of each partner as it takes to recognise it, m."""
    gates = {t for one in description.relations if one.kind == "through" for t in one.targets}
    before = {t for one in description.relations if one.kind == "behind" for t in one.targets}
    kinds = {relation.kind for relation in description.relations}
    least = main.size_m * (1.6 if "through" in kinds else 0.5)
    nearest: dict[int, Actor] = {}
    for actor in sorted(partners, key=lambda one: _gap(one, main, times)):
        nearest.setdefault(actor.object_index, actor)
    pieces = []
    for actor in nearest.values():
        reach = min(_RECOGNISED * actor.size_m, _REACH_OF_PARTNER * main.size_m)
        is_gate = actor.object_index in gates and actor.size_m <= WHOLE * main.size_m
        # So are a kite and a balloon on their strings.
        if is_gate or actor.tether is not None:
            reach = 2.0 * actor.size_m
        is_before = actor.object_index in before
        pieces.append(near_piece(actor, main, times, max(reach, least), is_before=is_before))
    return pieces


def _limit_extent(actor: Actor, passed: set[int], largest_m: float) -> float:
    """How much of an object at rest must fit, m."""
    is_whole = actor.object_index not in passed and actor.size_m <= WHOLE * largest_m
    return math.inf if is_whole else LIMIT * largest_m
