"""The check of a video: measurements of one pass over it, and motion per frame at some instants."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Unpack

import numpy as np
from numpy.typing import NDArray

from texvent.brightness import balanced_log
from texvent.capture.fit_to_sensor import fit_pixels
from texvent.capture.open import open_frames
from texvent.config import CaptureConfig, ReadingConfig
from texvent.frames import Frame, FrameStream
from texvent.interpolate.dis_flow.estimator import DisFlow
from texvent.options.keywords import ReadingOptions
from texvent.options.values import with_options
from texvent.pairs.instants import matching_luma
from texvent.pairs.scene_change import SceneChange, detect_scene_change
from texvent.runtime.progress import Progress
from texvent.runtime.progress_option import ProgressOption, open_progress
from texvent.sensor import SensorSize
from texvent.video_check.checks import VideoReport
from texvent.video_check.measurements import VideoMeasurer

PAIRS = 8
"""Pairs of frames whose motion is measured, spread over the clip."""
FIRST_GAP = 10
"""Frames between the first two pairs of a clip of unknown length; every gap is twice the last."""
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


def check_source(
    source: Any, *, progress: ProgressOption = None, **options: Unpack[ReadingOptions]
) -> VideoCheckResult:
    """Look through a video once.

    Args:
        source: as `texvent.simulate` takes it.
        progress: as there.
        **options: how frames are read, such as `fps=25`.

    Raises:
        InputError: the frames cannot be read.
        ConfigError: an unknown option, or one that does not fit.
    """
    given = {name: value for name, value in options.items() if value is not None}
    reading = with_options(ReadingConfig(), given, where="options")
    with open_progress(progress) as shown:
        return check_frames(open_source(source, reading), shown)


def open_source(source: Any, reading: ReadingConfig) -> FrameStream:
    """The frames as they are stored, not fitted to a sensor.

    Raises:
        InputError: they cannot be read.
    """
    return open_frames(source, CaptureConfig(**vars(reading)))


def check_frames(video: FrameStream, progress: Progress) -> VideoCheckResult:
    """The same for frames that are open; they are read once, and may be live.

    Args:
        video: frames at their own size.
        progress: receives every frame.
    """
    measurer, chosen = VideoMeasurer(), _instants(video.frame_count)
    pairs: list[tuple[Frame, Frame]] = []
    wanted, last = next(chosen, None), None
    for index, frame in enumerate(video):
        measurer.add(frame)
        progress.advance("check", index + 1, video.frame_count)
        if last is not None and wanted is not None and index >= wanted:
            pairs.append((last, frame))
            wanted = next(chosen, None)
        last = frame
    measurements = {**measurer.measurements(), **measure_motion(pairs)}
    measurements["missing"] = float("images_missing" in video.metadata)
    return VideoCheckResult(VideoReport(measurements), tuple(measurer.cut_times_us), video.size)


def _instants(total: int | None) -> Iterator[int]:
    """Frames that end the pairs whose motion is measured."""
    if total is not None:
        yield from (max(1, (2 * number + 1) * total // (2 * PAIRS)) for number in range(PAIRS))
        return
    index, gap = 1, FIRST_GAP
    while True:
        yield index
        index, gap = index + gap, 2 * gap


def measure_motion(pairs: list[tuple[Frame, Frame]]) -> dict[str, float]:
    """Motion from frame to frame, by name; nothing where there is no pair.

    Args:
        pairs: frames that follow each other, of one size; a cut between them has no motion.

    Returns:
        `motion_px` and `fast_px`: median and 99th percentile of how far pixels move whose
        brightness changes by at least 0.1 log units, px; 0 if none does. `motion_share`: the
        median over the longer side, of at least 320 px.
    """
    if not pairs:
        return {}
    size = pairs[0][0].size
    scale = max(1.0, max(size) / FLOW_SIDE)
    small = SensorSize(*(max(1, round(side / scale)) for side in size))
    flow, found = DisFlow(), [np.zeros(0, np.float32)]
    for pair in pairs:
        if detect_scene_change(*pair) is SceneChange.NONE:
            lumas = (np.asarray(fit_pixels(matching_luma(one), small, "stretch")) for one in pair)
            earlier, later = (luma.astype(np.float32, copy=False) for luma in lumas)
            found.append(_moved_px(earlier, later, flow) * np.float32(scale))
    lengths = np.concatenate(found)
    middle, fast = np.percentile(lengths, (50, 99)) if len(lengths) else (0.0, 0.0)
    share = float(middle) / max(FLOW_SIDE, *size)
    return {"motion_px": float(middle), "fast_px": float(fast), "motion_share": share}


def _moved_px(
    earlier: NDArray[np.float32], later: NDArray[np.float32], flow: DisFlow
) -> NDArray[np.float32]:
    """Lengths of the optical flow where the image changes by at least 0.1 log units, [n], px."""
    forward, _ = flow.both_ways(earlier, later)
    side = -(-len(earlier) // len(forward))  # a vector may stand for 2×2 px
    earlier, later = earlier[::side, ::side], later[::side, ::side]
    change = np.abs(balanced_log(later, BALANCE) - balanced_log(earlier, BALANCE))
    return np.asarray(np.hypot(forward[..., 0], forward[..., 1])[change >= CHANGE_LOG])
