"""Video files through PyAV: exact variable-frame-rate times, upright, at their own bit depth."""

from __future__ import annotations

import contextlib
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

import av
from av.container import InputContainer
from av.error import FFmpegError
from av.video.frame import VideoFrame
from av.video.stream import VideoStream

from texvent.capture.decoding import (
    PacketTimes,
    PixelReader,
    coding_facts,
    count_undelayed,
    needs_packet_times,
    read_packet_times,
    warn_of_pixels,
)
from texvent.capture.frame_source import FrameSource
from texvent.capture.given_times import FrameTimes
from texvent.errors import FileFormatError, few, warn
from texvent.frames import MICROSECONDS, PREVIEW_MARK, Frame, frame_time_us
from texvent.io.input_checks import begins_with, refuse_missing
from texvent.runtime.files.image_files import HEAD_BYTES
from texvent.runtime.files.media_files import is_timeless, open_media_file, raise_scarcity
from texvent.runtime.memory import usable_bytes
from texvent.sensor import checked_size

SLACK_US = 100_000
"""A file may end this much before its header says, or three frames, before it counts as cut."""
TEXT_ART = "tty"
"""libav "plays" any .txt file as terminal art, which is never meant."""

PLAYLIST_MARKS = (b"#EXTM3U", b"ffconcat version", b"v=0", b"<?xml", b"<MPD")
"""First bytes of files that name other files."""
SEQUENCE_BRAND = "msf1"
"""Brand of files of HEIF that hold animations."""
ATTACHED_PICTURE = 1 << 10
"""libav's AV_DISPOSITION_ATTACHED_PIC."""
HELD_BYTES = 6 * 8
"""Per pixel: 16-bit RGB, in as many frames as decoder, threads and simulation hold at least."""


class VideoFile(FrameSource):
    """The frames of a video file; every iteration opens the file anew.

    Times are the file's own presentation times, `round(pts · time_base · 10⁶)` in exact
    arithmetic, counted from the first frame, unless `times` are given. Where the file states a
    rate and all times are those of this rate, rounded to its clock (Matroska counts milliseconds),
    the rate gives them. Other frames that repeat the time of the frame before (some recorders
    write them) are dropped, counted in `metadata` and warned of.

    Raises:
        InputError: the file does not exist.
        FileFormatError: it has no video that can be decoded; while iterating: it is damaged, ends
            before its header says, or its time goes backwards.
    """

    def __init__(self, path: Path, times: FrameTimes | None = None) -> None:
        self._path = path
        self._times = times
        self._packets: PacketTimes | None = None
        with _opened(path) as (container, stream):
            comment = container.metadata.get("comment", "")
            if comment == PREVIEW_MARK:
                warn(
                    f"{path} is a preview that texvent drew of events, not what a camera saw; give "
                    "the video that the events were made of"
                )
            self._rate = _own_rate(container, stream)
            count = stream.frames
            is_doubtful = needs_packet_times(stream)
            first = next(self._decode(container, stream), None)
            if first is None:
                raise FileFormatError(
                    f"{path} has no frame that can be decoded; it may be cut off or empty"
                )
            self._warn_of_others(container, stream)
            self._warn_of_times(container, stream)
            reader = PixelReader(path)
            pixels = reader.read(first)
            metadata = {
                "source": str(path),
                "kind": "video file",
                "codec": stream.codec_context.name,
                "pixel_format": first.format.name,
                "display_matrix": list(reader.matrix(first)),
                "duplicate_times_dropped": 0,
                **coding_facts(first, comment),
            }
            size = checked_size(pixels.shape[1], pixels.shape[0])
            warn_of_pixels(stream, first, pixels, str(path))
        super().__init__(size, None, None, metadata)
        self.frame_count = (self._count_packets() if is_doubtful else count) or None
        self.fps = times.fps if times else self._rate

    def _warn_of_others(self, container: InputContainer, stream: VideoStream) -> None:
        """Say that there is another video in the file."""
        videos = [one for one in container.streams.video if has_decoder(one) and not is_cover(one)]
        # Its first image, and alpha, are streams of their own in an image sequence (AVIF).
        is_sequence = SEQUENCE_BRAND in container.metadata.get("compatible_brands", "")
        if len(videos) > 1 and not is_sequence:
            sizes = [f"{one.width}x{one.height}" for one in videos]
            warn(
                f"{self._path} holds {len(videos)} videos ({few(sizes)}); number "
                f"{1 + videos.index(stream)} is read, of {stream.width}x{stream.height}; copy "
                "another into a file of its own (ffmpeg -map 0:v:NUMBER -c copy)"
            )

    def _warn_of_times(self, container: InputContainer, stream: VideoStream) -> None:
        """Say what is assumed where the file has neither times nor a rate."""
        if self._times is None and not _states_rate(self._path, container, stream):
            warn(
                f"{self._path} holds neither times nor a frame rate, so {self._rate} frames per "
                "second are assumed, as players do; give the rate (`fps`)"
            )
        count = 0 if self._times else count_undelayed(self._path, container, stream)
        if count:
            warn(
                f"{self._path} states no delay after {count} of its frames; each is shown for "
                "0.1 s, as browsers do. Give the rate (`fps`)"
            )

    def _count_packets(self) -> int:
        """Frames that will be shown; finds the constant rate of a file whose clock rounds it."""
        found = self._read_packets()
        if self._times is not None:
            return found.count
        self._rate = found.constant_rate or self._rate
        self._note_repeats(found.repeats, found.count)
        return found.count - found.repeats

    def _read_packets(self) -> PacketTimes:
        """Facts of all packets: one pass over the file, without decoding."""
        if self._packets is None:
            with _opened(self._path) as (container, stream):
                self._packets = read_packet_times(container, stream)
        return self._packets

    @property
    def is_cut_off(self) -> bool:
        """Whether its packets end before its header says."""
        times_us = self._read_packets().times_us
        with _opened(self._path) as (_, stream):
            first_us = Fraction(stream.start_time or 0) * (stream.time_base or 0) * MICROSECONDS
            promised_us = _promised_end_us(stream, first_us)
        if promised_us is None or times_us is None:
            return False
        return int(times_us[-1]) + max(SLACK_US, self._step_us(4)) < promised_us

    def _step_us(self, frames: int) -> int:
        return frames * round(MICROSECONDS / self._rate) if self._rate else 0

    @property
    def times_us(self) -> Sequence[int] | None:
        """Times of all frames, as the packets have them, µs; None where they have none."""
        found = self._read_packets()
        is_own = self._times is None and found.constant_rate is None
        if is_own and found.times_us is not None:
            return [*map(int, found.times_us)]
        times = self._times or (FrameTimes(fps=self._rate) if self._rate else None)
        return None if times is None else times.of(found.count)

    def _note_repeats(self, dropped: int, count: int) -> None:
        """Count frames that repeat a time, and warn of them once."""
        if dropped > self._metadata["duplicate_times_dropped"]:
            warn(
                f"{self._path}: {dropped} of {count} frames are left out, because each has the "
                "time of the frame before it; if frames are evenly spaced, give their rate (`fps`)"
            )
        self._metadata["duplicate_times_dropped"] = dropped

    def __iter__(self) -> Iterator[Frame]:
        """Frames in time order; see the class for what can go wrong."""
        clock = PresentationClock(self._path, self._times, self._rate)
        with _opened(self._path) as (container, stream):
            is_mixed_up = container.format.name == AVI and stream.codec_context.has_b_frames
            clock.is_counting = is_mixed_up
            clock.is_even = self._packets is not None and self._packets.constant_rate is not None
            frames, reader = self._decode(container, stream), PixelReader(self._path)
            while True:
                try:
                    decoded = next(frames, None)
                except FFmpegError as error:
                    raise_scarcity(error, self._path)
                    raise _damaged(self._path, clock, f"is damaged ({error.strerror})") from error
                if decoded is None:
                    break
                t_us = clock.read(decoded)
                if t_us is not None:
                    yield Frame(reader.read(decoded), t_us)
            self._check_end(stream, clock)
        self._note_repeats(clock.dropped, clock.count)

    def _decode(self, container: InputContainer, stream: VideoStream) -> Iterator[VideoFrame]:
        """Whole frames; those before a damaged place come out before the error does."""
        for packet in container.demux(stream):
            if packet.is_corrupt:
                yield from _flushed(stream)
                raise av.error.InvalidDataError(0, "a packet is incomplete")
            try:
                decoded = packet.decode()
            except FFmpegError:
                yield from _flushed(stream)
                raise
            for frame in decoded:
                if frame.is_corrupt:
                    raise av.error.InvalidDataError(0, "a frame is incomplete")
                yield frame

    def _check_end(self, stream: VideoStream, clock: PresentationClock) -> None:
        end_us = _promised_end_us(stream, clock.first_pts_us)
        if end_us is not None and clock.end_us + max(SLACK_US, self._step_us(3)) < end_us:
            problem = f"is cut off: its header promises {end_us / MICROSECONDS:g} s"
            raise _damaged(self._path, clock, problem)
        if self._times is not None:
            self._times.check_count(clock.count)


@dataclass
class PresentationClock:
    """Time of each decoded frame, µs; remembers where it is, for messages and checks."""

    path: Path
    times: FrameTimes | None
    rate: Fraction | None
    count: int = 0
    """Frames read."""
    dropped: int = 0
    """Frames left out because they repeat a time."""
    first_us: int = 0
    """Time of the first frame, on the clock that the caller sees."""
    last_us: int | None = None
    """Time of the last frame, on the clock that the caller sees."""
    end_us: int = 0
    """End of the last frame, on the file's own clock."""
    is_counting: bool = False
    """Whether frames have the times of the nominal rate, whatever the file says."""
    is_even: bool = False
    """Whether the file's times are those of the nominal rate, rounded."""
    first_pts_us: Fraction = Fraction(0)
    """Presentation time of the first frame, before it is shifted to 0."""

    def read(self, frame: VideoFrame) -> int | None:
        """Time of the next frame, or None if it repeats the time of the frame before.

        Raises:
            FileFormatError: the time goes backwards, or there is none.
            InputError: more frames than times were given.
        """
        t_us = self._own_time_us(frame)
        if self.times is not None:
            t_us = self.times(self.count)
        self.count += 1
        if self.last_us is None:
            self.first_us = t_us
        elif t_us == self.last_us:
            self.dropped += 1
            return None
        elif t_us < self.last_us:
            raise FileFormatError(
                f"{self.path}: time goes back from {self.last_us} to {t_us} µs at frame "
                f"{self.count - 1}; give a frame rate that replaces the file's times (`fps`)"
            )
        self.last_us = t_us
        return t_us

    def _own_time_us(self, frame: VideoFrame) -> int:
        if frame.pts is None or frame.time_base is None or self.is_counting:
            return self._nominal_time_us()
        pts_us = frame.pts * frame.time_base * MICROSECONDS
        if self.count == 0:
            self.first_pts_us = pts_us
        t_us = round(pts_us - self.first_pts_us)
        duration_us = round((frame.duration or 0) * frame.time_base * MICROSECONDS)
        self.end_us = max(self.end_us, t_us + duration_us)
        if not self.is_even or not self.rate:
            return t_us
        is_clear = 2 * self.rate * frame.time_base < 1
        index = round(t_us * self.rate / MICROSECONDS) if is_clear else self.count
        return frame_time_us(index, self.rate)

    def _nominal_time_us(self) -> int:
        if self.times is None and self.rate is None:
            raise FileFormatError(
                f"{self.path} states neither frame times nor a frame rate; give one with `fps`"
            )
        if not self.rate:
            return 0
        self.end_us = frame_time_us(self.count + 1, self.rate)
        return frame_time_us(self.count, self.rate)


@contextlib.contextmanager
def _opened(path: Path) -> Iterator[tuple[InputContainer, VideoStream]]:
    """The container and its main video stream, decoding on all cores."""
    refuse_missing(path, "video")
    try:
        container = open_media_file(path)
    except (FFmpegError, OSError) as error:
        raise_scarcity(error, path)
        if any(begins_with(path, mark) for mark in PLAYLIST_MARKS):
            raise FileFormatError(
                f"{path} is a playlist, which names other files; give the video itself"
            ) from error
        raise FileFormatError(
            f"{path} is not a video that can be read ({error.strerror}); "
            "it may be cut off, still being written, or of another type"
        ) from error
    with container:
        stream = container.streams.best("video")
        if not isinstance(stream, VideoStream) or container.format.name == TEXT_ART:
            raise FileFormatError(f"{path} holds no video stream")
        if is_cover(stream):
            raise FileFormatError(f"{path} holds no video stream, but the picture of a cover")
        if not has_decoder(stream):
            raise FileFormatError(f"{path} is coded in a way that libav does not know")
        stream.thread_type = "AUTO"
        _check_claim(path, stream)
        try:
            yield container, stream
        except FFmpegError as error:
            raise_scarcity(error, path)
            raise FileFormatError(
                f"{path} has no frame that can be decoded ({error.strerror}); "
                "it may be cut off or encrypted"
            ) from error


def is_cover(stream: VideoStream) -> bool:
    """Whether a stream is the picture of a cover, which players show beside music."""
    return bool(stream.disposition & type(stream.disposition)(ATTACHED_PICTURE))


def has_decoder(stream: VideoStream) -> bool:
    """Whether libav knows a decoder of a stream; without one it has no size either."""
    context: object = stream.codec_context
    return context is not None


def _check_claim(path: Path, stream: VideoStream) -> None:
    """Refuse frames that memory has no room for, by the header, and bound those that come."""
    context = stream.codec_context
    most_pixels = usable_bytes() // HELD_BYTES
    if stream.width * stream.height > most_pixels:
        raise FileFormatError(
            f"{path} claims frames of {stream.width}x{stream.height}, which need about "
            f"{stream.width * stream.height * HELD_BYTES / 2**30:,.0f} GiB; this process may use "
            f"{usable_bytes() / 2**30:,.0f} GiB. Give a smaller video"
        )
    context.options = {**context.options, "max_pixels": str(min(most_pixels, 2**31 - 1))}


def _flushed(stream: VideoStream) -> list[VideoFrame]:
    """Frames that the decoder still holds when no more data can come."""
    frames: list[VideoFrame] = []
    with contextlib.suppress(FFmpegError, EOFError):
        frames.extend(frame for frame in stream.decode(None) if not frame.is_corrupt)
    return frames


def _damaged(path: Path, clock: PresentationClock, problem: str) -> FileFormatError:
    shown_us = (clock.last_us or clock.first_us) - clock.first_us
    # Rounded down, so that the last whole frame is the one at which reading stops.
    stop = shown_us // 1000 / 1000
    advice = f"keep what is whole with stop={stop:g}, or repair the file" if stop else "repair it"
    return FileFormatError(
        f"{path} {problem}; its frames end at {shown_us / MICROSECONDS:g} s "
        f"after {clock.count} frames; {advice}"
    )


def _promised_end_us(stream: VideoStream, first_pts_us: Fraction) -> int | None:
    """End of the video by its file's header, counted from its first frame."""
    if stream.duration and stream.time_base:
        return round(stream.duration * stream.time_base * MICROSECONDS)
    # Matroska and WebM: "00:00:01.200000000", the end on the file's own clock.
    tag = re.fullmatch(r"(\d+):(\d+):(\d+(?:\.\d+)?)", stream.metadata.get("DURATION", ""))
    if tag is None:
        return None
    seconds = int(tag[1]) * 3600 + int(tag[2]) * 60 + Fraction(tag[3])
    return round(seconds * MICROSECONDS - first_pts_us)


Y4M = "yuv4mpegpipe"
AVI = "avi"
"""Container without times: its frames follow one another, and B-frames mix up the order in it."""


def _own_rate(container: InputContainer, stream: VideoStream) -> Fraction | None:
    """Frame rate of the stream; libav invents one for streams without a container."""
    rate = stream.average_rate or stream.guessed_rate
    if is_timeless(container):
        rate = stream.codec_context.framerate or rate
    return Fraction(rate) if rate else None


def _states_rate(path: Path, container: InputContainer, stream: VideoStream) -> bool:
    """Whether a rate, or times, are the file's own, and not invented by libav."""
    if container.format.name == Y4M:
        with path.open("rb") as file:
            return re.search(rb" F[1-9]", file.readline(HEAD_BYTES)) is not None
    return not is_timeless(container) or bool(stream.codec_context.framerate)
