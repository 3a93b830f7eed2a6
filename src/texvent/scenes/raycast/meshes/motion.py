"""Where points of meshes that deform go: a point keeps its weights in its triangle."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.scenes.raycast.meshes.tree import tree_of
from texvent.scenes.raycast.records import OwnedWorld, World
from texvent.scenes.raycast.trace import hit_again, ray_direction
from texvent.scenes.raycast.uncounted import uncounted_world
from texvent.scenes.raycast.vectors import turned
from texvent.scenes.scene import Float64Array, Primitives


def deforming_shapes(start: Primitives, stop: Primitives) -> NDArray[np.intp]:
    """Numbers of the shapes whose mesh is not the same at both instants."""
    if start.mesh is None or stop.mesh is None:
        return np.zeros(0, dtype=np.intp)
    pairs = zip(start.mesh, stop.mesh, strict=True)
    return np.flatnonzero([first is not second for first, second in pairs])


def follow_triangles(
    world: World | OwnedWorld,
    points: Float64Array,
    number: int,
    start: Primitives,
    stop: Primitives,
) -> Float64Array:
    """World points at the second instant of what a deforming mesh shows at the first.

    Args:
        world: the scene at the first instant.
        points: [k, 2] image points that show the mesh, pixels.
        number: its shape number.
        start: the shapes at the first instant.
        stop: the shapes at the second one.

    Returns:
        [k, 3] metres.
    """
    if not isinstance(world, OwnedWorld) or start.mesh is None or stop.mesh is None:
        return np.full((len(points), 3), np.nan)
    depth, face = np.empty(len(points)), np.empty(len(points), dtype=np.int64)
    places = np.empty((len(points), 3))
    cast_faces(world, np.ascontiguousarray(points), number, depth, face, places)
    first, leaf = start.mesh[number], int(world.shapes["root"][number])
    while world.nodes["count"][leaf] == 0:
        leaf += 1  # the first leaf of a tree owns its first triangle
    triangle = tree_of(first).order[face - world.nodes["first"][leaf]]
    corners = first.vertices[first.triangles[triangle]]
    weights = _weights(corners, places)
    second = stop.mesh[number]
    moved = (weights[:, :, None] * second.vertices[second.triangles[triangle]]).sum(axis=1)
    to_world = stop.to_world[number]
    return np.asarray(moved @ to_world[:, :3].T + to_world[:, 3])


def _weights(corners: Float64Array, places: Float64Array) -> Float64Array:
    """[k, 3] barycentric weights of [k, 3] places in triangles [k, 3, 3]."""
    second, third = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    normal = np.cross(second, third)
    square = (normal**2).sum(axis=1)
    offset = places - corners[:, 0]
    b = (np.cross(offset, third) * normal).sum(axis=1) / square
    c = (np.cross(second, offset) * normal).sum(axis=1) / square
    return np.stack([1.0 - b - c, b, c], axis=1)


@jit(error_model="numpy")
def cast_faces(
    owner: World | OwnedWorld,
    points: Float64Array,
    number: int,
    depth: Float64Array,
    face: NDArray[np.int64],
    places: Float64Array,
) -> None:
    """Where rays meet one shape.

    Args:
        owner: the scene.
        points: [k, 2] x and y, pixels.
        number: shape number.
        depth: [k] m, is written.
        face: [k] face, of a mesh triangle, is written.
        places: [k, 3] the point in the shape's coordinates, is written.
    """
    world = uncounted_world(owner)
    instant, shape = world.instant[0], world.shapes[number]
    for index in range(len(points)):
        x, y = points[index, 0], points[index, 1]
        depth[index], face[index] = hit_again(world, x, y, number)
        d = turned(shape.inverse, ray_direction(instant, x, y))
        for axis in range(3):
            places[index, axis] = shape.eye[axis] + depth[index] * d[axis]
