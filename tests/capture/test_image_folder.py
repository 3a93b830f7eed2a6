from fractions import Fraction

import cv2
import numpy as np
import pytest

from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import FileFormatError, InputError


def save_images(folder, count=3, dtype=np.uint8, channels=(), name="frame{}.png", step=1):
    folder.mkdir(parents=True, exist_ok=True)
    for index in range(count):
        pixels = np.full((4, 6, *channels), 100 + step * index, dtype)
        assert cv2.imwrite(str(folder / name.format(index)), pixels)
    return folder


def test_a_frame_rate_gives_the_times(tmp_path):
    save_images(tmp_path)
    stream = open_frames(tmp_path, CaptureConfig(fps=Fraction(30_000, 1001)))
    assert [frame.t_us for frame in stream] == [0, 33_367, 66_733]
    assert stream.frame_count == 3


def test_ecd_layout_is_found_without_options_and_keeps_its_clock(tmp_path):
    save_images(tmp_path / "images")
    (tmp_path / "images.txt").write_text(
        "# time name\n0.5 images/frame0.png\n0.538766001 images/frame2.png\n"
    )
    frames = list(open_frames(tmp_path, CaptureConfig()))
    assert [frame.t_us for frame in frames] == [500_000, 538_766]
    assert [int(frame.pixels[0, 0]) for frame in frames] == [100, 102]


def test_sixteen_bits_stay(tmp_path):
    save_images(tmp_path, dtype=np.uint16, step=30_000)
    frames = list(open_frames(tmp_path, CaptureConfig(fps=Fraction(10))))
    assert frames[1].pixels.dtype == np.uint16
    assert int(frames[1].pixels[0, 0]) == 30_100


def test_colour_comes_as_rgb_and_alpha_goes(tmp_path):
    for index in range(2):
        pixels = np.zeros((4, 6, 4), np.uint8)
        pixels[:] = (10, 20, 200, 128)  # blue, green, red, alpha
        cv2.imwrite(str(tmp_path / f"{index}.png"), pixels)
    frame = next(iter(open_frames(tmp_path, CaptureConfig(fps=Fraction(10)))))
    assert frame.pixels[0, 0].tolist() == [200, 20, 10]


def test_a_wrong_number_of_times_is_refused(tmp_path):
    save_images(tmp_path)
    (tmp_path / "timestamps.txt").write_text("0\n0.1\n")
    with pytest.raises(InputError, match=r"timestamps\.txt has 2 times for 3 frames"):
        open_frames(tmp_path, CaptureConfig())


def test_a_damaged_image_is_named(tmp_path):
    save_images(tmp_path)
    (tmp_path / "frame1.png").write_bytes(b"not an image")
    with pytest.raises(FileFormatError, match=r"frame1\.png cannot be decoded"):
        list(open_frames(tmp_path, CaptureConfig(fps=Fraction(10))))
