"""Meshes and scenes with one mesh, made by hand."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np
from tests.scenes.hand_scenes import day, look_at

from texvent.camera import PosedCamera
from texvent_scenes.mesh import Mesh, SurfaceImage, make_mesh, smooth_normals
from texvent_scenes.rendered_scene import Environment, Float64Array, Primitives, Shape


def ball(across: int = 24, down: int = 12) -> tuple[Float64Array, np.ndarray]:
    """A sphere of radius 1: [v, 3] vertices and [t, 3] triangles."""
    turn = 2.0 * np.pi * np.arange(across) / across
    rise = np.pi * np.arange(1, down) / down
    ring = np.stack(
        [
            np.outer(np.sin(rise), np.cos(turn)),
            np.outer(np.sin(rise), np.sin(turn)),
            np.outer(np.cos(rise), np.ones(across)),
        ],
        axis=-1,
    ).reshape(-1, 3)
    vertices = np.concatenate([ring, [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]])
    top, bottom = len(vertices) - 2, len(vertices) - 1
    triangles = []
    for i in range(across):
        j = (i + 1) % across
        triangles.append((top, i, j))
        for row in range(down - 2):
            a, b = row * across + i, row * across + j
            triangles += [(a, a + across, b + across), (a, b + across, b)]
        last = (down - 2) * across
        triangles.append((bottom, last + j, last + i))
    return vertices, np.array(triangles)


def ball_mesh(across: int = 24, down: int = 12) -> tuple[Mesh, Float64Array]:
    vertices, triangles = ball(across, down)
    return make_mesh(vertices, triangles, normals=smooth_normals(vertices, triangles))


def sheet(image: SurfaceImage) -> tuple[Mesh, Float64Array]:
    """A square in x and z, |x|, |z| <= 1, facing -y, that shows an image upright."""
    vertices = np.array([[-1.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.0, -1.0], [-1.0, 0.0, -1.0]])
    triangles = np.array([[0, 2, 1], [0, 3, 2]])
    places = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], dtype=np.float32)
    return make_mesh(
        vertices,
        triangles,
        colours=(1.0, 1.0, 1.0),
        uv=places[triangles],
        image=np.zeros(2, dtype=int),
        images=[image],
    )


def front(time_s: float) -> PosedCamera:
    del time_s
    return look_at((0.0, -4.0, 1.0), (0.0, 0.0, 1.0))


@dataclass(frozen=True)
class MeshScene:
    """One mesh, with its map to the coordinates around it, at a height of 1 m."""

    placed: tuple[Mesh, Float64Array]
    move: Callable[[float], Float64Array] = lambda time: np.eye(3, 4)
    camera_at: Callable[[float], PosedCamera] = front
    surroundings: Environment = field(default_factory=day)
    class_names: dict[int, str] = field(default_factory=lambda: {1: "thing"})
    others: tuple[Mesh, ...] = ()
    """Stand in the same place, before it in the scene's order."""

    def primitives(self, time_s: float) -> Primitives:
        mesh, to_body = self.placed
        move = self.move(time_s)
        to_world = move[:, :3] @ to_body
        to_world[:, 3] += move[:, 3] + [0.0, 0.0, 1.0]
        count = len(self.others) + 1
        meshes = np.empty(count, dtype=object)
        meshes[:] = [*self.others, mesh]
        return Primitives(
            shape=np.full(count, Shape.MESH, dtype=np.int8),
            to_world=np.repeat(to_world[None], count, axis=0),
            colour=np.ones((count, 3), dtype=np.float32),
            second_colour=np.ones((count, 3), dtype=np.float32),
            texture=np.zeros(count, dtype=np.int8),
            texture_scale=np.ones(count, dtype=np.float32),
            emission=np.zeros(count, dtype=np.float32),
            instance=np.ones(count, dtype=np.int32),
            mesh=meshes,
        )

    def camera(self, time_s: float) -> PosedCamera:
        return self.camera_at(time_s)

    def environment(self, time_s: float) -> Environment:
        return replace(self.surroundings, time_s=time_s)


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
