"""Threads on which things hang until they fall, and cords of what hangs from a ceiling."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from texvent_scenes.defaults import waits_to_fall
from texvent_scenes.description import SceneDescription
from texvent_scenes.models.materials import Material
from texvent_scenes.models.shapes import bounds, moved, point, rod
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.spec.scene import SceneObject
from texvent_scenes.staging.actors import Actor, PlacedModel
from texvent_scenes.staging.tracks.phases import schedule

_THREAD, _THREAD_M = Material((0.15, 0.14, 0.13)), 20.0
"""Thread on which hangs what is in the air until it falls; its length, m."""
_GONE = np.array([[1e-4, 0.0, 0.0, 0.0], [0.0, 1e-4, 0.0, 0.0], [0.0, 0.0, 1e-4, -50.0]])
"""Place of a thread that is gone, far below the ground, where it is a point."""
_CORD_M, _AT_TOP_M, _STILL_M = 0.014, 0.02, 1e-3
"""Radius of a cord, how far below its top parts of a lamp end on which one is, and way of a lamp
that hangs still, m."""
_INSTANTS = (0.31, 0.64, 1.0)
"""Shares of a clip at which a lamp is where it was, if it hangs still."""


def list_strings(
    description: SceneDescription, actors: Sequence[Actor], ceiling_m: float, duration_s: float
) -> tuple[tuple[PlacedModel, float], ...]:
    """Threads and cords of a scene, and when each lets go, s.

    Args:
        description: the scene.
        actors: its bodies.
        ceiling_m: height of the ceiling, m; inf = there is none.
        duration_s: length of the clip, s.
    """
    threads = _list_threads(description, actors, duration_s)
    return *threads, *_list_cords(actors, ceiling_m, duration_s)


def _list_threads(
    description: SceneDescription, actors: Sequence[Actor], duration_s: float
) -> Iterator[tuple[PlacedModel, float]]:
    """The threads of what waits in the air, and when each lets go, s."""
    for one in actors:
        until_s = let_go_s(description.objects[one.object_index], duration_s)
        if until_s is not None:
            yield _hang(one), until_s


def let_go_s(said: SceneObject, duration_s: float) -> float | None:
    """Instant at which the thread of what waits to fall lets it go, s; None: it hangs on none."""
    if not waits_to_fall(said):
        return None
    phases = schedule(said.motions, duration_s)
    return next((one.start_s for one in phases if one.motion.kind == "fall"), duration_s)


def _list_cords(
    actors: Sequence[Actor], ceiling_m: float, duration_s: float
) -> Iterator[tuple[PlacedModel, float]]:
    """The cords of what hangs still below a ceiling, which stay."""
    for one in actors:
        hangs = one.noun.name in nouns_with("hangs from a ceiling") and math.isfinite(ceiling_m)
        if hangs and is_still(one, duration_s):
            placed = one.place(0.0)
            boxes = [bounds([part]) for part in moved(placed.parts, placed.to_world)]
            top = max(float(high[2]) for _, high in boxes)
            ends = (0.5 * (low + high) for low, high in boxes if high[2] >= top - _AT_TOP_M)
            cords = [rod(_THREAD, (x, y, top - _AT_TOP_M), (x, y, ceiling_m), _CORD_M)
                     for x, y, _ in map(point, ends) if top < ceiling_m]  # fmt: skip
            yield PlacedModel(cords, np.eye(3, 4), one.instance), math.inf


def is_still(one: Actor, duration_s: float) -> bool:
    """Whether a body is in one place all the time, where it may turn about the vertical."""
    first = _place_m(one, 0.0)
    return all(
        bool(np.allclose(_place_m(one, share * duration_s), first, atol=_STILL_M))
        for share in _INSTANTS
    )


def _place_m(one: Actor, time_s: float) -> NDArray[np.float64]:
    """Middle of a body and heights of its corners, m."""
    corners = one.corners(time_s)
    return np.concatenate([corners.mean(axis=0), corners[:, 2]])


def _hang(actor: Actor) -> PlacedModel:
    """The thread on which a body hangs at first: from its top to beyond the picture."""
    x, y, top = actor.corners(0.0).max(axis=0) - [
        *0.5 * np.ptp(actor.corners(0.0)[:, :2], axis=0),
        0,
    ]
    thread = rod(_THREAD, (x, y, top - 0.1 * actor.model.height), (x, y, top + _THREAD_M),
                 max(0.004, 0.01 * actor.size_m))  # fmt: skip
    return PlacedModel([thread], np.eye(3, 4), 0)


def thread_at(hung: PlacedModel, end_s: float, time_s: float) -> PlacedModel:
    """A thread at an instant; it is gone when what hung on it falls."""
    if time_s < end_s:
        return hung
    return replace(hung, to_world=_GONE)
