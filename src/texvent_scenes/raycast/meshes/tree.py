"""Bounding-volume hierarchy of a mesh (Numba).

A binary tree in depth-first order: a node's first child follows it, and each node has the number of
the one after its last.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent_scenes.mesh import Float64Array, Mesh, SurfaceImage, triangle_normals
from texvent_scenes.raycast.records import (
    IMAGE_RECORD,
    NODE_RECORD,
    TRIANGLE_RECORD,
    PackedSurfaces,
)
from texvent_scenes.rendered_scene import Primitives

LEAF_TRIANGLES = 4
"""Triangles in a leaf at most, unless they cannot be told apart."""
_THIN_SHARE = 0.15
"""A mesh counts as thin as this share of its surface: chair legs count, a door handle does not."""
FACE_CODES = 60
"""Numbers that tell neighbouring parts of a mesh apart: 6 directions, 10 patches."""
_AXES = 6


@dataclass(frozen=True, eq=False)
class MeshTree:
    """A mesh as the kernels read it, on its own: indices count from its first node or triangle."""

    nodes: NDArray[Any]
    """[k] `NODE_RECORD`."""
    triangles: NDArray[Any]
    """[t] `TRIANGLE_RECORD`, in the order of the leaves."""
    half_width: float
    """Half the thickness of what is thin in it, as a share of its largest half extent."""


_TREES: WeakKeyDictionary[Mesh, MeshTree] = WeakKeyDictionary()


def tree_of(mesh: Mesh) -> MeshTree:
    """The tree of a mesh, built once."""
    found = _TREES.get(mesh)
    if found is None:
        found = _TREES[mesh] = _build(mesh)
    return found


def _build(mesh: Mesh) -> MeshTree:
    corners = np.ascontiguousarray(mesh.vertices[mesh.triangles])
    low, high = corners.min(axis=1), corners.max(axis=1)
    nodes = np.zeros(2 * len(corners), dtype=NODE_RECORD)
    order = np.arange(len(corners))
    count = build_nodes(low, high, 0.5 * (low + high), order, nodes)
    triangles = np.zeros(len(corners), dtype=TRIANGLE_RECORD)
    patches = patch_numbers(mesh)
    flat = triangle_normals(mesh.vertices, mesh.triangles)
    axis = np.abs(flat).argmax(axis=1)
    direction = 2 * axis + (np.take_along_axis(flat, axis[:, None], 1)[:, 0] > 0.0)
    triangles["corner"] = corners[order]
    triangles["normal"] = mesh.normals[order]
    triangles["uv"], triangles["colour"] = mesh.uv[order], mesh.colours[order]
    triangles["image"] = mesh.image[order]
    triangles["code"] = (direction + _AXES * (patches % (FACE_CODES // _AXES)))[order]
    return MeshTree(nodes[:count].copy(), triangles, _half_width(mesh, corners, patches))


def _half_width(mesh: Mesh, unit_corners: Float64Array, patches: NDArray[np.int64]) -> float:
    """Half thickness that `_THIN_SHARE` of the surface is at most, from its patches' boxes."""
    corners = unit_corners * (np.array(mesh.half) / max(mesh.half))
    count = int(patches.max()) + 1
    low, high = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
    np.minimum.at(low, patches, corners.min(axis=1))
    np.maximum.at(high, patches, corners.max(axis=1))
    sides = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = np.bincount(patches, np.linalg.norm(sides, axis=1), count)
    # Of the three extents the middle one: a patch is flat, a leg's side is long and narrow.
    width = 0.5 * np.sort(high - low, axis=1)[:, 1]
    rank = np.argsort(width, kind="stable")
    share = np.cumsum(area[rank]) / area.sum()
    return float(width[rank[np.searchsorted(share, _THIN_SHARE)]])


def patch_numbers(mesh: Mesh) -> NDArray[np.int64]:
    """[t] number of the smooth patch each triangle belongs to; creases and images bound patches."""
    _, places = np.unique(mesh.vertices.round(9), axis=0, return_inverse=True)
    corner = places.reshape(-1)[mesh.triangles]
    start, stop = corner[:, [0, 1, 2]], corner[:, [1, 2, 0]]
    swapped = start > stop
    edges = np.stack([np.minimum(start, stop), np.maximum(start, stop)], axis=-1).reshape(-1, 2)
    normals = np.stack([mesh.normals[:, [0, 1, 2]], mesh.normals[:, [1, 2, 0]]], axis=2)
    normals = np.where(swapped[..., None, None], normals[:, :, ::-1], normals).reshape(-1, 6)
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    first, second = order[:-1], order[1:]
    owner = np.repeat(np.arange(len(corner)), 3)
    joined = (edges[first] == edges[second]).all(axis=1)
    joined &= np.abs(normals[first] - normals[second]).max(axis=1) < 1e-3
    joined &= mesh.image[owner[first]] == mesh.image[owner[second]]
    label = np.arange(len(corner))
    join_labels(label, owner[first[joined]], owner[second[joined]])
    return np.unique(label, return_inverse=True)[1].reshape(-1)


@jit(error_model="numpy")
def join_labels(
    label: NDArray[np.int64], first: NDArray[np.int64], second: NDArray[np.int64]
) -> None:
    """Give joined items the same label: the least item of their group (union-find)."""
    for index in range(len(first)):
        a, b = first[index], second[index]
        while label[a] != a:
            label[a] = label[label[a]]
            a = label[a]
        while label[b] != b:
            label[b] = label[label[b]]
            b = label[b]
        if a < b:
            label[b] = a
        else:
            label[a] = b
    for item in range(len(label)):
        label[item] = label[label[item]]


@jit(error_model="numpy")
def build_nodes(
    low: Float64Array,
    high: Float64Array,
    middle: Float64Array,
    order: NDArray[np.int64],
    nodes: NDArray[Any],
) -> int:
    """Build the tree of boxes, split at the middle of the longest side of their middles' box.

    Args:
        low: [t, 3] least corner of each triangle's box.
        high: [t, 3] its greatest corner.
        middle: [t, 3] its middle.
        order: [t] triangle numbers; is sorted so that each leaf owns a range.
        nodes: [at least 2 t - 1] `NODE_RECORD` is written.

    Returns:
        How many nodes there are.
    """
    pending = np.empty((128, 3), dtype=np.int64)  # first, one past the last, the node it is in
    pending[0, 0], pending[0, 1], pending[0, 2] = 0, len(order), -1
    height, count = 1, 0
    parents = np.full(len(nodes), -1, dtype=np.int64)
    while height:
        height -= 1
        start, stop = pending[height, 0], pending[height, 1]
        node, parents[count] = nodes[count], pending[height, 2]
        part = order[start:stop]
        least, most = np.full(3, math.inf), np.full(3, -math.inf)
        node.low[:], node.high[:] = math.inf, -math.inf
        for item in part:
            for axis in range(3):
                node.low[axis] = min(node.low[axis], low[item, axis])
                node.high[axis] = max(node.high[axis], high[item, axis])
                least[axis] = min(least[axis], middle[item, axis])
                most[axis] = max(most[axis], middle[item, axis])
        axis = int((most - least).argmax())
        is_second = middle[part, axis] > 0.5 * (least[axis] + most[axis])
        seconds = is_second.sum()
        if len(part) <= LEAF_TRIANGLES or seconds == 0 or height > len(pending) - 2:
            node.first, node.count = start, len(part)
        else:
            sorted_part = part[np.argsort(is_second, kind="mergesort")]
            part[:] = sorted_part
            for first, last in ((stop - seconds, stop), (start, stop - seconds)):
                pending[height, 0], pending[height, 1], pending[height, 2] = first, last, count
                height += 1
        count += 1
    for number in range(count - 1, -1, -1):
        nodes[number].skip = max(nodes[number].skip, number + 1)
        if parents[number] >= 0:
            parent = nodes[parents[number]]
            parent.skip = max(parent.skip, nodes[number].skip)
    return count


def describe_surfaces(shapes: NDArray[Any], primitives: Primitives) -> PackedSurfaces:
    """Write which mesh and image each shape has into their records, and pack both."""
    shapes["image"] = -1
    count = len(shapes)
    meshes = primitives.mesh if primitives.mesh is not None else np.full(count, None)
    images = primitives.image if primitives.image is not None else np.full(count, None)
    packed = _pack(_distinct(meshes), _distinct(images))
    for index in np.flatnonzero(meshes != None):  # noqa: E711
        shapes["root"][index] = packed.roots[meshes[index]]
    for index in np.flatnonzero(images != None):  # noqa: E711
        image = images[index]
        lengths = np.linalg.norm(primitives.to_world[index, :, :3], axis=0)
        ratio = lengths[1] / max(lengths[2], 1e-12) / image.aspect
        shapes["image"][index] = packed.numbers[image]
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
        nodes["skip"] += node_count
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
        record["height"], record["width"] = image.levels[0].shape[:2]
        record["levels"] = len(image.levels)
        for number, level in enumerate(image.levels):
            record["start"][number] = begin
            texels.append(level.ravel())
            begin += level.size
    return records, np.concatenate(texels)
