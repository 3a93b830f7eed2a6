"""Named things that only stand about and that the camera leaves out: moved to where it looks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from texvent.scenes.description import SceneDescription
from texvent.scenes.scene import Camera, Float64Array
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.camera.camera_path import CameraPath
from texvent.scenes.staging.trajectories.trajectory import Stationary

_INSTANTS = 5
_ACROSS = (0.3, -0.3, 0.2, -0.2, 0.38, -0.38, 0.1, -0.1)
"""Where a thing may stand, in image widths from the middle."""
_DOWN = (0.1, 0.2, 0.0, 0.3, 0.4)
"""The same in image heights."""
_SMALLEST, _LARGEST = 0.1, 0.6
"""Shares of the image's width that a thing may be wide or high."""
_APART = 0.05
"""Share of the image's width between its outline and those of others."""
_BACKDROP = 8.0
"""How many times larger in the image a thing behind it is that it may cover in part."""
_SEEN = 0.6
"""Share of the clip in which it must be in the image."""


def move_into_view(
    description: SceneDescription,
    actors: Sequence[Actor],
    path: CameraPath,
    *,
    aspect: float,
    duration_s: float,
) -> list[Actor]:
    """The actors, those out of view that the prompt places nowhere moved to a free spot in view.

    Args:
        description: what the prompt says.
        actors: its objects.
        path: the camera.
        aspect: image height over width.
        duration_s: length of the clip, s.

    Returns:
        The actors in the same order. Who moves, is tied to another by a relation, stands high up or
        finds no spot stays where it is.
    """
    bound = {i for one in description.relations for i in (one.subject, *one.targets)}
    bound |= {one.source for one in description.effects if one.source is not None}
    times = [float(t) for t in np.linspace(0.0, duration_s, _INSTANTS)]
    cameras = [path.at(t) for t in times]
    placed = list(actors)
    for number, actor in enumerate(actors):
        is_free = actor.object_index not in bound and isinstance(actor.trajectory, Stationary)
        is_free &= description.objects[actor.object_index].side is None and actor.tether is None
        if not is_free or actor.trajectory.at(0.0).position[2] > 0.01:
            continue
        if any(_lies_inside(_outline(camera, actor.corners(t)), aspect, least=0.3)
               for camera, t in zip(cameras, times, strict=True)):  # fmt: skip
            continue
        others = [one for one in placed if one is not actor]
        placed[number] = _find_spot(actor, others, cameras, times, aspect) or actor
    return placed


def _find_spot(
    actor: Actor,
    others: Sequence[Actor],
    cameras: Sequence[Camera],
    times: Sequence[float],
    aspect: float,
) -> Actor | None:
    """The actor on the first free spot of the image."""
    middle = cameras[len(cameras) // 2]
    taken = [
        [(_outline(camera, corners), _depths(camera, corners)[0])
         for corners in (one.corners(t) for one in others)]
        for camera, t in zip(cameras, times, strict=True)
    ]  # fmt: skip
    for down in _DOWN:
        for across in _ACROSS:
            spot = _meet_ground(middle, across, down * aspect)
            moved = None if spot is None else _put(actor, spot)
            if moved is not None and _is_free(moved, taken, cameras, times, aspect):
                return moved
    return None


def _meet_ground(camera: Camera, across: float, down: float) -> Float64Array | None:
    """[2] the ground point behind an image point, in image widths from the middle; None = sky."""
    right, below, forward = camera.rotation
    ray = forward + (across * right + down * below) / camera.focal
    if ray[2] > -1e-3:
        return None
    return np.asarray((camera.position - ray * camera.position[2] / ray[2])[:2])


def _put(actor: Actor, spot: Float64Array) -> Actor | None:
    trajectory = actor.trajectory
    if not isinstance(trajectory, Stationary):
        return None
    home = (float(spot[0]), float(spot[1]), trajectory.home[2])
    return replace(actor, trajectory=replace(trajectory, home=home))


def _is_free(
    actor: Actor,
    taken: Sequence[Sequence[tuple[Float64Array | None, float]]],
    cameras: Sequence[Camera],
    times: Sequence[float],
    aspect: float,
) -> bool:
    """Whether it is in the image for long enough, of a fair size, and covers nothing named."""
    seen = 0
    for camera, time, outlines in zip(cameras, times, taken, strict=True):
        corners = actor.corners(time)
        box, depth = _outline(camera, corners), _depths(camera, corners)[1]
        if box is None:
            return False
        size = float(np.max(box[1] - box[0]))
        if size > _LARGEST or any(
            _meets(box, other) and not (near > depth and _is_backdrop(other, box))
            for other, near in outlines
        ):
            return False
        seen += size > _SMALLEST and _lies_inside(box, aspect, least=0.9)
    return seen >= _SEEN * len(times)


def _outline(camera: Camera, corners: Float64Array) -> Float64Array | None:
    """[2, 2] least and greatest x and y, in image widths from the middle; None = not ahead."""
    seen = (corners - camera.position) @ np.asarray(camera.rotation).T
    if np.min(seen[:, 2]) < 1e-2:
        return None
    image = camera.focal * seen[:, :2] / seen[:, 2:]
    return np.array([image.min(axis=0), image.max(axis=0)])


def _depths(camera: Camera, corners: Float64Array) -> tuple[float, float]:
    """Least and greatest distance along the camera's axis, m."""
    depth = (corners - camera.position) @ np.asarray(camera.rotation)[2]
    return float(depth.min()), float(depth.max())


def _is_backdrop(other: Float64Array | None, box: Float64Array) -> bool:
    """Whether it stays to be seen behind something so much smaller."""
    return other is not None and bool(
        np.prod(other[1] - other[0]) > _BACKDROP * np.prod(box[1] - box[0])
    )


def _lies_inside(box: Float64Array | None, aspect: float, *, least: float) -> bool:
    """Whether that share of an outline lies in the image."""
    if box is None:
        return False
    edge = np.array([0.5, 0.5 * aspect])
    inner = np.clip(box, -edge, edge)
    whole = float(np.prod(box[1] - box[0]))
    return float(np.prod(inner[1] - inner[0])) >= least * max(whole, 1e-12)


def _meets(box: Float64Array, other: Float64Array | None) -> bool:
    if other is None:
        return False
    return bool(np.all(box[0] - _APART < other[1]) and np.all(other[0] < box[1] + _APART))
