"""Named things that the camera leaves out or shows too small: where they are seen instead.

What relations tie together moves as one. Places are tried at several depths and across the image;
the best is the one from which most of it is seen, large enough, without covering other things.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from texvent.scenes.description import FORMATIONS, SceneDescription
from texvent.scenes.scene import Camera, Float64Array
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.camera.camera_path import CameraPath
from texvent.scenes.staging.camera.framed_points import is_backdrop, may_stand_back

_INSTANTS, _EYES = 5, 33
_ROUTE_REACH_M = 60.0
"""What counts as the subject's distance along a route, m."""
_CLEAR_M = 0.4
"""How far from a thing the camera stays, m."""
_ACROSS = (0.3, -0.3, 0.2, -0.2, 0.38, -0.38, 0.1, -0.1, 0.0)
"""Where a thing may be, in image widths from the middle."""
_DOWN = (0.0, -0.2, 0.15, -0.1)
"""The same in image heights, for what flies."""
_SIZES = (0.5, 0.35, 0.25, 0.18, 0.13)
"""Shares of the image that a thing may be wide or high."""
_LARGE = 0.22
"""Share of the image that is as good as more."""
_SMALL, _SMALL_AREA, _LONG = 0.12, 0.008, 0.35
"""A thing is large enough from this share of the image's width or height on, if its box covers
that share of the area, or if it is that long."""
_WHOLE_AREA = 0.8
"""Share of the image that is seen, however far a thing that covers it reaches beyond."""
_DEPTHS = 7
"""Distances that are tried between the nearest and where it is."""
_INSIDE = 0.6
"""Share of its box that must lie in the image."""
_ENOUGH = 0.85
"""How well a thing must be seen; 1 = large enough and wholly in the image."""
_MOST_COPIES = 5
"""Copies of a group that are enough."""
_COVERED = 0.3
"""Share of another thing's outline that may be covered, and of its own."""
_BACKDROP = 8.0
"""How many times larger in the image a thing behind it is that it may cover in part."""
_BETTER = 1.15
"""How much better a place must be."""
_LOOSE = frozenset({"past", "among", "surround"})
"""Relations that hold at any distance."""
_NEAREST, _FURTHEST = 1.5, 3.0
"""Least distance of a thing as a multiple of its size, and greatest of what is no backdrop, as a
multiple of the subject's distance."""


class _Boxes(NamedTuple):
    """Outlines in the image, of actors at instants."""

    low: Float64Array
    """[t, n, 2] least x and y, in image widths from the middle."""
    high: Float64Array
    """[t, n, 2]."""
    near: Float64Array
    """[t, n] least depth, m."""
    far: Float64Array
    """[t, n] greatest depth, m."""


class _Stage(NamedTuple):
    """What the camera sees over the clip."""

    cameras: Sequence[Camera]
    corners: Float64Array
    """[t, n, 8, 3] of every actor, m."""
    aspect: float
    room_m: float
    reach_m: float
    """Distance to what the camera looks at."""
    eyes: Float64Array
    """[k, 3] places of the camera over the clip, m."""


def find_shifts(
    description: SceneDescription,
    actors: Sequence[Actor],
    path: CameraPath,
    *,
    subject: int | None,
    aspect: float,
    duration_s: float,
) -> dict[int, Float64Array]:
    """How far to move objects that are out of view or too small.

    Args:
        description: what the prompt says.
        actors: its objects.
        path: the camera.
        subject: the object that it is about, which stays; None = there is none.
        aspect: image height over width.
        duration_s: length of the clip, s.

    Returns:
        Object → [3] m. What the prompt puts to a side or lets enter, what is tied to the subject,
        and what finds no better place is not there.
    """
    times = np.linspace(0.0, duration_s, _INSTANTS)
    stage = _Stage(
        [path.at(float(t)) for t in times],
        np.array([[actor.corners(float(t)) for actor in actors] for t in times]),
        aspect, path.room_m,
        path.framing.distance_m if path.journey is None else _ROUTE_REACH_M,
        np.array([path.at(float(t)).position for t in np.linspace(0.0, duration_s, _EYES)]),
    )  # fmt: skip
    shifts: dict[int, Float64Array] = {}
    for tied in _list_tied(description, actors, subject):
        own = [n for n, actor in enumerate(actors) if actor.object_index in tied]
        is_route = path.journey is not None
        if any(not _may_move(actors[n], description, is_route=is_route) for n in own):
            continue
        shift = _improve(stage, actors, own)
        if shift is not None:
            stage.corners[:, own] += shift
            shifts.update(dict.fromkeys(tied, shift))
    return shifts


def _may_move(actor: Actor, description: SceneDescription, *, is_route: bool) -> bool:
    """Whether the prompt leaves open where it is; along a route only what stands moves."""
    is_placed = description.objects[actor.object_index].side not in (None, *FORMATIONS)
    if is_route and actor.is_mover:
        return False
    return not (is_placed or actor.enters or actor.leaves or actor.goes_across)


def _list_tied(
    description: SceneDescription, actors: Sequence[Actor], subject: int | None
) -> list[set[int]]:
    """Sets of objects that relations tie together, without that of the subject."""
    by_object: dict[int, Actor] = {}
    for actor in actors:
        by_object.setdefault(actor.object_index, actor)
    tied = {index: {index} for index in by_object}
    for relation in description.relations:
        ends = [index for index in (relation.subject, *relation.targets) if index in by_object]
        bodies = [by_object[index] for index in ends]
        if relation.kind in _LOOSE or any(
            may_stand_back(description, one, other) for one in bodies for other in bodies
        ):
            continue
        for one in ends:
            for other in ends:
                if tied[one] is not tied[other]:
                    tied[one] |= tied[other]
                    for index in tied[other]:
                        tied[index] = tied[one]
    found: list[set[int]] = []
    for some in tied.values():
        if subject not in some and some not in found:
            found.append(some)
    return found


def _improve(stage: _Stage, actors: Sequence[Actor], own: Sequence[int]) -> Float64Array | None:
    """[3] the shift to the best place for those actors; None where they are seen well enough."""
    boxes = _outline(stage.cameras, stage.corners)
    is_good = _seen(boxes, stage, own) >= _ENOUGH
    wanted: dict[int, list[bool]] = {}
    for number, good in zip(own, is_good, strict=True):
        wanted.setdefault(actors[number].object_index, []).append(bool(good))
    if all(sum(one) >= min(len(one), _MOST_COPIES) for one in wanted.values()):
        return None
    others = [number for number in range(len(actors)) if number not in own]
    best, shift = _BETTER * _rate(boxes, stage, own, others) + 0.05, None
    weak = [number for number, good in zip(own, is_good, strict=True) if not good]
    for candidate in _candidates(stage, actors, own, weak):
        moved = stage.corners.copy()
        moved[:, own] += candidate
        if not _is_free(moved, stage, own, others):
            continue
        rating = _rate(_outline(stage.cameras, moved), stage, own, others)
        if rating > best:
            best, shift = rating, candidate
    return shift


_ALOFT_M = 0.1
"""Height of what is in the air, m; what rests on the ground stays there."""


def _candidates(
    stage: _Stage, actors: Sequence[Actor], own: Sequence[int], weak: Sequence[int]
) -> Iterator[Float64Array]:
    """Shifts that put the middle of the actors to places of the image, in sizes that are seen."""
    half = len(stage.cameras) // 2
    camera = stage.cameras[half]
    spots = stage.corners[half][list(weak)]
    anchor = spots.reshape(-1, 3).mean(axis=0)
    extent = float(np.median(np.ptp(spots, axis=1).max(axis=1)))
    lowest = float(stage.corners[half][own][..., 2].min())
    is_up = lowest > _ALOFT_M and all(actors[n].noun.habitat == "air" for n in own)
    is_far = any(extent > 6.0 and is_backdrop(actors[n], actors[0]) for n in weak)
    right, below, forward = np.asarray(camera.rotation)
    own_depth = float((anchor - camera.position) @ forward)
    depths = [camera.focal * extent / size for size in _SIZES]
    limit = np.inf if is_far else _FURTHEST * stage.reach_m
    nearest = _NEAREST * extent
    if own_depth > nearest:
        # Nearer to a camera that looks down, the ground is below the image.
        depths += [float(one) for one in np.geomspace(nearest, own_depth, _DEPTHS)[1:]]
    depths = [d for d in dict.fromkeys((*depths, own_depth)) if nearest < d < limit]
    for depth in depths:
        for across in _ACROSS:
            flat = camera.position + depth * (forward + across / camera.focal * right)
            if is_up:
                for down in _DOWN:
                    spot = flat + depth * down * stage.aspect / camera.focal * below
                    yield np.asarray(spot - anchor)
            elif below[2] < -0.05:
                spot = flat + (anchor[2] - flat[2]) / below[2] * below
                yield np.asarray((spot - anchor) * [1.0, 1.0, 0.0])


def _outline(cameras: Sequence[Camera], corners: Float64Array) -> _Boxes:
    """Where boxes [t, n, 8, 3] are in the image; behind the camera far outside of it."""
    lows, highs, nears, fars = [], [], [], []
    for camera, some in zip(cameras, corners, strict=True):
        seen = (some - camera.position) @ np.asarray(camera.rotation).T
        depth = seen[..., 2]
        image = camera.focal * seen[..., :2] / np.maximum(depth, 1e-2)[..., None]
        is_behind = depth.min(axis=1) < 1e-2
        low, high = image.min(axis=1), image.max(axis=1)
        low[is_behind] = high[is_behind] = 1e3
        lows.append(low)
        highs.append(high)
        nears.append(depth.min(axis=1))
        fars.append(depth.max(axis=1))
    return _Boxes(np.array(lows), np.array(highs), np.array(nears), np.array(fars))


def _area(low: Float64Array, high: Float64Array) -> Float64Array:
    return np.asarray(np.prod(np.maximum(high - low, 0.0), axis=-1))


def _goodness(boxes: _Boxes, stage: _Stage, own: Sequence[int]) -> Float64Array:
    """[t, k] how well each is seen at each instant: 1 = large enough and in the image."""
    edge = np.array([0.5, 0.5 * stage.aspect])
    low, high = boxes.low[:, own], boxes.high[:, own]
    inner_low, inner_high = np.clip(low, -edge, edge), np.clip(high, -edge, edge)
    inner = _area(inner_low, inner_high)
    inside = inner / np.maximum(_area(low, high), 1e-12)
    extent = ((inner_high - inner_low) / (2.0 * edge)).max(axis=-1)
    share = inner / stage.aspect
    size = np.minimum(extent / _SMALL, np.sqrt(share / _SMALL_AREA))
    size = np.maximum(size, extent / _LONG)
    most = np.minimum(inside / _INSIDE, 1.0) * (0.6 + 0.4 * inside)
    whole = np.maximum(most, np.minimum(share / _WHOLE_AREA, 1.0))
    return np.asarray(whole * np.minimum(size, _LARGE / _SMALL))


def _seen(boxes: _Boxes, stage: _Stage, own: Sequence[int]) -> Float64Array:
    """[k] how well each is seen at the second best of the instants."""
    return np.asarray(np.sort(_goodness(boxes, stage, own), axis=0)[-2])


def _rate(boxes: _Boxes, stage: _Stage, own: Sequence[int], others: Sequence[int]) -> float:
    """How well all of them are seen over the clip, with what they cover and what covers them."""
    good = np.minimum(_goodness(boxes, stage, own), _LARGE / _SMALL)
    rating = float(good.mean())
    if not others:
        return rating
    low, high = boxes.low[:, own, None], boxes.high[:, own, None]
    other_low, other_high = boxes.low[:, None, others], boxes.high[:, None, others]
    common = _area(np.maximum(low, other_low), np.minimum(high, other_high))
    mine, theirs = _area(low, high), _area(other_low, other_high)
    is_before = boxes.far[:, own, None] <= boxes.near[:, None, others]
    is_before |= (boxes.near[:, own, None] + boxes.far[:, own, None]) < (
        boxes.near[:, None, others] + boxes.far[:, None, others]
    )
    covers = np.where(is_before & (theirs < _BACKDROP * mine), common / np.maximum(theirs, 1e-9), 0)
    covered = np.where(~is_before, common / np.maximum(mine, 1e-9), 0.0)
    worst_covered = np.minimum(covered.sum(axis=2), 1.0)
    rating = float((good * (1.0 - worst_covered)).mean())
    excess = np.maximum(covers.sum(axis=1) - _COVERED, 0.0).mean(axis=0)
    return rating - 2.0 * float(np.minimum(excess, 1.0).sum())


def _is_free(
    corners: Float64Array, stage: _Stage, own: Sequence[int], others: Sequence[int]
) -> bool:
    """Whether they stand in nothing else, in the room, and not at the camera."""
    low, high = corners[:, own].min(axis=2), corners[:, own].max(axis=2)
    if np.isfinite(stage.room_m) and max(-low[..., :2].min(), high[..., :2].max()) > stage.room_m:
        return False
    eyes = stage.eyes[:, None]
    for near, far in zip(low, high, strict=True):
        if np.any(np.all((near - _CLEAR_M < eyes) & (eyes < far + _CLEAR_M), axis=2)):
            return False
    if not others:
        return True
    other_low, other_high = corners[:, others].min(axis=2), corners[:, others].max(axis=2)
    apart = np.maximum(low[:, :, None] - other_high[:, None], other_low[:, None] - high[:, :, None])
    return not bool(np.any(np.all(apart < 0.0, axis=-1)))
