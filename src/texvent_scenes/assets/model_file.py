"""Meshes of GLB, OBJ and PLY files, read by trimesh."""

from __future__ import annotations

import json
import logging
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from texvent._require import require
from texvent.errors import FileFormatError, InputError, few, one_line, shown, warn
from texvent.runtime.memory import check_claim
from texvent_scenes.mesh import (
    Colour,
    Float32Array,
    Float64Array,
    Mesh,
    SurfaceImage,
    decode_srgb,
    light_of,
    make_mesh,
    smooth_normals,
    surface_image,
)

KEPT_FILES = 32
"""Read files that are kept."""
MOST_NODES = 10_000
"""Nodes of a GLB file; a car in all its parts has some thousand."""
FARTHEST = 1e15
"""Coordinates of vertices, in the file's unit, are below this."""
IMAGE_FORMATS = ("PNG", "JPEG", "WEBP", "BMP", "TIFF", "TGA", "GIF", "DDS")
"""Pillow also opens formats that other programs would have to draw, such as EPS."""
VALUE_BYTES = 64
"""Largest item of an accessor: a 4x4 matrix of floats."""
TRIANGLE_BYTES = 300
"""Size of a triangle while it is read: corners with normals, colours and places in the image."""
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
        FileFormatError: it is damaged, has no triangle with an area, or would fill the memory.

    Warns:
        TexventWarning: a file that it names, such as an image, is not in its folder or below.
    """
    del changed_ns
    trimesh: Any = require("trimesh", extra="assets")
    require("PIL.Image", extra="assets")
    beside = _Beside(path.parent)
    try:
        if path.suffix.lower() == ".glb":
            _check_glb(path)
        with _images_of_any_size():
            loaded = trimesh.load(str(path), process=False, resolver=beside)
        is_scene = isinstance(loaded, trimesh.Scene)
        drawn = [loaded.graph[node][1] for node in loaded.graph.nodes_geometry] if is_scene else []
        meshes = [loaded.geometry[name] for name in drawn] if is_scene else [loaded]
        triangles = sum(len(getattr(mesh, "faces", ())) for mesh in meshes)
        check_claim(triangles * TRIANGLE_BYTES, path)
        for mesh in loaded.geometry.values() if is_scene else meshes:
            _check_image(_image_of(getattr(getattr(mesh, "visual", None), "material", None)), path)
        parts = loaded.dump() if is_scene else [loaded]
        is_linear = path.suffix.lower() == ".glb"  # colours as numbers; OBJ and PLY have sRGB
        surfaces = [
            surface
            for part in parts
            if isinstance(part, trimesh.Trimesh) and len(part.faces)
            and (surface := _surface(part, is_linear, path)) is not None
        ]  # fmt: skip
    except FileFormatError:
        raise
    except Exception as error:
        raise FileFormatError(f"{path} cannot be read as a model: {one_line(error)}") from error
    if beside.missing:
        warn(
            f"{path} names {few(list(map(shown, beside.missing)))}, which is not in its folder or "
            "below; the model is drawn without it"
        )
    if not surfaces:
        raise FileFormatError(f"{path} has no triangles")
    try:
        return _joined(surfaces)
    except InputError as error:
        raise FileFormatError(f"{path}: {error}") from error


class _Beside:
    """Files in a model's folder and below; a model reaches no other, and none in the network."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder.resolve()
        self.missing: list[str] = []

    def get(self, name: str) -> bytes:
        """A file by the name in the model, or by the last part of that name, as trimesh does."""
        for one in (name.strip(), name.replace("\\", "/").rpartition("/")[2].strip()):
            path = (self._folder / one).resolve()
            if path.is_relative_to(self._folder) and path.is_file():
                return path.read_bytes()
        self.missing.append(name)
        raise FileNotFoundError(name)

    __getitem__ = get


@contextmanager
def _images_of_any_size() -> Iterator[None]:
    """Pillow opens large images too: trimesh would hide its refusal; `check_claim` judges them."""
    logging.getLogger("trimesh").addHandler(logging.NullHandler())  # a file lacks: see `missing`
    images: Any = require("PIL.Image", extra="assets")
    most, images.MAX_IMAGE_PIXELS = images.MAX_IMAGE_PIXELS, None
    try:
        yield
    finally:
        images.MAX_IMAGE_PIXELS = most


def _check_glb(path: Path) -> None:
    """Refuse a GLB file of too many nodes, or of arrays that would fill the memory."""
    with path.open("rb") as file:
        length = int.from_bytes(file.read(20)[12:16], "little")
        head = json.loads(file.read(length))
    if len(head.get("nodes", ())) > MOST_NODES:
        raise FileFormatError(
            f"{path} has {len(head['nodes'])} nodes; {MOST_NODES} are the most, so join its parts"
        )
    counts = (int(one["count"]) for one in head.get("accessors", ()))
    check_claim(sum(counts) * VALUE_BYTES, path)


def _surface(part: Any, is_linear: bool, path: Path) -> _Surface | None:
    """A part's surface; None: it is clear."""
    vertices = np.asarray(part.vertices, dtype=np.float64)
    corners = np.asarray(part.faces)
    if not 0 <= corners.min() <= corners.max() < len(vertices):
        raise FileFormatError(f"{path}: a triangle names a vertex outside 0..{len(vertices) - 1}")
    if not (np.abs(vertices[corners]) < FARTHEST).all():
        raise FileFormatError(f"{path}: a coordinate is not a number below {FARTHEST:g}")
    corners = corners.astype(np.int32)
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
    image = _image_of(material)
    coded = np.asarray(material.main_color, dtype=np.uint8)
    red, green, blue = (float(value) for value in _linear(coded[:3], is_linear))
    is_blended = getattr(material, "alphaMode", None) == "BLEND" or not is_linear
    alpha = float(coded[3]) / 255.0 if len(coded) > 3 and is_blended else 1.0
    if image is None:
        return (red, green, blue), alpha, None
    surface = surface_image(light_of(_pixels(image)), repeats=True)
    return (red, green, blue) if is_linear else (1.0, 1.0, 1.0), alpha, surface


def _image_of(material: Any) -> Any:
    """The image of a material, Pillow's, or None."""
    return getattr(material, "image", None) or getattr(material, "baseColorTexture", None)


def _check_image(image: Any, path: Path) -> None:
    """Refuse an image that is not decoded yet, if it would fill the memory or run a program."""
    if image is None or image.format is None:  # made by trimesh
        return
    if image.format not in IMAGE_FORMATS:
        raise FileFormatError(
            f"{path}: an image of it is {image.format}; read are {', '.join(IMAGE_FORMATS)}"
        )
    check_claim(image.width * image.height * 4, path, copies=3)


def _pixels(image: Any) -> np.ndarray:
    """[h, w, 3] 8-bit colours of an image of Pillow's."""
    if image.mode.startswith("I"):  # Pillow would cut 16 bits off at 255
        grey = np.clip(np.asarray(image) // 257, 0, 255).astype(np.uint8)
        return np.repeat(grey[..., None], 3, axis=2)
    return np.asarray(image.convert("RGB"), dtype=np.uint8)


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
