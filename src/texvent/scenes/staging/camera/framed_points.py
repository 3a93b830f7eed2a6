"""What the image must hold: the subject over the clip, and what belongs to it."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from texvent.scenes.description import CameraMove, SceneDescription
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor

FILL = 0.84
"""Share of the image that what matters may fill."""
LIMIT = 0.7
"""What a mover passes counts for the framing up to this multiple of the mover's size."""
WHOLE = 3.5
"""Other objects must fit as a whole if they are at most this many times as large as the mover."""
INSTANTS = 13
_FILL_BY_MOVE = {"pan": 0.62, "tilt": 0.7, "truck": 0.66, "pedestal": 0.7, "orbit": 0.66,
                 "crane": 0.7, "handheld": 0.78, "roll": 0.7, "dolly zoom": 0.6}  # fmt: skip
_APPROACHES = frozenset({"zoom", "dolly", "dolly zoom"})
TYING = frozenset({"follow", "orbit"})
"""Moves that go along with the subject."""
_TURNING = frozenset({"behind", "front"})


def choose_points(
    description: SceneDescription,
    actors: Sequence[Actor],
    main: Actor,
    moves: Sequence[CameraMove],
    times: Float64Array,
    *,
    is_alone: bool = False,
) -> tuple[Float64Array, float]:
    """What must fit the image.

    Args:
        description: what the prompt says of the camera.
        actors: the objects of the prompt.
        main: the subject.
        moves: of the camera.
        times: instants at which it must fit, s.
        is_alone: whether only what moves counts.

    Returns:
        [n, 3] points, m, and the share of the image that they may fill.
    """
    shot = description.shot
    follows = any(move.kind in TYING for move in moves) and main.is_mover
    approaches = any(move.kind in _APPROACHES for move in moves)
    is_aimed = approaches and main.object_index == shot.target
    if is_aimed or shot.framing == "close":
        is_still = follows and not is_aimed
        points = [main.corners(float(time)) for time in (times[:1] if is_still else times)]
        return np.vstack(points), 0.55 if is_aimed else 0.95
    shown = [a for a in actors if a.is_mover or a is main] if is_alone else actors
    points_to_frame = _points_of(description, shown, main, times, moves if follows else ())
    if is_alone and not follows:
        is_through = any(relation.kind == "through" for relation in description.relations)
        reach = main.size_m * (1.6 if is_through else 0.5)
        near = [_near_piece(a, main, times, reach) for a in _related(description, actors, main)]
        points_to_frame = np.vstack([points_to_frame, *near])
    if shot.framing == "wide":
        return points_to_frame, 0.45
    fill = min([FILL, *(_FILL_BY_MOVE.get(move.kind, FILL) for move in moves)])
    if follows:
        fill = min(fill, 0.56)
    return points_to_frame, fill


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
        if relation.kind in ("past", "among", "overtake", "through")
        for target in relation.targets
    }
    points = []
    for actor in actors:
        is_far = description.objects[actor.object_index].side == "far"
        if actor is not main and (is_far or (tying and not actor.is_mover)):
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


def _related(description: SceneDescription, actors: Sequence[Actor], main: Actor) -> list[Actor]:
    """What the subject has to do with, and does not move itself."""
    targets = {
        target
        for relation in description.relations
        if relation.subject == main.object_index
        for target in relation.targets
        if description.objects[target].side != "far"
    }
    return [a for a in actors if a.object_index in targets and not a.is_mover]


def _near_piece(actor: Actor, main: Actor, times: Float64Array, reach: float) -> Float64Array:
    """[8, 3] the piece of an object's box that is nearest to the subject's way, m."""
    box = actor.corners(float(times[0]))
    low, high = box.min(axis=0), box.max(axis=0)
    ways = np.array([main.middle(float(time)) for time in times])
    nearest = np.clip(ways, low, high)
    point = nearest[int(np.argmin(np.linalg.norm(nearest - ways, axis=1)))]
    low, high = np.maximum(low, point - reach), np.minimum(high, point + reach)
    return np.array([[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1])
                     for z in (low[2], high[2])])  # fmt: skip


def _limit_extent(actor: Actor, passed: set[int], largest_m: float) -> float:
    """How much of an object at rest must fit, m."""
    is_whole = actor.object_index not in passed and actor.size_m <= WHOLE * largest_m
    return math.inf if is_whole else LIMIT * largest_m
