"""Image files are judged by their heads before they are decoded, at every door."""

import os
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest

from texvent.capture.exr_image import read_exr
from texvent.capture.image_folder import read_image
from texvent.errors import FileFormatError
from texvent.io.pixel_mask import read_pixel_mask
from texvent.runtime import memory
from texvent.runtime.files.image_files import decode_image, stated_bytes
from texvent.runtime.memory import SMALL_BYTES, check_claim
from texvent.sensor import SensorSize
from texvent_scenes.pictures import read_image as read_picture

SHAPE = (37, 53)
FORMATS = {
    **dict.fromkeys(("png", "tif", "jp2"), ("u1", "u2")),
    **dict.fromkeys(("jpg", "bmp", "webp"), ("u1",)),
    "hdr": ("f4",),
}


def write_image(path: Path, dtype: str = "u1", channels: int = 3) -> Path:
    shape = SHAPE if channels == 1 else (*SHAPE, channels)
    pixels = np.random.default_rng(0).uniform(0, 250, shape).astype(dtype)
    assert cv2.imwrite(str(path), pixels)
    return path


@pytest.mark.parametrize("channels", [1, 3])
@pytest.mark.parametrize(
    ("ending", "dtype"),
    [
        *((ending, dtype) for ending, types in FORMATS.items() for dtype in types),
        ("pnm", "u1"),
        ("pnm", "u2"),
    ],
)
def test_a_head_states_at_least_what_is_decoded(tmp_path, ending, dtype, channels):
    ending = {1: "pgm", 3: "ppm"}[channels] if ending == "pnm" else ending
    path = write_image(tmp_path / f"image.{ending}", dtype, channels)
    decoded = decode_image(path, cv2.IMREAD_ANYCOLOR | cv2.IMREAD_ANYDEPTH)
    stated = stated_bytes(path.read_bytes())
    assert decoded.shape[:2] == SHAPE
    assert decoded.nbytes <= stated <= 6 * decoded.nbytes


def read_as_exr(path: Path) -> object:
    library = pytest.importorskip("OpenEXR")
    zeros = np.zeros(SHAPE, np.float16)
    header = {"compression": library.ZIP_COMPRESSION, "type": library.scanlineimage}
    library.File(header, {name: zeros for name in "RGB"}).write(str(path))
    return read_exr(path)


DOORS: dict[str, Callable[[Path], object]] = {
    "frame": read_image,
    "picture": read_picture,
    "mask": lambda path: read_pixel_mask(path, SensorSize(SHAPE[1], SHAPE[0])),
    "exr": read_as_exr,
}


@pytest.mark.parametrize("usable", [SMALL_BYTES, 1000])
@pytest.mark.parametrize("door", DOORS)
def test_an_image_that_would_fill_the_memory_is_refused_at_every_door(
    tmp_path, monkeypatch, door, usable
):
    path = write_image(tmp_path / "image.png", channels=1 if door == "mask" else 3)
    if door == "mask":
        cv2.imwrite(str(path), np.eye(*SHAPE, dtype=np.uint8))
    DOORS[door](path)
    monkeypatch.setattr(memory, "usable_bytes", lambda: usable)
    if usable == SMALL_BYTES:  # the proportion alone
        monkeypatch.setattr(memory, "SMALL_BYTES", 1000)
        monkeypatch.setattr(memory, "MOST_EXPANSION", 0)
    what = "claims to unpack to" if usable == SMALL_BYTES else "of memory, and a run may use"
    with pytest.raises(FileFormatError, match=rf"image\.png .*{what}"):
        DOORS[door](path)


@pytest.mark.parametrize(
    "head",
    [
        b"P5 60000 60000 255\n",
        b"P6 # a comment\n60000 60000\n255\n",
        b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 60000 +X 60000\n",
        b"GIF89a\x60\xea\x60\xea",
        b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\xea\x60\0\0\xea\x60\x10\x02\0\0\0",
    ],
)
def test_a_short_file_of_a_large_image_is_refused(tmp_path, head):
    path = tmp_path / "image.png"
    path.write_bytes(head)
    with pytest.raises(FileFormatError, match="claims to unpack to"):
        read_image(path)


@pytest.mark.parametrize("claimed", [15360 * 8640 * 3, 7680 * 4320 * 3 * 4])
def test_black_frames_of_16k_and_8k_floats_are_no_bombs(tmp_path, claimed):
    path = tmp_path / "black.png"
    path.write_bytes(os.urandom(1000))
    check_claim(claimed, path)


def test_damaged_heads_leave_the_word_to_the_decoder(tmp_path):
    path = tmp_path / "image.png"
    for ending in FORMATS:
        whole = write_image(tmp_path / f"whole.{ending}", FORMATS[ending][0]).read_bytes()
        for length in (0, 1, 9, 30):
            path.write_bytes(whole[:length])
            with pytest.raises(FileFormatError, match=r"image\.png"):
                read_image(path)
