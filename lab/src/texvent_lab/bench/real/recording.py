"""Recordings of frames and events as scenes of the benchmark."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, ClassVar, NamedTuple

import numpy as np

from texvent.calibrate.recording import WARM_UP_US, TimeSpan
from texvent.capture.recorded_frames import is_dsec
from texvent.errors import InputError
from texvent.events import EventStream
from texvent.frames import MICROSECONDS, Frame, Video
from texvent.options.values import option_names
from texvent.settings.resolution import Settings, apply_options
from texvent_lab.bench.fidelity.entries import Entry, simulate_video
from texvent_lab.bench.fidelity.event_files import FileEntry
from texvent_lab.frame_recordings import (
    FrameRecording,
    locate_source,
    open_recording,
    recording_name,
)

SEGMENT_US, EDGE_US = 100_000, 50_000
"""Length of a scored span, and of what its start is a multiple of: windows of the metrics, µs."""
MOST_SEGMENTS = 20
FIT_SECONDS = 0.6
DISPLAY_GAMMA, LINEAR_GAMMA = 2.2, 1.0
MAX_INTERMEDIATE, SEED = 16, 0


class RecordingPart(NamedTuple):
    """Part of a recording that is used, and offset of its clocks."""

    start_s: float = 0.0
    """Skipped at the start of the frames, s."""
    seconds: float = 4.0
    """Longest part that is used, s: δ is fitted at the start of its first half, and its second
    half is scored, at most 2 s."""
    offset_us: int | None = None
    """Added to the times of the frames, µs; None: what the catalogue knows of the recording,
    else 0."""
    frames_gamma: float | None = None
    """Exponent that makes the frames linear; None: 1 for frames of a DAVIS, 2.2 for DSEC's."""


@dataclass(frozen=True, kw_only=True, eq=False)
class RealScene:
    """Frames and events of one sensor on one clock, in memory; see `Truth`."""

    scene: str
    video: Video
    """Frames, moved by the offset."""
    events: EventStream
    fit: TimeSpan
    """Span in which δ is fitted."""
    scored: tuple[TimeSpan, ...]
    """Spans that are scored."""
    frames_gamma: float
    offset_us: int

    target: ClassVar[str] = "recorded"
    """In place of the oracle's kind of pixels."""

    @property
    def references(self) -> list[EventStream]:
        """See `Truth`."""
        return [self.recorded(span) for span in self.scored]

    @property
    def fit_count(self) -> int:
        """See `Truth`."""
        return len(self.recorded(self.fit))

    def count(self, entry: Entry, threshold: float | None) -> int:
        """See `Truth`."""
        return len(self._simulate(entry, self.fit, threshold))

    def simulate(self, entry: Entry, threshold: float | None) -> list[EventStream]:
        """See `Truth`."""
        events = self._simulate(entry, self.whole, threshold)
        return [events.cut(*span) for span in self.scored]

    def check(self, entry: Entry) -> None:
        """Refuse event files that are not of these frames; see `FileEntry.check`."""
        if isinstance(entry, FileEntry):
            times_us = self.video.times_us
            span_us = times_us[0] - self.offset_us, times_us[-1] - self.offset_us
            entry.check(self.video.size, {self.scene: span_us}, is_part=True)

    def _simulate(self, entry: Entry, span: TimeSpan, threshold: float | None) -> EventStream:
        if isinstance(entry, FileEntry):
            span_us = span.start_us - self.offset_us, span.stop_us - self.offset_us
            found = entry.packets(self.scene, self.video.size, span_us, threshold).collect()
            return dataclasses.replace(found, t=found.t + self.offset_us)
        settings = adapt_settings(entry.settings(SEED), self.frames_gamma)
        return simulate_video(self.frames_around(span), settings, threshold).cut(*span)

    @property
    def whole(self) -> TimeSpan:
        """All scored spans, which follow on each other."""
        return TimeSpan(self.scored[0].start_us, self.scored[-1].stop_us)

    def recorded(self, span: TimeSpan) -> EventStream:
        """The recorded events of a span."""
        return self.events.cut(*span)

    def frames_around(self, span: TimeSpan) -> Video:
        """The frames from before a span, time to warm up included, to after its end."""
        times = np.asarray(self.video.times_us)
        first = max(int(np.searchsorted(times, span.start_us - WARM_UP_US, "right")) - 1, 0)
        last = int(np.searchsorted(times, span.stop_us, "left"))
        return Video(self.video.pixels[first : last + 1], self.video.times_us[first : last + 1])


def adapt_settings(settings: Settings, gamma: float) -> Settings:
    """Settings that know how the frames are coded, and ask for at most 16 frames in between.

    Args:
        settings: of a run.
        gamma: exponent that makes the frames linear.
    """
    options: dict[str, Any] = {"max_intermediate": MAX_INTERMEDIATE}
    if "gamma" in option_names(type(settings.simulate)):
        options["gamma"] = gamma
    return apply_options(settings, options, where="the recording")


WHOLE = RecordingPart()
"""The default part of a recording."""


def open_scene(source: str, part: RecordingPart = WHOLE) -> RealScene:
    """A scene from the name of a pulled data set, or the path of a recording.

    Args:
        source: `slider_depth`, `davis346`, or a folder or file that `open_recording` takes.
        part: which part of it.

    Raises:
        InputError: it is not there or not pulled, has no frames, or what frames and events share
            is too short.
        FileFormatError: a file is damaged.
    """
    path, offset_us = locate_source(source)
    recording = open_recording(path)
    offset_us = offset_us if part.offset_us is None else part.offset_us
    gamma = DISPLAY_GAMMA if is_dsec(path) else LINEAR_GAMMA
    frames = [Frame(one.pixels, one.t_us + offset_us) for one in used_frames(recording, part)]
    times_us = [frame.t_us for frame in frames]
    if len(frames) < 2:
        raise InputError(f"{source} has {len(frames)} frames in the part that is used; it needs 2")
    events = _used_events(recording, times_us[0], times_us[-1])
    fit, scored = _spans(source, times_us, events)
    return RealScene(
        scene=recording_name(source),
        video=Video(np.stack([frame.pixels for frame in frames]), times_us),
        events=events,
        fit=fit,
        scored=scored,
        frames_gamma=gamma if part.frames_gamma is None else part.frames_gamma,
        offset_us=offset_us,
    )


def used_frames(recording: FrameRecording, part: RecordingPart) -> Iterator[Frame]:
    """The frames of a part of a recording, on their own clock."""
    first_us: int | None = None
    for frame in recording.frames:
        first_us = frame.t_us if first_us is None else first_us
        since_us = frame.t_us - first_us - round(part.start_s * MICROSECONDS)
        if since_us > part.seconds * MICROSECONDS:
            return
        if since_us >= 0:
            yield frame


def _used_events(recording: FrameRecording, start_us: int, stop_us: int) -> EventStream:
    """Read packet by packet: a sequence may hold more events than fit in memory."""
    used: list[EventStream] = []
    for packet in recording.events:
        if len(packet) and int(packet.t[0]) >= stop_us:
            break
        used.append(packet.cut(start_us, stop_us))
    return EventStream.concat(used) if used else EventStream.empty(recording.frames.size)


def _spans(
    source: str, times_us: list[int], events: EventStream
) -> tuple[TimeSpan, tuple[TimeSpan, ...]]:
    """The start of the first half to fit, and whole segments of the second to score."""
    start = max(times_us[0] + WARM_UP_US, int(events.t[0]) if len(events) else times_us[0])
    stop = min(times_us[-1], int(events.t[-1]) if len(events) else times_us[0])
    middle = (start + stop) // 2
    first = -(-middle // EDGE_US) * EDGE_US
    count = min((stop - first) // SEGMENT_US, MOST_SEGMENTS)
    if count < 1:
        raise InputError(
            f"{source}: frames and events share {max(stop - start, 0) / MICROSECONDS:.3f} s in the "
            f"part that is used; it needs {2 * SEGMENT_US / MICROSECONDS:g} s and more. Do they "
            "run on the same clock?"
        )
    fit = TimeSpan(start, middle).first(FIT_SECONDS)
    edges = (first + number * SEGMENT_US for number in range(count))
    return fit, tuple(TimeSpan(edge, edge + SEGMENT_US) for edge in edges)
