"""Boxes around bodies and their parts over a clip, in the world and as a camera sees them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from texvent.camera import PosedCamera, project
from texvent.sensor import SensorSize
from texvent_scenes.models.shapes import bounds, moved
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.staging.actors import Actor


class BodyBoxes(NamedTuple):
    """Box around a body at the instants of a clip; arrays [t, 3]."""

    middle: Float64Array
    """m."""
    size: Float64Array
    """Extents, m."""
    seen: Float64Array
    """Middle in the image: tangents to the right and downwards, and depth, m."""
    displacement: Float64Array
    """[3] from the first place to the last along the camera's axes of mid clip, m."""
    parts: Float64Array
    """[k, 2, 3] boxes around its shapes at the first instant, m."""
    ahead: Float64Array = np.zeros((1, 2))
    """[t, 2] unit vectors of its heading on the ground; zero: it has none."""

    def cut(self, when: slice) -> BodyBoxes:
        """Boxes at some of the instants, the parts at the first of these."""
        middle = self.middle[when]
        parts = self.parts + (middle[0] - self.middle[0])
        size, seen, ahead = self.size[when], self.seen[when], self.ahead[when]
        return BodyBoxes(middle, size, seen, self.displacement, parts, ahead)


def body_of(actor: Actor, cameras: Sequence[PosedCamera], times: Sequence[float]) -> BodyBoxes:
    """The body of an actor at instants, s, with the camera at each."""
    bare = replace(actor, props=()) if actor.props else actor  # a guitar is not the body
    corners = np.array([bare.corners(time) for time in times])
    low, high = corners.min(axis=1), corners.max(axis=1)
    middle, shapes = 0.5 * (low + high), actor.place(times[0])
    seen = np.array([camera.rotation @ (place - camera.position)
                     for place, camera in zip(middle, cameras, strict=True)])  # fmt: skip
    seen[:, :2] /= np.maximum(seen[:, 2:], 1e-3)
    displacement = cameras[len(times) // 2].rotation @ (middle[-1] - middle[0])
    parts = [bounds([part]) for part in moved(shapes.parts, shapes.to_world)]
    yaws = np.array([actor.track.at(time).yaw for time in times])
    ahead = np.stack([np.cos(yaws), np.sin(yaws)], axis=1)
    return BodyBoxes(middle, high - low, seen, displacement, np.array(parts), ahead)


def is_any_inside(points: Float64Array, camera: PosedCamera, size: SensorSize) -> bool:
    """Whether any of some points, [n, 3] m, is in the image."""
    x, y, depth = project(camera, size, points).T
    is_in = (x >= 0.0) & (x < size.width) & (y >= 0.0) & (y < size.height) & (depth > 0.0)
    return bool(is_in.any())
