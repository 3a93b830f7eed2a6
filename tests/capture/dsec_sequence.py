"""A small DSEC sequence with a calibration of our own."""

import cv2
import h5py
import numpy as np
import yaml

WIDTH, HEIGHT = 32, 24


def write_sequence(folder, *, rotation=None, scale=2.0, frames=3):
    """A frame camera of `scale` times the focal length and resolution, turned by `rotation`."""
    events = folder / "events" / "left"
    images = folder / "images" / "left" / "rectified"
    calibration = folder / "calibration"
    for one in (events, images, calibration):
        one.mkdir(parents=True)
    column, row = np.meshgrid(np.arange(WIDTH), np.arange(HEIGHT))
    with h5py.File(events / "events.h5", "w") as file:
        file["t_offset"] = 0
    with h5py.File(events / "rectify_map.h5", "w") as file:
        file["rectify_map"] = np.stack([column, row], axis=2).astype(np.float32)
    big = (int(WIDTH * scale), int(HEIGHT * scale))
    for number in range(frames):
        ramp = np.tile(np.linspace(0, 250, big[0]), (big[1], 1)).astype(np.uint8)
        cv2.imwrite(str(images / f"{number:06d}.png"), ramp)
    times = (f"{1_000_000 + 50_000 * number}\n" for number in range(frames))
    (folder / "images" / "timestamps.txt").write_text("".join(times))
    extrinsics = np.eye(4)
    extrinsics[:3, :3] = np.eye(3) if rotation is None else rotation
    focal = 40.0
    camera = [focal, focal, WIDTH / 2, HEIGHT / 2]
    facts = {
        "intrinsics": {
            "camRect0": {"camera_matrix": camera},
            "camRect1": {"camera_matrix": [float(scale * value) for value in camera]},
        },
        "extrinsics": {
            "T_10": extrinsics.tolist(),
            "R_rect0": np.eye(3).tolist(),
            "R_rect1": np.eye(3).tolist(),
        },
    }
    (calibration / "cam_to_cam.yaml").write_text(yaml.safe_dump(facts))
    return folder
