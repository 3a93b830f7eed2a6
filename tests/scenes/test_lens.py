"""Images and truth of cameras with a lens; the models themselves are in tests/test_lens.py."""

import cv2
import numpy as np
import pytest
from tests.scenes.hand_scenes import HandScene, MovingShape, look_at, still

from texvent.camera import PosedCamera, camera_rays, project
from texvent.lens import Lens, lens_reach, normalised
from texvent.sensor import SensorSize
from texvent_scenes.raycast.ground_truth import ground_truth
from texvent_scenes.raycast.render import render, world_at
from texvent_scenes.raycast.trace import ray_direction
from texvent_scenes.rendered_scene import Shape

SIZE = SensorSize(160, 120)
RADTAN = Lens(110.0, 112.0, 78.0, 61.5, "radtan", (-0.28, 0.07, 2e-3, -1e-3))
SIX = Lens(110.0, 112.0, 78.0, 61.5, "radtan", (-0.28, 0.07, 2e-3, -1e-3, 0.02))
FISHEYE = Lens(70.0, 71.0, 81.0, 59.0, "equidistant", (0.02, -0.01, 3e-3, -5e-4))
BOTH = pytest.mark.parametrize("lens", [RADTAN, SIX, FISHEYE], ids=["radtan", "k3", "equidistant"])
VELOCITY = np.array([0.5, 0.3, 0.0])
CENTRE = 0.5
"""OpenCV's (0, 0) is the middle of the first pixel, ours its corner."""


def opencv_points(lens: Lens, points: np.ndarray) -> np.ndarray:
    """Where OpenCV puts points [n, 3] in camera coordinates, in our pixels."""
    matrix = np.array([[lens.fx, 0, lens.cx - CENTRE], [0, lens.fy, lens.cy - CENTRE], [0, 0, 1.0]])
    none, coefficients = np.zeros(3), np.array(lens.coefficients)
    if lens.distortion == "equidistant":
        placed, _ = cv2.fisheye.projectPoints(points[:, None], none, none, matrix, coefficients)
    else:
        placed, _ = cv2.projectPoints(points[:, None], none, none, matrix, coefficients)
    return placed[:, 0] + CENTRE


def ray_directions(camera: PosedCamera, size: SensorSize, points: np.ndarray) -> np.ndarray:
    """Directions [n, 3] through image points [n, 2]; their component along the axis is 1."""
    lens = camera.lens
    if lens is not None and lens.distortion != "none":
        plane = normalised(lens, points)
        right_axis, down_axis, forward = np.asarray(camera.rotation, dtype=np.float64)
        return np.asarray(forward + plane[:, :1] * right_axis + plane[:, 1:] * down_axis)
    rays = camera_rays(camera, size)
    return np.asarray(rays.corner + points[:, :1] * rays.right + points[:, 1:] * rays.down)


def camera_with(lens: Lens | None) -> PosedCamera:
    camera = look_at((0.0, -8.0, 1.7), (0.0, 0.0, 1.0))
    return PosedCamera(camera.position, camera.rotation, 1.0, lens)


@BOTH
def test_projection_agrees_with_opencv(lens):
    camera = camera_with(lens)
    seen = np.random.default_rng(1).uniform((-4, -3, 4), (4, 3, 9), (500, 3))
    ours = project(camera, SIZE, seen @ camera.rotation + camera.position)
    inside = np.isfinite(ours[:, 0])
    assert inside.mean() > 0.9
    np.testing.assert_allclose(
        ours[inside, :2], opencv_points(lens, seen)[inside], atol=1e-7, rtol=0
    )
    np.testing.assert_allclose(ours[:, 2], seen[:, 2])


@BOTH
def test_kernel_and_reference_give_the_same_rays(lens):
    scene = HandScene(camera_at=lambda time: camera_with(lens))
    instant = world_at(scene, 0.0, SIZE).instant[0]
    points = np.random.default_rng(2).uniform((0, 0), SIZE, (300, 2))
    kernel = [ray_direction(instant, x, y) for x, y in points]
    reference = ray_directions(camera_with(lens), SIZE, points)
    np.testing.assert_allclose(kernel, reference, atol=1e-10)


@BOTH
def test_flow_and_depth_agree_with_the_projection(lens):
    """A still ground under a moving camera: flow is the difference of projections."""

    def camera_at(time_s: float) -> PosedCamera:
        camera = camera_with(lens)
        return PosedCamera(camera.position + time_s * VELOCITY, camera.rotation, 1.0, lens)

    scene = HandScene(camera_at=camera_at)
    truth = ground_truth(scene, 0.0, 0.1, SIZE)
    row, column = 100, 30
    direction = ray_directions(camera_at(0.0), SIZE, np.array([[column + 0.5, row + 0.5]]))[0]
    depth = -camera_at(0.0).position[2] / direction[2]
    assert truth.depth[row, column] == pytest.approx(depth, rel=1e-6)
    point = camera_at(0.0).position + depth * direction
    after = project(camera_at(0.1), SIZE, point)
    expected = after[:2] - [column + 0.5, row + 0.5]
    np.testing.assert_allclose(truth.flow[row, column], expected, atol=1e-5)


def test_a_fisheye_that_looks_behind_has_a_dark_rim():
    """40 px per radian: 85° is 59.3 px from the axis; what is further is black and not moving."""
    wide = Lens(40.0, 40.0, 80.0, 60.0, "equidistant")
    assert lens_reach(wide, SIZE).dark == pytest.approx(1.0 - np.pi * 59.3**2 / 19_200, abs=0.05)
    scene = HandScene(
        (MovingShape(Shape.BOX, (30.0, 0.1, 30.0), still(0.0, 3.0, 0.0)),),
        lambda time: camera_with(wide),
    )
    image = render(scene, 0.0, SIZE)
    rows, columns = np.indices(SIZE.shape) + 0.5
    radius = np.hypot(columns - 80.0, rows - 60.0)
    limit = 40.0 * np.radians(85.0)
    assert np.isfinite(image).all()
    assert (image[radius > limit + 1.0] == 0.0).all()
    assert (image[radius < limit - 1.0].max(axis=1) > 20.0).all()
    truth = ground_truth(scene, 0.0, 0.1, SIZE)
    dark = radius > limit
    assert np.isnan(truth.flow[dark]).all()
    assert np.isinf(truth.depth[dark]).all()
    assert np.isfinite(truth.flow[radius < limit - 1.0]).all()
