"""Frames of recordings: DSEC's images seen from its event camera, and EVREAL's folders."""

import contextlib

import cv2
import h5py
import numpy as np
import pytest

from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import FileFormatError, InputError
from texvent.io.files import load
from texvent.sensor import SensorSize

from .dsec_sequence import HEIGHT, WIDTH, write_sequence

TURN = np.radians(2.0)


def test_frames_come_in_the_pixels_of_the_event_camera(tmp_path):
    frames = open_frames(write_sequence(tmp_path), CaptureConfig())
    assert frames.size == SensorSize(WIDTH, HEIGHT)
    shown = list(frames)
    assert [frame.t_us for frame in shown] == [1_000_000, 1_050_000, 1_100_000]
    # Twice the resolution: pixel x of the event camera is column 2x of the image.
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


@pytest.mark.parametrize("far", [0.9e-3, 1.1e-3])
def test_turns_that_are_none_and_places_that_are_nowhere_are_refused(tmp_path, far):
    stretched = np.diag([1.0 + far, 1.0, 1.0])
    folder = write_sequence(tmp_path, rotation=stretched)
    is_refused = pytest.raises(FileFormatError, match="not finite, or turns that are none")
    with contextlib.nullcontext() if far < 1e-3 else is_refused:
        open_frames(folder, CaptureConfig())
    with h5py.File(folder / "events" / "left" / "rectify_map.h5", "r+") as file:
        file["rectify_map"][3, 4, 1] = np.nan
    with pytest.raises(FileFormatError, match="rectify_map holds values that are NaN or infinite"):
        open_frames(folder, CaptureConfig())


IMAGES = np.arange(3 * 4 * 6, dtype=np.uint8).reshape(3, 4, 6)


def write_folder(folder, images=IMAGES, seconds=(5.0, 5.04, 5.0800004)):
    np.save(folder / "images.npy", images)
    np.save(folder / "images_ts.npy", np.asarray(seconds, np.float64))
    return folder


@pytest.mark.parametrize("extra", [(), (1,)])
def test_images_have_their_times_on_the_clock_of_the_events(tmp_path, extra):
    folder = write_folder(tmp_path, IMAGES.reshape(*IMAGES.shape, *extra))
    np.save(folder / "events_ts.npy", np.array([5.01, 5.02]))
    np.save(folder / "events_xy.npy", np.array([[5, 3], [0, 0]], np.uint16))
    np.save(folder / "events_p.npy", np.array([True, False]))
    frames = open_frames(folder, CaptureConfig())
    assert frames.size == SensorSize(6, 4)
    assert [frame.t_us for frame in frames] == [5_000_000, 5_040_000, 5_080_000]
    assert np.array_equal([frame.pixels for frame in frames], IMAGES)
    assert load(folder, size=frames.size).t.tolist() == [5_010_000, 5_020_000]


@pytest.mark.parametrize(
    ("images", "seconds", "error", "message"),
    [
        (IMAGES[0], (5.0,), InputError, r"shape \[4, 6\]"),
        (IMAGES, (5.0, 5.1), InputError, "2 times for 3 frames"),
        (IMAGES, (5.0, np.nan, 6.0), FileFormatError, "not all seconds"),
        (IMAGES, (5.0, 4.0, 6.0), InputError, "increase"),
    ],
)
def test_damaged_folders_are_refused(tmp_path, images, seconds, error, message):
    with pytest.raises(error, match=message):
        open_frames(write_folder(tmp_path, images, seconds), CaptureConfig())
