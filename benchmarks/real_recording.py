"""Every pixel model beside a real sensor: frames of a DAVIS in, its own events as the truth.

    python -m benchmarks.real_recording slider_depth [--fitted my.toml] [--seconds 0.6]
    python -m benchmarks.real_recording davis346

Each model gets the frames that the camera recorded, interpolated by flow, and one contrast
threshold that makes as many events as were recorded at the start of the first half (ON and OFF
keep their ratio; a sensor file that `texvent calibrate` wrote stays as it is). The start of the
second half, which no model has seen, is scored. The tables stand in docs/simulators.md.
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from texvent.calibrate.distance import Distance, measure_distance
from texvent.calibrate.rate import match_rate
from texvent.calibrate.recording import WARM_UP_US, Recording, Span
from texvent.capture.open import open_frames
from texvent.config import CaptureConfig, InterpolateConfig
from texvent.data.pull import pull
from texvent.errors import InputError
from texvent.io.files import load
from texvent.pipeline import video_to_events
from texvent.sensor import SensorSize
from texvent.settings import Settings, resolve
from texvent.simulate.thresholds import contrast_threshold_of
from texvent.video import Video

MODELS = (
    ("physical", "default"),
    ("physical", "davis346"),
    ("physical", "davis240c-ecd"),
    ("physical", "clean"),
    ("texvent", "paper"),
    ("esim", "default"),
    ("v2e", "default"),
    ("senpi", "default"),
    ("voltmeter", "davis346"),
)
MAX_INTERMEDIATE = 16


@dataclass(frozen=True)
class Source:
    """One recording."""

    events: str
    """Event file in the data set's folder; empty: the data set is one file."""
    size: SensorSize
    offset_us: int
    """What `texvent calibrate` adds to the frame times, µs."""


SOURCES: Mapping[str, Source] = {
    "slider_depth": Source("events.txt", SensorSize(240, 180), 2_500),
    "davis346": Source("", SensorSize(346, 260), 0),
}


def read_recording(name: str) -> Recording:
    """Frames, moved by their offset, and events of a recording."""
    source, path = SOURCES[name], pull(name)
    frames = list(open_frames(path, CaptureConfig()))
    video = Video(
        np.stack([frame.pixels for frame in frames]),
        [frame.t_us + source.offset_us for frame in frames],
    )
    events = load(path / source.events if source.events else path, size=source.size)
    return Recording(video, events, InterpolateConfig())


def cut(recording: Recording, start_us: int, stop_us: int) -> Video:
    """The frames from the last one before a span to the first one after it."""
    frames = list(recording.frames)
    first = max(i for i, frame in enumerate(frames) if frame.t_us <= start_us)
    last = min(i for i, frame in enumerate(frames) if frame.t_us >= stop_us)
    chosen = frames[first : last + 1]
    return Video(np.stack([frame.pixels for frame in chosen]), [frame.t_us for frame in chosen])


def score(recording: Recording, settings: Settings, held_out: Span) -> Distance:
    """Distance of a model's events of the held-out span from the recorded ones."""
    video = cut(recording, held_out.start_us - WARM_UP_US, held_out.stop_us)
    events = video_to_events(video, settings).packets.collect().between(*held_out)
    return measure_distance(events, recording.recorded(held_out))


def match_threshold(recording: Recording, settings: Settings, span: Span) -> Settings:
    """The settings with the threshold that gives the recorded number of events of a span."""
    video = cut(recording, *span)
    start_us = video.times_us[0]
    recorded = recording.events.between(start_us, start_us + (span.stop_us - span.start_us))
    simulation = video_to_events(video, settings)
    target_hz = len(recorded) / span.seconds
    return match_rate(simulation, target_hz, seconds=span.seconds)[0].settings


def options_of(simulator: str) -> dict[str, Any]:
    """Options of every run: frames of a DAVIS are linear."""
    options: dict[str, Any] = {"simulator": simulator, "max_intermediate": MAX_INTERMEDIATE}
    return {**options, "gamma": 1.0} if simulator == "physical" else options


def main() -> None:
    """Print one row per model, best first."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("recording", choices=tuple(SOURCES))
    parser.add_argument("--fitted", type=Path, help="sensor file that texvent calibrate wrote")
    parser.add_argument("--seconds", type=float, default=0.6)
    arguments = parser.parse_args()
    recording = read_recording(arguments.recording)
    span, held_out = (half.first(arguments.seconds) for half in recording.halves())
    rows: list[tuple[Distance, str, float]] = []
    too_noisy: list[str] = []
    for simulator, preset in MODELS:
        name = f"{simulator}, `{preset}`"
        settings = resolve("simulate", {**options_of(simulator), "preset": preset})
        try:
            matched = match_threshold(recording, settings, span)
        except InputError:
            too_noisy.append(name)
            continue
        threshold = contrast_threshold_of(matched.simulate)
        rows.append((score(recording, matched, held_out), name, threshold))
    if arguments.fitted is not None:
        options = {**options_of("physical"), "sensor": str(arguments.fitted)}
        settings = resolve("simulate", options)
        threshold = contrast_threshold_of(settings.simulate)
        rows.append((score(recording, settings, held_out), "physical, calibrated", threshold))
    print("| model | δ | distance | 1 − STPP | intervals, decades | ON | OFF |")
    print("|---|---|---|---|---|---|---|")
    for distance, name, threshold in sorted(rows, key=lambda row: row[0].total):
        on, off = np.exp(distance.log_on), np.exp(distance.log_off)
        print(
            f"| {name} | {threshold:.3g} | {distance.total:.3f} | {distance.overlap:.3f} "
            f"| {distance.intervals:.3f} | ×{on:.2f} | ×{off:.2f} |"
        )
    for name in too_noisy:
        print(f"| {name} | count not reached at any δ | | | | | |")


if __name__ == "__main__":
    main()
