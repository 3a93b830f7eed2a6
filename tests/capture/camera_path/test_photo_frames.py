"""A still image becomes frames, and events, by a camera that moves over it."""

import cv2
import numpy as np
import pytest

import texvent
from texvent.capture.camera_path.opening import open_photo
from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import ConfigError, InputError
from texvent.frames import RenderableStream
from texvent.sensor import SensorSize

ROWS, COLUMNS = np.mgrid[:60, :80]
PHOTO = np.uint8(127 + 60 * np.sin(0.31 * COLUMNS) + 60 * np.cos(0.23 * ROWS + 0.1 * COLUMNS))


@pytest.fixture
def photo(tmp_path):
    path = tmp_path / "photo.png"
    cv2.imwrite(str(path), PHOTO)
    return path


def frames_of(source=PHOTO, size=None, seed=0, **options):
    return open_photo(source, CaptureConfig(**options), size=size, seed=seed)


def test_frames_can_be_rendered_at_any_instant():
    video = frames_of(camera="shake", seed=3, duration=0.1)
    assert isinstance(video, RenderableStream)
    frames = list(video)
    assert len(frames) == video.frame_count == 7
    assert [frame.t_us for frame in frames][:3] == [0, 16667, 33333]
    for frame in frames:
        np.testing.assert_array_equal(video.at(frame.t_us).pixels, frame.pixels)
    assert not np.array_equal(video.at(5000).pixels, frames[0].pixels)


def test_all_of_a_path_is_covered_by_whole_frame_intervals():
    assert frames_of(camera="saccade").frame_count == 20
    assert frames_of(camera="saccade", fps=24).frame_count == 9
    assert frames_of(camera="pan", duration=0.001).frame_count == 2


def test_without_a_sensor_pixels_are_those_of_the_image():
    video = frames_of(camera="pan", camera_amplitude=1000, fps=1000, duration=0.002)
    first, middle, last = (frame.pixels for frame in video)
    np.testing.assert_array_equal(middle, PHOTO)
    np.testing.assert_array_equal(first[:, 1:], PHOTO[:, :-1])
    np.testing.assert_array_equal(last[:, :-1], PHOTO[:, 1:])
    np.testing.assert_array_equal(last[:, -1], PHOTO[:, -1])  # mirrored


def test_a_sensor_sees_as_much_of_the_image_as_its_path_allows():
    video = frames_of(camera="pan", camera_amplitude=80, size=SensorSize(16, 12), duration=0.1)
    assert video.size == (16, 12)
    assert video.metadata["image_px_per_px"] == pytest.approx(80 / 24)
    assert video.metadata["amplitude_px"] == 80


def test_large_images_are_averaged_in_blocks_without_a_shift():
    ramp = np.add.outer(0.05 * np.arange(480), 0.1 * np.arange(640)).astype(np.float32)
    video = frames_of(ramp, camera="pan", size=SensorSize(12, 9), duration=0.01)
    assert video.view.image.width < 640
    image = video.at(5_000).pixels
    # What is left over of whole blocks may be odd: half a px of the image, 0.05 levels.
    assert image.mean() == pytest.approx(ramp.mean(), abs=0.06)
    scale = video.metadata["image_px_per_px"]
    np.testing.assert_allclose(np.diff(image, axis=1), 0.1 * scale, rtol=0.01)


def test_motion_vectors_lead_to_the_same_brightness():
    ramp = (3 * COLUMNS + 0.5 * ROWS).astype(np.float32)
    video = frames_of(ramp, camera="shake", seed=1, duration=0.1)
    first, second = list(video)[:2]
    x, y = first.motion.forward[30, 40]
    slope = 3 * x + 0.5 * y
    change = second.pixels[30, 40] - first.pixels[30, 40]
    assert change == pytest.approx(-slope, abs=1e-3)
    np.testing.assert_allclose(second.motion.backward[30, 40], [-x, -y], atol=1e-6)
    assert first.motion.backward is None


def test_events_are_exact_by_default_and_the_same_from_file_and_array(photo):
    options = {"camera": "saccade", "sensor": "32x24", "noise": "none"}
    events = texvent.simulate(photo, **options)
    again = texvent.simulate(PHOTO, **options)
    assert len(events) > 100
    np.testing.assert_array_equal(events.t, again.t)
    settings = events.metadata["settings"]
    assert settings["interpolate"]["interpolate"] == "exact"
    assert events.metadata["source"]["camera"] == "saccade"
    assert len(events.metadata["source"]["fingerprint"]) == 64
    seeds = [texvent.simulate(PHOTO, **{**options, "camera": "shake", "seed": s}) for s in (1, 2)]
    assert not np.array_equal(seeds[0].t, seeds[1].t)


def test_enough_frames_are_rendered_that_nothing_moves_by_more_than_a_pixel():
    # Stripes that move by a whole period between two frames: their brightness does not change.
    stripes = np.tile(np.uint8(127 + 100 * np.sin(np.pi * np.arange(80) / 4)), (20, 1))
    options = {"camera": "pan", "camera_amplitude": 240.0, "fps": 30, "duration": 0.1}
    assert len(texvent.simulate(stripes, noise="none", **options)) > 20 * 60


def test_what_is_no_image_gets_one_line(tmp_path):
    video = tmp_path / "clip.mp4"
    video.write_bytes(b"x")
    with pytest.raises(InputError, match=r"clip.mp4 is no still image .* leave `camera` out"):
        texvent.simulate(video, camera="pan")
    with pytest.raises(InputError, match=r"no such image: .*none\.png"):
        texvent.simulate(tmp_path / "none.png", camera="pan")
    with pytest.raises(InputError, match=r"over one still image, not over int; give its path"):
        texvent.simulate(3, camera="pan")
    with pytest.raises(InputError, match=r"must be \[H, W\].*\[3, 60, 80\]"):
        texvent.simulate(np.stack([PHOTO] * 3), camera="pan")
    with pytest.raises(InputError, match="so they are probably"):
        texvent.simulate(PHOTO / 255.0, camera="pan")
    with pytest.raises(ConfigError, match="t_us is for videos"):
        open_frames(PHOTO, CaptureConfig(camera="pan"), t_us=[0, 1])
