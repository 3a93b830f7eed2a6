"""Ground truth against closed forms and an independent NumPy computation."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.scenes.raycast.intersect_reference import hit_shape_reference

from texvent.camera import PosedCamera, camera_rays
from texvent.sensor import SensorSize
from texvent_scenes.raycast.ground_truth import _hidden, ground_truth
from texvent_scenes.raycast.render import world_at
from texvent_scenes.raycast.trace import hit_shape
from texvent_scenes.rendered_scene import Ground, Shape

from ..hand_scenes import HandScene, MovingShape, look_at, moving, showcase, still

SIZE = SensorSize(80, 60)
NAMES = {one: f"thing {one}" for one in range(1, 7)}


def level(time: float) -> PosedCamera:
    return look_at((0.0, -8.0, 1.5), (0.0, 0.0, 1.5))


def moving_camera(time: float) -> PosedCamera:
    return look_at((0.4 * time, -8.0 + 0.5 * time, 1.7), (0.8 * time, 0.0, 1.0 + 0.2 * time))


def test_tiles_miss_no_shape_and_the_nearest_wins():
    scene = replace(showcase(Ground.NONE), class_names=NAMES, camera_at=moving_camera)
    truth = ground_truth(scene, 0.3, 0.3, SIZE)
    primitives, rays = scene.primitives(0.3), camera_rays(scene.camera(0.3), SIZE)
    row, column = np.indices(SIZE.shape)
    directions = (
        rays.corner
        + (column.reshape(-1, 1) + 0.5) * rays.right
        + (row.reshape(-1, 1) + 0.5) * rays.down
    )
    depths = []
    for shape, to_world in zip(primitives.shape, primitives.to_world, strict=True):
        inverse = np.linalg.inv(to_world[:, :3])
        origin = inverse @ (rays.origin - to_world[:, 3])
        origins = np.broadcast_to(origin, directions.shape)
        depths.append(hit_shape_reference(Shape(shape), origins, directions @ inverse.T))
    expected = np.min(depths, axis=0).reshape(SIZE.shape)
    nearest = np.argmin(depths, axis=0).reshape(SIZE.shape)
    ids = np.where(np.isinf(expected), 0, primitives.instance[nearest])
    assert np.mean(ids != truth.instance) < 1e-3  # rays that only graze a shape
    same = ids == truth.instance
    np.testing.assert_allclose(truth.depth[same], expected[same], rtol=1e-6)


def test_flow_of_a_moving_ball_is_the_projection_of_its_surface_points():
    ball = MovingShape(
        Shape.ELLIPSOID, (1.0, 0.8, 1.2), moving((0.0, 0.0, 1.5), (1.0, 0.5, 0.2)), instance=1,
        spin=0.6,
    )  # fmt: skip
    scene = HandScene((ball,), moving_camera, class_names=NAMES)
    truth = ground_truth(scene, 0.0, 0.25, SIZE)
    rows, columns = np.nonzero(truth.instance == 1)
    centres = np.stack([columns + 0.5, rows + 0.5], axis=1)
    rays = camera_rays(scene.camera(0.0), SIZE)
    points = rays.origin + truth.depth[rows, columns, None].astype(np.float64) * (
        rays.corner + centres[:, :1] * rays.right + centres[:, 1:] * rays.down
    )
    turn = 0.6 * 0.25
    spin = np.array([[np.cos(turn), -np.sin(turn), 0], [np.sin(turn), np.cos(turn), 0], [0, 0, 1]])
    moved = (points - [0.0, 0.0, 1.5]) @ spin.T + [0.25, 0.125, 1.55]
    camera = scene.camera(0.25)
    seen = (moved - camera.position) @ camera.rotation.T
    place = seen[:, :2] / seen[:, 2:] * 80.0 + [40.0, 30.0]
    assert len(rows) > 80
    np.testing.assert_allclose(truth.flow[rows, columns], place - centres, atol=1e-4)


def test_what_a_shape_moves_in_front_of_is_occluded():
    front = MovingShape(
        Shape.BOX, (0.5, 0.1, 3.0), moving((-2.0, -2.0, 1.5), (1.0, 0.0, 0.0)), instance=1
    )
    back = MovingShape(Shape.BOX, (4.0, 0.1, 3.0), still(0.0, 2.0, 1.5), instance=2)
    scene = HandScene((front, back), level, class_names=NAMES)
    truth = ground_truth(scene, 0.0, 2.0, SIZE)
    later = ground_truth(scene, 2.0, 2.0, SIZE)
    covered = (truth.instance == 2) & (later.instance == 1)
    assert covered.sum() > 100
    np.testing.assert_array_equal(truth.occluded[truth.instance == 2], covered[truth.instance == 2])
    assert not truth.occluded[truth.instance == 1].any()


def test_a_point_that_leaves_the_image_or_passes_the_camera_is_occluded():
    def forward(time: float) -> PosedCamera:
        return look_at((0.0, -8.0 + time, 1.5), (0.0, time, 1.5))

    truth = ground_truth(HandScene(camera_at=forward), 0.0, 6.0, SIZE)
    passed = truth.depth <= 6.0
    assert passed.any()
    assert np.isnan(truth.flow[passed & (truth.depth < 5.99)]).all()
    assert truth.occluded[passed].all()


@given(st.sampled_from([-1.0, -0.5, 0.0, 0.25, 1.0]), st.sampled_from([-1.0, -0.5, 0.0, 0.25, 1.0]))
@settings(max_examples=25)
def test_a_point_is_in_the_image_from_its_first_edge_up_to_the_last(beside, above):
    """`beside` and `above` are pixels from an edge; 0 is on the first, and out of the last."""
    world = world_at(HandScene((), level, class_names=NAMES), 0.0, SIZE, shadows=False)
    places = [(x, y) for x in (beside, SIZE.width + beside) for y in (above, SIZE.height + above)]
    hidden = _hidden(world, np.array([(x, y, 1e-3) for x, y in places]), SIZE)
    inside = [0.0 <= x < SIZE.width and 0.0 <= y < SIZE.height for x, y in places]
    assert hidden.tolist() == [not one for one in inside]
    assert _hidden(world, np.array([(x, y, 0.0) for x, y in places]), SIZE).all()


def test_boxes_hold_the_visible_pixels_and_say_how_much_is_visible():
    front = MovingShape(Shape.BOX, (0.5, 0.1, 3.0), still(0.5, -2.0, 1.5), instance=7)
    back = MovingShape(Shape.BOX, (1.0, 0.1, 1.0), still(0.0, -0.1, 1.5), instance=3)
    gone = MovingShape(Shape.BOX, (0.2, 0.1, 0.2), still(0.5, 0.0, 1.5), instance=5)
    names = {3: "sign", 5: "ball", 7: "wall"}
    truth = ground_truth(HandScene((front, back, gone), level, class_names=names), 0, 0, SIZE)
    assert [(box.instance, box.class_name) for box in truth.boxes] == [(3, "sign"), (7, "wall")]
    sign, wall = truth.boxes
    # 10 pixels per metre at the sign (8 m), 13.56 at the wall (5.9 m).
    assert (sign.x0, sign.x1, sign.y0, sign.y1) == (30, 40, 20, 40)
    assert sign.visibility == pytest.approx(0.5, abs=0.03)
    assert wall.visibility == 1.0
    assert (truth.instance[sign.y0 : sign.y1, sign.x0 : sign.x1] == 3).all()


UNIT_SHAPES = [shape for shape in Shape if shape is not Shape.MESH]


def rays(seed: int, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Rays from around the unit shapes towards points in and beside them."""
    generator = np.random.default_rng(seed)
    origins = generator.normal(size=(count, 3)) * 3.0
    targets = generator.uniform(-1.6, 1.6, size=(count, 3))
    return origins, (targets - origins) * generator.uniform(0.1, 2.0, size=(count, 1))


@pytest.mark.parametrize("shape", UNIT_SHAPES)
def test_the_kernel_equals_the_reference_on_random_rays(shape):
    origins, directions = rays(int(shape), 3000)
    expected = hit_shape_reference(shape, origins, directions)
    found = np.array(
        [
            hit_shape(int(shape), tuple(origin), tuple(direction), 0.0)[0]
            for origin, direction in zip(origins, directions, strict=True)
        ]
    )
    both = np.isfinite(found) & np.isfinite(expected)
    assert both.sum() > 300
    np.testing.assert_allclose(found[both], expected[both], rtol=1e-8, atol=1e-9)
    # Rays that only graze the shape may go either way; a grazing ray stays inside hardly any time.
    assert np.mean(np.isfinite(found) != np.isfinite(expected)) < 1e-3
