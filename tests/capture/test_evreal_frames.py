"""Images of EVREAL's folders."""

import numpy as np
import pytest

from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import FileFormatError, InputError
from texvent.io.files import load
from texvent.sensor import SensorSize

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


def test_a_part_of_a_folder_keeps_its_times(tmp_path):
    frames = open_frames(write_folder(tmp_path), CaptureConfig(start=0.03))
    assert [frame.t_us for frame in frames] == [5_040_000, 5_080_000]


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
