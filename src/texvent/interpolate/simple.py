"""Interpolators that estimate nothing: no frames, a cross-fade, or the scene itself rendered."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import ClassVar

from texvent.config import InterpolateConfig
from texvent.errors import ConfigError
from texvent.frames import Frame, FrameStream, RenderableStream
from texvent.pairs.motion_interpolation import MotionInterpolation


class NoInterpolator:
    """Adds no frames (ablation of Eq. 4)."""

    bytes_per_pixel: ClassVar[int] = 0

    def __init__(self, config: InterpolateConfig, stream: FrameStream) -> None:
        del config, stream  # the arguments of every interpolator; not used here

    def between(self, first: Frame, second: Frame, times_us: Sequence[int]) -> Iterator[Frame]:
        """No frames."""
        del first, second, times_us
        return iter(())


class BlendInterpolator:
    """Cross-fades: intensity changes linearly in time at every pixel."""

    bytes_per_pixel: ClassVar[int] = 30

    def __init__(self, config: InterpolateConfig, stream: FrameStream) -> None:
        del config, stream  # the arguments of every interpolator; not used here

    def between(self, first: Frame, second: Frame, times_us: Sequence[int]) -> MotionInterpolation:
        """Frames `I_1 + τ (I_2 − I_1)`, τ = (t − t_1) / (t_2 − t_1).

        Args:
            first: the earlier source frame.
            second: the later source frame.
            times_us: times of the intermediate frames, µs.

        Returns:
            One frame per time, [H, W] float32 luma, 0..255 scale.
        """
        return MotionInterpolation.between(first, second, times_us, None)


class ExactInterpolator:
    """Renders each intermediate frame, so nothing is estimated.

    Raises:
        ConfigError: the stream cannot render an instant; only generated scenes can.
    """

    bytes_per_pixel: ClassVar[int] = 130
    """Most of it for the flow that counts the frames of fast motion (`CountPolicy`)."""

    def __init__(self, config: InterpolateConfig, stream: FrameStream) -> None:
        del config  # an argument of every interpolator; not used here
        if not isinstance(stream, RenderableStream):
            raise ConfigError(
                "interpolate is 'exact', but these frames cannot be rendered at any instant; "
                "use flow, blend or none (exact works with generators such as procedural)"
            )
        self._stream = stream

    def between(self, first: Frame, second: Frame, times_us: Sequence[int]) -> Iterator[Frame]:
        """Frames of the scene at `times_us`.

        Args:
            first: the earlier source frame.
            second: the later source frame.
            times_us: times of the intermediate frames, µs.

        Yields:
            One frame per time, [H, W] float32 luma, 0..255 scale.
        """
        for t_us in times_us:
            exact = self._stream.at(t_us)
            luma = exact.float_luma.copy()  # a renderer may fill one array again and again
            yield Frame(luma, t_us, is_source=False, transfer=exact.transfer)
