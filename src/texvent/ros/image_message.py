"""sensor_msgs/Image → pixels.

Source: sensor_msgs, Image.msg and image_encodings.hpp; cv_bridge, which takes plain 8UC3 as BGR.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError, few, shown
from texvent.io.ros.messages import NS_PER_S


class Encoding(NamedTuple):
    """How pixels lie in an Image."""

    dtype: str
    """NumPy type of a channel, little-endian."""
    channels: int
    order: tuple[int, ...] | None
    """Channels of red, green and blue; None for grey."""


_RGB, _BGR = (0, 1, 2), (2, 1, 0)
ENCODINGS = {
    "mono8": Encoding("u1", 1, None),
    "8UC1": Encoding("u1", 1, None),
    "mono16": Encoding("<u2", 1, None),
    "16UC1": Encoding("<u2", 1, None),
    "rgb8": Encoding("u1", 3, _RGB),
    "bgr8": Encoding("u1", 3, _BGR),
    "8UC3": Encoding("u1", 3, _BGR),
    "rgba8": Encoding("u1", 4, _RGB),
    "bgra8": Encoding("u1", 4, _BGR),
    "8UC4": Encoding("u1", 4, _BGR),
    "rgb16": Encoding("<u2", 3, _RGB),
    "bgr16": Encoding("<u2", 3, _BGR),
    "16UC3": Encoding("<u2", 3, _BGR),
}
"""Name in the message → layout. Others have no agreed white, or are not images of light."""
ADVICE = {
    "bayer": "publish a demosaiced image, such as that of image_proc",
    "yuv": "let the camera's driver publish mono8 or rgb8",
    "nv": "let the camera's driver publish mono8 or rgb8",
    "32F": "floats have no agreed white; publish mono16",
    "64F": "floats have no agreed white; publish mono16",
}
"""Beginning of an encoding → what to do instead."""


def read_image(message: Any) -> NDArray[Any]:
    """Pixels of a sensor_msgs/Image.

    Args:
        message: anything with the fields of the message.

    Returns:
        [H, W] grey or [H, W, 3] RGB, uint8 or uint16; alpha is left out. A view of the message's
        bytes where these need no change.

    Raises:
        InputError: an encoding that is not in `ENCODINGS`, no pixel, a step shorter than a row, or
            fewer bytes than the rows take.
    """
    encoding = _encoding(str(message.encoding))
    height, width, step = int(message.height), int(message.width), int(message.step)
    if height < 1 or width < 1:
        raise InputError(f"an image of {width}x{height} pixels has none; check who publishes it")
    dtype = np.dtype(encoding.dtype)
    if message.is_bigendian:
        dtype = dtype.newbyteorder(">")
    row_bytes = width * encoding.channels * dtype.itemsize
    if step < row_bytes:
        raise InputError(
            f"an image states step {step}; a row of {width} pixels in {message.encoding} takes "
            f"{row_bytes} bytes"
        )
    data = np.frombuffer(message.data, dtype=np.uint8)
    needed = step * (height - 1) + row_bytes
    if data.size < needed:
        raise InputError(
            f"an image of {width}x{height} in {message.encoding} has {data.size} bytes; it needs "
            f"{needed}"
        )
    rows = np.lib.stride_tricks.as_strided(data, (height, row_bytes), (step, 1), writeable=False)
    values = np.ascontiguousarray(rows).view(dtype).astype(dtype.newbyteorder("="), copy=False)
    if encoding.order is None:
        return values.reshape(height, width)
    return values.reshape(height, width, encoding.channels)[:, :, list(encoding.order)]


def stamp_ns(message: Any) -> int:
    """Time of a message's header, ns."""
    stamp = message.header.stamp
    return int(stamp.sec) * NS_PER_S + int(stamp.nanosec)


def _encoding(name: str) -> Encoding:
    if name in ENCODINGS:
        return ENCODINGS[name]
    known = f"texvent takes {few(list(ENCODINGS), len(ENCODINGS))}"
    advice = next((text for start, text in ADVICE.items() if name.startswith(start)), None)
    raise InputError(f"an image is encoded as {shown(name)}; {advice or known}")
