"""How well `texvent check` measures, on clips that `texvent data pull` fetched.

    python -m texvent_lab.measure.video_check findings | rate | motion | compression

findings: what the checks measure. rate: the event rate of windows against that of the whole clip.
motion: how much better than blending the default interpolation is, by motion per frame; middle
frames are left out and compared. compression: blockiness after encoding with x264.
"""

from __future__ import annotations

import argparse
import itertools
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import av
import numpy as np
from numpy.typing import NDArray

import texvent
from texvent.brightness import balanced_log
from texvent.capture.open import open_frames
from texvent.config import CaptureConfig, InterpolateConfig
from texvent.data.pull import find_pulled
from texvent.interpolate.blend import BlendInterpolator
from texvent.interpolate.dis_flow.estimator import DisFlow
from texvent.interpolate.flow import FlowInterpolator
from texvent.pairs.instants import float_luma
from texvent.run.check import CHANGE_LOG, check_source, moved_px
from texvent.sensor import SensorSize
from texvent.video import Frame, FrameStream, Video
from texvent.video_check.flicker import BALANCE
from texvent.video_check.measurer import measure_video
from texvent.video_check.report import check_video

SETTING = ("bikes", "bigbuckbunny", "mouse250")
"""Clips on which the limits were set."""
HELD_OUT = ("carphone", "vtest", "tree", "davis346", "slider_depth")
"""Clips on which they were tried."""
PROMPTS = (
    "a red car drives left past two trees at dusk", "a dog runs on the grass at night",
    "a plane flies over the sea", "a red ball bounces on grass",
)  # fmt: skip
WIDTH = 320
STRIDES = (1, 2, 4, 8, 16)
QUALITIES = (18, 24, 30, 36, 42, 48)
KEY_FRAMES = 12
SHOWN = (
    "still_share", "motion", "flicker", "flash", "cuts", "correlation", "repeat_share",
    "pattern_period", "beat_share", "blockiness", "key_ratio", "banded_share", "bar_share",
    "irregular_share", "motion_px", "fast_px", "motion_share", "rate_hz",
)  # fmt: skip


def main() -> None:
    """Print one of the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("table", choices=("findings", "rate", "motion", "compression"))
    {
        "findings": print_findings,
        "rate": print_rates,
        "motion": print_motion,
        "compression": print_compression,
    }[parser.parse_args().table]()


def clips(names: tuple[str, ...] = SETTING + HELD_OUT) -> Iterator[tuple[str, Path]]:
    """The clips that are here."""
    for name in names:
        path = find_pulled(name)
        if path is not None:
            yield name, path


def sensor_of(video: FrameStream) -> SensorSize:
    """A sensor of the video's aspect, at most `WIDTH` wide."""
    width = min(WIDTH, video.size.width)
    return SensorSize(width, round(width * video.size.height / video.size.width))


def scenes() -> Iterator[tuple[str, FrameStream]]:
    """Embedded scenes."""
    for prompt in PROMPTS:
        yield prompt, texvent.video(prompt, sensor="240x180", duration=2.0)


def print_findings() -> None:
    """Measures and findings of every clip."""
    for name, source in (*clips(), *scenes()):
        size = sensor_of(open_frames(source, CaptureConfig()))
        found = check_source(source, sensor=str(size), progress=False).report
        values = " ".join(f"{key} {found.measures[key]:.3g}" for key in SHOWN)
        print(f"{name}: {[*found.problems, *found.remarks]} {values}", flush=True)


def print_rates() -> None:
    """Events per pixel and second: windows, with their standard error, and the whole clip."""
    sources: list[tuple[str, Any]] = [*clips(), *scenes()]
    for name, source in sources:
        video = open_frames(source, CaptureConfig())
        size = tuple(sensor_of(video))
        for simulator in ("texvent", "esim"):
            options: Any = {"sensor": size, "simulator": simulator}
            report = check_source(source, progress=False, **options).report.measures
            events = sum(map(len, texvent.simulate(source, as_packets=True, **options)))
            seconds = (report["frames"] - 1) / report["fps"]
            whole = events / seconds / (size[0] * size[1])
            windows, error = report["rate_hz"], report["rate_error_hz"]
            print(
                f"{name[:30]:<30} {simulator:<8} {windows:7.3f} ± {error:6.3f}   {whole:7.3f}   "
                f"{windows / whole - 1:+.0%}"
            )


def print_motion() -> None:
    """Error of the middle frame, flow over blend, in brightness where it changes."""
    for name, path in clips(SETTING + HELD_OUT[:2]):
        video = open_frames(path, CaptureConfig())
        frames = list(open_frames(path, CaptureConfig(), size=sensor_of(video)))
        for stride in STRIDES:
            taken = frames[::stride]
            firsts = range(0, len(taken) - 2, max(1, len(taken) // 12))
            scores = [middle_errors(*taken[first : first + 3]) for first in firsts]
            kept = np.array([one for one in scores if one is not None])
            if len(kept):
                motion, flow, blend = np.median(kept, axis=0)
                print(
                    f"{name:<14} stride {stride:2d}: {motion:5.1f} px, error {flow:.3f} against "
                    f"{blend:.3f} log, {flow / blend:.2f}"
                )


def middle_errors(first: Frame, middle: Frame, last: Frame) -> tuple[float, float, float] | None:
    """Median motion, and mean errors of the middle by flow and by blend."""
    logs = [balanced_log(one.luma, BALANCE) for one in (first, middle, last)]
    changed = np.abs(logs[2] - logs[0]) >= CHANGE_LOG
    if changed.mean() < 0.005:
        return None
    video = Video(np.stack([first.luma, last.luma]), (first.t_us, last.t_us))
    flow = FlowInterpolator(InterpolateConfig(), video)
    errors = []
    for interpolator in (flow, BlendInterpolator(InterpolateConfig(), video)):
        (made,) = interpolator.between(first, last, [middle.t_us])
        errors.append(np.abs(balanced_log(made.luma, BALANCE) - logs[1])[changed].mean())
    lengths = moved_px(float_luma(first), float_luma(last), DisFlow())
    return float(np.median(lengths)), float(errors[0]), float(errors[1])


def print_compression() -> None:
    """Blockiness and key frames, by x264's constant rate factor."""
    sources: list[tuple[str, Any]] = [*clips(), *scenes()]
    for name, source in sources:
        frames = list(itertools.islice(open_frames(source, CaptureConfig()), 72))
        row = [f"{check_video(frames).measures['blockiness']:.2f}"]
        for quality in QUALITIES:
            measures = measure_video(encoded(frames, quality))
            key = f" k{measures['key_period']:.0f}" if measures["key_period"] else ""
            row.append(f"{measures['blockiness']:.2f}{key}")
        print(f"{name[:30]:<30} {'  '.join(row)}")


def encoded(frames: list[Frame], quality: int, *, fps: int = 24) -> list[Frame]:
    """The frames after x264, a key frame every `KEY_FRAMES`."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "clip.mp4"
        with av.open(path, "w") as file:
            options = {"crf": str(quality), "g": str(KEY_FRAMES), "sc_threshold": "0"}
            stream = file.add_stream("libx264", rate=fps, options=options)
            stream.width, stream.height = (side // 2 * 2 for side in frames[0].size)
            stream.pix_fmt = "yuv420p"
            for frame in frames:
                image = rgb(frame)[: stream.height, : stream.width]
                file.mux(stream.encode(av.VideoFrame.from_ndarray(image, format="rgb24")))
            file.mux(stream.encode())
        return list(open_frames(path, CaptureConfig()))


def rgb(frame: Frame) -> NDArray[np.uint8]:
    """8-bit colour."""
    pixels = frame.pixels if frame.pixels.ndim == 3 else np.repeat(frame.pixels[..., None], 3, 2)
    if pixels.dtype == np.uint16:
        pixels = pixels / 257.0
    return np.ascontiguousarray(np.clip(np.rint(pixels), 0, 255).astype(np.uint8))


if __name__ == "__main__":
    main()
