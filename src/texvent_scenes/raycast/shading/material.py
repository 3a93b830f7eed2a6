"""Materials averaged over the patch of surface that one pixel covers (compiled by Numba).

A tile of a material repeats over the surface. Where a pixel covers one texel or less, the texels
around it are blended; where it covers more, blurred levels of the tile stand in (Williams,
"Pyramidal parametrics", SIGGRAPH 1983), along the longer side of the patch several times, so that
a ground seen at a low angle keeps its detail (after McCormack et al., "Feline", SIGGRAPH 1999).
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.core import cgutils

from texvent.runtime.jit import intrinsic, jit
from texvent_scenes.raycast.addresses import texel_at
from texvent_scenes.raycast.records import Record
from texvent_scenes.raycast.shading.value_noise import mix
from texvent_scenes.raycast.surfaces.catalogue import CHANNELS, LEVELS
from texvent_scenes.raycast.surfaces.fields import SIDE
from texvent_scenes.raycast.vectors import along, scaled, triple
from texvent_scenes.rendered_scene import FIRST_SURFACE, Colour

_pack: Any = cgutils.pack_array
_tuple_of: Any = types.UniTuple
_PLACES, _FOUR = _tuple_of(types.int64, 4), _tuple_of(types.float64, 4)
_FLOATS = ir.VectorType(ir.FloatType(), 4)
_DOUBLES = ir.VectorType(ir.DoubleType(), 4)


def _build_blend(typing_context: Any, *arguments: Any) -> Any:
    def build(context: Any, builder: Any, signature: Any, values: Any) -> Any:
        address, places, weights = values
        pointer = builder.inttoptr(address, ir.FloatType().as_pointer())
        total = ir.Constant(_DOUBLES, [0.0] * 4)
        for number in range(4):
            place = builder.extract_value(places, number)
            here = builder.bitcast(builder.gep(pointer, [place]), _FLOATS.as_pointer())
            four = builder.fpext(builder.load(here, align=4), _DOUBLES)
            weight = ir.Constant(_DOUBLES, ir.Undefined)
            for lane in range(4):
                weight = builder.insert_element(
                    weight, builder.extract_value(weights, number), ir.IntType(32)(lane)
                )
            total = builder.fadd(total, builder.fmul(four, weight))
        lanes = [builder.extract_element(total, ir.IntType(32)(lane)) for lane in range(4)]
        return _pack(builder, lanes)

    return _FOUR(types.int64, _PLACES, _FOUR), build


def _typed_blend(typing_context: Any, address: Any, places: Any, weights: Any) -> Any:
    return _build_blend(typing_context, address, places, weights)


def _blend(address: int, places: Corners, weights: Sample) -> Sample:
    rows = [[texel_at(address, place + lane) for lane in range(4)] for place in places]
    a, b, c, d = (np.array(weights) @ np.array(rows, np.float64)).tolist()
    return a, b, c, d


blend_four: Any = intrinsic(_typed_blend, _blend)
"""`blend_four(address, places, weights)`: the weighted sum of four rows of four float32 numbers
that begin `places` (four integers) numbers after the address; four float64."""


Sample = tuple[float, float, float, float]
"""Factors of the first and second colour, and slopes along u and v."""
Patch = tuple[float, float, float, float]
"""Change of (u, v) from one pixel to the next, to the right and down."""
Corners = tuple[int, int, int, int]
TexelPlace = tuple[float, float, float]
"""(u, v) in tiles, and the ease of weights between texels there."""

_SHARPNESS = 0.5
"""Levels finer than the one whose texels are as large as the patch is wide: blending blurs too."""
_FINEST = 2.0**_SHARPNESS
"""Width of a patch, in texels, up to which the finest level is read."""
_MAX_TAPS = 4
"""Averages along the longer side of a patch."""
_MAX_LARGE_TAPS = 2
_LARGE_TURN = (0.8, 0.6)
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


@jit(error_model="numpy", inner=True)
def _eased(share: float, ease: float) -> float:
    """A weight between two texels: straight at ease 0, level at both of them at ease 1.

    Straight weights have a kink at every texel. As it passes a pixel, the brightest instant falls
    between two frames, so that few frames would fire fewer events than many.
    """
    return share * ((1.0 - ease) + (ease * share) * (3.0 - 2.0 * share))


@jit(error_model="numpy", inner=True)
def _corners(level: int, u: float, v: float, ease: float) -> tuple[Corners, Sample]:
    """Offsets in the array of the four texels around (u, v), in tiles, and their weights.

    `ease` is that of `_eased`.
    """
    side = SIDE >> level
    start = (4 * SIDE * SIDE - ((4 * SIDE * SIDE) >> (2 * level))) // 3
    x, y = u * side - 0.5, v * side - 0.5
    column, row = math.floor(x), math.floor(y)
    across, down = _eased(x - column, ease), _eased(y - row, ease)
    left, top = int(column) & (side - 1), int(row) & (side - 1)
    right, bottom = (left + 1) & (side - 1), (top + 1) & (side - 1)
    upper, lower = start + top * side, start + bottom * side
    places = (
        CHANNELS * (upper + left),
        CHANNELS * (upper + right),
        CHANNELS * (lower + left),
        CHANNELS * (lower + right),
    )
    up = 1.0 - down
    return places, ((1.0 - across) * up, across * up, (1.0 - across) * down, across * down)


@jit(error_model="numpy", inner=True)
def _add_texels(tile: int, level: int, place: TexelPlace, share: float, total: Sample) -> Sample:
    """`total` and `share` times the blend of a tile's texels at `place`."""
    corners, weights = _corners(level, place[0], place[1], place[2])
    here = blend_four(tile, corners, weights)
    return (
        total[0] + share * here[0],
        total[1] + share * here[1],
        total[2] + share * here[2],
        total[3] + share * here[3],
    )


@jit(error_model="numpy", inner=True)
def _taps(axes: Patch, most: int) -> tuple[int, float, float]:
    """Number of averages along a patch's longer axis, the level that they read, and their ease.

    A texel that covers two pixels or more is not eased: it would show as a square.
    """
    long, short = SIDE * axes[2], SIDE * axes[3]
    taps = 1
    if long > 1.0:
        taps = min(math.ceil(long / max(short, 1.0) - 1e-6), most)
    width = max(short, long / taps)
    ease = min(max(2.0 * width - 1.0, 0.0), 1.0)
    return taps, 0.0 if width <= _FINEST else max(math.log2(width) - _SHARPNESS, 0.0), ease


@jit(error_model="numpy")
def tile_average(tile: int, u: float, v: float, axes: Patch) -> Sample:
    """A tile averaged over a patch around (u, v).

    Args:
        tile: its address, from `surfaces.catalogue.surface_rows`.
        u: place in tiles.
        v: place in tiles.
        axes: of the patch, in tiles, from `patch_axes`.
    """
    taps, level, ease = _taps(axes, _MAX_TAPS)
    total = (0.0, 0.0, 0.0, 0.0)
    fine = int(level)
    if fine >= _LAST:
        return _add_texels(tile, _LAST, (0.5, 0.5, 0.0), 1.0, total)
    coarse_share = (level - fine) / taps
    fine_share = 1.0 / taps - coarse_share
    for tap in range(taps):
        place = (tap + 0.5) / taps - 0.5
        x, y = u + place * axes[0], v + place * axes[1]
        total = _add_texels(tile, fine, (x, y, ease), fine_share, total)
        if coarse_share > 0.0:
            total = _add_texels(tile, fine + 1, (x, y, ease), coarse_share, total)
    return total


@jit(error_model="numpy", inner=True)
def _first_channel(tile: int, level: int, place: TexelPlace) -> float:
    """A tile's first channel at `place`."""
    corners, weights = _corners(level, place[0], place[1], place[2])
    return float(
        weights[0] * texel_at(tile, corners[0])
        + weights[1] * texel_at(tile, corners[1])
        + weights[2] * texel_at(tile, corners[2])
        + weights[3] * texel_at(tile, corners[3])
    )


@jit(error_model="numpy", inner=True)
def _tile_factor(tile: int, u: float, v: float, axes: Patch) -> float:
    """As `tile_average`, the first channel doubled: patterns of one colour share it evenly."""
    taps, level, ease = _taps(axes, _MAX_LARGE_TAPS)
    fine = int(level)
    if fine >= _LAST:
        return 1.0
    total = 0.0
    for tap in range(taps):
        place = (tap + 0.5) / taps - 0.5
        x, y = u + place * axes[0], v + place * axes[1]
        here = _first_channel(tile, fine, (x, y, ease))
        if level > fine:
            here += (level - fine) * (_first_channel(tile, fine + 1, (x, y, ease)) - here)
        total += here
    return 2.0 * total / taps


@jit(error_model="numpy", inner=True)
def sample_material(
    instant: Record, texture: int, u: float, v: float, axes: Patch, fineness: float
) -> Sample:
    """A material averaged over a patch, with patches larger than its tile.

    Args:
        instant: the scene's record.
        texture: `Texture` of a material.
        u: metres.
        v: metres.
        axes: of the patch, metres, from `patch_axes`.
        fineness: how much smaller than life the material is; 1 = life size.
    """
    number = texture - FIRST_SURFACE
    scale = instant.surface_sizes[number, 0] * fineness
    near = tile_average(
        instant.surface_tiles[number, 0], scale * u, scale * v,
        (scale * axes[0], scale * axes[1], scale * axes[2], scale * axes[3]),
    )  # fmt: skip
    if instant.surface_sizes[number, 1] == 0.0:
        return near
    factor = _large_factor(instant, number, (u, v), axes)
    return near[0] * factor, near[1] * factor, near[2], near[3]


@jit(error_model="numpy", inner=True)
def _large_factor(instant: Record, number: int, place: tuple[float, float], axes: Patch) -> float:
    """Factor of a material's large patches; they are turned, so that tiles do not line up."""
    c, s = _LARGE_TURN
    scale = instant.surface_sizes[number, 2]
    u = scale * (c * place[0] - s * place[1]) + 0.37
    v = scale * (s * place[0] + c * place[1]) + 0.71
    turned = (
        scale * (c * axes[0] - s * axes[1]),
        scale * (s * axes[0] + c * axes[1]),
        scale * axes[2],
        scale * axes[3],
    )
    factor = _tile_factor(instant.surface_tiles[number, 1], u, v, turned)
    return 1.0 + float(instant.surface_sizes[number, 1]) * (factor - 1.0)


_PAVEMENT = (0.34, 0.33, 0.32)
_DRY = (0.05, 0.035, 0.008)
_CITY = 5
_SNOW = 25

Look = tuple[Colour, float, float]
"""Reflectance, and slopes along x and y."""


@jit(error_model="numpy", inner=True)
def painted(sample: Sample, first: Colour, second: Colour, factor: float) -> Look:
    """A material in two colours."""
    colour = along(scaled(first, factor * sample[0]), second, factor * sample[1])
    return colour, sample[2], sample[3]


@jit(error_model="numpy", inner=True)
def mixed(first: Look, second: Look, share: float) -> Look:
    """`first` at share 0, `second` at share 1."""
    return (
        mix(first[0], second[0], share),
        first[1] + share * (second[1] - first[1]),
        first[2] + share * (second[2] - first[2]),
    )


@jit(error_model="numpy", inner=True)
def land_look(instant: Record, x: float, y: float, axes: Patch) -> Look:
    """The ground's material at (x, y), metres; `axes` of the patch from `patch_axes`."""
    sample = sample_material(instant, instant.ground_surface, x, y, axes, 1.0)
    first, second = triple(instant.colour), triple(instant.second_colour)
    if instant.ground == _CITY:
        first, second = _PAVEMENT, scaled(_PAVEMENT, 1.25)
    elif instant.ground in (2, 3, 11, 12):  # the second colour is that of the road or the water
        second = along(scaled(first, 1.35), _DRY, 1.0)
        if instant.ground_surface == _SNOW:
            second = scaled(first, 0.85)
    return painted(sample, first, second, 1.0)
