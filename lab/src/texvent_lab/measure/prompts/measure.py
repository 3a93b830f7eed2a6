"""A prompt rendered and simulated: stills, what is in view, events, local contrast."""

from __future__ import annotations

import time
import warnings
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from texvent.brightness import luma_bt601
from texvent.errors import TexventWarning
from texvent.generate.procedural import ProceduralConfig, ProceduralGenerator, ProceduralVideo
from texvent.generate.scene_input import list_nouns, understand
from texvent.pipeline import video_to_events
from texvent.scenes.report import REPORT_KEY
from texvent.sensor import SensorSize
from texvent.settings.resolution import resolve
from texvent.video import MICROSECONDS

SIZE = SensorSize(173, 130)
DURATION_S = 2.0
STILLS = 6
SEED = 0
PRESETS = {
    "paper": {"simulator": "texvent", "preset": "paper"},
    "physical": {"simulator": "physical", "preset": "default"},
}
SETTINGS: dict[str, Any] = {
    "size": str(SIZE), "duration_s": DURATION_S, "stills": STILLS, "seed": SEED,
    "presets": PRESETS,
}  # fmt: skip
LEAST_SHARE = 0.002
"""Share of the image, at its largest, below which a thing is hardly in view: 45 pixels."""
CONTRAST_PX = 9
"""Side of the window of the local contrast."""


def measure_prompt(
    prompt: str, *, with_events: bool
) -> tuple[list[NDArray[np.uint8]], dict[str, Any]]:
    """Stills [H, W, 3] RGB and the facts of a prompt.

    Args:
        prompt: what to show.
        with_events: whether events are simulated.

    Raises:
        InputError: nothing of the prompt is understood.
    """
    started = time.perf_counter()
    generator = ProceduralGenerator(ProceduralConfig(duration=DURATION_S), seed=SEED, size=SIZE)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", TexventWarning)
        video = generator.generate(prompt)
        times = still_times_us()
        frames = [np.asarray(video.at(t).pixels, np.float32) for t in times]
        in_view = measure_view(video, times)
        facts: dict[str, Any] = {
            REPORT_KEY: video.metadata[REPORT_KEY],
            "is_camera_moving": understand(prompt, list_nouns()).shot.is_moving,
            "in_view": in_view,
            "hardly_in_view": sorted(
                {
                    name
                    for name in video.class_names.values()
                    if in_view.get(name, 0.0) < LEAST_SHARE
                }
            ),
            "contrast": round(local_contrast([luma_bt601(frame) for frame in frames]), 4),
        }
        if with_events:
            facts["events"] = {name: _simulate(video, options) for name, options in PRESETS.items()}
    facts["seconds"] = round(time.perf_counter() - started, 2)
    return [np.clip(np.rint(frame), 0, 255).astype(np.uint8) for frame in frames], facts


def still_times_us() -> list[int]:
    """Instants of the stills: uneven, so that what repeats at a round rate is not at rest in them.

    Example:
        >>> still_times_us()
        [0, 430902, 811803, 1242705, 1623607, 2000000]
    """
    step_us = DURATION_S * MICROSECONDS / (STILLS - 1)
    early = [round(k * step_us + 50_000 * (0.618034 * k % 1.0)) for k in range(STILLS - 1)]
    return [*early, round(DURATION_S * MICROSECONDS)]


def measure_view(video: ProceduralVideo, times_us: list[int]) -> dict[str, float]:
    """Noun → the largest share of the image that its things fill together, over the instants."""
    names = video.class_names
    largest: dict[str, float] = {}
    rows, columns = np.mgrid[: SIZE.height : 2, : SIZE.width : 2]
    points = np.stack([columns.ravel(), rows.ravel()], axis=1).astype(np.float64)
    for t_us in times_us:
        _, instances = video.instances_at(t_us, points)
        ids, counts = np.unique(instances, return_counts=True)
        filled: dict[str, float] = {}
        for number, count in zip(ids.tolist(), counts.tolist(), strict=True):
            if number in names:
                filled[names[number]] = filled.get(names[number], 0.0) + count / len(points)
        for name, share in filled.items():
            largest[name] = max(largest.get(name, 0.0), round(share, 4))
    return largest


def local_contrast(lumas: list[NDArray[np.float32]]) -> float:
    """Median standard deviation of log luma, 0..255 and at least 1, in windows of 9x9 pixels.

    Example:
        >>> stripes = np.tile(np.float32([[100.0, 200.0]]), (20, 10))
        >>> round(local_contrast([stripes]), 2)
        0.34
    """
    deviations = []
    for luma in lumas:
        log = np.log(np.maximum(luma, 1.0)).astype(np.float64)
        window = (CONTRAST_PX, CONTRAST_PX)
        mean, square = cv2.blur(log, window), cv2.blur(log * log, window)
        deviations.append(np.sqrt(np.maximum(square - mean * mean, 0.0)))
    return float(np.median(deviations))


def _simulate(video: ProceduralVideo, options: dict[str, str]) -> dict[str, float]:
    settings = resolve("generate", {**options, "sensor": str(SIZE), "seed": SEED,
                                    "duration": DURATION_S})  # fmt: skip
    events = video_to_events(video, settings).packets.collect(progress=False)
    counts = np.zeros((SIZE.height, SIZE.width), np.int64)
    first = events.t < MICROSECONDS
    np.add.at(counts, (events.y[first], events.x[first]), 1)
    return {
        "per_pixel_and_second": round(len(events) / counts.size / DURATION_S, 4),
        "pixels_with_two": round(float((counts >= 2).mean()), 4),
        "on_share": round(float(events.p.mean()), 4) if len(events) else 0.0,
    }
