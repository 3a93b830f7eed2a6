"""Image files decoded by OpenCV, after a look at how large their heads say that they are."""

from __future__ import annotations

import contextlib
import re
import struct
from mmap import mmap
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, one_line
from texvent.runtime.memory import check_claim

DAMAGE = (struct.error, ValueError, IndexError, KeyError)
"""Raised where the head of an image is damaged."""
COPIES = 3
"""An image is decoded, its colours change places, and it is handed on."""
_JPEG_SIZE = re.compile(rb"\xff[\xc0-\xc3\xc5-\xc7\xc9-\xcb\xcd-\xcf]...(....)(.)", re.DOTALL)
_GAP = rb"(?:\s|#[^\n]*\n)+"
_TEXT_SIZE = re.compile(
    rb"#\?.*?[-+][XY] +(\d+) +[-+][XY] +(\d+)|P\d" + _GAP + rb"(\d+)" + _GAP + rb"(\d+)",
    re.DOTALL,
)
"""Sizes in headers of Radiance HDR, and of PNM."""
_JPEG_2000 = b"\xff\x4f\xff\x51"
HEAD_BYTES = 4096
"""An animation says that it is one before its first pixels."""
TIFF_HEADS = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")
WIDTH, HEIGHT, BITS, PHOTOMETRIC, CHANNELS = 256, 257, 258, 262, 277
"""Tags of TIFF."""


def decode_image(path: Path, flags: int) -> NDArray[Any]:
    """The image of a file, [H, W] or [H, W, channels], as `cv2.imdecode` gives it with these flags.

    Raises:
        FileFormatError: it cannot be decoded, is an animation, or would fill the memory.
    """
    return decode_bytes(path.read_bytes(), str(path), flags)


def decode_bytes(data: bytes, path: str, flags: int) -> NDArray[Any]:
    """As `decode_image`, of the content of a file; `path` names it in messages."""
    import cv2  # only images need it

    if is_animation(data[:HEAD_BYTES]):
        raise FileFormatError(
            f"{path} is an animation, not one image; give it as the source by itself"
        )
    claimed = 0
    with contextlib.suppress(*DAMAGE):  # then the decoder says what is wrong
        claimed = stated_bytes(data)
    check_claim(claimed, path, copies=COPIES, size=len(data))
    try:
        image = cv2.imdecode(np.frombuffer(data, np.uint8), flags) if data else None
    except cv2.error as error:
        raise FileFormatError(f"image {path} is damaged: {one_line(error)}") from error
    if image is None:
        raise FileFormatError(
            f"image {path} cannot be decoded; it may be cut off, damaged, of over 2^30 pixels, or "
            "of pixels that OpenCV does not read; save it as PNG or TIFF of 8 or 16 bits"
        )
    return np.asarray(image)


def is_animation(head: bytes) -> bool:
    """Whether an image file that begins like this is an animated PNG or WebP."""
    if head.startswith(b"\x89PNG"):
        return b"acTL" in head
    return head[8:16] == b"WEBPVP8X" and bool(head[20:21] and head[20] & 2)


def stated_bytes(data: bytes) -> int:
    """Bytes of the pixels that an image has by its head; 0 where its format is another.

    PNG, JPEG, TIFF, BMP, GIF, WebP, JPEG 2000, AVIF, Radiance HDR, PNM.

    Raises:
        Exception: one of `DAMAGE`; the head is damaged.
    """
    width, height, channels, bits = 0, 0, 3, 8
    if data[:4] == b"\x89PNG":
        width, height, bits = struct.unpack_from(">IIB", data, 16)
        channels = {0: 1, 4: 2, 6: 4}.get(data[25], 3)
    elif data[:2] == b"\xff\xd8":
        width, height, channels = _jpeg_size(data)
    elif data[:4] in TIFF_HEADS:
        tags = tiff_tags(data)
        width, height = tags[WIDTH], tags[HEIGHT]
        channels, bits = tags.get(CHANNELS, 1), tags.get(BITS, 8)
    elif data[:2] == b"BM":
        width, height = map(abs, struct.unpack_from("<ii", data, 18))
    elif data[:4] == b"GIF8":
        width, height = struct.unpack_from("<HH", data, 6)
    elif data[8:12] == b"WEBP":
        width, height = _webp_size(data)
    elif data[4:8] in (b"jP  ", b"ftyp") or data[:4] == _JPEG_2000:
        width, height, bits = *_boxed_size(data), 16
    elif found := _TEXT_SIZE.match(data[:HEAD_BYTES]):
        width, height = int(found[1] or found[3]), int(found[2] or found[4])
        bits = 32 if found[1] else 16
    return width * height * channels * max(bits // 8, 1)


def _jpeg_size(data: bytes) -> tuple[int, int, int]:
    """Width, height and channels, in the first frame head among the segments."""
    place = 2
    while not (found := _JPEG_SIZE.match(data, place)):
        is_filled = data[place + 1] == 0xFF
        place += 1 if is_filled else 2 + struct.unpack_from(">H", data, place + 2)[0]
    height, width = struct.unpack(">HH", found[1])
    return width, height, found[2][0]


def tiff_tags(data: bytes | mmap) -> dict[int, int]:
    """The first value of each tag of whole numbers, of the first page; of BigTIFF too.

    Raises:
        Exception: one of `DAMAGE`; the head is damaged.
    """
    order = "<" if data[:1] == b"I" else ">"
    is_big = b"+" in data[2:4]
    # Formats of an offset and a count of tags; bytes of a place, before the first tag, and of one.
    offset, count, room, gap, length = ("Q", "Q", 8, 8, 20) if is_big else ("I", "H", 4, 2, 12)
    start = struct.unpack_from(order + offset, data, room)[0]
    last = start + gap + length * struct.unpack_from(order + count, data, start)[0]
    tags = {}
    for place in range(start + gap, min(last, len(data)), length):
        tag, kind, size = struct.unpack_from(order + "HH" + offset, data, place)
        if form := {1: "B", 3: "H", 4: "I", 16: "Q"}.get(kind):
            value = place + length - room
            if size * struct.calcsize(form) > room:  # the values are elsewhere
                value = struct.unpack_from(order + offset, data, value)[0]
            tags[tag] = struct.unpack_from(order + form, data, value)[0]
    return tags


def _boxed_size(data: bytes) -> tuple[int, int]:
    """Width and height of JPEG 2000, in a box or not, and of AVIF, whose boxes are alike."""
    if data[4:8] == b"jP  ":
        height, width = struct.unpack_from(">II", data, data.index(b"ihdr") + 4)
    else:
        place = 8 if data[:4] == _JPEG_2000 else data.index(b"ispe") + 8
        width, height = struct.unpack_from(">II", data, place)
    return width, height


def _webp_size(data: bytes) -> tuple[int, int]:
    kind = data[12:16]
    if kind == b"VP8X":
        width, height = (int.from_bytes(data[at : at + 3], "little") + 1 for at in (24, 27))
        return width, height
    if kind == b"VP8L":
        packed = int.from_bytes(data[21:25], "little")
        return (packed & 0x3FFF) + 1, (packed >> 14 & 0x3FFF) + 1
    width, height = struct.unpack_from("<HH", data, 26)
    return width & 0x3FFF, height & 0x3FFF
