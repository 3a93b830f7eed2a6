"""Frames with integer-microsecond times, and streams of them.

What always holds:

* A frame's time is integer µs, computed as `t0 + round(i · 10⁶ / fps)` or read from the file;
  it is never accumulated, so it never drifts.
* Pixels keep the precision they came with: uint8 stays uint8, uint16 stays uint16, float stays
  float. Intermediate frames are float32 and are never rounded back to whole levels.
* A stream has one size, strictly increasing times, and can be iterated again (live sources
  excepted: their `is_live` is true).
* `transfer` says whether levels are gamma-coded, as in ordinary video, or linear light. A stream
  whose frames are linear says so in its metadata, too (`transfer_of`).
* `is_source` says which frames came from the video and which were interpolated; the paper's
  local brightness cache resets at source frames.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import Any, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from texvent.brightness import check_intensity, luma_bt601
from texvent.errors import InputError, shown
from texvent.options.arrays import as_array, usable_pixels, whole_us
from texvent.runtime.notebooks import NotebookValue
from texvent.sensor import SensorSize
from texvent.transfer import Transfer

MICROSECONDS = 1_000_000
PREVIEW_MARK = "preview of events, drawn by texvent"
"""Comment in video files that show events, so that they are not taken for sources."""
LATEST_US = 2**53
"""Frame times lie within ± this many µs, 285 years: float64 holds them exactly."""
UINT16_PER_LEVEL = 257.0
"""65535 / 255: a uint16 pixel is full scale, so this brings it to the 0..255 scale."""

PixelArray = NDArray[Any]


def frame_time_us(index: int, fps: Fraction, start_us: int = 0) -> int:
    """Time of frame `index` in integer µs: `start_us + round(index · 10⁶ / fps)`.

    Example:
        >>> frame_time_us(30_000, Fraction(30_000, 1001))  # 1001 s exactly: no drift
        1001000000
    """
    return start_us + round(index * MICROSECONDS / fps)


@dataclass(frozen=True, eq=False)
class MotionVectors:
    """Motion of the pixels of a source frame, known instead of estimated: a renderer's output.

    A vector is the displacement of the piece of surface seen at a pixel's centre, in pixels of
    its frame, x to the right and y down. NaN where it is not known.
    """

    forward: NDArray[np.float32] | None = None
    """[H, W, 2] from this frame to the next one; None for the last frame."""
    backward: NDArray[np.float32] | None = None
    """[H, W, 2] from this frame to the one before it; None for the first frame."""
    depth: NDArray[np.float32] | None = None
    """[H, W] distance along the optical axis, m; inf where there is no surface."""
    instance: NDArray[np.int32] | None = None
    """[H, W] id of the object seen; 0 is the background."""

    def __post_init__(self) -> None:
        for name, values in list(vars(self).items()):
            if values is not None:
                object.__setattr__(self, name, as_array(values, name).copy())


@dataclass(frozen=True, eq=False, repr=False)
class Frame(NotebookValue):
    """One image and its time.

    A source frame and its motion are copies, as they are kept until the next frame comes: cameras
    and renderers fill one array again and again.

    Raises:
        InputError: pixels are not [H, W] or [H, W, 3], not uint8, uint16, bool or float, or masked;
            or the time is not whole µs.

    Example:
        >>> import numpy as np
        >>> from texvent import Frame
        >>> Frame(np.zeros((6, 8), np.uint8), t_us=1000)
        Frame(8x6 uint8 grey, t 1000 µs)
    """

    pixels: PixelArray
    """[H, W] luma or [H, W, 3] RGB; uint8 (0..255), uint16 (0..65535) or float (0..255 scale, and
    above 255 what is brighter than diffuse white)."""
    t_us: int
    """Time, µs."""
    is_source: bool = True
    """False for a frame made by interpolation."""
    motion: MotionVectors | None = None
    """Motion vectors and depth, where the source gives them with its frames."""
    transfer: Transfer = Transfer.GAMMA
    """Whether the pixels are gamma-coded or linear light."""

    def __post_init__(self) -> None:
        pixels = usable_pixels(as_array(self.pixels, "a frame"), "a frame")
        shape = pixels.shape
        if not (pixels.ndim == 2 or (pixels.ndim == 3 and shape[2] == 3)):
            raise InputError(f"a frame must be [H, W] or [H, W, 3]; got shape {list(shape)}")
        if 0 in shape:
            raise InputError(f"a frame must have at least one pixel; got shape {list(shape)}")
        object.__setattr__(self, "pixels", pixels.copy() if self.is_source else pixels)
        object.__setattr__(self, "t_us", whole_us(self.t_us, "t_us of a frame"))

    def __repr__(self) -> str:
        kind = "" if self.is_source else ", intermediate"
        light = ", linear" if self.transfer is Transfer.LINEAR else ""
        pixels = f"{self.pixels.dtype} {'RGB' if self.pixels.ndim == 3 else 'grey'}"
        return f"Frame({self.size} {pixels}, t {self.t_us} µs{light}{kind})"

    @property
    def size(self) -> SensorSize:
        """Width and height, pixels."""
        return SensorSize(self.pixels.shape[1], self.pixels.shape[0])

    @cached_property
    def luma(self) -> PixelArray:
        """BT.601 luma, 0..255 scale, [H, W]: uint8 if the frame is 8-bit grey, else float32.

        Of linear RGB it is the same sum, of light.
        """
        pixels = self.pixels
        luma = luma_bt601(pixels) if pixels.ndim == 3 else pixels
        if pixels.dtype == np.uint16:
            return np.asarray(luma / np.float32(UINT16_PER_LEVEL), dtype=np.float32)
        if luma.dtype == np.uint8:
            return luma
        return np.asarray(luma, dtype=np.float32)

    def sampled_luma(self, step: int) -> PixelArray:
        """`luma` of every `step`-th row and column; only these are computed."""
        if "luma" in vars(self):
            return self.luma[::step, ::step]
        sample = Frame(self.pixels[::step, ::step], self.t_us, is_source=False)
        return sample.luma

    @cached_property
    def float_luma(self) -> NDArray[np.float32]:
        """Luma as float32, C-contiguous; 8-bit levels convert exactly."""
        return np.ascontiguousarray(self.luma, dtype=np.float32)


@runtime_checkable
class FrameStream(Protocol):
    """Frames of one size in strictly increasing time order.

    Example:
        >>> import texvent
        >>> frames = texvent.video("a red ball bounces", sensor="48x36", duration=0.2)
        >>> isinstance(frames, texvent.FrameStream), frames.fps, frames.frame_count
        (True, Fraction(24, 1), 5)
    """

    @property
    def size(self) -> SensorSize:
        """Width and height of every frame, pixels."""
        ...

    @property
    def fps(self) -> Fraction | None:
        """Nominal frame rate, or None where the times are irregular and nothing was stated."""
        ...

    @property
    def frame_count(self) -> int | None:
        """Number of frames (an estimate from the container, for progress), or None."""
        ...

    @property
    def is_live(self) -> bool:
        """True if the frames can be read only once."""
        ...

    @property
    def metadata(self) -> Mapping[str, Any]:
        """Origin of the frames (JSON-serialisable), stored in every output.

        `{"transfer": "linear"}` among it where the frames are linear light.
        """
        ...

    def __iter__(self) -> Iterator[Frame]:
        """Frames in time order."""
        ...


class NotebookFrames(NotebookValue):
    """A stream of frames that shows itself in notebooks, and is not read up by that."""


@runtime_checkable
class RenderableStream(FrameStream, Protocol):
    """A stream that can also render the scene at any instant, such as the embedded generator's."""

    def at(self, t_us: int) -> Frame:
        """The frame at `t_us` (`is_source` False), float32, as exact as any other frame."""
        ...


@runtime_checkable
class MovingStream(RenderableStream, Protocol):
    """A renderable stream that also knows how everything in it moves."""

    def with_motion(self) -> MovingStream:
        """The same stream, whose source frames carry `Frame.motion`."""
        ...

    def between(self, first: Frame, second: Frame, times_us: Sequence[int]) -> Iterator[Frame]:
        """The frames at `times_us` between two of its frames, [H, W] float32 luma, in order."""
        ...


@runtime_checkable
class FlickeringStream(RenderableStream, Protocol):
    """A renderable stream that knows how fast its light beats.

    Two frames cannot show a beat between them (it aliases), so Eq. 4 cannot ask for it.
    """

    @property
    def flicker_hz(self) -> float | None:
        """Periods per second of the fastest light that beats, or None where all is steady."""
        ...


def transfer_of(stream: FrameStream) -> Transfer:
    """Transfer of the frames of a stream, known before the first of them: its metadata say it.

    Raises:
        InputError: they say neither gamma nor linear.
    """
    said = stream.metadata.get("transfer", Transfer.GAMMA)
    try:
        return Transfer(said)
    except ValueError:
        raise InputError(
            f"the metadata of the frames say transfer {said!r}; allowed: gamma, linear"
        ) from None


def describe_stream(stream: FrameStream) -> str:
    """A stream of frames in one short line, for its `__repr__`."""
    count = "live" if stream.is_live else "? frames"
    if stream.frame_count is not None:
        count = f"{stream.frame_count} frames"
    rate = "" if stream.fps is None else f", {float(stream.fps):g} fps"
    return f"{type(stream).__name__}({count}, {stream.size}{rate})"


@dataclass(frozen=True, eq=False, repr=False)
class Video(NotebookFrames):
    """Frames held in memory.

    Raises:
        InputError: no frame, another number of times than of frames, or times that do not
            strictly increase.

    Example:
        >>> import numpy as np
        >>> from texvent import Video
        >>> video = Video(np.zeros((3, 6, 8), np.uint8), times_us=(0, 10_000, 25_000))
        >>> video, video[2]
        (Video(3 frames, 8x6), Frame(8x6 uint8 grey, t 25000 µs))
    """

    pixels: PixelArray
    """[N, H, W] or [N, H, W, 3]; see `Frame.pixels`."""
    times_us: Sequence[int]
    """N times, µs."""
    fps: Fraction | None = None
    metadata: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if self.pixels.ndim not in (3, 4):
            raise InputError(
                f"frames must be [N, H, W] or [N, H, W, 3]; got shape {list(self.pixels.shape)}"
            )
        if len(self.pixels) == 0:
            raise InputError("the video has no frame; give at least two")
        if len(self.times_us) != len(self.pixels):
            raise InputError(
                f"{len(self.pixels)} frames but {len(self.times_us)} times; give one per frame"
            )
        checker = StreamChecker()
        for index in range(len(self.pixels)):
            checker.check(self[index])

    def __repr__(self) -> str:
        return describe_stream(self)

    def __len__(self) -> int:
        return len(self.pixels)

    def __getitem__(self, index: int) -> Frame:
        return Frame(self.pixels[index], int(self.times_us[index]), transfer=transfer_of(self))

    def __iter__(self) -> Iterator[Frame]:
        return (self[index] for index in range(len(self.pixels)))

    @property
    def size(self) -> SensorSize:
        """Width and height, pixels."""
        return SensorSize(self.pixels.shape[2], self.pixels.shape[1])

    @property
    def frame_count(self) -> int:
        """Number of frames."""
        return len(self.pixels)

    @property
    def is_live(self) -> bool:
        """False: frames in memory can be read again."""
        return False


class StreamChecker:
    """Checks, frame by frame, what a FrameStream promises. Costs one pass over float pixels."""

    def __init__(self) -> None:
        self._size: SensorSize | None = None
        self._last_us: int | None = None
        self._index = 0

    def check(self, frame: Frame) -> Frame:
        """Return `frame` if it keeps the promises.

        Raises:
            InputError: as `check_order`, or a pixel outside 0..`HIGHEST_INTENSITY`.
        """
        check_intensity(frame.pixels, self.check_order(frame))
        return self.accept(frame)

    def check_order(self, frame: Frame) -> str:
        """The same without a look at the pixels; nothing is remembered of the frame yet.

        Returns:
            Which frame it is, for messages about its pixels.

        Raises:
            InputError: another size than before, a time that does not increase, or one beyond
                ± `LATEST_US`.
        """
        where = f"frame {self._index} (t = {shown(frame.t_us)} µs)"
        if not -LATEST_US <= frame.t_us <= LATEST_US:
            raise InputError(
                f"{where} lies outside ±{LATEST_US} µs (285 years); give a higher fps, or times "
                "in µs, not ns, that count from a later moment"
            )
        if self._size is not None and frame.size != self._size:
            raise InputError(f"{where} is {frame.size}, the frames before it are {self._size}")
        if self._last_us is not None and frame.t_us <= self._last_us:
            raise InputError(
                f"{where} does not come after the frame before it (t = {self._last_us} µs); "
                "frame times must strictly increase"
            )
        return where

    def accept(self, frame: Frame) -> Frame:
        """Remember a frame that was checked: the next one is compared with it."""
        self._size, self._last_us = frame.size, frame.t_us
        self._index += 1
        return frame
