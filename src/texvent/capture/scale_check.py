"""Doubts about the scale of pixels and the unit of their times, said once for every source.

Floats that hardly exceed 1 are most likely 0..1, where texvent's are 0..255; uint16 up to 1023 or
4095 has 10 or 12 bits; levels 0 and 1 of uint8 are masks. All of them would be nearly black. Floats
far above 255, or pixels above a given `white_level`, would be nearly white.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np

from texvent.brightness import SYMMETRIC
from texvent.capture.array_frames import ArrayFrames
from texvent.capture.frame_source import ChangedFrames
from texvent.capture.given_times import warn_of_unit
from texvent.capture.intensity_scale import FULL_SCALE
from texvent.capture.linear_light import FULL_SCALE as FULL_SCALE_FACT
from texvent.capture.linear_light import GAMMA, LINEAR, find_coding
from texvent.config import CaptureConfig
from texvent.errors import InputError, warn
from texvent.frames import (
    MICROSECONDS,
    Frame,
    FrameStream,
    NotebookFrames,
    PixelArray,
    RenderableStream,
    Video,
    transfer_of,
)
from texvent.transfer import Transfer

GIVE_WHITE = (
    "Give white_level=1 if 1 means white, or white_level=255 if the images really are that dark"
)
FEW = 0.01
"""Share of pixels that highlights and the overshoot of resized images take up at most."""
OVERSHOOT = 1.25
"""The highest that resizing makes of white in 0..1."""
DIMMEST = 16.0
"""Levels of 255 that a video exceeds somewhere, unless it is nearly black."""
STEADY_FRAMES = 3
"""Frames, not black and no brighter than those before them, after which a stream is spoken of: it
no longer fades in."""
WHITES = (1023, 4095, 65535)
"""White of 10, 12 and 16 bits."""
INTEGERS, FLOATS = (np.uint8, np.uint16), (np.float32, np.float64)
TIMES_JUDGED = 4
"""Frames after which the unit of their times is judged."""


class _Evidence:
    """Pixels of one type so far."""

    def __init__(self, dtype: np.dtype[Any], white: float | None, advice: str) -> None:
        self._dtype, self._white, self._advice = dtype, white, advice
        self._lowest = self._highest = 0.0
        self._pixels = self._above_1 = self._above_white = 0
        self._is_whole = True
        self.steady_frames = 0
        """Frames with light, no brighter than those before."""
        self.is_said = False

    @property
    def has_light(self) -> bool:
        """Whether a pixel is not black."""
        return self._highest > 0

    def add(self, pixels: PixelArray) -> None:
        """Take a frame into account."""
        highest = float(pixels.max())
        self.steady_frames += 0 < highest <= self._highest
        self._highest = max(self._highest, highest)
        self._pixels += pixels.size
        self._above_white += int(np.count_nonzero(pixels > (self._white or FULL_SCALE)))
        if self._dtype.kind == "f" and self._white is None:
            self._lowest = min(self._lowest, float(pixels.min()))
            self._above_1 += int(np.count_nonzero(pixels > 1))
            self._is_whole = self._is_whole and bool((np.rint(pixels) == pixels).all())

    def doubt(self) -> tuple[bool, str] | None:
        """Whether the pixels so far are refused, and why, with the option that helps.

        Returns:
            None where nothing is doubtful.
        """
        if not np.isfinite(self._highest):  # refused elsewhere
            return None
        if self._white is not None:
            doubt = self._doubt_of_white(self._white)
        elif self._dtype.kind == "f":
            return self._doubt_of_floats()
        else:
            doubt = self._doubt_of_bits()
        return None if doubt is None else (False, doubt)

    def _doubt_of_floats(self) -> tuple[bool, str] | None:
        highest = self._highest
        if highest <= 1 and self._lowest < -0.5:
            return True, f"floats from {self._lowest:g} to {highest:g}, so {SYMMETRIC}"
        is_few = self._above_1 <= FEW * self._pixels
        if highest <= OVERSHOOT or (not self._is_whole and (is_few or highest <= DIMMEST)):
            is_sure = highest <= OVERSHOOT or (is_few and not DIMMEST < highest <= FULL_SCALE)
            share = f", of which a share of {self._above_1 / self._pixels:.3g} exceeds 1"
            return is_sure, (
                f"floats that never exceed {highest:g}{share if highest > 1 else ''}, so they "
                f"{'are probably 0..1' if is_sure else 'may be 0..1 with highlights'}, while "
                f"texvent's intensities are 0..255. {self._advice}"
            )
        if highest > FULL_SCALE and (self._is_whole or self._is_overexposed(FULL_SCALE)):
            white = next((one for one in WHITES if highest <= one), highest)
            return False, (
                f"floats up to {highest:g}, while texvent's are 0..255. Give white_level={white:g} "
                "if that is white, or white_level=255 if they really are brighter than white"
            )
        return None

    def _doubt_of_bits(self) -> str | None:
        """The same of whole levels; the highest is a lower bound of white."""
        if self._dtype == np.uint8 and self._highest <= 1:
            return (
                "no level above 1 of 255, so it is probably a mask; give white_level=1, or "
                "white_level=255 if it really is that dark"
            )
        bits = next((bits for bits in (8, 10, 12) if self._highest < 1 << bits), None)
        if self._dtype != np.uint16 or bits is None:
            return None
        return (
            f"16-bit frames up to {self._highest:g}, so they probably have {bits} bits or a few "
            f"more; give the white of the camera, such as white_level={(1 << bits) - 1}, or "
            "white_level=65535 if they really are that dark"
        )

    def _doubt_of_white(self, white: float) -> str | None:
        """The same where `white_level` is given."""
        if self._dtype.kind != "f" and white > 2 * np.iinfo(self._dtype).max:
            return f"{self._dtype}, which never comes near white_level={white:g}; check it"
        if self._above_white == 0 or not self._is_overexposed(white):
            return None
        return (
            f"values up to {self._highest:g}, of which a share of "
            f"{self._above_white / self._pixels:.3g} exceeds white_level={white:g}; give a higher "
            "one, unless they really are brighter than white"
        )

    def _is_overexposed(self, white: float) -> bool:
        is_near = self._highest <= white * WHITES[0] / FULL_SCALE
        return self._above_white > self._pixels * (0.5 if is_near else 0.1)


class ScaleCheck:
    """Evidence of the scale of pixels, gathered frame by frame until it is clear.

    Args:
        white: value that means white, if it is given; then only what exceeds it is doubted.
        sure: types whose scale is not in doubt.
        advice: said of floats of 0..1.
        only_warns: whether nothing is refused.
    """

    def __init__(
        self,
        white: float | None = None,
        *,
        sure: Iterable[type] = (),
        advice: str = GIVE_WHITE,
        only_warns: bool = False,
    ) -> None:
        self._white, self._advice, self._only_warns = white, advice, only_warns
        self._settled = {np.dtype(one) for one in sure}
        self._open: dict[np.dtype[Any], _Evidence] = {}
        self._seen: list[np.dtype[Any]] = []

    def look(self, pixels: PixelArray) -> bool:
        """Take a frame into account; whether the scale of its type is clear."""
        dtype = pixels.dtype
        if dtype in self._settled:
            return True
        evidence = self._open.setdefault(dtype, _Evidence(dtype, self._white, self._advice))
        evidence.add(pixels)
        if self._white is not None or evidence.doubt() is not None:
            return False
        del self._open[dtype]
        self._settled.add(dtype)
        return True

    def look_at_stream(self, pixels: PixelArray, where: str) -> None:
        """The same, and a warning as soon as a stream no longer fades in.

        Args:
            pixels: of the next frame.
            where: what to call it in messages.

        Warns:
            TexventWarning: another type than before, or as `conclude`.
        """
        dtype = pixels.dtype
        if dtype not in self._seen:
            if self._seen:
                warn(
                    f"{where} has pixels of type {dtype}, those before it {self._seen[-1]}; each "
                    "type is read at its own full scale"
                )
            self._seen.append(dtype)
        if self.look(pixels):
            return
        evidence = self._open[dtype]
        # A camera's events are used at once, and it may never be closed.
        enough = 1 if self._only_warns else STEADY_FRAMES
        if evidence.steady_frames >= enough and not evidence.is_said:
            self._say(evidence, f"the video up to {where}")

    def conclude(self, where: str) -> None:
        """Say what all frames leave in doubt; nothing more is said of their types.

        Args:
            where: what to call them in messages.

        Raises:
            InputError: they are most likely 0..1, or -1..1.

        Warns:
            TexventWarning: they probably have another white than their type says.
        """
        ended, self._open = self._open, {}
        self._settled.update(ended)
        for evidence in ended.values():
            self._say(evidence, where, is_all=True)

    def _say(self, evidence: _Evidence, where: str, *, is_all: bool = False) -> None:
        is_sure, doubt = evidence.doubt() or (False, None)
        if doubt is None or not evidence.has_light:
            return
        if is_all and is_sure and not self._only_warns:
            raise InputError(f"{where} holds {doubt}")
        if not evidence.is_said:
            evidence.is_said = True
            warn(f"{where} holds {doubt}")


class CheckedFrames(ChangedFrames):
    """The frames of a source as they come, with a word on what is probably not meant.

    Args:
        source: its frames.
        scale: what is known of their scale.
        judges_times: whether the unit of their times is in doubt.
    """

    def __init__(self, source: FrameStream, scale: ScaleCheck, *, judges_times: bool) -> None:
        super().__init__(source)
        self._scale, self._judges_times = scale, judges_times
        self._times_us: list[int] = []

    def __iter__(self) -> Iterator[Frame]:
        """Frames in time order.

        Raises:
            InputError: the source's, or all are most likely 0..1.
        """
        for frame in self.source:
            self._scale.look_at_stream(frame.pixels, f"the frame at {frame.t_us} µs")
            if self._judges_times:
                self._times_us.append(frame.t_us)
                if len(self._times_us) == TIMES_JUDGED:
                    self.judge_times(self._times_us)
            yield frame
        self.conclude()

    def conclude(self) -> None:
        """Say what all frames leave in doubt; see `ScaleCheck.conclude`."""
        self.judge_times(self._times_us)
        self._scale.conclude("the video")

    def judge_times(self, times_us: Sequence[int]) -> None:
        """Warn, once, of times that are probably no µs and not those of the stated rate."""
        if not self._judges_times or len(times_us) < 2:
            return
        self._judges_times = False
        step_us, rate = float(np.median(np.diff(times_us))), self.source.fps
        if rate is None or not 0.5 < step_us * rate / MICROSECONDS < 2:
            warn_of_unit(times_us, "t_us")


def check_frames(
    stream: FrameStream, config: CaptureConfig, *, only_warns: bool = False
) -> CheckedFrames:
    """The stream with a check of its scale, and of its times where a program made them.

    Args:
        stream: frames as they come: not yet linear, cut, scaled or fitted.
        config: its `white_level` and `transfer`.
        only_warns: whether nothing is refused: frames are there one by one, and so are the events.

    Raises:
        InputError: frames that can be read again are most likely 0..1, or -1..1.
    """
    is_held = isinstance(stream, ArrayFrames | Video)
    is_foreign = isinstance(stream, Video) or not isinstance(stream, NotebookFrames)
    check = _scale_of(stream, config, is_file=not (is_held or is_foreign), only_warns=only_warns)
    is_again = (is_held or isinstance(stream, RenderableStream)) and not stream.is_live
    is_unsure = is_again and config.white_level is None
    if is_unsure and not any(check.look(frame.pixels) for frame in stream):
        check.conclude("the video")
    checked = CheckedFrames(stream, check, judges_times=is_foreign)
    if isinstance(stream, Video):
        checked.judge_times(stream.times_us)
    return checked


def _scale_of(
    stream: FrameStream, config: CaptureConfig, *, is_file: bool, only_warns: bool
) -> ScaleCheck:
    """The check of a stream, by what it says of its pixels, and what the options say."""
    coding, _ = find_coding(stream.metadata, config)
    if stream.metadata.get(FULL_SCALE_FACT) is not None or transfer_of(stream) is Transfer.LINEAR:
        return ScaleCheck(sure=(*INTEGERS, *FLOATS))
    if config.white_level is not None and coding in (GAMMA, LINEAR):
        return ScaleCheck(config.white_level)
    if coding == GAMMA:
        # A file's bytes are levels, as dark as they may be.
        return ScaleCheck(sure=(np.uint8,) if is_file else (), only_warns=only_warns)
    # Of a signal, white_level says which light is white, not which value is the signal 1.
    signal = f"A signal coded as {coding} is 0..255 in float frames: multiply it by 255"
    advice = GIVE_WHITE if coding == LINEAR else signal
    return ScaleCheck(sure=INTEGERS, advice=advice, only_warns=only_warns)


def check_image_scale(pixels: PixelArray, where: str) -> None:
    """Say what an image leaves in doubt; see `ScaleCheck.conclude`."""
    scale = ScaleCheck()
    scale.look(pixels)
    scale.conclude(where)
