"""Images on surfaces, as mip pyramids in linear light, and triangle meshes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from texvent import transfer
from texvent.errors import InputError

MOST_LEVELS = 14
"""Levels of a pyramid at most: images up to 8,192 pixels on a side reach a single pixel."""
KEPT_COLOURS = 32
"""Meshes in other colours that are kept."""
LARGEST_SIDE = 4096
"""Longest side of an image, pixels: larger ones are made smaller."""


@dataclass(frozen=True, eq=False)
class SurfaceImage:
    """An image that a surface shows; u runs right and v down over 0..1."""

    levels: tuple[Float32Array, ...]
    """[h, w, 3] linear RGB, each half as large as the one before, down to one pixel."""
    repeats: bool = False
    """Whether it repeats beyond 0..1, as textures of meshes do."""

    @property
    def aspect(self) -> float:
        """Width divided by height."""
        height, width = self.levels[0].shape[:2]
        return float(width / height)


def surface_image(linear: NDArray[np.floating], *, repeats: bool = False) -> SurfaceImage:
    """An image with its pyramid, every level the mean over areas of the one before.

    Args:
        linear: [h, w, 3] linear RGB, 1 = white.
        repeats: as in `SurfaceImage`.
    """
    levels = [np.ascontiguousarray(linear, dtype=np.float32)]
    while max(levels[-1].shape[:2]) > 1 and len(levels) < MOST_LEVELS:
        height, width = levels[-1].shape[:2]
        half = (max(width // 2, 1), max(height // 2, 1))
        smaller = cv2.resize(levels[-1], half, interpolation=cv2.INTER_AREA)
        levels.append(np.asarray(smaller, dtype=np.float32).reshape(half[1], half[0], 3))
    return SurfaceImage(tuple(levels), repeats=repeats)


def decode_srgb(coded: NDArray[np.uint8]) -> Float32Array:
    """Linear light 0..1 of [..., 3] 8-bit values coded with the sRGB curve (IEC 61966-2-1)."""
    return _LINEAR[coded]


_LINEAR = transfer.decode_srgb(np.arange(256) / 255.0)


def light_of(coded: NDArray[np.uint8]) -> Float32Array:
    """`decode_srgb` of an image [h, w, 3], made smaller if a side is above `LARGEST_SIDE`."""
    height, width = coded.shape[:2]
    share = LARGEST_SIDE / max(height, width)
    if share >= 1.0:
        return decode_srgb(coded)
    size = (max(round(width * share), 1), max(round(height * share), 1))
    # Light is averaged, not its code; in whole numbers, half as large as float32.
    light = np.rint(_LINEAR * 65535.0).astype(np.uint16)[coded]
    smaller = cv2.resize(light, size, interpolation=cv2.INTER_AREA)
    return np.asarray(smaller / np.float32(65535.0), dtype=np.float32)


Float64Array = NDArray[np.float64]
Float32Array = NDArray[np.float32]
Colour = tuple[float, float, float]

FLATTEST = 1e-3
"""Least half extent of a mesh along any axis, as a share of its largest: a flat one has room."""


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles within the cube |x|, |y|, |z| <= 1; both sides are seen.

    Attributes are stored per corner, so that neighbours may share a place but not a normal.
    """

    vertices: Float64Array
    """[v, 3] places."""
    triangles: NDArray[np.int32]
    """[t, 3] vertex numbers."""
    normals: Float32Array
    """[t, 3, 3] unit normal at each corner."""
    colours: Float32Array
    """[t, 3, 3] linear RGB at each corner; multiplies the image where there is one."""
    uv: Float32Array
    """[t, 3, 2] place in the image at each corner: u right, v down."""
    image: NDArray[np.int32]
    """[t] index into `images`, -1 = none."""
    images: tuple[SurfaceImage, ...] = ()
    """Textures."""
    half: tuple[float, float, float] = (1.0, 1.0, 1.0)
    """Half extents before it was scaled into the cube."""


def make_mesh(
    vertices: Float64Array,
    triangles: NDArray[np.integer],
    *,
    normals: Float32Array | None = None,
    colours: Float32Array | Colour = (0.5, 0.5, 0.5),
    uv: Float32Array | None = None,
    image: NDArray[np.integer] | None = None,
    images: Sequence[SurfaceImage] = (),
) -> tuple[Mesh, Float64Array]:
    """A mesh moved into the unit cube, and the map that takes it back.

    Args:
        vertices: [v, 3] places, any unit.
        triangles: [t, 3] vertex numbers.
        normals: [t, 3, 3] at corners; None: flat ones.
        colours: [t, 3, 3] linear RGB at corners, or one colour.
        uv: [t, 3, 2] at corners; None: all 0.
        image: [t] index into `images`, -1 = none; None: none.
        images: textures.

    Returns:
        The mesh, and the [3, 4] map from its coordinates to those of `vertices`.

    Raises:
        InputError: there is no triangle with an area, a place is not finite, or a vertex number
            is out of range.
    """
    places = np.asarray(vertices, dtype=np.float64).reshape(-1, 3)
    corners = np.asarray(triangles, dtype=np.int32).reshape(-1, 3)
    if corners.size and not 0 <= corners.min() <= corners.max() < len(places):
        raise InputError(f"a triangle names a vertex outside 0..{len(places) - 1}")
    if not np.isfinite(places[corners]).all():
        raise InputError("a vertex has a coordinate that is not a finite number")
    flat = triangle_normals(places, corners)
    has_area = np.linalg.norm(flat, axis=1) > 0.0
    if not has_area.any():
        raise InputError("no triangle has an area")
    count = len(corners)
    shape = (count, 3, 3)
    given = np.broadcast_to(flat[:, None], shape) if normals is None else normals
    mesh = Mesh(
        vertices=places,
        triangles=corners,
        normals=_unit_or(np.asarray(given, dtype=np.float64), flat[:, None]),
        colours=np.array(np.broadcast_to(np.asarray(colours, dtype=np.float32), shape)),
        uv=np.zeros((count, 3, 2), np.float32) if uv is None else np.asarray(uv, np.float32),
        image=np.full(count, -1, np.int32) if image is None else np.asarray(image, np.int32),
        images=tuple(images),
    )
    names = ("triangles", "normals", "colours", "uv", "image")
    return _into_unit_cube(replace(mesh, **{name: getattr(mesh, name)[has_area] for name in names}))


def _into_unit_cube(mesh: Mesh) -> tuple[Mesh, Float64Array]:
    """The same mesh moved and scaled per axis into the unit cube, and the [3, 4] map back."""
    used = mesh.vertices[np.unique(mesh.triangles)]
    low, high = used.min(axis=0), used.max(axis=0)
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    half = np.maximum(half, FLATTEST * max(float(half.max()), 1e-12))
    normals = _unit_or(mesh.normals * half, np.array([0.0, 0.0, 1.0]))
    extents = (float(half[0]), float(half[1]), float(half[2]))
    vertices = (mesh.vertices - middle) / half
    placed = replace(mesh, vertices=vertices, normals=normals, half=extents)
    return placed, np.column_stack([np.diag(half), middle])


def triangle_normals(vertices: Float64Array, triangles: NDArray[np.int32]) -> Float64Array:
    """[t, 3] normals, as long as twice the triangles' areas."""
    first, second, third = (vertices[triangles[:, corner]] for corner in range(3))
    return np.asarray(np.cross(second - first, third - first))


def smooth_normals(
    vertices: Float64Array, triangles: NDArray[np.int32], crease_degrees: float = 40.0
) -> Float32Array:
    """[t, 3, 3] corner normals: means over the triangles around a place, up to a crease.

    Vertices at the same place count as one. A corner keeps its triangle's normal where the mean
    turns away from it by more than the crease angle.
    """
    _, same = np.unique(vertices.round(9), axis=0, return_inverse=True)
    corners = same.reshape(-1)[triangles]
    flat = triangle_normals(vertices, triangles)
    total = np.zeros((int(corners.max()) + 1, 3))
    np.add.at(total, corners.ravel(), np.repeat(flat, 3, axis=0))
    mean = _unit_or(total[corners], flat[:, None])
    own = _unit_or(np.broadcast_to(flat[:, None], mean.shape), np.array([0.0, 0.0, 1.0]))
    turns = (mean * own).sum(axis=2) < np.cos(np.radians(crease_degrees))
    mean[turns] = own[turns]
    return mean


@lru_cache(maxsize=KEPT_COLOURS)
def recoloured(mesh: Mesh, colour: Colour) -> Mesh:
    """The same mesh in one colour: what was brighter than its mean stays brighter."""
    weights = np.array([0.2126, 0.7152, 0.0722])
    tint = np.asarray(colour, dtype=np.float64)

    def tinted(values: Float32Array) -> Float32Array:
        luma = values @ weights
        share = luma / max(float(luma.mean()), 1e-3)
        return np.asarray(np.clip(share[..., None] * tint, 0.0, 1.0), dtype=np.float32)

    images = tuple(
        replace(one, levels=tuple(tinted(level) for level in one.levels)) for one in mesh.images
    )
    plain = tinted(mesh.colours)
    has_image = (mesh.image >= 0)[:, None, None]
    return replace(mesh, colours=np.where(has_image, np.float32(1.0), plain), images=images)


@lru_cache(maxsize=KEPT_COLOURS)
def mean_colour(mesh: Mesh) -> Colour:
    """Mean linear RGB of a mesh over its area."""
    corners = mesh.colours.astype(np.float64).mean(axis=1)
    texels = [np.ones(3), *(one.levels[-1].mean(axis=(0, 1)) for one in mesh.images)]
    sides = triangle_normals(mesh.vertices * mesh.half, mesh.triangles)
    areas = np.linalg.norm(sides, axis=1)
    mean = areas @ (corners * np.array(texels)[mesh.image + 1]) / areas.sum()
    return float(mean[0]), float(mean[1]), float(mean[2])


def _unit_or(vectors: Float64Array, otherwise: Float64Array) -> Float32Array:
    """Unit vectors; where one has no length, that of `otherwise`."""
    chosen = np.asarray(vectors, dtype=np.float64)
    length = np.linalg.norm(chosen, axis=-1, keepdims=True)
    chosen = np.where(length > 1e-12, chosen, otherwise)
    length = np.linalg.norm(chosen, axis=-1, keepdims=True)
    return np.asarray(chosen / np.maximum(length, 1e-300), dtype=np.float32)
