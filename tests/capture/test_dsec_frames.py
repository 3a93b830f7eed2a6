"""DSEC's pictures seen from its event camera: a small sequence with a calibration of our own."""

import cv2
import h5py
import numpy as np
import pytest
import yaml

from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import FileFormatError
from texvent.sensor import SensorSize

WIDTH, HEIGHT = 32, 24
TURN = np.radians(2.0)


def write_sequence(folder, *, rotation=None, scale=2.0):
    """A frame camera of `scale` times the focal length and resolution, turned by `rotation`."""
    events = folder / "events" / "left"
    pictures = folder / "images" / "left" / "rectified"
    calibration = folder / "calibration"
    for one in (events, pictures, calibration):
        one.mkdir(parents=True)
    column, row = np.meshgrid(np.arange(WIDTH), np.arange(HEIGHT))
    with h5py.File(events / "events.h5", "w") as file:
        file["t_offset"] = 0
    with h5py.File(events / "rectify_map.h5", "w") as file:
        file["rectify_map"] = np.stack([column, row], axis=2).astype(np.float32)
    big = (int(WIDTH * scale), int(HEIGHT * scale))
    for number in range(3):
        ramp = np.tile(np.linspace(0, 250, big[0]), (big[1], 1)).astype(np.uint8)
        cv2.imwrite(str(pictures / f"{number:06d}.png"), ramp)
    (folder / "images" / "timestamps.txt").write_text("1000000\n1050000\n1100000\n")
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


def test_frames_come_in_the_pixels_of_the_event_camera(tmp_path):
    frames = open_frames(write_sequence(tmp_path), CaptureConfig())
    assert frames.size == SensorSize(WIDTH, HEIGHT)
    shown = list(frames)
    assert [frame.t_us for frame in shown] == [1_000_000, 1_050_000, 1_100_000]
    # Twice the resolution: pixel x of the event camera is column 2x of the picture.
    expected = np.linspace(0, 250, 2 * WIDTH).astype(np.uint8)[::2]
    assert np.abs(shown[0].pixels[5].astype(int) - expected).max() <= 1


def test_a_turned_camera_is_turned_back(tmp_path):
    rotation = cv2.Rodrigues(np.array([0.0, TURN, 0.0]))[0]
    turned = open_frames(write_sequence(tmp_path, rotation=rotation), CaptureConfig())
    row = next(iter(turned)).pixels[HEIGHT // 2].astype(float)
    # A point ahead of the event camera lies tan(2°) · f = 2.8 columns (of 2 f) to the right.
    middle = WIDTH // 2
    expected = np.linspace(0, 250, 2 * WIDTH)[2 * middle] + 250 / 63 * 80 * np.tan(TURN)
    assert row[middle] == pytest.approx(expected, abs=2)


@pytest.mark.parametrize("missing", ["rectify_map.h5", "cam_to_cam.yaml"])
def test_a_sequence_without_calibration_is_refused(tmp_path, missing):
    folder = write_sequence(tmp_path)
    next(folder.rglob(missing)).unlink()
    with pytest.raises(FileFormatError, match=missing.partition(".")[0]):
        open_frames(folder, CaptureConfig())


def test_a_calibration_that_lacks_an_entry_is_refused(tmp_path):
    folder = write_sequence(tmp_path)
    (folder / "calibration" / "cam_to_cam.yaml").write_text("intrinsics: {}\n")
    with pytest.raises(FileFormatError, match="camRect0"):
        open_frames(folder, CaptureConfig())
