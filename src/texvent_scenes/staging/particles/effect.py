"""Sources of particles, what they need to know of a scene, and shapes in numbers."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from texvent_scenes.rendered_scene import (
    Colour,
    Float64Array,
    Primitives,
    Shape,
    Texture,
)
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.camera.camera_track import CameraTrack

_NO_GROUND = ("sky", "space", "underwater", "lake bed")
TINY_M = 5e-6
"""Half extent of a particle that is not there at the moment: the caster leaves it out."""


@dataclass(frozen=True)
class Setting:
    """Context of effects in the scene."""

    actors: Sequence[Actor]
    camera: CameraTrack
    place: str
    duration_s: float
    seed: int
    is_dark: bool = False
    """Whether it is night: drops glint in the lamps around."""

    @property
    def away(self) -> Float64Array:
        """[3] horizontal unit vector away from the camera."""
        flat = -self.camera.framing.offset * [1.0, 1.0, 0.0]
        return np.asarray(flat / max(float(np.linalg.norm(flat)), 1e-9))

    @property
    def floor_m(self) -> float:
        """Height of the ground, m; -inf = none."""
        return -math.inf if self.place in _NO_GROUND else 0.0


def many_shapes(
    maps: Float64Array,
    shape: Shape,
    colours: Float64Array | Colour,
    emission: Float64Array | float = 0.0,
) -> Primitives:
    """Shapes of one kind, scenery without an id, from maps [n, 3, 4] unit shape → world."""
    count = len(maps)
    return Primitives(
        shape=np.full(count, shape, dtype=np.int8),
        to_world=maps,
        colour=np.broadcast_to(np.asarray(colours, dtype=np.float32), (count, 3)).copy(),
        second_colour=np.zeros((count, 3), dtype=np.float32),
        texture=np.full(count, Texture.PLAIN, dtype=np.int8),
        texture_scale=np.ones(count, dtype=np.float32),
        emission=np.broadcast_to(np.asarray(emission, dtype=np.float32), (count,)).copy(),
        instance=np.zeros(count, dtype=np.int32),
    )


def along(places: Float64Array, heading: Float64Array, half: Float64Array) -> Float64Array:
    """[n, 3, 4] maps of shapes at places, local z along a heading; half extents in m."""
    length = np.linalg.norm(heading, axis=1, keepdims=True)
    z = np.where(length > 1e-9, heading / np.maximum(length, 1e-9), [0.0, 0.0, 1.0])
    helper = np.where(np.abs(z[:, :1]) < 0.7, [[1.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]])
    x = np.cross(helper, z)
    x /= np.linalg.norm(x, axis=1, keepdims=True)
    turn = np.stack([x, np.cross(z, x), z], axis=2)
    return np.concatenate([turn * half[:, None, :], places[:, :, None]], axis=2)


def tumbling(places: Float64Array, angles: Float64Array, half: Float64Array) -> Float64Array:
    """[n, 3, 4] maps of shapes turned by [n, 2] angles about x, then z; half extents [n, 3], m."""
    (cx, cz), (sx, sz), zero = np.cos(angles).T, np.sin(angles).T, np.zeros(len(angles))
    rows = [[cz, -sz * cx, sz * sx], [sz, cz * cx, -cz * sx], [zero, sx, cx]]
    turn = np.array(rows).transpose(2, 0, 1)
    return np.concatenate([turn * half[:, None, :], places[:, :, None]], axis=2)


@dataclass(frozen=True)
class Source:
    """The point that particles come from: on an object, or fixed."""

    size_m: float
    """Unit of the effect's lengths."""
    fixed: Float64Array
    """[3] the point, m, where there is no object; else in the object's body coordinates."""
    actor: Actor | None = None
    floor_m: float = -math.inf
    """Height of what the pieces of an object come to rest on, m; -inf = the ground."""

    @property
    def extents_m(self) -> Float64Array:
        """[3] length, width and height of the object, m; where there is none, a cube's."""
        if self.actor is None:
            return np.full(3, self.size_m)
        model = self.actor.model
        return np.array([model.length, model.width, model.height])

    def at(self, times_s: Float64Array) -> Float64Array:
        """[n, 3] where the point is at [n] times, m."""
        if self.actor is None:
            return np.tile(self.fixed, (len(times_s), 1))
        maps = [self.actor.track.at(float(time)).to_world() for time in times_s]
        return np.array([one[:, :3] @ self.fixed + one[:, 3] for one in maps]).reshape(-1, 3)

    def turn(self, time_s: float) -> Float64Array:
        """[3, 3] axes of the object; of the world where there is none."""
        if self.actor is None:
            return np.eye(3)
        return np.asarray(self.actor.track.at(time_s).to_world()[:, :3])
