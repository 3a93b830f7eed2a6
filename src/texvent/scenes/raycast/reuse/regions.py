"""What a change of a shape or a lamp can reach: light and shadow."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.scenes.projection import Rays
from texvent.scenes.raycast.acceleration import TILE, screen_bounds
from texvent.scenes.raycast.lamps.bins import in_beam
from texvent.scenes.raycast.lamps.light import FULL, POSITION, REACH
from texvent.scenes.raycast.reuse.tiles import Balls, Mask
from texvent.scenes.raycast.trace import MESH, SHADOW_BIAS_M
from texvent.scenes.scene import Float64Array, Ground, Primitives, Shape
from texvent.sensor import SensorSize

BIAS_M = 2.0 * SHADOW_BIAS_M
"""How far beside a surface its shadow rays may begin, with room for rounding, m."""
LOWEST_SUN = 1e-3
"""Below this sine of the sun's height its shadows are longer than the world."""
_CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=float)


class _Boxes:
    """Placed boxes, as `screen_bounds` takes them."""

    def __init__(self, to_world: Float64Array) -> None:
        self.to_world = to_world
        self.shape = np.full(len(to_world), Shape.BOX, dtype=np.int8)


def shape_balls(shapes: NDArray[Any], primitives: Primitives) -> Balls:
    """Balls that hold shapes, as wide as thin ones are made to be found."""
    to_world = np.asarray(primitives.to_world, dtype=np.float64)
    widened = to_world[:, :, :3] / np.maximum(shapes["shrink"], 1e-9)[:, None, :]
    corners = np.einsum("nij,kj->nki", widened, _CORNERS)
    radius = np.linalg.norm(corners, axis=2).max(axis=1)
    return Balls(to_world[:, :, 3], radius * (1.0 + 1e-9) + BIAS_M)


def receiving_balls(shapes: NDArray[Any], balls: Balls) -> Balls:
    """Balls that hold the points of shapes where shadow rays begin."""
    # On a mesh they begin where it would be smooth: `trace.shadow_point`.
    return balls._replace(radius=np.where(shapes["kind"] == MESH, 3.0, 1.0) * balls.radius)


def lit_by_lamp(lamp: Float64Array, balls: Balls) -> Mask:
    """[n] which balls a lamp's light may reach, whatever stands in its way."""
    offset = balls.centre - lamp[POSITION : POSITION + 3]
    distance = np.linalg.norm(offset, axis=1)
    there = balls.radius >= 0.0
    near = there & (distance - balls.radius <= lamp[REACH])
    if lamp[FULL] >= -1.0:
        near &= in_beam(lamp, offset, distance, np.maximum(balls.radius, 0.0))
    return np.asarray(near)


def shaded_from_lamp(lamp: Float64Array, casters: Balls, balls: Balls) -> Mask:
    """[n] which balls the shadow of a caster may fall on."""
    place = lamp[POSITION : POSITION + 3]
    towards, width = _seen_from(place, casters)
    ways, widths = _seen_from(place, balls)
    cosine = np.clip(towards @ ways.T, -1.0, 1.0)
    reaches = np.arccos(cosine) <= width[:, None] + widths[None, :] + 1e-6
    start = np.linalg.norm(casters.centre - place, axis=1) - casters.radius
    end = np.linalg.norm(balls.centre - place, axis=1) + balls.radius
    return np.asarray((reaches & (end >= start[:, None])).any(axis=0) & lit_by_lamp(lamp, balls))


def _seen_from(place: Float64Array, balls: Balls) -> tuple[Float64Array, Float64Array]:
    """Unit vectors to balls and their angular radii, radians; π around the place itself."""
    offset = balls.centre - place
    distance = np.maximum(np.linalg.norm(offset, axis=1), 1e-12)
    sine = balls.radius / distance
    width = np.where(sine >= 1.0 - 1e-9, np.pi, np.arcsin(np.clip(sine, 0.0, 1.0)))
    return offset / distance[:, None], width


def sun_shadow_windows(
    instant: Any, shapes: NDArray[Any], chosen: NDArray[np.int64]
) -> Float64Array | None:
    """Where in the image the sun's shadows of some shapes may lie on the ground: [k, 4], pixels.

    None: the sun is so low that there is no telling.
    """
    if instant["ground"] == Ground.NONE:
        return np.zeros((0, 4))
    sun, plane = instant["sun"], instant["sun_plane"]
    if sun[2] < LOWEST_SUN:
        return None
    window = shapes["sun_window"][chosen] + BIAS_M * np.array([-1.0, 1.0, -1.0, 1.0, 1.0])
    # Each axis of the plane facing the sun, moved along the sun's direction down to the ground.
    axes = plane - (plane[:, 2:] / sun[2]) * sun
    middle, half = window[:, 0:4:2] + window[:, 1:4:2], window[:, 1:4:2] - window[:, 0:4:2]
    to_world = np.zeros((len(chosen), 3, 4))
    to_world[:, :, :2] = 0.5 * half[:, None, :] * axes.T
    to_world[:, :, 3] = 0.5 * middle @ axes
    rays = Rays(instant["origin"], instant["corner"], instant["right"], instant["down"])
    size = SensorSize(TILE * int(instant["tile_columns"]), TILE * int(instant["tile_rows"]))
    bounds = screen_bounds(_Boxes(to_world), rays, size)[0]
    return np.asarray(bounds + np.array([-1.0, 1.0, -1.0, 1.0]))


def sunlit_behind(shapes: NDArray[Any], balls: Balls, chosen: NDArray[np.int64]) -> Mask:
    """[n] which shapes some shapes may shade from the sun.

    Shadow rays of a mesh begin where it would be smooth, which is at most its own size outside.
    """
    own, other = shapes["sun_window"], shapes["sun_window"][chosen]
    beyond = np.where(shapes["kind"] == MESH, 2.0 * balls.radius, BIAS_M)[:, None]
    result: Mask = np.ones((len(own), len(other)), dtype=np.bool_)
    for low, high in ((0, 1), (2, 3)):
        result &= own[:, low, None] - beyond <= other[None, :, high]
        result &= other[None, :, low] <= own[:, high, None] + beyond
    return np.asarray(result.any(axis=1))
