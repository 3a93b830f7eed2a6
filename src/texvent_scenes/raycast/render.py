"""Draw a scene at one instant: `render(scene, time_s, size)`.

An image is a pure function of scene, instant and size: the same arguments give the same bits,
with any number of threads, and a scene that stands still gives identical images.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.camera import Rays, camera_rays
from texvent.runtime.threads import run_parts
from texvent.sensor import SensorSize
from texvent.transfer import encode_srgb
from texvent_scenes.raycast.acceleration import TILE, Bins, build_world
from texvent_scenes.raycast.adaptive_sampling import UNKNOWN, Codes, render_rows
from texvent_scenes.raycast.lamps.glow import see_glows
from texvent_scenes.raycast.lamps.light import list_casters, order_lamps
from texvent_scenes.raycast.media import describe_media
from texvent_scenes.raycast.optics import PERFECT, Optics
from texvent_scenes.raycast.records import World
from texvent_scenes.raycast.shading.ambient import list_windows
from texvent_scenes.rendered_scene import (
    Environment,
    Float32Array,
    Float64Array,
    Primitives,
    RenderedScene,
)


def light_up(
    world: World,
    primitives: Primitives,
    environment: Environment,
    rays: Rays,
    *,
    shadows: bool,
) -> World:
    """The world with its lamps, their shadows and glow, and its media.

    Args:
        world: of `build_world`.
        primitives: the shapes, as given to `build_world`.
        environment: the surroundings.
        rays: the camera's rays.
        shadows: False turns the shadows of lamps off.
    """
    list_windows(world.instant)
    if not len(environment.lamps) and not len(environment.media):
        return world
    instant = world.instant
    lamps, casting = order_lamps(environment.lamps, shadows=shadows)
    grids = [list_casters(lamp, world.shapes, primitives) for lamp in lamps[:casting]]
    instant["shadow_lamps"] = casting
    instant["lamp_cells"] = len(world.lists)
    media, tiles = describe_media(environment.media, rays, instant[0])
    instant["medium_tiles"] = len(world.lists) + sum(len(bins.start) for bins in grids)
    lists = np.concatenate([world.lists, *_joined([*grids, tiles], len(world.lists))])
    world = world._replace(lists=lists.astype(np.int32), lamps=lamps, media=media).addressed()
    return world._replace(glows=see_glows(world, rays)).addressed()


def _joined(grids: list[Bins], first: int) -> list[np.ndarray]:
    """Starts of all grids, then their items; starts count from the array's beginning."""
    before = first + sum(len(bins.start) for bins in grids)
    starts = []
    for bins in grids:
        starts.append(bins.start + before)
        before += len(bins.items)
    return [*starts, *(bins.items for bins in grids)]


def world_at(
    scene: RenderedScene, time_s: float, size: SensorSize, *, shadows: bool = True, samples: int = 2
) -> World:
    """Records of one instant of a scene, as the kernels read them."""
    return world_and_shapes(scene, time_s, size, shadows=shadows, samples=samples).world


class Drawn(NamedTuple):
    """One instant as it is drawn."""

    world: World
    primitives: Primitives


def world_and_shapes(
    scene: RenderedScene, time_s: float, size: SensorSize, *, shadows: bool = True, samples: int = 2
) -> Drawn:
    """Records of one instant of a scene, and the shapes that they were made from."""
    camera = scene.camera(time_s)
    rays = camera_rays(camera, size)
    primitives, environment = scene.primitives(time_s), scene.environment(time_s)
    world = build_world(
        primitives, environment, rays, size, shadows=shadows, samples=samples, lens=camera.lens
    )
    return Drawn(light_up(world, primitives, environment, rays, shadows=shadows), primitives)


def render(
    scene: RenderedScene,
    time_s: float,
    size: SensorSize,
    *,
    samples: int = 2,
    shadows: bool = True,
    optics: Optics = PERFECT,
) -> Float32Array:
    """Draw a scene as a camera would see it at one instant.

    Args:
        scene: what to draw.
        time_s: the instant, s.
        size: image size, pixels.
        samples: probes per pixel side that look for edges, which bisection then places; a pixel
            with something thinner than the probes is the mean of (4 · samples)² rays.
        shadows: False leaves out all shadows.
        optics: the camera's lens.

    Returns:
        [H, W, 3] RGB, float32, 0..255, gamma-coded with the sRGB curve (IEC 61966-2-1), not
        rounded to whole levels.
    """
    world = world_at(scene, time_s, size, shadows=shadows, samples=samples)
    light = light_of_rows(world, (0, size.height), size, samples=samples)
    everywhere = np.ones(size.shape, dtype=np.bool_)
    passed = optics.passed(light, world, everywhere)
    return encode_srgb(passed.reshape(light.shape))


def render_light(
    scene: RenderedScene,
    time_s: float,
    size: SensorSize,
    *,
    samples: int = 2,
    shadows: bool = True,
) -> Float32Array:
    """The light that a perfect lens passes, which `render` gamma-codes.

    Args:
        scene: what to draw.
        time_s: the instant, s.
        size: image size, pixels.
        samples: as for `render`.
        shadows: as for `render`.

    Returns:
        [H, W, 3] linear RGB, float32; 1 is white, and the brightest where the scene has no
        highlights.
    """
    world = world_at(scene, time_s, size, shadows=shadows, samples=samples)
    return light_of_rows(world, (0, size.height), size, samples=samples)


def light_of_rows(
    world: World,
    rows: tuple[int, int],
    size: SensorSize,
    *,
    samples: int = 2,
    wanted: NDArray[np.bool_] | None = None,
    codes: Codes | None = None,
    light: Float32Array | None = None,
) -> Float32Array:
    """Some rows of what `render_light` gives.

    Args:
        world: of `world_at`, with the same size and samples.
        rows: first row and one past the last row.
        size: image size, pixels.
        samples: as for `render`.
        wanted: [H, W] which pixels to draw, the others stay as they are; None: all.
        codes: [H, W] what fills whole pixels, as for `render_rows`; None: nothing is known.
        light: [H, W, 3] is written; None: a new one.
    """
    first, last = rows
    image = np.empty((last, size.width, 3), dtype=np.float32) if light is None else light
    # The kernel is compiled for contiguous masks alone.
    chosen = np.ascontiguousarray(
        np.ones((last, size.width), dtype=np.bool_) if wanted is None else wanted
    )
    known = np.full((last, size.width), UNKNOWN) if codes is None else codes
    pattern = sample_pattern((4 * samples) ** 2)

    def draw(top: int) -> None:
        band = top, min(top + TILE, last)
        render_rows(world.instant, band, samples, pattern, chosen, known, image)

    run_parts(draw, range(first, last, TILE))
    return image[first:]


def sample_pattern(count: int) -> Float64Array:
    """Positions of `count` samples in a pixel: one in each row and each column (Hammersley).

    So an upright or level edge that crosses the pixel passes the samples one by one.

    Returns:
        [count, 2] x and y in (0, 1).
    """
    index = np.arange(count)
    reversed_bits, place, rest = np.zeros(count), 0.5, index.copy()
    while rest.any():
        reversed_bits += place * (rest % 2)
        rest //= 2
        place *= 0.5
    rank = np.argsort(np.argsort(reversed_bits, kind="stable"), kind="stable")
    return (np.stack([index, rank], axis=1) + 0.5) / count
