"""Optical flow in one file per frame: Middlebury's .flo and 16-bit PNG."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, InputError

FLO_MAGIC = b"PIEH"
FLO_HEADER = 12
FLO_UNKNOWN = 1e9
"""Components above this are not known."""
MOST_PIXELS = 1 << 28
PNG_CENTRE = 2**15
PNG_PER_PIXEL: Mapping[str, float] = {"kitti": 64.0, "dsec": 128.0}
"""Steps of a 16-bit channel per pixel of flow: the two data sets look alike and differ."""
CARLA_DEPTH_M = 1000.0
"""Depth of a CARLA depth image that is white, m."""


def read_flo(path: Path) -> NDArray[np.float32]:
    """Flow of a .flo file, [H, W, 2], px, x right and y down; NaN where it is not known.

    Raises:
        FileFormatError: it is cut off or no .flo file.

    Source: Baker et al., Middlebury optical flow, flow-code/README.txt.
    """
    with path.open("rb") as file:
        header = file.read(FLO_HEADER)
        if len(header) < FLO_HEADER or not header.startswith(FLO_MAGIC):
            raise FileFormatError(
                f"{path} does not begin as a .flo file does (PIEH, width, height)"
            )
        width, height = np.frombuffer(header, "<i4", 2, 4).tolist()
        if width < 1 or height < 1 or width * height > MOST_PIXELS:
            raise FileFormatError(f"{path} states a size of {width}x{height}")
        values = np.fromfile(file, "<f4", 2 * width * height)
    if len(values) < 2 * width * height:
        raise FileFormatError(f"{path} was cut off: it states {width}x{height} vectors")
    flow = values.reshape(height, width, 2).astype(np.float32)
    flow[(np.abs(flow) > FLO_UNKNOWN).any(axis=-1)] = np.nan
    return flow


def read_flow_png(path: Path, convention: str | None) -> NDArray[np.float32]:
    """Flow of a 16-bit PNG, [H, W, 2], px; NaN where its third channel says that it is not valid.

    Args:
        path: the file.
        convention: "kitti", "dsec" or "unreal"; the file itself does not say it.

    Raises:
        InputError: no such convention is given.
        FileFormatError: it is no PNG of three or more 16-bit channels.

    Source: KITTI 2015 devkit, readme.txt: u = (R - 2^15) / 64, B valid; DSEC, optical flow:
        (R - 2^15) / 128. Unreal: 0..1, which `CONVENTIONS` turns into NDC.
    """
    if convention not in (*PNG_PER_PIXEL, "unreal"):
        raise InputError(
            f"{path} is a PNG of flow, and KITTI and DSEC count its steps differently; give "
            "motion_convention='kitti' (1/64 px) or dsec (1/128 px)"
        )
    pixels = read_png(path)
    if pixels.dtype != np.uint16 or pixels.ndim != 3:
        raise FileFormatError(
            f"{path} has {pixels.dtype} pixels of shape {list(pixels.shape)}; a PNG of flow has "
            "three channels of 16 bits"
        )
    if convention == "unreal":
        return np.asarray(pixels[..., :2] / np.float32(65535), dtype=np.float32)
    steps = pixels[..., :2].astype(np.float32) - PNG_CENTRE
    flow = steps / np.float32(PNG_PER_PIXEL[str(convention)])
    flow[pixels[..., 2] == 0] = np.nan
    return np.asarray(flow, dtype=np.float32)


def read_depth_png(path: Path, convention: str | None) -> NDArray[np.float32]:
    """Depth of a PNG, [H, W], in stored units; CARLA's 24 bits are decoded to m.

    Raises:
        FileFormatError: it has colours and is not said to be CARLA's.

    Source: CARLA documentation, depth camera: (R + 256 G + 65536 B) / (2^24 - 1) km.
    """
    pixels = read_png(path)
    if pixels.ndim == 2:
        return pixels.astype(np.float32)
    if convention != "carla" or pixels.dtype != np.uint8:
        raise FileFormatError(
            f"{path} is a colour image; depth is one channel of 8 or 16 bits, or CARLA's 24 bits "
            "(motion_convention='carla')"
        )
    weights = np.array([1, 256, 65536], np.float64) * (CARLA_DEPTH_M / (2**24 - 1))
    return np.asarray(pixels[..., :3] @ weights, dtype=np.float32)


def read_png(path: Path) -> NDArray[Any]:
    """A PNG at its own precision, [H, W] or [H, W, 3 or 4], red first.

    Raises:
        FileFormatError: it cannot be decoded.
    """
    import cv2  # only images need it

    data = np.fromfile(path, dtype=np.uint8)
    try:
        image = cv2.imdecode(data, cv2.IMREAD_UNCHANGED) if data.size else None
    except cv2.error as error:
        raise FileFormatError(f"image {path} is damaged: OpenCV refuses it") from error
    if image is None:
        raise FileFormatError(f"image {path} cannot be decoded; it may be cut off or damaged")
    if image.ndim == 3:
        image = image[..., [2, 1, 0, *range(3, image.shape[2])]]
    return np.asarray(image)
