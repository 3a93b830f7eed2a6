"""Coded pixels → linear light (OpenEXR, Radiance, HDR10, HLG), or the light that a model takes.

A source says in its metadata how its pixels are coded (`"coding"`), if not as ordinary video; the
option `transfer` overrides it.

Models that declare `takes_linear` get linear light as it is. All others are defined on the luma of
ordinary video: linear frames are gamma-coded for them by sRGB's curve, which goes on above white.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent._registry import SIMULATORS
from texvent.capture.frame_source import ChangedFrames
from texvent.capture.intensity_scale import float_levels
from texvent.config import CaptureConfig
from texvent.frames import UINT16_PER_LEVEL, Frame, FrameStream, PixelArray, transfer_of
from texvent.options.values import option_names
from texvent.transfer import DECODERS, WHITE, Transfer, encode_srgb


def adapt_transfer(video: FrameStream, simulator: str, config: Any) -> tuple[FrameStream, Any]:
    """Frames in the transfer that a pixel model is defined for, and the model's options for them.

    The option `gamma` of a model undoes the coding of frames: for linear ones it is 1.
    """
    if transfer_of(video) is Transfer.GAMMA:
        return video, config
    if not getattr(SIMULATORS.load(simulator), "takes_linear", False):
        return gamma_coded(video), config
    return video, replace(config, gamma=1.0) if "gamma" in option_names(type(config)) else config


def gamma_coded(video: FrameStream) -> FrameStream:
    """A linear stream as gamma-coded frames.

    A stream that renders its frames codes them itself, so that it can still render any instant.
    """
    code_itself: Callable[[], FrameStream] | None = getattr(video, "gamma_coded", None)
    return GammaCodedFrames(video) if code_itself is None else code_itself()


class GammaCodedFrames(ChangedFrames):
    """The frames of a linear stream, gamma-coded."""

    @property
    def metadata(self) -> Mapping[str, Any]:
        """The source's, without what says that it is linear."""
        return {name: one for name, one in self.source.metadata.items() if name != "transfer"}

    def __iter__(self) -> Iterator[Frame]:
        """Frames in time order, float32."""
        yield from map(gamma_coded_frame, self.source)


def gamma_coded_frame(frame: Frame) -> Frame:
    """A frame as gamma-coded levels, float32 where it was linear."""
    if frame.transfer is Transfer.GAMMA:
        return frame
    coded = encode_srgb(float_levels(frame.pixels) / np.float32(WHITE))
    return replace(frame, pixels=coded, transfer=Transfer.GAMMA)


UINT16_FULL = WHITE * UINT16_PER_LEVEL
AUTO, GAMMA, LINEAR, HALF = "auto", "gamma", "linear", "half"
CODING = "coding"
"""Key in a source's metadata; absent where pixels are gamma-coded."""
FULL_SCALE = "full_scale"
"""Key in a source's metadata: the value that is white, or a signal's 1, where the pixels' type does
not say it."""
VIDEO_CODINGS = {8: LINEAR, 16: "pq", 18: "hlg"}
"""libav's number of a transfer characteristic (ISO/IEC 23091-2) → coding; others are gamma-coded.
"""


def decode_light(stream: FrameStream, config: CaptureConfig) -> tuple[FrameStream, CaptureConfig]:
    """The stream as linear light where it is not gamma-coded, and what is left to do to it.

    Args:
        stream: frames as they come.
        config: its `transfer` says how they are coded, unless it is auto; its `white_level` which
            light is white.
    """
    coding, white_level = find_coding(stream.metadata, config)
    if coding == GAMMA:
        return stream, replace(config, white_level=white_level)
    return LinearFrames(stream, coding, white_level), replace(config, white_level=None)


def find_coding(facts: Mapping[str, Any], config: CaptureConfig) -> tuple[str, float | None]:
    """Coding of pixels, and the level that is white, if any is stated.

    Args:
        facts: metadata of the source.
        config: its `transfer` and `white_level`.
    """
    coding = facts.get(CODING, GAMMA) if config.transfer == AUTO else config.transfer
    if coding in (GAMMA, LINEAR):
        return coding, config.white_level or facts.get(FULL_SCALE)
    return coding, config.white_level


def linear_facts(coding: str) -> dict[str, str]:
    """Metadata of frames that were made linear."""
    return {CODING: coding, "transfer": Transfer.LINEAR.value}


class LinearFrames(ChangedFrames):
    """The frames of a source as linear light, 255 where it is white.

    Args:
        source: its frames, coded.
        coding: linear, srgb, pq or hlg.
        white_level: as for `to_light`.
    """

    def __init__(self, source: FrameStream, coding: str, white_level: float | None) -> None:
        super().__init__(source)
        self._coding, self._white_level = coding, white_level

    @property
    def metadata(self) -> Mapping[str, Any]:
        """The source's, and that the frames are linear."""
        return {**self.source.metadata, **linear_facts(self._coding)}

    def __iter__(self) -> Iterator[Frame]:
        """Frames in time order, float32."""
        full_scale = self.source.metadata.get(FULL_SCALE)
        for frame in self.source:
            pixels = to_light(frame.pixels, self._coding, full_scale, self._white_level)
            yield replace(frame, pixels=pixels, transfer=Transfer.LINEAR)


def to_light(
    pixels: PixelArray,
    coding: str,
    full_scale: float | None = None,
    white_level: float | None = None,
) -> NDArray[np.float32]:
    """Coded pixels as linear light, 255 where it is white. NaN stays.

    Args:
        pixels: [H, W] or [H, W, 3], any type of `Frame.pixels`.
        coding: linear, srgb, pq or hlg.
        full_scale: value of the signal 1; None: as for frames of that type (65535 for uint16, else
            255).
        white_level: light that is white, in the unit of the coding: cd/m² of PQ, a share of the
            peak of HLG and sRGB, a pixel's value where it is linear. None: `DECODERS` has it, and
            linear pixels are white at full scale.
    """
    full = full_scale or (UINT16_FULL if pixels.dtype == np.uint16 else WHITE)
    if coding == LINEAR:
        # What filters leave below 0 counts as 0.
        light = np.maximum(np.asarray(pixels, np.float32), np.float32(0))
        return light * np.float32(WHITE / (white_level or full))
    if pixels.dtype.kind == "f":
        return _decoded(pixels / full, coding, white_level)
    return _table(int(np.iinfo(pixels.dtype).max), full, coding, white_level)[pixels]


@functools.lru_cache(maxsize=4)
def _table(
    highest: int, full: float, coding: str, white_level: float | None
) -> NDArray[np.float32]:
    """Linear light of all whole levels: frames are looked up."""
    return _decoded(np.arange(highest + 1) / full, coding, white_level)


def _decoded(
    signal: NDArray[np.floating], coding: str, white_level: float | None
) -> NDArray[np.float32]:
    decode, own_white = DECODERS[coding]
    return decode(signal) * np.float32(WHITE / (white_level or own_white))
