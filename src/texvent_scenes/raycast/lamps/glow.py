"""Glow of lamps in the image: a spot of light with a faint halo (compiled by Numba).

A lamp of a few millimetres covers a hundredth of a pixel, yet it is the brightest thing in the
image. Its light is spread over a normal distribution as wide as the lens blurs it, integrated over
each pixel, so that the sum over the image depends on the lamp's intensity and distance alone.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.camera import Rays
from texvent.runtime.jit import jit
from texvent_scenes.raycast.acceleration import NEAR_M
from texvent_scenes.raycast.addresses import glow_at, list_at, shape_at
from texvent_scenes.raycast.media import optical_depth
from texvent_scenes.raycast.records import GLOW_RECORD, Record, World
from texvent_scenes.raycast.trace import background_hit, is_between, plane_direction, tile_at
from texvent_scenes.raycast.vectors import plane_point, triple, turned
from texvent_scenes.rendered_scene import Colour, Float64Array

BLUR_PX = 0.55
"""Standard deviation of the spot that the lens makes of a point, pixels."""
HALO_SHARE = 0.02
"""Share of a lamp's light that the lens scatters around it."""
HALO_WIDTH = 0.012
"""Standard deviation of that halo, image widths."""
_SPILL = 0.004
"""Share of a beam's light that is seen from outside the beam."""
_FAINTEST = 1e-5
"""A glow ends where it adds less than this to a pixel, in shares of white."""
_PROBES = 48
"""Points of a lamp that are looked at to tell how much of it is hidden."""


def see_glows(world: World, rays: Rays) -> np.ndarray:
    """The lamps that the camera sees as glows, [g] `GLOW_RECORD`, with what stands before them."""
    lamps = world.lamps[world.lamps["glows"] > 0.0]
    if not len(lamps):
        return world.glows
    instant = world.instant[0]
    offset = lamps["place"] - rays.origin
    basis = np.stack([rays.right, rays.down, rays.corner], axis=1)
    seen = offset @ np.linalg.inv(basis).T
    front = seen[:, 2] > NEAR_M
    lamps, offset, seen = lamps[front], offset[front], seen[front]
    glows = np.zeros(len(lamps), dtype=GLOW_RECORD)
    depth = seen[:, 2].copy()  # contiguous, as the kernel is compiled for
    place = seen[:, :2] / depth[:, None]
    glows["place"] = place
    pixel = float(instant["step"])
    distance = np.linalg.norm(offset, axis=1)
    radius = lamps["radius"] / (pixel * distance)
    glows["core"] = np.hypot(BLUR_PX, 0.45 * radius)
    glows["halo"] = np.hypot(HALO_WIDTH * _width(rays), radius)
    visible = np.zeros(len(lamps))
    probes = _disc(_PROBES) * np.maximum(radius, 0.7)[:, None, None]
    see_lamps(world.instant, lamps["radius"].copy(), place, depth, probes, visible)
    share = visible * _towards_camera(lamps, offset, distance)
    share *= np.exp(-distance * float(instant["fog"]))
    # A surface at 1 m that the lamp lights by 1 has radiance 1: intensity π, per pixel's solid
    # angle.
    light = np.pi * lamps["light"] / (pixel * distance)[:, None] ** 2
    light *= share[:, None] * float(instant["exposure"])
    glows["core_light"] = (1.0 - HALO_SHARE) * light
    glows["halo_light"] = HALO_SHARE * light
    for name in ("core", "halo"):
        variance = glows[name] ** 2
        peak = np.maximum(glows[f"{name}_light"].max(axis=1) / (2.0 * np.pi * variance), 1e-300)
        glows[f"{name}_reach"] = glows[name] * np.sqrt(
            2.0 * np.maximum(np.log(peak / _FAINTEST), 0.0)
        )
    return glows[(glows["core_reach"] > 0.0) | (glows["halo_reach"] > 0.0)]


def _width(rays: Rays) -> float:
    """Width of the image, pixels, from the rays: its middle lies on the optical axis."""
    step = float(np.linalg.norm(rays.right))
    return float(-2.0 * np.dot(rays.corner, rays.right) / step**2)


def _towards_camera(
    lamps: NDArray[Any], offset: Float64Array, distance: Float64Array
) -> Float64Array:
    """Share of its light that each lamp sends to the camera."""
    cosine = -(offset * lamps["beam"]).sum(axis=1) / distance
    width = np.maximum(lamps["full"] - lamps["dark"], 1e-9)
    share = np.clip((cosine - lamps["dark"]) / width, 0.0, 1.0)
    share = np.maximum(share * share * (3.0 - 2.0 * share), _SPILL)
    return np.where(lamps["full"] < -1.0, 1.0, share)


def _disc(count: int) -> Float64Array:
    """[count, 2] points spread evenly over the unit disc (Vogel's spiral)."""
    index = np.arange(count)
    radius, angle = np.sqrt((index + 0.5) / count), index * math.pi * (3.0 - math.sqrt(5.0))
    return np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)


@jit(error_model="numpy")
def see_lamps(
    instants: NDArray[Any],
    radii: Float64Array,
    places: Float64Array,
    depths: Float64Array,
    probes: Float64Array,
    visible: Float64Array,
) -> None:
    """Visible share of each lamp's disc, attenuated by participating media.

    Args:
        instants: `World.instant` of the scene.
        radii: [g] of the lamps, m.
        places: [g, 2] in the image without distortion, pixels.
        depths: [g] m.
        probes: [g, k, 2] points of its disc relative to its middle, pixels.
        visible: [g] 0..1 is written.
    """
    instant = instants[0]
    for index in range(len(radii)):
        near = depths[index] - 2.0 * radii[index] - 0.03
        count = 0
        for probe in range(probes.shape[1]):
            x = places[index, 0] + probes[index, probe, 0]
            y = places[index, 1] + probes[index, probe, 1]
            if not _is_hidden(instant, x, y, near):
                count += 1
        share = count / probes.shape[1]
        if share > 0.0 and instant.medium_count > 0:
            x, y = places[index, 0], places[index, 1]
            share *= math.exp(-optical_depth(instant, x, y, depths[index]))
        visible[index] = share


@jit(error_model="numpy", inner=True)
def _is_hidden(instant: Record, x: float, y: float, depth: float) -> bool:
    """Whether something nearer than `depth` is at a point of the image without distortion."""
    lists = instant.lists
    direction = plane_direction(instant, x, y)
    if background_hit(instant, direction)[0] < depth:
        return True
    cell = tile_at(instant, x, y)
    for index in range(list_at(lists, cell), list_at(lists, cell + 1)):
        shape = shape_at(instant.shapes, list_at(lists, index))
        if shape.depth >= depth:
            break
        d = turned(shape.inverse, direction)
        if is_between(instant, shape, triple(shape.eye), d, depth):
            return True
    return False


@jit(error_model="numpy", inner=True)
def _share_of_pixel(offset: float, spread: float) -> float:
    """Share of a normal distribution that falls on the pixel `offset` from its middle."""
    scale = 1.0 / (math.sqrt(2.0) * spread)
    return 0.5 * (math.erf((offset + 0.5) * scale) - math.erf((offset - 0.5) * scale))


@jit(error_model="numpy", inner=True)
def _spot(dx: float, dy: float, spread: float, reach: float) -> float:
    """Share of a spot's light on the pixel at (dx, dy) from its middle."""
    if abs(dx) > reach + 0.5 or abs(dy) > reach + 0.5:
        return 0.0
    return _share_of_pixel(dx, spread) * _share_of_pixel(dy, spread)


@jit(error_model="numpy", inner=True)
def _glow_at(glow: Record, u: float, v: float) -> Colour:
    """Light of one glow on the pixel at (u, v) of the image without distortion."""
    dx, dy = u - glow.place[0], v - glow.place[1]
    core = _spot(dx, dy, glow.core, glow.core_reach)
    halo = _spot(dx, dy, glow.halo, glow.halo_reach)
    return (
        core * glow.core_light[0] + halo * glow.halo_light[0],
        core * glow.core_light[1] + halo * glow.halo_light[1],
        core * glow.core_light[2] + halo * glow.halo_light[2],
    )


@jit(error_model="numpy", inner=True)
def add_glows(instant: Record, x: float, y: float, light: Colour) -> Colour:
    """A pixel's exposed light with all glows: each fills what is left to white, or is added."""
    u, v = plane_point(instant, x, y)
    if math.isnan(u):
        return light
    red, green, blue = 0.0, 0.0, 0.0
    for index in range(instant.glow_count):
        glow = _glow_at(glow_at(instant.glows, index), u, v)
        red, green, blue = red + glow[0], green + glow[1], blue + glow[2]
    if instant.highlights == 1:
        return light[0] + red, light[1] + green, light[2] + blue
    return (
        1.0 - (1.0 - light[0]) * math.exp(-red),
        1.0 - (1.0 - light[1]) * math.exp(-green),
        1.0 - (1.0 - light[2]) * math.exp(-blue),
    )
