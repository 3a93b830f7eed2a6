"""Meshes in the ray caster: hits against brute force, no cracks, exact motion, pictures."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples
from tests.scenes.raycast.meshes.mesh_scenes import (
    MeshScene,
    ball,
    ball_mesh,
    hit_mesh_reference,
)

from texvent.errors import InputError
from texvent.runtime.jit import jit
from texvent.sensor import SensorSize
from texvent_scenes.mesh import (
    make_mesh,
    mean_colour,
    recoloured,
    smooth_normals,
    surface_image,
    triangle_normals,
)
from texvent_scenes.raycast.ground_truth import ground_truth
from texvent_scenes.raycast.meshes.hit import hit_mesh, mesh_normals
from texvent_scenes.raycast.meshes.tree import join_labels, tree_of
from texvent_scenes.raycast.render import world_at

SIZE = SensorSize(48, 36)


@jit(error_model="numpy")
def cast_many(instants, root, origins, directions, any_hit, depth, triangle):
    for k in range(len(origins)):
        o = (origins[k, 0], origins[k, 1], origins[k, 2])
        d = (directions[k, 0], directions[k, 1], directions[k, 2])
        depth[k], triangle[k] = hit_mesh(instants[0], root, o, d, 0.0, any_hit)


def cast(mesh, origins, directions, *, any_hit=False, others=()):
    """Depth and triangle of rays that meet a mesh, which other meshes of the scene come before."""
    world = world_at(MeshScene((mesh, np.eye(3, 4)), others=others), 0.0, SIZE)
    root = sum(len(tree_of(one).nodes) for one in others)
    depth, triangle = np.empty(len(origins)), np.empty(len(origins), dtype=np.int64)
    cast_many(world.instant, root, origins, directions, any_hit, depth, triangle)
    return depth, triangle - sum(len(one.triangles) for one in others)


def soup(seed, count):
    """Random triangles, some of them flat along an axis, some with a side in common."""
    rng = np.random.default_rng(seed)
    vertices = rng.normal(size=(count + 2, 3))
    vertices[rng.random(vertices.shape) < 0.15] = 0.5
    triangles = np.stack([rng.permutation(count + 2)[:3] for _ in range(count)])
    return make_mesh(vertices, triangles)[0]


def rays(seed, count):
    rng = np.random.default_rng([seed, 1])
    origins = rng.normal(size=(count, 3)) * 2.0
    directions = rng.uniform(-1.0, 1.0, size=(count, 3)) - origins
    directions[rng.random(directions.shape) < 0.05] = 0.0
    directions[(directions == 0.0).all(axis=1)] = (0.0, 0.0, 1.0)
    return origins, directions


@given(seed=st.integers(0, 2**31), count=st.integers(1, 60), before=st.integers(0, 2))
@examples(40)
def test_the_tree_finds_what_all_triangles_say(seed, count, before):
    mesh, others = soup(seed, count), tuple(soup(seed + 1 + one, 9) for one in range(before))
    origins, directions = rays(seed, 60)
    depth, triangle = cast(mesh, origins, directions, others=others)
    expected = hit_mesh_reference(mesh, origins, directions)
    same = np.isclose(depth, expected, rtol=1e-9, atol=1e-12) | (depth == expected)
    # A ray that grazes an edge may be decided either way by rounding.
    nudged = hit_mesh_reference(mesh, origins + 1e-9, directions)
    assert (same | (np.isinf(expected) != np.isinf(nudged)) | ~np.isclose(expected, nudged)).all()
    is_hit = np.isfinite(depth)
    assert ((triangle >= 0) & (triangle < len(mesh.triangles)))[is_hit].all()
    blocked = cast(mesh, origins, directions, any_hit=True, others=others)[0]
    np.testing.assert_array_equal(np.isinf(blocked), np.isinf(depth))


def test_no_ray_slips_between_triangles_at_vertices_and_edges():
    mesh, _ = ball_mesh(16, 8)
    corners = mesh.vertices[mesh.triangles]
    targets = np.concatenate(
        [mesh.vertices, corners.mean(axis=1), 0.5 * (corners[:, 0] + corners[:, 1])]
    )
    targets = 0.98 * targets
    for origin in ((0.0, 0.0, 0.0), (0.1, 0.2, -0.3)):
        origins = np.broadcast_to(np.array(origin), targets.shape).copy()
        depth, _ = cast(mesh, origins, targets - origins)
        assert np.isfinite(depth).all()


@given(st.lists(st.tuples(st.integers(0, 11), st.integers(0, 11)), max_size=14))
def test_joined_items_have_the_least_number_of_their_group(pairs):
    label = np.arange(12)
    join_labels(label, *np.array(pairs, np.int64).reshape(-1, 2).T.copy())
    groups = [{item} for item in range(12)]
    for pair in pairs:
        joined = set.union(*(groups[one] for one in pair))
        for item in joined:
            groups[item] = joined
    assert label.tolist() == [*map(min, groups)]


def test_meshes_that_are_none_are_refused_in_one_line():
    corners = np.eye(3)
    with pytest.raises(InputError, match="no triangle has an area"):
        make_mesh(corners, np.array([[0, 1, 1]]))
    with pytest.raises(InputError, match="vertex outside"):
        make_mesh(corners, np.array([[0, 1, 3]]))
    with pytest.raises(InputError, match="not a finite number"):
        make_mesh(corners * np.nan, np.array([[0, 1, 2]]))


def turning(time_s):
    c, s = math.cos(time_s), math.sin(time_s)
    return np.array([[c, -s, 0.0, 0.2 * time_s], [s, c, 0.0, 0.0], [0.0, 0.0, 1.0, -0.1 * time_s]])


def project(camera, points, size):
    seen = (points - camera.position) @ camera.rotation.T
    scale = camera.focal * size.width
    return seen[:, :2] / seen[:, 2:] * scale + [0.5 * size.width, 0.5 * size.height]


def first_triangle(corners, origin, direction):
    """Triangle, weights and depth where a ray first meets [t, 3, 3] corners, by brute force."""
    sides = np.stack([corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]], axis=2)
    minus = np.broadcast_to(-direction[:, None], (len(corners), 3, 1))
    matrices = np.concatenate([sides, minus], axis=2)
    u, v, t = np.linalg.solve(matrices, (origin - corners[:, 0])[..., None])[..., 0].T
    met = (u >= 0.0) & (v >= 0.0) & (u + v <= 1.0) & (t > 0.0)
    one = int(np.argmin(np.where(met, t, np.inf)))
    return one, np.array([1.0 - u[one] - v[one], u[one], v[one]]), t[one]


def world_corners(scene, time):
    primitives = scene.primitives(time)
    to_world, mesh = primitives.to_world[0], primitives.mesh[0]
    return (mesh.vertices @ to_world[:, :3].T + to_world[:, 3])[mesh.triangles]


def test_flow_of_a_mesh_follows_its_triangles():
    """Flow and depth of pixel centres, against points followed by brute force."""
    scene = MeshScene(ball_mesh(), turning)
    size, times = SensorSize(40, 30), (0.0, 0.25)
    truth = ground_truth(scene, *times, size)
    start, stop = (world_corners(scene, time) for time in times)
    camera = scene.camera(0.0)
    rows, columns = np.nonzero(truth.instance == 1)
    assert len(rows) > 100
    for row, column in zip(rows[::7], columns[::7], strict=True):
        place = (np.array([column, row]) + 0.5 - [20.0, 15.0]) / (camera.focal * size.width)
        direction = np.array([*place, 1.0]) @ camera.rotation
        one, weights, depth = first_triangle(start, camera.position, direction)
        assert truth.depth[row, column] == pytest.approx(depth, rel=1e-6)
        moved = project(scene.camera(times[1]), (weights @ stop[one])[None], size)[0]
        expected = moved - [column + 0.5, row + 0.5]
        np.testing.assert_allclose(truth.flow[row, column], expected, atol=1e-4)


@given(half=st.tuples(*3 * [st.floats(0.2, 5.0)]), across=st.integers(20, 40))
@examples(12)
def test_smooth_normals_are_those_of_the_surface_that_triangles_stand_for(half, across):
    """A sphere's are its places; of one that is stretched they go with the gradient."""
    vertices, triangles = ball(across, across // 2)
    normals = smooth_normals(vertices, triangles)
    assert (normals * vertices[triangles]).sum(axis=2).min() > 0.99
    mesh, to_file = make_mesh(vertices * half, triangles, normals=normals / np.float32(half))
    inverse = np.linalg.inv(to_file[:, :3])
    turned = mesh.normals.astype(np.float64) @ inverse  # a normal goes by the transposed inverse
    turned /= np.linalg.norm(turned, axis=2, keepdims=True)
    gradient = normals / np.array(half)
    gradient /= np.linalg.norm(gradient, axis=2, keepdims=True)
    np.testing.assert_allclose(turned, gradient, atol=1e-5)


@jit(error_model="numpy")
def normals_of(instants, triangles, points, smooth, flat):
    for k in range(len(points)):
        point = (points[k, 0], points[k, 1], points[k, 2])
        smooth[k], flat[k] = mesh_normals(instants[0], 0, triangles[k], point)


@given(seed=st.integers(0, 2**31), half=st.tuples(*3 * [st.floats(0.3, 3.0)]))
@examples(12)
def test_a_normal_between_corners_is_the_mean_of_theirs_by_area(seed, half):
    rng = np.random.default_rng(seed)
    corners = rng.normal(size=(20, 3, 3))
    normals = rng.normal(size=(20, 3, 3)).astype(np.float32)
    mesh, _ = make_mesh(corners.reshape(-1, 3), np.arange(60).reshape(20, 3), normals=normals)
    scene = MeshScene((mesh, np.hstack([np.diag(half), np.zeros((3, 1))])))
    tree, (to_world,) = tree_of(mesh), scene.primitives(0.0).to_world
    weights = rng.dirichlet(np.ones(3), size=20)
    inner = np.einsum("tc,tcx->tx", weights, tree.triangles["corner"])
    points = inner @ to_world[:, :3].T + to_world[:, 3]
    found = [np.empty((20, 3)), np.empty((20, 3))]
    normals_of(world_at(scene, 0.0, SIZE).instant, np.arange(20), points, *found)
    a, b, c = np.moveaxis(tree.triangles["corner"], 1, 0)
    mixed = np.einsum("tc,tcx->tx", weights, tree.triangles["normal"].astype(float))
    expected = [one @ np.linalg.inv(to_world[:, :3]) for one in (mixed, np.cross(b - a, c - a))]
    smooth, flat = (one / np.linalg.norm(one, axis=1, keepdims=True) for one in expected)
    flat *= np.sign(((scene.camera(0.0).position - points) * flat).sum(axis=1, keepdims=True))
    smooth *= np.sign((smooth * flat).sum(axis=1, keepdims=True))
    np.testing.assert_allclose(found[0], smooth, atol=1e-5)
    np.testing.assert_allclose(found[1], flat, atol=1e-5)


@pytest.mark.parametrize("crease", [40.0, 25.0])
@pytest.mark.parametrize("angle", [20.0, 30.0, 45.0, 100.0])
def test_an_edge_is_rounded_up_to_the_crease(angle, crease):
    """Two triangles that meet at an edge; their mean turns away from each by half of the angle."""
    a, b = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    vertices = np.array([[0, 0, 0], [0, 1, 0], [-1, 0.5, 0], [a, 0.5, -b]])
    triangles = np.array([[0, 1, 2], [1, 0, 3]])
    normals = smooth_normals(vertices, triangles, crease)
    flat = triangle_normals(vertices, triangles.astype(np.int32))
    flat /= np.linalg.norm(flat, axis=1, keepdims=True)
    turned = np.degrees(np.arccos(np.clip((normals * flat[:, None]).sum(axis=2), -1.0, 1.0)))
    half = 0.5 * angle if 0.5 * angle < crease else 0.0
    np.testing.assert_allclose(turned, [[half, half, 0.0]] * 2, atol=0.05)


@given(st.integers(0, 2**32 - 1))
@examples(12)
def test_a_colour_keeps_what_is_brighter_by_luma(seed):
    rng = np.random.default_rng(seed)
    vertices, triangles = ball(6, 4)
    colours = rng.uniform(0.1, 0.6, (len(triangles), 3, 3)).astype(np.float32)
    mesh, _ = make_mesh(vertices, triangles, colours=colours)
    tint = (0.2, 0.05, 0.1)
    luma = 0.2126 * colours[..., 0] + 0.7152 * colours[..., 1] + 0.0722 * colours[..., 2]  # BT.709
    expected = (luma / luma.mean())[..., None] * tint
    np.testing.assert_allclose(recoloured(mesh, tint).colours, expected, rtol=1e-5)


@given(seed=st.integers(0, 2**31), half=st.tuples(*3 * [st.floats(0.05, 5.0)]))
def test_the_mean_colour_of_a_mesh_is_that_over_its_area_in_the_file(seed, half):
    rng = np.random.default_rng(seed)
    vertices, triangles = (
        rng.normal(size=(9, 3)) * half,
        rng.permuted([range(9)] * 4, axis=1)[:, :3],
    )
    colours, image = rng.uniform(size=(4, 3, 3)), rng.integers(-1, 2, 4)
    texels = rng.uniform(size=(2, 4, 4, 3))
    means = np.vstack([texels.mean(axis=(1, 2)), np.ones(3)])[image]
    mesh, _ = make_mesh(vertices, triangles, colours=colours.astype(np.float32), image=image,
                        images=[surface_image(one) for one in texels])  # fmt: skip
    areas = np.linalg.norm(triangle_normals(vertices, triangles), axis=1)
    expected = areas @ (colours.mean(axis=1) * means) / areas.sum()
    np.testing.assert_allclose(mean_colour(mesh), expected, rtol=1e-4)
