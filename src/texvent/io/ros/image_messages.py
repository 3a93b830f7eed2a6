"""ROS messages that hold an image, unpacked: sensor_msgs/Image and CompressedImage.

    Image            header · u32 height · u32 width · string encoding · u8 is_bigendian ·
                     u32 step · bytes, rows of `step` bytes
    CompressedImage  header · string format · bytes of a JPEG, PNG or other image file

Source: sensor_msgs, message definitions and image_encodings.h; cv_bridge, order of Bayer patterns.
"""

from __future__ import annotations

import struct
from collections.abc import Mapping

import numpy as np

from texvent.errors import FileFormatError, shown
from texvent.frames import PixelArray
from texvent.io.ros.messages import MessageFields
from texvent.runtime.files.image_files import decode_bytes

IMAGE = "sensor_msgs/msg/Image"
COMPRESSED = "sensor_msgs/msg/CompressedImage"
IMAGE_MESSAGES = (IMAGE, COMPRESSED)
ENCODINGS: Mapping[str, tuple[str, int, slice]] = {
    **dict.fromkeys(("mono8", "8UC1"), ("u1", 1, slice(None))),
    "mono16": ("u2", 1, slice(None)),
    "rgb8": ("u1", 3, slice(None)),
    "rgb16": ("u2", 3, slice(None)),
    "rgba8": ("u1", 4, slice(3)),
    **dict.fromkeys(("bgr8", "8UC3"), ("u1", 3, slice(None, None, -1))),
    **dict.fromkeys(("bgr16", "16UC3"), ("u2", 3, slice(None, None, -1))),
    **dict.fromkeys(("bgra8", "8UC4"), ("u1", 4, slice(2, None, -1))),
}
"""Encoding → type of its values, their number per pixel, and those of them that are red, green and
blue, or grey. 16UC1 is not among them: in bags it is depth, mostly."""
DEPTH = ("16UC1", "32FC1")
BAYER = {"rggb": "BG", "bggr": "RG", "gbrg": "GR", "grbg": "GB"}
"""Pattern of a Bayer encoding such as bayer_rggb8, by its first two rows → OpenCV's name of it, by
the second pixel of the second row."""


def image_stamp_ns(data: bytes, version: int) -> int:
    """Time in the header of a serialised image message, ns.

    Raises:
        FileFormatError: it is damaged.
    """
    try:
        return MessageFields(data, version).header()
    except struct.error as error:
        raise FileFormatError("a message of an image is cut off") from error


def read_image(kind: str, data: bytes, version: int) -> PixelArray:
    """[H, W] grey or [H, W, 3] RGB of a serialised image message, uint8 or uint16.

    Raises:
        FileFormatError: it is damaged, or its encoding is not read.
    """
    try:
        fields = MessageFields(data, version)
        fields.header()
        if kind == COMPRESSED:
            return _decompressed(fields)
        height, width = fields.number("I"), fields.number("I")
        encoding = fields.text().decode("latin-1")
        is_big_endian, step = bool(fields.number("B")), fields.number("I")
        rows = fields.data()
    except struct.error as error:
        raise FileFormatError("a message of an image is cut off") from error
    pattern = encoding.removeprefix("bayer_").removesuffix("8")
    is_bayer = f"bayer_{pattern}8" == encoding and pattern in BAYER
    if not is_bayer and encoding not in ENCODINGS:
        raise FileFormatError(
            f"an image is encoded as {shown(encoding)}; texvent reads {', '.join(ENCODINGS)} and "
            f"bayer_ {', '.join(f'{one}8' for one in BAYER)}; republish it as one of these"
        )
    kind, count, channels = ENCODINGS["mono8" if is_bayer else encoding]
    dtype = np.dtype(kind).newbyteorder(">" if is_big_endian else "<")
    used = width * count * dtype.itemsize
    if not width or not height or step < used or len(rows) < step * (height - 1) + used:
        raise FileFormatError(
            f"an image of {width}x{height} {encoding} has {len(rows)} bytes in rows of {step}"
        )
    whole = np.zeros(step * height, np.uint8)  # the last row may end with its pixels
    whole[: len(rows)] = np.frombuffer(rows, np.uint8)[: len(whole)]
    pixels = np.ascontiguousarray(whole.reshape(height, step)[:, :used]).view(dtype)
    pixels = pixels.astype(dtype.newbyteorder("="), copy=False)
    if is_bayer:
        return _without_mosaic(pixels, pattern)
    if count == 1:
        return pixels
    return np.ascontiguousarray(pixels.reshape(height, width, count)[..., channels])


def _without_mosaic(pixels: PixelArray, pattern: str) -> PixelArray:
    import cv2

    code = getattr(cv2, f"COLOR_Bayer{BAYER[pattern]}2RGB")
    return np.asarray(cv2.cvtColor(pixels, code), np.uint8)


def _decompressed(fields: MessageFields) -> PixelArray:
    import cv2

    form = fields.text().decode("latin-1")
    if "compressedDepth" in form or form.startswith(DEPTH):
        raise FileFormatError(f"an image is of depth ({shown(form)}); choose a topic of pictures")
    flags = cv2.IMREAD_ANYCOLOR | cv2.IMREAD_ANYDEPTH | cv2.IMREAD_IGNORE_ORIENTATION
    pixels = decode_bytes(bytes(fields.data()), f"of a message ({shown(form)})", flags)
    if pixels.dtype.kind != "u":
        raise FileFormatError(f"an image has values of {pixels.dtype}; texvent reads 8 or 16 bits")
    return np.ascontiguousarray(pixels[..., 2::-1]) if pixels.ndim == 3 else pixels
