"""Meshes and images of a scene → the flat arrays that the kernels read."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.scenes.image import SurfaceImage
from texvent.scenes.mesh import Mesh
from texvent.scenes.raycast.meshes.tree import tree_of
from texvent.scenes.raycast.records import IMAGE_RECORD, NODE_RECORD, TRIANGLE_RECORD
from texvent.scenes.scene import Primitives

_FACE_AXES = ((1, 2), (1, 2), (0, 2), (0, 2), (1, 0), (1, 0))
"""Axes of a box's face that are the image's right and down, without their signs."""


class PackedSurfaces(NamedTuple):
    """All meshes and images of an instant."""

    nodes: NDArray[Any]
    triangles: NDArray[Any]
    images: NDArray[Any]
    texels: NDArray[np.float32]
    roots: dict[Mesh, int]
    """First node of each mesh."""
    numbers: dict[SurfaceImage, int]
    """Index of each image."""


def describe_surfaces(shapes: NDArray[Any], primitives: Primitives) -> PackedSurfaces | None:
    """Write which mesh and image each shape has into their records, and pack both.

    None: there are neither.
    """
    shapes["image"] = -1
    if primitives.mesh is None and primitives.image is None:
        return None
    count = len(shapes)
    meshes = primitives.mesh if primitives.mesh is not None else np.full(count, None)
    images = primitives.image if primitives.image is not None else np.full(count, None)
    packed = _pack(_distinct(meshes), _distinct(images))
    for index in np.flatnonzero(meshes != None):  # noqa: E711
        shapes["root"][index] = packed.roots[meshes[index]]
    for index in np.flatnonzero(images != None):  # noqa: E711
        image = images[index]
        face = 0 if primitives.image_face is None else int(primitives.image_face[index])
        lengths = np.linalg.norm(primitives.to_world[index, :, :3], axis=0)
        across, down = (lengths[axis] for axis in _FACE_AXES[face])
        ratio = across / max(down, 1e-12) / image.aspect
        shapes["image"][index], shapes["image_face"][index] = packed.numbers[image], face
        shapes["image_fit"][index] = max(ratio, 1.0), max(1.0 / max(ratio, 1e-12), 1.0)
    return packed


def _distinct(values: NDArray[np.object_]) -> tuple[Any, ...]:
    return tuple(dict.fromkeys(value for value in values if value is not None))


@lru_cache(maxsize=2)
def _pack(meshes: tuple[Mesh, ...], shown: tuple[SurfaceImage, ...]) -> PackedSurfaces:
    """Arrays of these meshes and images; kept, because most scenes have the same at all times."""
    own = [image for mesh in meshes for image in mesh.images]
    numbers = {image: index for index, image in enumerate(dict.fromkeys([*shown, *own]))}
    all_nodes, all_triangles, roots = [], [], {}
    node_count, triangle_count = 0, 0
    for mesh in meshes:
        tree = tree_of(mesh)
        nodes, triangles = tree.nodes.copy(), tree.triangles.copy()
        nodes["first"] += triangle_count
        nodes["second"] += node_count
        nodes["parent"] += np.where(nodes["parent"] < 0, 0, node_count)
        table = np.array([*(numbers[image] for image in mesh.images), -1])
        triangles["image"] = table[triangles["image"]]
        roots[mesh] = node_count
        all_nodes.append(nodes)
        all_triangles.append(triangles)
        node_count, triangle_count = node_count + len(nodes), triangle_count + len(triangles)
    images, texels = _pack_images(tuple(numbers))
    return PackedSurfaces(
        np.concatenate([np.zeros(0, NODE_RECORD), *all_nodes]),
        np.concatenate([np.zeros(0, TRIANGLE_RECORD), *all_triangles]),
        images,
        texels,
        roots,
        numbers,
    )


def _pack_images(images: Sequence[SurfaceImage]) -> tuple[NDArray[Any], NDArray[np.float32]]:
    records = np.zeros(len(images), dtype=IMAGE_RECORD)
    texels: list[NDArray[np.float32]] = [np.zeros(0, dtype=np.float32)]
    begin = 0
    for record, image in zip(records, images, strict=True):
        record["repeats"] = int(image.repeats)
        if image.checks is not None:
            record["checks"] = image.checks
            continue
        record["height"], record["width"] = image.levels[0].shape[:2]
        record["levels"] = len(image.levels)
        for number, level in enumerate(image.levels):
            record["start"][number] = begin
            texels.append(level.ravel())
            begin += level.size
    return records, np.concatenate(texels)
