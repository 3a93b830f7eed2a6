"""Dense optical flow between two frames by DIS (OpenCV), in both directions."""

from __future__ import annotations

import math
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

FlowArray = NDArray[np.float32]
ByteArray = NDArray[np.uint8]

SMALL_SIDE_PX = 100
"""Frames with a shorter side than this are enlarged before the flow: DIS matches 8×8 patches on
half-size pictures, which says little about a small frame."""
ENLARGE = 3
LEAST_SIDE_PX = 32
"""DIS refuses pictures below 12 px and gives NaN on narrow strips: edges are repeated this far."""
LEAST_RANGE = 16.0
"""The flow sees this many intensity levels or more stretched over 8 bits, so that the noise of a
flat frame does not look like texture."""
BAND_ROWS = 16
"""Rows that are converted at a time: what they need stays in the processor's cache."""


class DisFlow:
    """DIS with the preset MEDIUM, on an 8-bit stretched copy of the frames.

    Only the flow sees 8 bits; frames are warped at full precision. The result does not depend on
    the number of OpenCV threads (tested).

    Source: Kroeger et al., Fast Optical Flow using Dense Inverse Search (ECCV 2016).
    """

    def __init__(self) -> None:
        # One for each direction: they keep buffers.
        self._ahead, self._back = (
            cv2.DISOpticalFlow.create(cv2.DISOPTICAL_FLOW_PRESET_MEDIUM) for _ in range(2)
        )

    def both_ways(
        self, first: NDArray[np.float32], second: NDArray[np.float32]
    ) -> tuple[FlowArray, FlowArray]:
        """Flow from first to second, and from second to first.

        Args:
            first: the earlier frame, [H, W], intensity.
            second: the later frame, [H, W], intensity.

        Returns:
            Two flows, [H, W, 2] float32 as (x, y), px; finite.
        """
        shape = first.shape
        earlier, later = stretch_to_bytes(first, second)
        scale = ENLARGE if min(shape) < SMALL_SIDE_PX else 1
        earlier, later = _enlarge(earlier, scale), _enlarge(later, scale)
        # At once, because OpenCV's own threads speed up one direction by a third only.
        with ThreadPoolExecutor(1, "texvent-flow") as helper:
            back = helper.submit(_flow, self._back, later, earlier)
            forward = _reduce(_flow(self._ahead, earlier, later), shape, scale)
            return forward, _reduce(back.result(), shape, scale)


def stretch_to_bytes(
    first: NDArray[np.float32], second: NDArray[np.float32]
) -> tuple[ByteArray, ByteArray]:
    """8-bit copies of two frames with one common scale, from their darkest to brightest level."""
    low = float(min(first.min(), second.min()))
    high = float(max(first.max(), second.max()))
    gain = np.float32(255.0 / max(high - low, LEAST_RANGE))
    return _to_bytes(first, low, gain), _to_bytes(second, low, gain)


def _flow(dis: Any, earlier: ByteArray, later: ByteArray) -> FlowArray:
    height, width = earlier.shape
    flow = dis.calc(_pad(earlier), _pad(later), None)
    flow = np.asarray(flow[:height, :width], dtype=np.float32)
    with np.errstate(invalid="ignore"):
        is_finite = bool(np.isfinite(flow.sum()))
    if not is_finite:
        # A pixel without a finite flow is taken as still; the consistency check judges it.
        flow = np.nan_to_num(flow, nan=0.0, posinf=0.0, neginf=0.0)
    return np.asarray(flow, dtype=np.float32)


def _to_bytes(frame: NDArray[np.float32], low: float, gain: np.float32) -> ByteArray:
    levels = np.empty(frame.shape, np.uint8)
    for top in range(0, len(frame), BAND_ROWS):
        band = slice(top, top + BAND_ROWS)
        levels[band] = np.rint((frame[band] - np.float32(low)) * gain)
    return levels


def _enlarge(picture: ByteArray, scale: int) -> ByteArray:
    if scale == 1:
        return picture
    size = (picture.shape[1] * scale, picture.shape[0] * scale)
    return np.asarray(cv2.resize(picture, size, interpolation=cv2.INTER_CUBIC), dtype=np.uint8)


def _pad(picture: ByteArray) -> ByteArray:
    height, width = picture.shape
    # DIS chooses its coarsest scale by the width alone, so a long strip must not be too flat.
    least = max(LEAST_SIDE_PX, math.ceil(max(height, width) / 16))
    below, right = max(0, least - height), max(0, least - width)
    if below == 0 and right == 0:
        return picture
    return np.pad(picture, ((0, below), (0, right)), mode="edge")


def _reduce(flow: FlowArray, shape: tuple[int, ...], scale: int) -> FlowArray:
    if scale == 1:
        return np.ascontiguousarray(flow)
    height, width = shape
    cells = flow.reshape(height, scale, width, scale, 2)
    return np.ascontiguousarray(cells.mean(axis=(1, 3), dtype=np.float32) / np.float32(scale))
