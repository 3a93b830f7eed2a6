"""Patterns of materials, their sizes, and the tiles that the kernels read."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from texvent_scenes.raycast.surfaces import patterns
from texvent_scenes.raycast.surfaces.fields import SIDE, Field, interpolated
from texvent_scenes.rendered_scene import FIRST_SURFACE, Texture

LEVELS = 9
"""A tile, and its averages over 2 × 2, 4 × 4, ... texels up to the whole tile."""
CHANNELS = 4
STEEPEST = 1.2
"""Slopes of relief are cut off here."""
_PATCHES, _LIGHTER = 8, 0.35
"""Patches along a tile's side that are evened out; by how much a second colour is lighter."""
_FRACTION = 1 << 16
"""Factors are whole multiples of 1 / this, so that their sum is exact."""


@dataclass(frozen=True)
class SurfaceKind:
    """One material."""

    pattern: Callable[[], patterns.Pattern]
    side_m: float
    """Side of its tile, metres."""
    relief: float = 0.0
    """Strength of its bumps: slope per unit of height per texel."""
    wear: float = 0.6
    """Strength of patches larger than the tile."""
    large: Texture = Texture.VARIATION
    """Pattern of those patches."""
    larger: float = 25.0
    """Size of their tile, as a multiple of the material's."""
    gloss: float = 0.0
    """Share of light that its clear layer mirrors straight on; 0 = it is matt."""
    roughness: float = 0.02
    """Blur of what it mirrors, radians."""
    crown: float = 0.0
    """Slope at the edges of a box's faces, which bulge as sheet metal does."""
    is_regular: bool = False
    """Whether its patches line up in nature too."""

    @property
    def is_evened(self) -> bool:
        """Whether larger patches, which do not line up, take the place of its own."""
        return self.wear > 0.0 and not self.is_regular


SURFACES: dict[Texture, SurfaceKind] = {
    Texture.VARIATION: SurfaceKind(patterns.variation, 1.0, wear=0.0),
    Texture.CRACKED: SurfaceKind(patterns.cracked, 1.0, wear=0.0),
    Texture.WORN: SurfaceKind(patterns.worn, 1.6, wear=0.0),
    Texture.ASPHALT: SurfaceKind(patterns.asphalt, 1.1, 0.25, 1.0, Texture.CRACKED, 13.7),
    Texture.GRASS: SurfaceKind(patterns.grass, 1.7, 0.35, 1.0),
    Texture.SOIL: SurfaceKind(patterns.soil, 1.6, 0.7, 0.8),
    Texture.SAND: SurfaceKind(patterns.sand, 2.2, 0.9, 0.8),
    Texture.LEAVES: SurfaceKind(patterns.leaves, 1.9, 0.4, 0.8),
    Texture.SNOW: SurfaceKind(patterns.snow, 3.0, 0.9, 0.5),
    Texture.PAVING: SurfaceKind(patterns.paving, 3.0, 0.8, 0.8),
    Texture.TILES: SurfaceKind(patterns.tiles, 1.6, 0.4, 0.5, is_regular=True),
    Texture.BOARDS: SurfaceKind(patterns.boards, 1.9, 0.3, 0.6),
    Texture.CARPET: SurfaceKind(patterns.carpet, 1.8, 0.3, 0.7),
    Texture.WATER: SurfaceKind(patterns.water, 3.5, 0.3, 0.9),
    Texture.STONE: SurfaceKind(patterns.stone, 1.5, 0.9),
    Texture.CONCRETE: SurfaceKind(patterns.concrete, 2.6, 0.5, 0.7, larger=5.3),
    Texture.PLASTER: SurfaceKind(patterns.plaster, 3.2, 0.35, 0.25),
    Texture.BRICK: SurfaceKind(patterns.brick, 2.0, 0.8, 0.5),
    Texture.ROOFING: SurfaceKind(patterns.roofing, 2.5, 0.4),
    Texture.WOOD: SurfaceKind(patterns.wood, 0.9, 0.2, 0.0),
    Texture.BARK: SurfaceKind(patterns.bark, 0.9, 0.9, 0.0),
    Texture.FOLIAGE: SurfaceKind(patterns.foliage, 1.8, 0.45, 0.5, larger=4.3),
    Texture.NEEDLES: SurfaceKind(patterns.needles, 1.5, 0.45, 0.5, larger=4.3),
    Texture.FUR: SurfaceKind(patterns.fur, 0.6, 0.35, 0.0),
    Texture.FEATHERS: SurfaceKind(patterns.feathers, 0.5, 0.3, 0.0),
    Texture.CLOTH: SurfaceKind(patterns.cloth, 0.7, 0.35, 0.0),
    Texture.SKIN: SurfaceKind(patterns.skin, 0.35, 0.2, 0.0),
    Texture.METAL: SurfaceKind(patterns.metal, 1.0, 0.1, 0.0, gloss=0.25, roughness=0.12),
    Texture.RUST: SurfaceKind(patterns.rust, 0.9, 0.4, 0.0),
    Texture.LEATHER: SurfaceKind(patterns.leather, 0.6, 0.5, 0.0),
    Texture.SPOTS: SurfaceKind(patterns.spots, 1.0, 0.2, 0.0),
    Texture.SCALES: SurfaceKind(patterns.scales, 0.5, 0.4, 0.0),
    Texture.LACQUER: SurfaceKind(patterns.worn, 1.6, wear=0.0, gloss=0.06, crown=0.3),
    Texture.PANE: SurfaceKind(patterns.worn, 1.6, wear=0.0, gloss=0.1, crown=0.06),
    Texture.MIRROR: SurfaceKind(patterns.worn, 1.6, wear=0.0, gloss=0.9, roughness=0.004),
    Texture.PRINT: SurfaceKind(patterns.print_, 0.5, wear=0.0),
    Texture.PAPER: SurfaceKind(patterns.paper, 0.8, wear=0.0),
    Texture.BOOKS: SurfaceKind(patterns.books, 1.2, 0.5, wear=0.0),
}
"""Every material."""
SURFACE_COUNT = max(SURFACES) - FIRST_SURFACE + 1
"""Rows of a table by texture less `FIRST_SURFACE`."""


@cache
def build_tile(texture: Texture) -> NDArray[np.float32]:
    """A material's tile at all levels.

    Channels: what the first and the second colour are multiplied by, and the slope of the relief
    along u and v. All four are averages at every level, so what is shown of a pixel that covers
    many texels is their mean.

    Args:
        texture: one of `SURFACES`.

    Returns:
        [n, CHANNELS], kept while the process runs: one level after the other, the finest first,
        each with its rows along v.
    """
    kind = SURFACES[texture]
    pattern = kind.pattern()
    share = np.clip(pattern.share, 0.0, 1.0)
    factor = np.clip(pattern.factor, 0.0, 8.0)
    if kind.is_evened:
        factor = _evened(factor, share)
    factor = np.rint(factor * _FRACTION)
    factor = factor * (SIDE * SIDE / float(int(factor.astype(np.int64).sum())))
    level = np.stack(
        [
            factor * (1.0 - share),
            factor * share,
            _slope(pattern.height, 1, kind.relief),
            _slope(pattern.height, 0, kind.relief),
        ],
        axis=-1,
    )
    levels = [level]
    while len(levels[-1]) > 1:
        fine = levels[-1]
        levels.append((fine[::2, ::2] + fine[1::2, ::2] + fine[::2, 1::2] + fine[1::2, 1::2]) / 4.0)
    return np.concatenate([each.reshape(-1, CHANNELS) for each in levels]).astype(np.float32)


def _evened(factor: Field, share: Field) -> Field:
    """A factor without patches of an eighth of the tile or more.

    Where they are a few pixels wide their repetition would be seen as rows and columns; larger
    patches that do not line up take their place.
    """
    side = SIDE // _PATCHES
    for _ in range(2):
        whole = np.rint(factor * (1.0 + _LIGHTER * share) * _FRACTION)
        sums = whole.reshape(_PATCHES, side, _PATCHES, side).sum(axis=(1, 3))
        patches = interpolated(sums * (_PATCHES * _PATCHES / sums.sum()))
        factor = factor / np.roll(patches, side // 2, axis=(0, 1))
    return factor


@cache
def surface_rows(textures: frozenset[int]) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Addresses and sizes of the materials in use, for the kernels.

    Args:
        textures: values of `Texture`; those without a tile are passed over.

    Returns:
        By texture less `FIRST_SURFACE`: addresses [SURFACE_COUNT, 2] of a material's tile and of
        its large patches' tile, and [SURFACE_COUNT, 3] tiles per metre, strength of those
        patches and their tiles per metre. Rows of materials that are not in use are 0.
    """
    addresses = np.zeros((SURFACE_COUNT, 2), dtype=np.int64)
    sizes = np.zeros((SURFACE_COUNT, 3))
    for value in sorted(textures):
        if value < FIRST_SURFACE:
            continue
        kind = SURFACES[Texture(value)]
        row = value - FIRST_SURFACE
        addresses[row] = [build_tile(each).ctypes.data for each in (Texture(value), kind.large)]
        sizes[row] = 1.0 / kind.side_m, kind.wear, 1.0 / (kind.larger * kind.side_m)
    return addresses, sizes


def gloss_rows() -> NDArray[np.float64]:
    """[SURFACE_COUNT, 3] gloss, roughness and crown, by texture less `FIRST_SURFACE`."""
    rows = np.zeros((SURFACE_COUNT, 3))
    for texture, kind in SURFACES.items():
        rows[texture - FIRST_SURFACE] = kind.gloss, kind.roughness, kind.crown
    return rows


def _slope(height: Field, axis: int, relief: float) -> Field:
    """Slope along one axis, from the texels on both sides."""
    step = 0.5 * relief * (np.roll(height, -1, axis) - np.roll(height, 1, axis))
    return np.clip(step, -STEEPEST, STEEPEST)
