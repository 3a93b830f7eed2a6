"""Meshes of GLB, OBJ and PLY files, read by trimesh."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from texvent._require import require
from texvent.errors import FileFormatError, InputError, one_line
from texvent.scenes.mesh import (
    Colour,
    Float32Array,
    Float64Array,
    Mesh,
    SurfaceImage,
    decode_srgb,
    make_mesh,
    recoloured,
    smooth_normals,
    surface_image,
)

KEPT_FILES = 32
"""Read files that are kept."""
_CLEAR = 0.4
"""Surfaces less opaque than this are left out: panes of glass."""
_GREY: Colour = (0.5, 0.5, 0.5)


@dataclass(frozen=True, eq=False)
class _Surface:
    """Triangles with one material, per corner where needed; units and axes are the file's."""

    vertices: Float64Array
    """[v, 3]."""
    triangles: np.ndarray
    """[t, 3]."""
    normals: Float32Array
    """[t, 3, 3] at corners."""
    colours: Float32Array
    """[t, 3, 3] linear RGB at corners."""
    uv: Float32Array
    """[t, 3, 2] at corners, v down."""
    image: SurfaceImage | None


@lru_cache(maxsize=KEPT_FILES)
def load_mesh(path: Path, changed_ns: int) -> tuple[Mesh, Float64Array]:
    """The mesh of a file, and the [3, 4] map from it to the file's coordinates.

    Args:
        path: ends in .glb, .obj or .ply.
        changed_ns: when it was last changed; another time reads it anew.

    Raises:
        MissingDependencyError: trimesh is not installed.
        FileFormatError: the file is damaged, or has no triangle with an area.
    """
    del changed_ns
    trimesh: Any = require("trimesh", extra="assets")
    require("PIL.Image", extra="assets")
    try:
        loaded = trimesh.load(str(path), process=False)
        parts = loaded.dump() if isinstance(loaded, trimesh.Scene) else [loaded]
        is_linear = path.suffix.lower() == ".glb"  # colours as numbers; OBJ and PLY have sRGB
        surfaces = [
            surface
            for part in parts
            if isinstance(part, trimesh.Trimesh) and len(part.faces)
            and (surface := _surface(part, is_linear)) is not None
        ]  # fmt: skip
    except Exception as error:
        raise FileFormatError(f"{path} cannot be read as a model: {one_line(error)}") from error
    if not surfaces:
        raise FileFormatError(f"{path} has no triangles")
    try:
        return _joined(surfaces)
    except InputError as error:
        raise FileFormatError(f"{path}: {error}") from error


def _surface(part: Any, is_linear: bool) -> _Surface | None:
    """A part's surface; None: it is clear."""
    vertices = np.asarray(part.vertices, dtype=np.float64)
    corners = np.asarray(part.faces, dtype=np.int32)
    colour, alpha, image = _material(part.visual, is_linear)
    if alpha < _CLEAR:
        return None
    colours = np.broadcast_to(np.array(colour, dtype=np.float32), (*corners.shape, 3))
    if part.visual.kind == "vertex":
        coded = np.asarray(part.visual.vertex_colors)[:, :3].astype(np.uint8)
        colours = _linear(coded, is_linear)[corners]
    uv = np.zeros((*corners.shape, 2), np.float32)
    given = getattr(part.visual, "uv", None)
    if given is None or len(given) != len(vertices):
        image = None
    else:
        uv = np.asarray(np.asarray(given) * [1, -1] + [0, 1], np.float32)[corners]
    normals = smooth_normals(vertices, corners)
    if "vertex_normals" in part._cache:
        normals = np.asarray(part.vertex_normals, dtype=np.float32)[corners]
    return _Surface(vertices, corners, normals, colours, uv, image)


def _material(visual: Any, is_linear: bool) -> tuple[Colour, float, SurfaceImage | None]:
    """Linear colour, opacity and image of a part; an image's colour is multiplied by the first."""
    material = getattr(visual, "material", None)
    if material is None:
        return _GREY, 1.0, None
    image = getattr(material, "image", None) or getattr(material, "baseColorTexture", None)
    coded = np.asarray(material.main_color, dtype=np.uint8)
    red, green, blue = (float(value) for value in _linear(coded[:3], is_linear))
    is_blended = getattr(material, "alphaMode", None) == "BLEND" or not is_linear
    alpha = float(coded[3]) / 255.0 if len(coded) > 3 and is_blended else 1.0
    if image is None:
        return (red, green, blue), alpha, None
    pixels = np.asarray(image.convert("RGB"), dtype=np.uint8)
    shown = surface_image(decode_srgb(pixels), repeats=True)
    return (red, green, blue) if is_linear else (1.0, 1.0, 1.0), alpha, shown


def _linear(coded: np.ndarray, is_linear: bool) -> Float32Array:
    """Linear light of 8-bit numbers."""
    return coded.astype(np.float32) / np.float32(255.0) if is_linear else decode_srgb(coded)


def _joined(surfaces: Sequence[_Surface]) -> tuple[Mesh, Float64Array]:
    """All surfaces as one mesh, and the map from it."""
    images = list(dict.fromkeys(one.image for one in surfaces if one.image is not None))
    firsts = np.cumsum([0, *(len(one.vertices) for one in surfaces)])
    numbers = [-1 if one.image is None else images.index(one.image) for one in surfaces]
    return make_mesh(
        np.concatenate([one.vertices for one in surfaces]),
        np.concatenate(
            [one.triangles + first for one, first in zip(surfaces, firsts, strict=False)]
        ),
        normals=np.concatenate([one.normals for one in surfaces]),
        colours=np.concatenate([one.colours for one in surfaces]),
        uv=np.concatenate([one.uv for one in surfaces]),
        image=np.repeat(numbers, [len(one.triangles) for one in surfaces]),
        images=images,
    )


@lru_cache(maxsize=KEPT_FILES)
def painted(mesh: Mesh, colour: Colour) -> Mesh:
    """The mesh in a colour, made once."""
    return recoloured(mesh, colour)
