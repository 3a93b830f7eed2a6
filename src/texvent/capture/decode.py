"""A decoded PyAV frame → an upright NumPy image at its own precision."""

from __future__ import annotations

import json

import numpy as np
from av.video.format import VideoFormat
from av.video.frame import VideoFrame
from av.video.reformatter import ColorRange

from texvent.capture.linear_light import CODING, HALF, LINEAR, VIDEO_CODINGS
from texvent.video import PixelArray

QUARTER_TURN = 90
UNSPECIFIED = 2
"""libav's number of an unknown transfer characteristic."""


def decoded_pixels(frame: VideoFrame) -> PixelArray:
    """Pixels of a decoded frame, turned as its display matrix says.

    Args:
        frame: any video frame that libav decodes.

    Returns:
        [H, W] for grey formats, else [H, W, 3] RGB; uint8 for up to 8 bits per component, uint16
        (65535 is white) for more. Alpha is dropped. YUV becomes RGB by the matrix and range that
        the file states; files that state none are read as BT.601 limited range, as libav does.
        libav's 16-bit RGB of deep YUV has its white at 65283, 0.4 % below full scale.
    """
    image = frame.reformat(format=pixel_format(frame.format), dst_color_range=ColorRange.JPEG)
    pixels = image.to_ndarray()
    turns = round(frame.rotation / QUARTER_TURN) % 4
    return np.ascontiguousarray(np.rot90(pixels, turns)) if turns else pixels


def coding_facts(frame: VideoFrame, comment: str = "") -> dict[str, str]:
    """How a decoded frame is coded, for a source's metadata: nothing where it is gamma-coded.

    Args:
        frame: it says its transfer characteristic.
        comment: of the file; texvent writes facts there as JSON, and light as half floats.
    """
    try:
        facts = json.loads(comment)
    except (ValueError, RecursionError):
        facts = None
    if isinstance(facts, dict) and (facts.get("transfer"), facts.get(CODING)) == (LINEAR, HALF):
        return {CODING: HALF}
    # PyAV 16 and older do not tell.
    coding = VIDEO_CODINGS.get(int(getattr(frame, "color_trc", UNSPECIFIED)))
    return {} if coding is None else {CODING: coding}


def pixel_format(source: VideoFormat) -> str:
    """The libav format that keeps the precision and the colour of `source`.

    Args:
        source: format of a decoded frame.

    Returns:
        `gray`, `gray16le`, `rgb24` or `rgb48le`.
    """
    # Palettes (GIF, PNG) have one component, but it is an index, not a grey level.
    planes = [component for component in source.components if not component.is_alpha]
    is_grey = len(planes) == 1 and planes[0].is_luma and not source.has_palette
    is_deep = max(component.bits for component in planes) > 8
    if is_grey:
        return "gray16le" if is_deep else "gray"
    return "rgb48le" if is_deep else "rgb24"
