"""What light reaches a surface, as bits: the sun and the lamps that cast shadows (Numba)."""

from __future__ import annotations

from texvent.runtime.jit import jit
from texvent.scenes.raycast.lamps.shadows import LIT_BITS, lamps_reach
from texvent.scenes.raycast.records import World
from texvent.scenes.raycast.trace import (
    ROOM,
    SKY,
    ray_direction,
    shadow_point,
    sun_reaches,
    surface_normal,
)
from texvent.scenes.raycast.vectors import along, triple

ALL_LIGHTS = (1 << LIT_BITS) - 1
"""All bits of a probe that tell what light reaches a surface."""


@jit(error_model="numpy", inner=True)
def lit_by(
    world: World, x: float, y: float, hit: tuple[float, int, int], wanted: int
) -> tuple[int, bool]:
    """What light reaches what was hit (bit 0: sun, then lamps), and whether a thin shadow is near.

    Only the lights in `wanted` are looked for; only lamps that cast shadows count.
    """
    depth, number, face = hit
    instant = world.instant[0]
    if number == SKY or (number == ROOM and instant.shadow_lamps == 0):
        return 0, False
    point = along(triple(instant.origin), ray_direction(instant, x, y), depth)
    normal = surface_normal(world, number, face, point)
    point = shadow_point(world, number, face, point)
    is_sunlit, thin = False, False
    if number != ROOM and wanted & 1:
        is_sunlit, thin = sun_reaches(world, point, normal)
    lit = int(is_sunlit)
    if instant.shadow_lamps > 0:
        lamps, thin_lamp = lamps_reach(world, point, normal, wanted >> 1)
        lit |= lamps << 1
        thin = thin or thin_lamp
    return lit, thin
