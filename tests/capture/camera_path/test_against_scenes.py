"""One image of an embedded scene, moved by the scene's own poses, against the scene itself."""

import math

import numpy as np
import pytest

import texvent
from texvent.capture.camera_path.opening import open_photo
from texvent.config import CaptureConfig
from texvent.sensor import SensorSize
from texvent.truth.poses import pose_row

END_US = 100_000
INSIDE = slice(8, -8), slice(10, -10)
"""Away from the borders, where the image is mirrored."""


@pytest.mark.parametrize(
    "prompt", ["the camera orbits a parked car", "the camera pans left past a house"]
)
def test_poses_and_depth_show_what_the_moved_camera_sees(prompt, tmp_path):
    scene = texvent.video(prompt, sensor="96x72", duration=0.5)
    large = texvent.video(prompt, sensor="384x288", duration=0.5)
    poses = tmp_path / "poses.txt"
    times = range(0, END_US + 1, 20_000)
    cameras = [scene.camera_at(t_us) for t_us in times]
    rows = [
        pose_row(t_us, one.position, one.rotation.T)
        for t_us, one in zip(times, cameras, strict=True)
    ]
    poses.write_text("".join(rows))
    fov = math.degrees(2 * math.atan(0.5 / large.camera_at(0).focal))
    photo = np.clip(large.at(0).luma, 0, 255).astype(np.float32)
    options = CaptureConfig(camera=str(poses), camera_fov=fov)
    depth = large.ground_truth(0, 0).depth
    video = open_photo(photo, options, size=SensorSize(96, 72), depth=depth)
    # The sensor sees a part of the image, so that all of the path lies in it: compare centres.
    zoom = 4.0 / video.metadata["image_px_per_px"]
    for t_us in (0, END_US):
        wide = scene.at(t_us).luma
        size = SensorSize(96, 72)
        seen = video.at(t_us).pixels
        rows, columns = (
            (np.arange(n) + 0.5 - n / 2) / zoom + n / 2 - 0.5 for n in (size.height, size.width)
        )
        near = wide[np.rint(rows).astype(int)][:, np.rint(columns).astype(int)]
        error = np.abs(near - seen)[INSIDE]
        still = np.abs(near - video.at(0).pixels)[INSIDE]
        assert np.median(error) < 3.0
        if t_us:
            assert (error**2).mean() < 0.5 * (still**2).mean()
