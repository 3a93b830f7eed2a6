"""sensor_msgs/Image → pixels, by hand-made bytes."""

import re

import numpy as np
import pytest
from tests.ros.rclpy_interface import Image
from texvent_ros.messages import read_image

from texvent.errors import InputError

RED, GREEN, BLUE, ALPHA = 10, 20, 30, 99


def make(encoding: str, height: int, width: int, data: bytes, step: int, *, big: int = 0) -> Image:
    message = Image()
    message.height, message.width, message.step = height, width, step
    message.encoding, message.is_bigendian, message.data = encoding, big, data
    return message


@pytest.mark.parametrize(
    ("encoding", "pixel"),
    [
        ("rgb8", [RED, GREEN, BLUE]),
        ("bgr8", [BLUE, GREEN, RED]),
        ("8UC3", [BLUE, GREEN, RED]),
        ("rgba8", [RED, GREEN, BLUE, ALPHA]),
        ("bgra8", [BLUE, GREEN, RED, ALPHA]),
        ("8UC4", [BLUE, GREEN, RED, ALPHA]),
        ("rgb16", [RED, 0, GREEN, 0, BLUE, 0]),
        ("bgr16", [BLUE, 0, GREEN, 0, RED, 0]),
        ("16UC3", [BLUE, 0, GREEN, 0, RED, 0]),
    ],
)
def test_colour_encodings_become_rgb(encoding, pixel):
    read = read_image(make(encoding, 1, 2, bytes([*pixel, *[0] * len(pixel)]), 2 * len(pixel)))
    assert read.shape == (1, 2, 3)
    assert read[0].tolist() == [[RED, GREEN, BLUE], [0, 0, 0]]
    assert read.dtype == (np.uint16 if "16" in encoding else np.uint8)


@pytest.mark.parametrize("encoding", ["mono8", "8UC1"])
def test_bytes_after_a_row_are_skipped(encoding):
    read = read_image(make(encoding, 2, 3, bytes([1, 2, 3, 255, 4, 5, 6]), 4))
    assert read.tolist() == [[1, 2, 3], [4, 5, 6]]


@pytest.mark.parametrize("encoding", ["mono16", "16UC1"])
@pytest.mark.parametrize(("big", "data"), [(0, [1, 2, 3, 4]), (1, [2, 1, 4, 3])])
def test_16_bits_of_either_byte_order(encoding, big, data):
    read = read_image(make(encoding, 1, 2, bytes(data), 4, big=big))
    assert read.tolist() == [[0x0201, 0x0403]]
    assert read.dtype == np.uint16
    assert read.dtype.isnative


@pytest.mark.parametrize(
    ("height", "width", "step", "count", "words"),
    [
        (0, 4, 4, 0, "4x0 pixels has none"),
        (2, 4, 3, 8, "states step 3; a row of 4 pixels in mono8 takes 4 bytes"),
        (2, 4, 4, 7, "4x2 in mono8 has 7 bytes; it needs 8"),
    ],
)
def test_damaged_images_are_refused(height, width, step, count, words):
    with pytest.raises(InputError, match=re.escape(words)):
        read_image(make("mono8", height, width, bytes(count), step))
