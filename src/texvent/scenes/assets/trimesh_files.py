"""OBJ and PLY files, read by trimesh."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from texvent._require import require
from texvent.errors import FileFormatError, one_line
from texvent.scenes.assets.figure import RigidFigure, Surface
from texvent.scenes.image import SurfaceImage, decode_srgb, surface_image

_CLEAR = 0.4
"""Surfaces less opaque than this are left out: panes of glass."""


def load_with_trimesh(path: Path) -> RigidFigure:
    """The model of an OBJ or PLY file.

    Raises:
        MissingDependencyError: trimesh is not installed.
        FileFormatError: the file is damaged.
        InputError: it has no triangle with an area.
    """
    trimesh: Any = require("trimesh", extra="assets")
    require("PIL.Image", extra="assets")
    try:
        loaded = trimesh.load(str(path), process=False)
        parts = loaded.dump() if isinstance(loaded, trimesh.Scene) else [loaded]
        surfaces = [_surface(part) for part in parts if isinstance(part, trimesh.Trimesh)]
    except Exception as error:
        raise FileFormatError(f"{path} cannot be read as a model: {one_line(error)}") from error
    kept = [surface for surface in surfaces if surface is not None]
    if not kept:
        raise FileFormatError(f"{path} has no triangles")
    return RigidFigure(kept)


def _surface(part: Any) -> Surface | None:
    vertices = np.asarray(part.vertices, dtype=np.float64)
    if not len(part.faces):
        return None
    given = "vertex_normals" in part._cache
    colour, alpha, image = _material(part.visual)
    if alpha < _CLEAR:
        return None
    uv = getattr(part.visual, "uv", None)
    has_uv = uv is not None and len(uv) == len(vertices)
    colours = None
    if part.visual.kind == "vertex":
        colours = decode_srgb(np.asarray(part.visual.vertex_colors)[:, :3].astype(np.uint8))
        colour = (1.0, 1.0, 1.0)
    return Surface(
        vertices,
        np.asarray(part.faces),
        normals=np.asarray(part.vertex_normals, dtype=np.float32) if given else None,
        uv=np.asarray(np.asarray(uv) * [1, -1] + [0, 1], np.float32) if has_uv else None,
        colours=colours,
        colour=colour,
        image=image if has_uv else None,
    )


def _material(visual: Any) -> tuple[tuple[float, float, float], float, SurfaceImage | None]:
    """Linear colour, opacity and image of a part."""
    material = getattr(visual, "material", None)
    if material is None:
        return (0.5, 0.5, 0.5), 1.0, None
    image = getattr(material, "image", None) or getattr(material, "baseColorTexture", None)
    coded = np.asarray(material.main_color, dtype=np.uint8)
    red, green, blue = (float(value) for value in decode_srgb(coded[:3]))
    alpha = float(coded[3]) / 255.0 if len(coded) > 3 else 1.0
    if image is None:
        return (red, green, blue), alpha, None
    pixels = np.asarray(image.convert("RGB"), dtype=np.uint8)
    return (1.0, 1.0, 1.0), alpha, surface_image(decode_srgb(pixels), repeats=True)
