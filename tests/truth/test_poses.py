"""Conventions of poses, intrinsics and flow, by hand and by OpenCV."""

import cv2
import numpy as np
from hypothesis import example, given
from hypothesis import strategies as st

from texvent.camera import PosedCamera, project
from texvent.lens import Lens
from texvent.truth.flow_between import FrameFlow
from texvent.truth.poses import (
    camera_facts,
    intrinsics,
    pose_matrix,
    pose_row,
    quaternion,
    rotation_matrix,
)

from .hand_video import SIZE, level


def test_a_level_camera_that_looks_north():
    camera = level(0.0)
    text = pose_row(1_500_000, camera.position, camera.rotation.T)
    row = [float(word) for word in text.split()]
    half = np.sqrt(0.5)
    np.testing.assert_allclose(row, [1.5, 0.0, -8.0, 1.5, -half, 0.0, 0.0, half], atol=1e-9)


def test_poses_are_camera_to_world_with_x_right_y_down_z_forward():
    pose = pose_matrix(level(0.0))
    right_down_forward = pose[:3, :3].T
    np.testing.assert_allclose(right_down_forward, [[1, 0, 0], [0, 0, -1], [0, 1, 0]], atol=1e-12)
    np.testing.assert_allclose(pose @ [0, 0, 2, 1], [0, -6, 1.5, 1], atol=1e-12)


def test_opencv_projects_as_the_scene_does():
    camera = level(0.0)
    points = np.array([[0.4, 1.0, 2.2], [-1.5, 3.0, 0.2]])
    pose = np.linalg.inv(pose_matrix(camera))
    fx, fy, cx, cy = intrinsics(camera, SIZE)
    matrix = np.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1]])
    turn, _ = cv2.Rodrigues(pose[:3, :3])
    found, _ = cv2.projectPoints(points, turn, pose[:3, 3], matrix, None)
    # The scene counts from the corner of the first pixel, OpenCV from its middle.
    np.testing.assert_allclose(found[:, 0], project(camera, SIZE, points)[:, :2] - 0.5, atol=1e-9)


def test_a_lens_is_written_as_calibrations_have_it():
    lens = Lens(90.0, 91.0, 40.5, 30.5, "radtan", (-0.1, 0.01, 0.001, 0.002))
    camera = PosedCamera(np.zeros(3), np.eye(3), 1.0, lens)
    facts = camera_facts(camera, SIZE)
    assert facts["intrinsics"] == [90.0, 91.0, 40.0, 30.0]
    assert facts["distortion_model"] == "radtan"
    assert facts["distortion_coeffs"] == [-0.1, 0.01, 0.001, 0.002]


@given(st.lists(st.floats(-1, 1), min_size=4, max_size=4))
def test_quaternions_and_matrices_are_inverse(values):
    unit = np.array(values)
    if np.linalg.norm(unit) < 1e-3:
        unit = np.array([0.0, 0.0, 0.0, 1.0])
    unit /= np.linalg.norm(unit)
    matrix = rotation_matrix(unit)
    np.testing.assert_allclose(matrix @ matrix.T, np.eye(3), atol=1e-12)
    found = quaternion(matrix)
    assert found[3] >= 0
    np.testing.assert_allclose(rotation_matrix(found), matrix, atol=1e-9)


def test_nothing_moves_within_an_instant_the_last_one_too() -> None:
    flow = FrameFlow(np.array([0, 10, 20]), np.ones((2, 3, 4, 2), np.float32))
    for t_us in (0, 5, 20):
        np.testing.assert_array_equal(flow.between(t_us, t_us), np.zeros((2, 3, 4)))
    assert np.isnan(flow.between(21, 21)).all()


@given(
    seed=st.integers(0, 999),
    ends=st.tuples(st.integers(0, 3), st.integers(0, 3)).map(sorted),
    hides=st.booleans(),
    is_slide=st.booleans(),
)
@example(seed=2, ends=[0, 3], hides=True, is_slide=True)
def test_steps_are_followed_pixel_by_pixel_until_something_hides_them(
    seed, ends, hides, is_slide
):  # fmt: skip
    """Whole pixels each their own way, or all by the same part of one; what hides is nearest."""
    rng, shape, (first, last) = np.random.default_rng(seed), (5, 6), ends
    times_us = np.array([-7, 10, 21, 40])
    flow = rng.integers(-1, 2, (3, *shape, 2)).astype(np.float32)
    if is_slide:
        flow[:] = rng.choice([-0.7, -0.3, 0.3, 0.4, 0.8], (3, 1, 1, 2))
    hidden = rng.random((3, *shape)) < 0.2
    found = FrameFlow(times_us, flow, hidden if hides else None).between(
        int(times_us[first]), int(times_us[last])
    )
    for y, x in np.ndindex(shape):
        place, total = np.array([x, y], float), np.zeros(2)
        for step in range(first, last):
            if not (0 <= place[0] <= shape[1] - 1 and 0 <= place[1] <= shape[0] - 1):
                total = np.full(2, np.nan)
                break
            column, row = np.rint(place).astype(int)
            place = place + flow[step, row, column].astype(float)
            total = place - [x, y]
            if hides and hidden[step, row, column]:
                place = np.array([-1.0, -1.0])  # what is seen there later is another thing
        np.testing.assert_allclose(found[:, y, x], total, atol=1e-6)
