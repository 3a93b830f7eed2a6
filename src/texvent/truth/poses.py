"""Camera poses and intrinsics in the conventions that other programs read.

Camera axes: x right, y down, z forward (along the optical axis). World axes: x right (east), y away
from the first camera (north), z up, metres. A pose is camera-to-world: `X_world = R · X_camera + t`
with the camera's position t, and R as a quaternion.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.camera import PosedCamera
from texvent.frames import MICROSECONDS
from texvent.sensor import SensorSize

POSE_HEADER = "# timestamp tx ty tz qx qy qz qw\n"
INTRINSICS_HEADER = "# t_us fx fy cx cy\n"


def rotation_matrix(quaternion: NDArray[np.float64]) -> NDArray[np.float64]:
    """The rotation matrix [3, 3] of a quaternion (x, y, z, w) of any length but 0."""
    x, y, z, w = quaternion / np.linalg.norm(quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def quaternion(rotation: NDArray[np.float64]) -> NDArray[np.float64]:
    """The unit quaternion (x, y, z, w), w >= 0, of a rotation matrix [3, 3].

    Example:
        >>> quaternion(np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])).round(4)
        array([0.    , 0.    , 0.7071, 0.7071])
    """
    r = np.asarray(rotation, dtype=np.float64)
    # Four times the squares of w, x, y, z; the largest is divided by, so nothing is lost.
    squares = 1.0 + np.array(
        [
            r[0, 0] + r[1, 1] + r[2, 2],
            r[0, 0] - r[1, 1] - r[2, 2],
            r[1, 1] - r[0, 0] - r[2, 2],
            r[2, 2] - r[0, 0] - r[1, 1],
        ]
    )
    x, y, z = r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]
    xy, xz, yz = r[0, 1] + r[1, 0], r[0, 2] + r[2, 0], r[1, 2] + r[2, 1]
    columns = np.array(
        [
            [x, y, z, squares[0]],
            [squares[1], xy, xz, x],
            [xy, squares[2], yz, y],
            [xz, yz, squares[3], z],
        ]
    )
    best = columns[int(np.argmax(squares))]
    return np.asarray(best / np.linalg.norm(best) * (-1.0 if best[3] < 0 else 1.0))


def pose_matrix(camera: PosedCamera) -> NDArray[np.float64]:
    """Camera-to-world, [4, 4], metres."""
    pose = np.eye(4)
    pose[:3, :3] = np.asarray(camera.rotation).T
    pose[:3, 3] = camera.position
    return pose


def pose_row(t_us: int, position: NDArray[Any], to_world: NDArray[Any]) -> str:
    """A row of the TUM trajectory format: time in seconds, position in metres, quaternion.

    Args:
        t_us: time, µs.
        position: [3] in the world, m.
        to_world: [3, 3] rotation to the world.
    """
    values = [*position, *quaternion(to_world)]
    return f"{seconds_text(t_us)} {' '.join(f'{value:.9f}' for value in values)}\n"


def seconds_text(t_us: int) -> str:
    """A time in seconds, exact to the µs.

    Example:
        >>> seconds_text(41667), seconds_text(-1)
        ('0.041667', '-0.000001')
    """
    seconds, rest = divmod(abs(t_us), MICROSECONDS)
    return f"{'-' if t_us < 0 else ''}{seconds}.{rest:06d}"


def intrinsics(camera: PosedCamera, size: SensorSize) -> tuple[float, float, float, float]:
    """fx, fy, cx, cy in pixels; pixel centres have whole coordinates, as in OpenCV and DSEC.

    Example:
        >>> eye = np.eye(3)
        >>> intrinsics(PosedCamera(np.zeros(3), eye, 1.5), SensorSize(100, 60))
        (150.0, 150.0, 49.5, 29.5)
    """
    lens = camera.lens
    if lens is not None:
        return lens.intrinsics
    focal = camera.focal * size.width
    return focal, focal, (size.width - 1) / 2, (size.height - 1) / 2


def intrinsics_row(t_us: int, values: NDArray[np.float64]) -> str:
    """Time in µs and fx, fy, cx, cy in pixels: a zoom changes them."""
    return f"{t_us} {' '.join(f'{value:.9g}' for value in values)}\n"


def camera_facts(camera: PosedCamera, size: SensorSize) -> Mapping[str, Any]:
    """Camera at the first frame, from camera.json."""
    lens = camera.lens
    return {
        "camera_model": "pinhole",
        "resolution": [size.width, size.height],
        "intrinsics": list(intrinsics(camera, size)),
        "intrinsics_order": "fx, fy, cx, cy",
        "distortion_model": "none" if lens is None else lens.distortion,
        "distortion_coeffs": [] if lens is None else list(lens.coefficients),
        "pixel_centre": "whole coordinates: (0, 0) is the centre of the top left pixel",
        "camera_axes": "x right, y down, z forward",
        "world_axes": "x right (east), y away (north), z up; metres",
        "T_world_camera": pose_matrix(camera).tolist(),
        "poses": "poses.txt: camera-to-world, TUM: timestamp [s] tx ty tz [m] qx qy qz qw",
        "intrinsics_over_time": "intrinsics.txt: t [us] fx fy cx cy [px]",
    }
