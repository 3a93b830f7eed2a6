"""Camera-way check: ways and turns of the camera with respect to a body, over the clip."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

import numpy as np

from texvent_scenes.checks.clip.staged_clip import StagedClip
from texvent_scenes.description import Claim
from texvent_scenes.models.activities import PERSON_NOUNS
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.staging.camera.subject import choose_main, near_part

_Rule = Callable[[Float64Array, Float64Array, Float64Array], bool]
"""Whether a camera is so, by its places from a body, [t, 3] m, its directions of sight, [t, 3], and
the extents of that body, [3] m."""
_NEARED, _AHEAD, _SWEPT, _ARC = 0.1, 0.8, 0.15, 0.25
"""Least share by which a camera nears something; cosine up to which something is in sight; least
turn of the sight, and way by the distance, along something; least arc around it, rad."""
_DOWN = -0.7
"""Most upward part of the sight of a camera that looks down."""
_MACRO_M, _HALF = 0.9, 0.5
"""Most width across the image at the subject of a macro or an extreme close-up, m; share of the
instants at which it is so."""
_EYES_M, _LEVEL, _UPPER = (0.9, 2.2), 0.26, (0.45, 1.35)
"""Least and greatest height of what flies at eye level, m; greatest slope of the sight of a level
camera; its height, in heights of whom it looks at."""
_LEAST_WAY, _OVER = 0.5, 0.7
"""Way of a camera that goes, and most distance aside of what it goes over, in sizes of that."""


def is_camera_so(staged: StagedClip, claim: Claim) -> bool:
    """Whether the camera goes so with respect to a body: towards it, past it, around it."""
    cameras = [staged.scene.camera(one) for one in staged.times]
    places = np.array([one.position for one in cameras])
    sight = np.array([one.rotation[2] for one in cameras])
    return any(
        _CAMERA_WAYS.get(str(claim.value), _never)(places - body.middle, sight, body.size[0])
        for target in claim.targets
        for body in staged.boxes[target]
    )


def is_overtaken(staged: StagedClip, claim: Claim) -> bool:
    """Whether bodies come from beside the camera, which goes the same way, and get ahead of it."""
    cameras = [staged.scene.camera(one) for one in staged.times]
    places = np.array([one.position for one in cameras])
    sight = np.array([one.rotation[2] for one in cameras])
    way = places[-1] - places[0]
    for body in staged.own_boxes(claim):
        ahead = ((body.middle - places) * sight).sum(axis=1)
        led = (body.middle[-1] - body.middle[0]) @ way > 0.0
        if not (led and ahead[0] <= body.size[0].max() and ahead[-1] >= 1.5 * body.size[0].max()):
            return False
    return True


def is_macro(staged: StagedClip, claim: Claim) -> bool:
    """Whether so little is across the image at the subject that small things are large in it."""
    if not staged.scene.actors:
        return False
    main, widths_m = choose_main(staged.description, staged.scene.actors), list[float]()
    for time_s, held in zip(
        staged.times, near_part(main, "close", np.array(staged.times)), strict=True
    ):
        camera = staged.scene.camera(time_s)
        depth_m = float((held.mean(axis=0) - camera.position) @ camera.rotation[2])
        widths_m.append(depth_m / camera.focal)
    return bool(np.mean(np.array(widths_m) <= _MACRO_M) >= _HALF)


def is_at_eye_level(staged: StagedClip, claim: Claim) -> bool:
    """Whether what flies ends about as high as eyes are, or the camera looks level at a subject.

    Of who has a face, that is as high as the upper half of the body; of an animal where it is said
    that the eyes are its own.
    """
    if claim.subject is not None:
        low, high = _EYES_M
        ends = [one.middle[-1, 2] for one in staged.own_boxes(claim)]
        return bool(ends) and all(low <= one <= high for one in ends)
    cameras = [staged.scene.camera(one) for one in staged.times]
    is_level = np.mean([abs(one.rotation[2, 2]) <= _LEVEL for one in cameras]) >= _HALF
    if not (is_level and staged.scene.actors):
        return bool(is_level)
    main = choose_main(staged.description, staged.scene.actors)
    if main.noun.name not in PERSON_NOUNS and claim.value != "own":
        heights = [(camera.position[2], *np.sort(main.corners(one)[:, 2])[[0, -1]])
                   for camera, one in zip(cameras, staged.times, strict=True)]  # fmt: skip
        is_so = [eyes <= _EYES_M[1] or low <= eyes <= high for eyes, low, high in heights]
        return bool(np.mean(is_so) >= _HALF)
    tops = [main.corners(one)[:, 2].max() for one in staged.times]
    heights = [one.position[2] for one in cameras]
    shares = np.array(heights) / np.maximum(tops, 1e-6)
    return bool(np.mean((shares >= _UPPER[0]) & (shares <= _UPPER[1])) >= _HALF)


def _never(off: Float64Array, sight: Float64Array, size_m: Float64Array) -> bool:
    """The rule of what cannot be told of a camera."""
    return False


def _nears(sign: float, off: Float64Array, sight: Float64Array, size_m: Float64Array) -> bool:
    """Whether the distance to a body shrinks (1) or grows (-1) by so much."""
    far = np.linalg.norm(off, axis=1)
    return bool(sign * (far[0] - far[-1]) >= _NEARED * far.max())


def _sweeps(off: Float64Array, sight: Float64Array, size_m: Float64Array) -> bool:
    """Whether its line of sight, or its way, passes over a body or along it."""
    to_body = -off / np.linalg.norm(off, axis=1, keepdims=True)
    turned = np.linalg.norm(np.ptp(sight, axis=0))
    gone = np.linalg.norm(np.ptp(off, axis=0)) / np.linalg.norm(off, axis=1).min()
    is_met = (to_body * sight).sum(axis=1).max() >= _AHEAD
    return bool(is_met and max(turned, gone) >= _SWEPT)


def _flies_over(off: Float64Array, sight: Float64Array, size_m: Float64Array) -> bool:
    """Whether it passes above a body, or turns over it where it stays."""
    if np.linalg.norm(np.ptp(off, axis=0)) < _LEAST_WAY * size_m.max():
        return _sweeps(off, sight, size_m)
    aside = np.linalg.norm(off[:, :2], axis=1).min()
    return bool(aside <= _OVER * size_m.max() and off[:, 2].min() >= 0.5 * size_m[2])


def _faces(off: Float64Array, sight: Float64Array, size_m: Float64Array) -> bool:
    """Whether it has a body in sight all the time."""
    to_body = -off / np.linalg.norm(off, axis=1, keepdims=True)
    return bool((to_body * sight).sum(axis=1).min() >= _AHEAD)


def _looks_down(off: Float64Array, sight: Float64Array, size_m: Float64Array) -> bool:
    """Whether it is above a body, and looks down on it all the time."""
    is_down = sight[:, 2].max() <= _DOWN and off[:, 2].min() >= 0.5 * size_m[2]
    return _faces(off, sight, size_m) and bool(is_down)


def _rounds(off: Float64Array, sight: Float64Array, size_m: Float64Array) -> bool:
    """Whether it goes around a body by a part of a circle."""
    return float(np.ptp(np.unwrap(np.arctan2(off[:, 1], off[:, 0])))) >= _ARC


_CAMERA_WAYS: Mapping[str, _Rule] = {
    "towards": partial(_nears, 1.0),
    "to": partial(_nears, 1.0),
    "away from": partial(_nears, -1.0),
    "past": _sweeps,
    "above": _flies_over,
    "around": _rounds,
    "before": _faces,
    "over": _looks_down,
}
"""Kind of relation → its rule."""
