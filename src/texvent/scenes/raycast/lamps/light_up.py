"""Adds an instant's lamps and puffs to what the kernels read; without them it costs nothing."""

from __future__ import annotations

import numpy as np

from texvent.scenes.projection import Rays
from texvent.scenes.raycast.acceleration import Bins
from texvent.scenes.raycast.lamps.bins import list_casters, order_lamps
from texvent.scenes.raycast.lamps.glow import see_glows
from texvent.scenes.raycast.puffs.bins import describe_puffs
from texvent.scenes.raycast.records import OwnedWorld, World, point_to
from texvent.scenes.scene import Environment, Primitives


def light_up(
    world: World | OwnedWorld,
    primitives: Primitives,
    environment: Environment,
    rays: Rays,
    *,
    shadows: bool,
) -> World | OwnedWorld:
    """The world with its lamps, their shadows and glow, and its puffs.

    Args:
        world: of `build_world`.
        primitives: the shapes, as given to `build_world`.
        environment: the surroundings.
        rays: the camera's rays.
        shadows: False turns the shadows of lamps off.
    """
    if not len(environment.lamps) and not len(environment.puffs):
        return world
    instant = world.instant
    lamps, casting = order_lamps(environment.lamps, shadows=shadows)
    inverse = world.shapes["inverse"]
    grids = [list_casters(lamp, primitives, inverse) for lamp in lamps[:casting]]
    instant["lamp_count"], instant["shadow_lamps"] = len(lamps), casting
    instant["lamp_cells"] = len(world.lists)
    puffs, tiles = describe_puffs(environment.puffs, rays, instant[0])
    instant["puff_tiles"] = len(world.lists) + sum(len(bins.start) for bins in grids)
    lists = np.concatenate([world.lists, *_joined([*grids, tiles], len(world.lists))])
    world = world._replace(lists=lists.astype(np.int32), lamps=lamps, puffs=puffs)
    point_to(world)
    world = world._replace(glows=see_glows(world, rays))
    point_to(world)
    return world


def _joined(grids: list[Bins], first: int) -> list[np.ndarray]:
    """Starts of all grids, then their items; starts count from the array's beginning."""
    before = first + sum(len(bins.start) for bins in grids)
    starts = []
    for bins in grids:
        starts.append(bins.start + before)
        before += len(bins.items)
    return [*starts, *(bins.items for bins in grids)]
