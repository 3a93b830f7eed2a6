"""What effects know of their scene, and arrays of many small shapes and puffs."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from texvent.scenes.scene import (
    LAMP_COLUMNS,
    PUFF_COLUMNS,
    Colour,
    Float64Array,
    Primitives,
    Shape,
    Texture,
)
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.camera.camera_path import CameraPath
from texvent.scenes.staging.camera.framing import Framing

_NO_GROUND = ("sky", "space", "underwater")
TINY_M = 5e-6
"""Half extent of a particle that is not there at the moment: the caster leaves it out."""


@dataclass(frozen=True)
class Setting:
    """What effects need to know about the scene."""

    actors: Sequence[Actor]
    camera: CameraPath
    place: str
    duration_s: float
    seed: int

    @property
    def framing(self) -> Framing:
        """What the camera looks at, and from where."""
        return self.camera.framing

    @property
    def base(self) -> Float64Array:
        """[3] the point on the ground below what the camera looks at, m."""
        return np.array([self.framing.target[0], self.framing.target[1], 0.0])

    @property
    def away(self) -> Float64Array:
        """[3] horizontal unit vector away from the camera."""
        flat = -self.framing.offset * [1.0, 1.0, 0.0]
        return np.asarray(flat / max(float(np.linalg.norm(flat)), 1e-9))

    @property
    def floor_m(self) -> float:
        """Height of the ground, m; -inf = none."""
        return -math.inf if self.place in _NO_GROUND else 0.0


class ParticleEffect:
    """An effect as a function of time; each kind overrides what it has."""

    def at(self, time_s: float) -> Primitives:
        """Its solid shapes at that instant: always as many, in the same order."""
        del time_s
        return many_shapes(np.zeros((0, 3, 4)), Shape.ELLIPSOID, np.zeros((0, 3)))

    def puffs(self, time_s: float) -> Float64Array:
        """[k, 19] its translucent puffs, as in `Environment.puffs`."""
        del time_s
        return np.zeros((0, PUFF_COLUMNS))

    def lamps(self, time_s: float) -> Float64Array:
        """[m, 15] the light it sheds, as in `Environment.lamps`."""
        del time_s
        return np.zeros((0, LAMP_COLUMNS))


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
