"""Ray meets mesh, said as plainly as possible in NumPy: every triangle, one after the other."""

from __future__ import annotations

import numpy as np

from texvent.scenes.mesh import Float64Array, Mesh


def hit_mesh_reference(mesh: Mesh, origins: Float64Array, directions: Float64Array) -> Float64Array:
    """Ray parameters at which rays first meet a mesh from either side.

    Solves origin + t · direction = a + u · (b - a) + v · (c - a) for every triangle.

    Args:
        mesh: the mesh.
        origins: [k, 3] ray origins, in its coordinates.
        directions: [k, 3] ray directions, any length but 0.

    Returns:
        [k] parameters > 0; inf where a ray misses.
    """
    best = np.full(len(origins), np.inf)
    for a, b, c in mesh.vertices[mesh.triangles]:
        sides = np.column_stack([b - a, c - a])
        matrices = np.concatenate(
            [np.broadcast_to(sides, (len(origins), 3, 2)), -directions[:, :, None]], axis=2
        )
        crossing = np.abs(np.linalg.det(matrices)) > 1e-14
        solved = np.full((len(origins), 3), np.nan)
        right_hand = (origins - a)[crossing, :, None]
        solved[crossing] = np.linalg.solve(matrices[crossing], right_hand)[..., 0]
        u, v, t = solved.T
        hit = (u >= 0.0) & (v >= 0.0) & (u + v <= 1.0) & (t > 0.0)
        best = np.where(hit & (t < best), t, best)
    return best
