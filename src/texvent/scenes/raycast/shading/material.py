"""Materials averaged over the patch of surface that one pixel covers (compiled by Numba).

A tile of a material repeats over the surface. Where a pixel covers one texel or less, the texels
around it are blended; where it covers more, blurred levels of the tile stand in (Williams,
"Pyramidal parametrics", SIGGRAPH 1983), along the longer side of the patch several times, so that
a ground seen at a low angle keeps its detail (after McCormack et al., "Feline", SIGGRAPH 1999).
"""

from __future__ import annotations

import math

from texvent.runtime.jit import jit
from texvent.scenes.raycast.records import World
from texvent.scenes.raycast.surfaces.catalogue import LEVELS
from texvent.scenes.raycast.surfaces.fields import SIDE
from texvent.scenes.scene import FIRST_SURFACE, Float32Array

Sample = tuple[float, float, float, float]
"""What the first and second colour are multiplied by, and slopes along u and v."""
Patch = tuple[float, float, float, float]
"""Change of (u, v) from one pixel to the next, to the right and down."""

_EVEN = (0.5, 0.5, 0.0, 0.0)
_SHARPNESS = 0.5
"""Levels finer than the one whose texels are as large as the patch is wide: blending blurs too."""
_MAX_TAPS = 4
"""Averages along the longer side of a patch."""
_LARGE_TURN = (0.8, 0.6)
_LARGER = 13.7
"""How much larger the tiles of a material's large patches are."""
_LAST = LEVELS - 1


@jit(error_model="numpy")
def patch_axes(patch: Patch) -> Patch:
    """The longer axis of what a pixel covers (two numbers), its length, and the shorter one's."""
    a = patch[0] * patch[0] + patch[2] * patch[2]
    b = patch[0] * patch[1] + patch[2] * patch[3]
    c = patch[1] * patch[1] + patch[3] * patch[3]
    half = 0.5 * (a - c)
    root = math.sqrt(half * half + b * b)
    middle = 0.5 * (a + c)
    long = math.sqrt(middle + root)
    short = math.sqrt(max(middle - root, 0.0))
    x, y = (root + half, b) if half >= 0.0 else (b, root - half)
    size = math.sqrt(x * x + y * y)
    if size == 0.0:
        return long, 0.0, long, short
    return long * x / size, long * y / size, long, short


@jit(error_model="numpy")
def _blend_texels(tiles: Float32Array, tile: int, level: int, u: float, v: float) -> Sample:
    """The four texels around (u, v), in tiles, of one level."""
    side = SIDE >> level
    start = (4 * SIDE * SIDE - ((4 * SIDE * SIDE) >> (2 * level))) // 3
    x, y = u * side - 0.5, v * side - 0.5
    column, row = math.floor(x), math.floor(y)
    across, down = x - column, y - row
    left, top = int(column) & (side - 1), int(row) & (side - 1)
    right, bottom = (left + 1) & (side - 1), (top + 1) & (side - 1)
    a, b = start + top * side + left, start + top * side + right
    c, d = start + bottom * side + left, start + bottom * side + right
    wa, wb = (1.0 - across) * (1.0 - down), across * (1.0 - down)
    wc, wd = (1.0 - across) * down, across * down
    return (
        wa * tiles[tile, a, 0] + wb * tiles[tile, b, 0] + wc * tiles[tile, c, 0]
        + wd * tiles[tile, d, 0],
        wa * tiles[tile, a, 1] + wb * tiles[tile, b, 1] + wc * tiles[tile, c, 1]
        + wd * tiles[tile, d, 1],
        wa * tiles[tile, a, 2] + wb * tiles[tile, b, 2] + wc * tiles[tile, c, 2]
        + wd * tiles[tile, d, 2],
        wa * tiles[tile, a, 3] + wb * tiles[tile, b, 3] + wc * tiles[tile, c, 3]
        + wd * tiles[tile, d, 3],
    )  # fmt: skip


@jit(error_model="numpy")
def _blend_levels(tiles: Float32Array, tile: int, level: float, u: float, v: float) -> Sample:
    """The tile at (u, v), between two levels."""
    if level <= 0.0:
        return _blend_texels(tiles, tile, 0, u, v)
    fine = int(level)
    if fine >= _LAST:
        return _blend_texels(tiles, tile, _LAST, 0.5, 0.5)
    first = _blend_texels(tiles, tile, fine, u, v)
    second = _blend_texels(tiles, tile, fine + 1, u, v)
    share = level - fine
    return _mix_samples(first, second, share)


@jit(error_model="numpy")
def _mix_samples(first: Sample, second: Sample, share: float) -> Sample:
    rest = 1.0 - share
    return (
        rest * first[0] + share * second[0],
        rest * first[1] + share * second[1],
        rest * first[2] + share * second[2],
        rest * first[3] + share * second[3],
    )


@jit(error_model="numpy")
def tile_average(tiles: Float32Array, tile: int, u: float, v: float, axes: Patch) -> Sample:
    """A tile averaged over a patch around (u, v).

    Args:
        tiles: as in `World`.
        tile: which one.
        u: place in tiles.
        v: place in tiles.
        axes: of the patch, in tiles, from `patch_axes`.
    """
    long, short = SIDE * axes[2], SIDE * axes[3]
    taps = 1
    if long > 1.0:
        taps = min(math.ceil(long / max(short, 1.0) - 1e-6), _MAX_TAPS)
    width = max(short, long / taps)
    level = -1.0 if width < 1.0 else math.log2(width) - _SHARPNESS
    if taps == 1 or level >= _LAST:
        return _blend_levels(tiles, tile, level, u, v)
    total = (0.0, 0.0, 0.0, 0.0)
    for tap in range(taps):
        place = (tap + 0.5) / taps - 0.5
        here = _blend_levels(tiles, tile, level, u + place * axes[0], v + place * axes[1])
        total = (total[0] + here[0], total[1] + here[1], total[2] + here[2], total[3] + here[3])
    share = 1.0 / taps
    return total[0] * share, total[1] * share, total[2] * share, total[3] * share


@jit(error_model="numpy")
def sample_material(
    world: World, texture: int, u: float, v: float, axes: Patch, fineness: float
) -> Sample:
    """A material averaged over a patch, with patches larger than its tile.

    Args:
        world: the scene.
        texture: `Texture` of a material.
        u: metres.
        v: metres.
        axes: of the patch, metres, from `patch_axes`.
        fineness: how much smaller than life the material is; 1 = life size.
    """
    kind = world.surfaces[texture - FIRST_SURFACE]
    scale = kind[2] * fineness
    near = tile_average(
        world.tiles, int(kind[0]), scale * u, scale * v,
        (scale * axes[0], scale * axes[1], scale * axes[2], scale * axes[3]),
    )  # fmt: skip
    if kind[3] == 0.0:
        return near
    factor = _large_factor(world, kind, scale / _LARGER, (u, v), axes)
    return near[0] * factor, near[1] * factor, near[2], near[3]


@jit(error_model="numpy")
def _large_factor(
    world: World, kind: Float32Array, scale: float, place: tuple[float, float], axes: Patch
) -> float:
    """Factor of a material's large patches; they are turned, so that tiles do not line up."""
    c, s = _LARGE_TURN
    u = scale * (c * place[0] - s * place[1]) + 0.37
    v = scale * (s * place[0] + c * place[1]) + 0.71
    turned = (
        scale * (c * axes[0] - s * axes[1]),
        scale * (s * axes[0] + c * axes[1]),
        scale * axes[2],
        scale * axes[3],
    )
    sample = tile_average(world.tiles, int(kind[1]), u, v, turned)
    return 1.0 + float(kind[3]) * (sample[0] + sample[1] - 1.0)


@jit(error_model="numpy")
def largest_patches(world: World, texture: int, u: float, v: float, axes: Patch) -> float:
    """Factor of patches of a ground, larger again: fields, not tufts."""
    kind = world.surfaces[texture - FIRST_SURFACE]
    return _large_factor(world, kind, kind[2] / (9.0 * _LARGER), (v, u), axes)
