"""A whole check of a video: its measures, and motion and event rate of short windows of it."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Unpack

import numpy as np
from numpy.typing import NDArray

from texvent.brightness import balanced_log
from texvent.capture.fit_to_sensor import fit_pixels
from texvent.capture.frame_source import FrameSource, SourceFacts
from texvent.capture.open import open_frames
from texvent.capture.prepare import PreparedFrames
from texvent.config import CaptureConfig
from texvent.errors import ConfigError
from texvent.interpolate.dis_flow.estimator import DisFlow
from texvent.options.keywords import SimulateOptions
from texvent.pairs.instants import matching_luma
from texvent.pairs.scene_change import SceneChange, detect_scene_change
from texvent.pipeline import Simulation, video_to_events
from texvent.runtime.progress import Progress, ProgressOption, open_progress
from texvent.sensor import SensorSize
from texvent.settings.resolution import Settings, resolve
from texvent.video import MICROSECONDS, Frame, FrameStream
from texvent.video_check.checks import VideoReport, evaluate
from texvent.video_check.measurements import VideoMeasurer

WINDOWS, WINDOW_FRAMES = 8, 6
"""Windows that are simulated, spread over the clip, and frames of each."""
FIRST_GAP = 10
"""Frames between the first two windows of a clip of unknown length; every gap is twice the last."""
FLOW_SIDE = 320
"""Longest side of the frames that optical flow is computed on, px."""
BALANCE = 30.0
"""Balance of the logarithm, as of the default pixel model."""
CHANGE_LOG = 0.1
"""Pixels that change by this much between two frames may fire: their motion counts."""


@dataclass(frozen=True)
class VideoCheckResult:
    """Result of the check of a video."""

    report: VideoReport
    cut_times_us: tuple[int, ...]
    """Times of the first frames of new shots, µs."""
    size: SensorSize
    """Of the sensor: motion and event rate are for it."""


def check_source(
    source: Any, *, progress: ProgressOption = None, **options: Unpack[SimulateOptions]
) -> VideoCheckResult:
    """Look through a video once, and simulate short windows of it.

    Args:
        source: as `texvent.simulate` takes it.
        progress: as there.
        **options: those of `texvent.simulate`; the event rate is for them.

    Raises:
        InputError: the frames cannot be read.
        ConfigError: an unknown option, one that does not fit, or one that checks do not have.
    """
    settings = resolve("simulate", options)
    with open_progress(progress) as shown:
        return check_frames(open_source(source, settings), settings, shown)


def open_source(source: Any, settings: Settings) -> FrameStream:
    """The frames as they are stored, not fitted to the sensor.

    Raises:
        InputError: they cannot be read.
        ConfigError: `camera` or `target_rate` is given.
    """
    if settings.source.camera is not None:
        raise ConfigError("camera makes frames of an image, which need no check; leave it out")
    if settings.run.target_rate is not None:
        raise ConfigError("target_rate decides the event rate; leave it out to see the expected")
    return open_frames(source, settings.source)


def check_frames(video: FrameStream, settings: Settings, progress: Progress) -> VideoCheckResult:
    """The same for frames that are open; they are read once, and may be live.

    Args:
        video: frames that are not fitted to the sensor yet.
        settings: all options of the simulation.
        progress: receives every frame.
    """
    measurer, windows = VideoMeasurer(), _Windows(video, settings)

    def watched() -> Iterator[Frame]:
        for index, frame in enumerate(video, start=1):
            measurer.add(frame)
            progress.advance("check", index, video.frame_count)
            yield frame

    # A camera does not wait for a simulation.
    frames, later = watched(), list[list[Frame]]()
    look = later.append if video.is_live else windows.add
    for gap in _gaps(video.frame_count):
        window = list(itertools.islice(frames, WINDOW_FRAMES))
        look(window)
        if len(window) < WINDOW_FRAMES:
            break
        for _ in itertools.islice(frames, gap):
            pass
    for _ in frames:
        pass
    for window in later:
        windows.add(window)
    measurements = {**measurer.measurements(), **windows.measurements()}
    return VideoCheckResult(
        evaluate(measurements),
        tuple(measurer.cut_times_us),
        windows.size,
    )


def _gaps(total: int | None) -> Iterator[int]:
    """Frames to leave out after each window."""
    if total is None:
        for number in itertools.count():
            yield FIRST_GAP * 2**number
    else:
        for number in range(WINDOWS):
            stop = (number + 1) * total // WINDOWS - number * total // WINDOWS
            yield max(stop - WINDOW_FRAMES, 0)


class _Windows:
    """Event rate and motion of short runs of frames."""

    def __init__(self, video: FrameStream, settings: Settings) -> None:
        self._video, self._settings = video, settings
        self.size = settings.size or video.size
        self._fit = CaptureConfig(fit=settings.source.fit)
        self._flow: DisFlow | None = None
        self._events: list[int] = []
        self._seconds: list[float] = []
        self._lengths: list[NDArray[np.float32]] = []

    def add(self, frames: list[Frame]) -> None:
        """Simulate a window and look at the motion in its middle; a single frame has neither."""
        if len(frames) < 2:
            return
        window: FrameStream = _Window(self._video, frames)
        if window.size != self.size:
            window = PreparedFrames(window, self._fit, size=self.size, check_scale=False)
        fitted = list(window)
        middle = len(fitted) // 2
        self._look_at(fitted[middle - 1], fitted[middle])
        run = video_to_events(_Window(window, fitted), self._settings)
        events, seconds = _count_events(run)
        self._events.append(events)
        self._seconds.append(seconds)

    def _look_at(self, first: Frame, second: Frame) -> None:
        """Take the motion of a pair; a cut has none."""
        if detect_scene_change(first, second) is not SceneChange.NONE:
            return
        scale = max(1.0, max(self.size) / FLOW_SIDE)
        small = SensorSize(*(max(1, round(side / scale)) for side in self.size))
        earlier, later = (
            np.asarray(fit_pixels(matching_luma(one), small, "stretch"), np.float32)
            for one in (first, second)
        )
        self._flow = self._flow or DisFlow()
        self._lengths.append(moved_px(earlier, later, self._flow) * np.float32(scale))

    def measurements(self) -> dict[str, float]:
        """By name.

        Returns:
            `motion_px` and `fast_px`: median and 99th percentile of how far pixels whose
            brightness changes by at least 0.1 log units move from frame to frame, px of the
            sensor; 0 if none does. `motion_share`: the median over the sensor's longer side, of at
            least 320 px.
            `rate_hz`: events per pixel and second; `rate_error_hz`: its standard error over the
            windows, 0 of a single one.
        """
        if not self._events:
            return {}
        lengths = np.concatenate([np.zeros(0, np.float32), *self._lengths])
        middle, fast = np.percentile(lengths, (50, 99)) if len(lengths) else (0.0, 0.0)
        pixels = self.size.width * self.size.height
        rates = np.array(self._events) / np.array(self._seconds) / pixels
        error = rates.std(ddof=1) / np.sqrt(len(rates)) if len(rates) > 1 else 0.0
        return {
            "motion_px": float(middle),
            "fast_px": float(fast),
            "motion_share": float(middle) / max(FLOW_SIDE, *self.size),
            "rate_hz": sum(self._events) / sum(self._seconds) / pixels,
            "rate_error_hz": float(error),
        }


def moved_px(
    earlier: NDArray[np.float32], later: NDArray[np.float32], flow: DisFlow
) -> NDArray[np.float32]:
    """Lengths of the optical flow where the image changes by at least 0.1 log units.

    Args:
        earlier: luma, [H, W], 0..255 scale.
        later: the next frame's.
        flow: what estimates it.

    Returns:
        [n], px per frame.
    """
    forward, _ = flow.both_ways(earlier, later)
    change = np.abs(balanced_log(later, BALANCE) - balanced_log(earlier, BALANCE))
    return np.asarray(np.hypot(forward[..., 0], forward[..., 1])[change >= CHANGE_LOG])


def _count_events(simulation: Simulation) -> tuple[int, float]:
    """Events of a window and how long it lasts, s.

    The first pair is left out where there is another: some models begin it with all references
    at the first frame, so their pixels are further from firing than later.
    """
    times_us: list[int] = []
    events: list[int] = []
    for frame, packet in simulation.steps():
        if times_us:
            events[-1] += len(packet)
        if frame.is_source:
            times_us.append(frame.t_us)
            events.append(0)
    at_the_end = events.pop()
    events[-1] += at_the_end
    skipped = 1 if len(events) > 1 else 0
    return sum(events[skipped:]), (times_us[-1] - times_us[skipped]) / MICROSECONDS


class _Window(FrameSource):
    """A few frames of a stream, in memory."""

    def __init__(self, whole: FrameStream, frames: list[Frame]) -> None:
        self._facts = SourceFacts(whole.size, whole.fps, len(frames), whole.metadata)
        self._frames = frames

    def __iter__(self) -> Iterator[Frame]:
        return iter(self._frames)
