"""Transfer adaptation: linear or gamma-coded frames, as a pixel model is defined for them.

Models that declare `takes_linear` get linear light as it is. All others are defined on the luma of
ordinary video: linear frames are gamma-coded for them by sRGB's curve, which goes on above white.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from texvent._registry import SIMULATORS
from texvent.capture.frame_source import ChangedFrames
from texvent.capture.intensity_scale import float_levels
from texvent.frames import Frame, FrameStream, transfer_of
from texvent.options.values import option_names
from texvent.transfer import WHITE, Transfer, encode_srgb


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
