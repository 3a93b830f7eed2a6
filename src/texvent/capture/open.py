"""Open any source of frames."""

from __future__ import annotations

import stat
from collections.abc import Callable, Iterable, Mapping, Set
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

from texvent.capture.aedat4_frames import Aedat4Frames, is_aedat4
from texvent.capture.array_frames import ArrayFrames
from texvent.capture.camera_path.opening import check_camera_options, is_still, open_photo
from texvent.capture.given_times import FrameTimes, listed_times, read_timestamps
from texvent.capture.image_folder import ImageFolder, count_images
from texvent.capture.linear_light import AUTO, decode_light
from texvent.capture.motion_vectors.frames import attach_motion
from texvent.capture.prepare import PreparedFrames
from texvent.capture.recorded_frames import DsecFrames, is_dsec, is_evreal, open_evreal
from texvent.capture.scale_check import check_frames
from texvent.config import CaptureConfig
from texvent.errors import ConfigError, FileFormatError, InputError, is_address, shown
from texvent.frames import FrameStream, NotebookFrames, RenderableStream, Video
from texvent.io.arrays.npy_file import StoredArray
from texvent.io.files import event_extensions
from texvent.io.ros.bag_kind import is_bag
from texvent.options.arrays import is_array_like
from texvent.runtime.files.file_names import usable_path
from texvent.runtime.files.image_files import HEAD_BYTES, is_animation
from texvent.sensor import SensorSize


def open_frames(
    source: Any,
    config: CaptureConfig,
    *,
    size: SensorSize | None = None,
    t_us: Any = None,
    motion: Mapping[str, Any] | None = None,
    seed: int = 0,
) -> FrameStream:
    """Frames of a video file, an image folder, an array, a camera or a network stream.

    Args:
        source: a path of a video file, an image folder, an EVREAL folder, a DSEC sequence, a .npy
            file, an AEDAT4 recording with frames or a ROS bag with images; a device such as
            /dev/video0, an address such as rtsp://..., a named pipe, or "-" for standard input; an
            array [N, H, W] or [N, H, W, 3] (RGB) or an iterable of such images; or a FrameStream.
        config: frame rate, times, start, stop, fit, transfer and white level.
        size: sensor size to fit the frames to, or None to keep theirs.
        t_us: [N] frame times, integer µs.
        motion: fields of motion in memory, as `attach_motion` takes them.
        seed: of a camera that shakes over a still image.

    Returns:
        A checked stream: one size, strictly increasing times, at least two frames, no NaN.

    Raises:
        InputError: there is no such source, or it cannot be used; some faults show only while
            iterating.
        FileFormatError: a file is damaged or holds no video.
        ConfigError: frame times are given in two ways at once, or the motion's convention is
            unknown.
    """
    check_camera_options(config, {"t_us": t_us, **(motion or {})})
    asked = _Asked(source, config, _given_times(config, t_us), size, seed)
    kind = next(one for one in SOURCES if one.matches(asked))
    if config.topic is not None and kind.name != BAG:
        raise ConfigError(f"topic chooses images of a ROS bag, and {shown(source)} is none")
    stream = kind.open(asked)
    if config.camera is not None:  # in its light, and fitted
        return stream
    if not isinstance(source, FrameStream):  # which says itself what light it is
        stream, config = decode_light(check_frames(stream, config), config)
    stream = attach_motion(stream, config, motion)
    is_as_given = stream is source and config.white_level is None
    if is_as_given and (config.start, config.stop) == (0, None) and size in (None, stream.size):
        return stream
    return PreparedFrames(stream, config, size=size)


def _given_times(config: CaptureConfig, t_us: Any) -> FrameTimes | None:
    """Times from t_us or fps; a timestamp file is read where the source is known."""
    options = {"t_us": t_us, "fps": config.fps, "timestamps": config.timestamps}
    named = [name for name, value in options.items() if value is not None]
    if len(named) > 1:
        raise ConfigError(f"frame times are given twice, by {' and '.join(named)}; give one")
    if t_us is not None:
        return listed_times(t_us)
    return FrameTimes(fps=Fraction(config.fps)) if config.fps is not None else None


@dataclass(frozen=True)
class _Asked:
    """A source with the options that decide how it is read."""

    source: Any
    config: CaptureConfig
    given: FrameTimes | None
    size: SensorSize | None
    seed: int

    @property
    def times(self) -> FrameTimes | None:
        """Frame times of the options or of their timestamp file."""
        if self.config.timestamps is None:
            return self.given
        return read_timestamps(self.config.timestamps, self.config.timestamps_unit).times

    @property
    def has_own_times(self) -> bool:
        """Whether no option replaces the times of the source."""
        return self.given is None and self.config.timestamps is None

    @cached_property
    def path(self) -> Path:
        """The source as a path; an address, which may be longer than any, has none."""
        name = "-" if is_address(str(self.source)) else str(self.source).removeprefix("file://")
        return usable_path(usable_path(name).expanduser())

    @property
    def is_in_memory(self) -> bool:
        """Whether it is an array or an iterable of images."""
        no_images = (str, Path, bytes, bytearray, Mapping, Set)
        is_iterable = isinstance(self.source, Iterable) and not isinstance(self.source, no_images)
        return is_iterable or is_array_like(self.source)

    @property
    def is_live(self) -> bool:
        """Whether it is standard input, a network address, a pipe or a device."""
        mode = self.path.stat().st_mode if self.path.exists() else 0
        is_stream = str(self.source) == "-" or is_address(str(self.source))
        return is_stream or stat.S_ISFIFO(mode) or stat.S_ISCHR(mode)


class _Source(NamedTuple):
    """One kind of source."""

    name: str
    """In errors on files; empty where it is none."""
    matches: Callable[[_Asked], bool]
    open: Callable[[_Asked], FrameStream]


def _open_array(asked: _Asked) -> FrameStream:
    times = asked.times
    if times is None:
        raise InputError(
            "frames in memory have no times; give fps=, or t_us= with one time per frame, in µs"
        )
    return ArrayFrames(asked.source, times)


def _adopt_stream(asked: _Asked) -> FrameStream:
    """A stream of the caller, checked unless it is texvent's own; one that renders stays so."""
    stream, config = asked.source, asked.config
    if not asked.has_own_times:
        raise InputError("a FrameStream has its own times; leave out fps, t_us and timestamps")
    if config.transfer != AUTO:
        raise InputError(
            "a FrameStream says itself whether it is linear, by Frame.transfer and its metadata; "
            "leave out transfer"
        )
    is_own = isinstance(stream, NotebookFrames) and not isinstance(stream, Video)
    checked = stream if is_own else check_frames(stream, config)
    # Frames in memory are checked by now.
    is_done = isinstance(stream, RenderableStream | Video) and config.white_level is None
    return stream if is_done else checked


def _refuse_other(asked: _Asked) -> FrameStream:
    raise InputError(
        f"cannot read frames from {type(asked.source).__name__}; give a path, an address, an array "
        "[N, H, W] or [N, H, W, 3], or a FrameStream"
    )


def _open_live(asked: _Asked) -> FrameStream:
    from texvent.capture.live import LiveFrames  # brings PyAV

    return LiveFrames(str(asked.source), asked.times)


def _open_bag(asked: _Asked) -> FrameStream:
    from texvent.capture.bag_frames import BagFrames  # brings the readers of compressed bags

    return BagFrames(asked.path, asked.times, topic=asked.config.topic)


def _open_images(asked: _Asked) -> FrameStream:
    config = asked.config
    return ImageFolder(
        asked.path,
        asked.given,
        timestamps=config.timestamps,
        unit=config.timestamps_unit,
        white_level=config.white_level,
    )


def _refuse_still(asked: _Asked) -> FrameStream:
    raise InputError(
        f"{asked.path} is one image, so nothing changes; move a camera over it with `camera` "
        "saccade, shake or pan, or name a folder of images"
    )


def _is_animated(asked: _Asked) -> bool:
    if not is_still(asked.path):
        return False
    with asked.path.open("rb") as file:
        return is_animation(file.read(HEAD_BYTES))


def _open_animation(asked: _Asked) -> FrameStream:
    if asked.path.suffix.lower() == ".webp":
        raise InputError(
            f"{asked.path} is an animated WebP, which is not read; make an animated PNG of it: "
            "PIL.Image.open('a.webp').save('a.png', save_all=True)"
        )
    return _open_video(asked)


def _open_video(asked: _Asked) -> FrameStream:
    from texvent.capture.video_file import VideoFile  # brings PyAV

    try:
        return VideoFile(asked.path, asked.times)
    except FileFormatError as error:
        # Some events and some videos share an extension, such as .dat: only now it is clear.
        if asked.path.suffix.lower() in event_extensions():
            raise FileFormatError(
                f"{asked.path} is not a video but, by its name, an event file; texvent render, "
                "view, convert and info take those"
            ) from error
        names = ", ".join(source.name for source in SOURCES if source.name)
        raise FileFormatError(f"{error}; frames are read from: {names}") from error


BAG = "ROS bag"
SOURCES = (
    _Source(
        "",
        lambda a: a.config.camera is not None,
        lambda a: open_photo(a.source, a.config, size=a.size, seed=a.seed),
    ),
    _Source("", lambda a: isinstance(a.source, FrameStream), _adopt_stream),
    _Source("", lambda a: a.is_in_memory, _open_array),
    _Source("", lambda a: not isinstance(a.source, (str, Path)), _refuse_other),
    _Source("live video", lambda a: a.is_live, _open_live),
    _Source(
        "EVREAL folder",
        lambda a: is_evreal(a.path),
        lambda a: open_evreal(a.path, a.times),
    ),
    _Source(
        "DSEC sequence",
        lambda a: is_dsec(a.path) and a.has_own_times,
        lambda a: DsecFrames(a.path),
    ),
    _Source(BAG, lambda a: is_bag(a.path), _open_bag),
    _Source("image folder", lambda a: a.path.is_dir(), _open_images),
    _Source(
        ".npy",
        lambda a: a.path.suffix.lower() == ".npy" and a.path.is_file(),
        lambda a: _open_array(replace(a, source=StoredArray(a.path))),
    ),
    _Source("AEDAT4", lambda a: is_aedat4(a.path), lambda a: Aedat4Frames(a.path, a.times)),
    _Source("animated PNG", _is_animated, _open_animation),
    _Source("TIFF stack", lambda a: is_still(a.path) and count_images(a.path) > 1, _open_images),
    _Source("still image", lambda a: is_still(a.path), _refuse_still),
    _Source("video file", lambda a: True, _open_video),
)
"""Sources in the order in which they are tried: by type, address, content, extension."""
