"""How near and how high the camera is for what is small: things in hands, people by a train."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from texvent.scenes.description import SceneDescription
from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor, corners_over
from texvent.scenes.staging.camera.camera_path import CameraPath
from texvent.scenes.staging.camera.framed_points import upper_part
from texvent.scenes.staging.camera.framing import Framing, fit
from texvent.scenes.staging.camera.prominence import Prominence, between
from texvent.scenes.staging.still_life import is_still_life

_SMALL = 0.3
"""Size of a small thing, as a multiple of the subject's, at most."""
_CLOSE = 1.3
"""How far from the subject's middle it may be, in the subject's sizes."""
_WAIST, _CHEST = 0.45, 0.68
"""Shares of a person's height below which the image may end; the second one where the first is not
near enough for the small things."""
_FILL, _FILL_PANNING = 0.9, 0.72
_PROMINENCE, _ALONE = 0.5, 0.9
"""How prominent a small thing should be: a seventh of the image's width and height; a quarter where
nothing else that the prompt names would leave the image for it."""
_STILL = 0.3
"""How far, in its sizes, a subject may go whose legs need not be seen."""
STAYING = frozenset({"handheld", "static", "follow", "pan"})
"""Moves of a camera that may stand nearer than it would."""


def is_open(description: SceneDescription) -> bool:
    """Whether the prompt leaves open how near the camera is."""
    shot = description.shot
    return shot.framing is None and shot.view in (None, "side", "front")


def come_near_small(
    description: SceneDescription,
    actors: Sequence[Actor],
    main: Actor,
    path: CameraPath,
    path_of: Callable[[Framing], CameraPath],
    times: Float64Array,
    aspect: float,
) -> CameraPath:
    """The camera as near as it takes to recognise the small things that the prompt names.

    Args:
        description: what the prompt says of the camera.
        actors: its objects.
        main: the subject.
        path: the camera that shows the subject.
        path_of: the camera over the clip from a framing.
        times: instants at which they must fit, s.
        aspect: image height over width.

    Returns:
        The path, from nearer where small things are at a person who stays in place.
    """
    moves = (*description.shot.moves, *path.moves)
    if not is_open(description) or any(move.kind not in STAYING for move in moves):
        return path
    small = [actor for actor in actors if _is_small(actor, main, times)]
    bodies = [actor for actor in actors if actor.object_index == main.object_index]
    if not small or not all(_stays(one, times) for one in bodies):
        return path
    prominences = [
        Prominence.of([one for one in small if one.object_index == index], times, aspect)
        for index in {one.object_index for one in small}
    ]

    def least(some: CameraPath) -> float:
        return min(prominence(some) for prominence in prominences)

    known = {main.object_index, *(actor.object_index for actor in small)}
    goal = _ALONE if all(actor.object_index in known for actor in actors) else _PROMINENCE
    things = corners_over(small, times)
    fill = _FILL_PANNING if any(m.kind == "pan" for m in path.moves) else _FILL
    for share in (_WAIST, _CHEST):
        wide = path.framing
        upper = [upper_part(corners_over([one], times), share) for one in bodies]
        points = np.vstack([*upper, things])
        near = fit(points, azimuth=wide.azimuth, elevation=wide.elevation, aspect=aspect,
                   fill=fill, focal=wide.focal)  # fmt: skip
        if near.distance_m > 0.95 * wide.distance_m or least(path) >= goal:
            break
        path = between(path, path_of(near), least, goal, lambda _: True)
    return path


_EYE_M = 3.0
"""Height of a camera that shows small things on the ground with a large or high subject."""
_LOWEST_RAD = -0.6


def eye_level(
    description: SceneDescription,
    actors: Sequence[Actor],
    main: Actor,
    framing: Framing,
) -> float | None:
    """Elevation of a camera at eye level, where one higher up would see no ground that is near.

    Only beside a large or high subject, and where smaller things on the ground are to be seen; and
    where the prompt says that the camera is low, or at the level of eyes.
    """
    if description.shot.view in ("low", "level"):
        tallest = max(_LEAST_EYES_M, min(_EYES_M, 0.8 * main.model.height))
        height = _LOW_M if description.shot.view == "low" else tallest
        return _elevation_of(height, framing)
    if description.shot.view is not None or framing.position[2] <= 1.1 * _EYE_M:
        return None
    smaller = [
        actor
        for actor in actors
        if actor.noun.habitat == "ground" and actor.size_m < 0.4 * main.size_m
    ]
    if is_still_life(description):
        least = min(actor.size_m for actor in actors)
        if least < _TINY * max(actor.size_m for actor in actors):
            return _elevation_of(max(_LEAST_EYES_M, 1.5 * least), framing)
    if not smaller:
        return None
    return _elevation_of(_EYE_M, framing)


_TINY = 0.1
"""Size of the least of some things side by side, as a share of the largest's, at which the camera
is as low as it, so that it can stand before the camera."""
_LOW_M, _EYES_M, _LEAST_EYES_M = 0.4, 1.55, 0.35
"""Height of a camera that is low, and of one at the level of eyes: a person's, of what is small."""


def _elevation_of(height_m: float, framing: Framing) -> float:
    """Elevation of a camera of that height above the ground."""
    rise = (height_m - float(framing.target[2])) / framing.distance_m
    return max(math.asin(min(max(rise, -1.0), 1.0)), _LOWEST_RAD)


def _is_small(actor: Actor, main: Actor, times: Float64Array) -> bool:
    if actor.object_index == main.object_index or actor.size_m > _SMALL * main.size_m:
        return False
    apart = [np.linalg.norm(actor.middle(float(t)) - main.middle(float(t))) for t in times]
    return float(max(apart)) < _CLOSE * main.size_m


def _stays(main: Actor, times: Float64Array) -> bool:
    if main.noun.name not in PERSON_NOUNS:
        return False
    places = [main.middle(float(time)) for time in times]
    return float(np.ptp(places, axis=0).max()) < _STILL * main.size_m
