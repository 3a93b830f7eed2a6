"""Finished videos in memory or on disk.

Files are 16-bit lossless for what we generate, anything PyAV reads for the rest.

A diffusion model's decoder gives floats. They are kept at 16 bits per component in FFV1, a
lossless codec, in an AVI file: that is 256 times finer than 8-bit video and finer than the
half-precision floats the models compute with. AVI is used because it counts frames exactly;
Matroska rounds frame times to whole milliseconds. Common players show these files.

Linear frames, which go above white, are kept as half floats, the numbers of OpenEXR: their 16 bits
are the levels of the file (`transfer.encode_half`), which then looks flat in a player. The file's
note says `"transfer": "linear"` and `"coding": "half"`.
"""

from __future__ import annotations

import dataclasses
import functools
import json
from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import KW_ONLY, dataclass, field
from fractions import Fraction
from pathlib import Path
from typing import Any, Self

import av
import numpy as np
from av.error import FFmpegError
from av.video.reformatter import VideoReformatter
from av.video.stream import VideoStream

from texvent._require import require
from texvent.errors import FileFormatError, InputError
from texvent.frames import (
    UINT16_PER_LEVEL,
    Frame,
    FrameStream,
    NotebookFrames,
    PixelArray,
    describe_stream,
    frame_time_us,
    transfer_of,
)
from texvent.io.atomic import atomic_file
from texvent.pairs.on_device import keep_on_device
from texvent.runtime.devices import Tensor
from texvent.runtime.files.media_files import open_media_file, raise_scarcity
from texvent.sensor import SensorSize
from texvent.transfer import WHITE, Transfer, encode_half

EXTENSION = ".avi"
REMEDY = "delete it and generate again"
"""Advice about a damaged file."""
FULL_SCALE = 65_535.0
NOT_FINITE = "the generator made a frame with NaN or infinite values; try another seed"
NO_FRAME = "the video has no frame; events need the change between at least two"
_CODEC_OPTIONS = {"level": "3", "slices": "4", "slicecrc": "1"}
_EIGHT_BITS = 8


@dataclass(frozen=True, eq=False, repr=False)
class FinishedVideo(NotebookFrames, ABC):
    """A generated video as a stream of frames at a stated rate."""

    fps: Fraction
    size: SensorSize
    frame_count: int
    metadata: Mapping[str, Any] = field(default_factory=dict)
    """Origin of the video (JSON-serialisable)."""

    def __repr__(self) -> str:
        return describe_stream(self)

    @property
    def is_live(self) -> bool:
        """False: the frames can be read again."""
        return False

    def with_metadata(self, **facts: Any) -> Self:
        """The same video with more facts about it."""
        return dataclasses.replace(self, metadata={**self.metadata, **facts})

    @abstractmethod
    def __iter__(self) -> Iterator[Frame]:
        """Frames in time order."""


@dataclass(frozen=True, eq=False, repr=False)
class MadeVideo(FinishedVideo):
    """A video in memory, where the model left it: on a GPU it need not go up again."""

    _: KW_ONLY
    levels: Tensor
    """[N, H, W, 3] int16, the bits of 16-bit levels."""

    @functools.cached_property
    def pixels(self) -> PixelArray:
        """The levels on the host, uint16; 65535 is white."""
        return np.asarray(self.levels.cpu().numpy()).view(np.uint16)

    def with_metadata(self, **facts: Any) -> Self:
        """The same video with more facts about it; its levels come to the host once."""
        video = super().with_metadata(**facts)
        if "pixels" in vars(self):
            vars(video)["pixels"] = self.pixels
        return video

    def __iter__(self) -> Iterator[Frame]:
        """Frames in time order, [H, W, 3] RGB, uint16, also on the device of the levels."""
        for index, pixels in enumerate(self.pixels):
            frame = Frame(pixels, frame_time_us(index, self.fps))
            yield keep_on_device(frame, self.levels[index])


@dataclass(frozen=True, eq=False, repr=False)
class StoredVideo(FinishedVideo):
    """A video file, decoded anew at every iteration.

    The file's own times are not used: a generated video has a frame rate and nothing else.
    """

    _: KW_ONLY
    path: Path

    def __iter__(self) -> Iterator[Frame]:
        """Frames in time order, [H, W, 3] RGB: uint16 (65535 is white), uint8 for 8-bit files.

        Linear ones are float32, 255 is white.

        Raises:
            FileFormatError: the file is damaged.
        """
        index = -1
        for index, pixels in enumerate(_decode(self.path)):
            yield _frame(pixels, frame_time_us(index, self.fps), transfer_of(self))
        if index + 1 != self.frame_count:
            raise FileFormatError(
                f"{self.path} has {self.frame_count} frames and ends after {index + 1}; {REMEDY}"
            )


def open_stored(path: Path, fps: Fraction, metadata: Mapping[str, Any]) -> StoredVideo:
    """A video file that another program wrote; its frames are counted by decoding them once.

    Raises:
        FileFormatError: the file is damaged or holds no frame.
    """
    count, shape = 0, (0, 0)
    for pixels in _decode(path):
        count, shape = count + 1, (pixels.shape[1], pixels.shape[0])
    if count == 0:
        raise FileFormatError(f"{path} holds no frame")
    return StoredVideo(fps, SensorSize(*shape), count, metadata, path=path)


def reopen(path: Path) -> StoredVideo | None:
    """A video that `write_video` wrote, with what made it, or None for any other file."""
    try:
        with open_media_file(path) as container:
            if not container.streams.video:
                return None
            stream = container.streams.video[0]
            if getattr(stream, "codec_context", None) is None:  # libav does not know the codec
                return None
            metadata = json.loads(container.metadata.get("comment", ""))
            size = SensorSize(stream.width, stream.height)
            rate, count = stream.average_rate, stream.frames
    except (FFmpegError, ValueError, RecursionError):
        return None
    is_ours = stream.codec_context.name == "ffv1" and isinstance(metadata, dict)
    if not is_ours or not rate or count < 1:
        return None
    return StoredVideo(Fraction(rate), size, count, metadata, path=path)


def write_stream(video: FrameStream, path: Path, *, overwrite: bool) -> StoredVideo:
    """Write any stream of frames losslessly at 16 bits; see `write_video`.

    Raises:
        InputError: the stream has no frame rate.
    """
    if video.fps is None:
        raise InputError("the video has no frame rate, so it cannot be written; give `fps`")
    frames = (_full_scale(frame) for frame in getattr(video, "plain", video))
    return write_video(frames, path, video.fps, video.metadata, overwrite=overwrite)


def write_video(
    frames: Iterable[PixelArray],
    path: Path,
    fps: Fraction,
    metadata: Mapping[str, Any],
    *,
    overwrite: bool,
) -> StoredVideo:
    """Write frames losslessly, one at a time; nothing is left behind if that fails.

    Args:
        frames: [H, W, 3] RGB each: float from 0 to 1, or uint16 at full scale; light where the
            metadata say that `transfer` is linear: float, 1 is white.
        path: file to write; its name ends in .avi.
        fps: frame rate.
        metadata: what made the video, stored in the file as JSON.
        overwrite: whether an existing file may be replaced.

    Raises:
        OutputError: the file exists already or cannot be written.
        InputError: there are no frames.
    """
    count, size = 0, SensorSize(0, 0)
    transfer = Transfer(metadata.get("transfer", Transfer.GAMMA))
    if transfer is Transfer.LINEAR:
        metadata = {**metadata, "coding": "half"}
    with atomic_file(path, overwrite=overwrite) as part, av.open(str(part), "w") as container:
        stream: VideoStream | None = None
        container.metadata["comment"] = json.dumps(dict(metadata), ensure_ascii=False)
        for pixels in frames:
            deep = to_16_bits(pixels, transfer)
            if stream is None:
                size = SensorSize(deep.shape[1], deep.shape[0])
                stream = container.add_stream("ffv1", rate=fps, options=_CODEC_OPTIONS)
                stream.width, stream.height, stream.pix_fmt = size.width, size.height, "gbrp16le"
                stream.time_base = 1 / fps
            video_frame = av.VideoFrame.from_ndarray(deep, format="rgb48le")
            video_frame.pts, video_frame.time_base = count, 1 / fps
            container.mux(stream.encode(video_frame))
            count += 1
        if stream is None:
            raise InputError(NO_FRAME)
        container.mux(stream.encode())
    return StoredVideo(fps, size, count, metadata, path=path)


def _frame(pixels: PixelArray, t_us: int, transfer: Transfer) -> Frame:
    """A frame of the levels that are stored."""
    if transfer is Transfer.GAMMA:
        return Frame(pixels, t_us)
    light = pixels.view(np.float16).astype(np.float32) * np.float32(WHITE)
    return Frame(light, t_us, transfer=transfer)


def to_16_bits(pixels: PixelArray, transfer: Transfer = Transfer.GAMMA) -> PixelArray:
    """Floats from 0 to 1 as uint16 at full scale, rounded to nearest; uint16 as it is.

    Light is stored as half floats.

    Raises:
        InputError: a value is NaN or infinite.
    """
    if pixels.dtype == np.uint16:
        return np.ascontiguousarray(pixels)
    if not np.isfinite(pixels).all():
        raise InputError(NOT_FINITE)
    if transfer is Transfer.LINEAR:
        return np.ascontiguousarray(encode_half(pixels))
    scaled = np.clip(pixels.astype(np.float32), 0.0, 1.0) * np.float32(FULL_SCALE)
    return np.ascontiguousarray(np.rint(scaled).astype(np.uint16))


def to_16_bits_there(frames: Tensor) -> Tensor:
    """`to_16_bits` of a model's frames, on their device.

    Args:
        frames: [N, H, W, 3] floats from 0 to 1.

    Returns:
        [N, H, W, 3] int16, with the bits of uint16, contiguous.

    Raises:
        InputError: there is no frame, or a value is NaN or infinite.
    """
    torch = require("torch", extra="generate")
    if not len(frames):
        raise InputError(NO_FRAME)
    levels = torch.empty(frames.shape, dtype=torch.int16, device=frames.device)
    is_finite = torch.ones((), dtype=torch.bool, device=frames.device)
    for frame, to in zip(frames, levels, strict=True):  # one by one: floats take twice the room
        is_finite &= frame.isfinite().all()
        whole = (frame.float().clamp(0.0, 1.0) * FULL_SCALE).round()
        to.copy_(torch.where(whole > 32_767, whole - 65_536, whole))
    if not is_finite:
        raise InputError(NOT_FINITE)
    return levels


def _full_scale(frame: Frame) -> PixelArray:
    """RGB of a frame on any scale as `write_video` takes it; 8-bit values stay exact."""
    pixels = frame.pixels
    rgb = pixels if pixels.ndim == 3 else np.repeat(pixels[..., None], 3, axis=2)
    if frame.transfer is Transfer.LINEAR:
        full = WHITE * (UINT16_PER_LEVEL if rgb.dtype == np.uint16 else 1.0)
        return rgb / np.float32(full)
    if rgb.dtype == np.uint8:
        return rgb.astype(np.uint16) * np.uint16(UINT16_PER_LEVEL)
    return rgb if rgb.dtype == np.uint16 else rgb / np.float32(WHITE)


def _decode(path: Path) -> Iterator[PixelArray]:
    try:
        with open_media_file(path) as container:
            if not container.streams.video:
                raise FileFormatError(f"{path} holds no video")
            stream = container.streams.video[0]
            stream.thread_type = "AUTO"
            scaler = VideoReformatter()  # one for all frames: each keeps threads of its own
            for video_frame in container.decode(stream):
                deepest = max(component.bits for component in video_frame.format.components)
                name = "rgb48le" if deepest > _EIGHT_BITS else "rgb24"
                yield scaler.reformat(video_frame, format=name).to_ndarray()
    except FFmpegError as error:
        raise_scarcity(error, path)
        raise FileFormatError(
            f"{path} cannot be decoded, it is damaged ({error.strerror}); {REMEDY}"
        ) from error
