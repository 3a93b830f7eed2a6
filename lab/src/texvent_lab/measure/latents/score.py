"""Events of test scenes by several ways, against the events of their true dense frames."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

import texvent
from texvent.events import EventStream
from texvent.extending import require
from texvent.metrics.compare import compare
from texvent.runtime.progress import Progress
from texvent.sensor import SensorSize
from texvent.video import RenderableStream, frame_time_us
from texvent_lab.latents.autoencoder import Autoencoder
from texvent_lab.latents.change import BrightnessChange
from texvent_lab.latents.head import LatentHead
from texvent_lab.latents.sampling import sample_packets
from texvent_lab.train.latents.scenes import LatentScenes, keep

torch: Any = require("torch", extra="generate")
THRESHOLD = 0.2
PIXELS: Any = {
    "simulator": "esim",
    "log_eps": 30 / 255,
    "contrast_threshold_on": THRESHOLD,
    "contrast_threshold_off": THRESHOLD,
}
"""Ideal pixels with the paper's α, the same for all ways and for the truth."""
TRUE_FRAMES = 10
"""Frames per interval of the true dense video."""
RESAMPLES, LEVEL = 4000, 95
ORIGINAL, FULL, TINY = "original frames", "full decoder", "tiny decoder"
HEAD, HEAD_LDATI = "head, ideal pixels", "head, LDATI"
TRUE_CHANGE, TRUE_LDATI = "true changes, ideal pixels", "true changes, LDATI"
Row = dict[str, Any]
Frames = NDArray[np.float32]


Runs = Iterator[tuple[str, Row, EventStream]]
"""Of ways on a scene: name, CPU seconds and other facts, events."""
Way = Callable[[Frames, BrightnessChange], Runs]


def run_bounds(frames: Frames, change: BrightnessChange) -> Runs:
    """What no latents are needed for: the best that a decoder, or a head, could give."""
    yield ORIGINAL, *_timed(lambda: simulate(frames, change.fps))
    for name, sample in ((TRUE_CHANGE, ideal_pixels), (TRUE_LDATI, ldati)):
        yield name, *_timed(lambda: sample(change))  # noqa: B023


@dataclass(frozen=True)
class Ways:
    """What turns latents into events."""

    autoencoder: Autoencoder
    tiny: Autoencoder
    head: LatentHead

    def run(self, frames: Frames, change: BrightnessChange) -> Runs:
        """Every way on a scene, with the bounds."""
        yield from run_bounds(frames, change)
        latents = self.autoencoder.encode(frames, change.fps)
        for name, autoencoder in ((FULL, self.autoencoder), (TINY, self.tiny)):
            facts, decoded = _timed(lambda: decode(autoencoder, latents.decoder_input))  # noqa: B023
            rest, events = _timed(lambda: simulate(decoded, change.fps))  # noqa: B023
            psnr = 10 * np.log10(255**2 / float(((decoded - frames) ** 2).mean()))
            yield name, {"cpu_s": facts["cpu_s"] + rest["cpu_s"], "psnr": psnr}, events
        facts, found = _timed(lambda: self.head.predict(latents))
        for name, sample in ((HEAD, ideal_pixels), (HEAD_LDATI, ldati)):
            rest, events = _timed(lambda: sample(found))  # noqa: B023
            yield name, {"cpu_s": facts["cpu_s"] + rest["cpu_s"]}, events


def score(run: Way, scenes: LatentScenes, count: int, progress: Progress) -> list[Row]:
    """A row per way and scene, of the first `count`: metrics, numbers of events, CPU seconds."""
    rows = []
    for _ in run(*scenes.read(0)):
        pass  # compiles what is timed
    for number in range(count):
        frames, change = scenes.read(number)
        true = true_events(scenes, number)
        for way, facts, events in run(frames, change):
            metrics = compare(events, true, ["stpp"])
            found = {"scene": number, "way": way, "1-stpp": 1 - metrics["stpp"]}
            counts = {"events": len(events), "true_events": len(true), "frames": len(frames)}
            rows.append({**found, **counts, **facts})
        progress.advance("score", number + 1, count)
    return rows


def true_events(scenes: LatentScenes, number: int) -> EventStream:
    """Events of a scene rendered `TRUE_FRAMES` times as often; kept, for it takes seconds."""

    def render() -> dict[str, NDArray[Any]]:
        video = cast(RenderableStream, scenes.clips.simulation(number).video)
        change = scenes.read(number)[1]
        last = len(change.voxels) * change.frames_per_latent * TRUE_FRAMES
        times = [frame_time_us(index, change.fps * TRUE_FRAMES) for index in range(last + 1)]
        dense = np.stack([video.at(t_us).luma for t_us in times])
        events = _simulate(dense, times, interpolate="none")
        columns = {name: getattr(events, name) for name in "xytp"}
        return {**columns, "size": np.array(events.size)}

    identity = scenes.identity(number, "true events", TRUE_FRAMES, sorted(PIXELS.items()))
    found = keep(scenes.folder / f"{identity}.npz", render)
    size = SensorSize(*found["size"].tolist())
    return EventStream(found["x"], found["y"], found["t"], found["p"], size)


def simulate(frames: Frames, fps: Fraction) -> EventStream:
    """Events of frames [n, H, W, 3], 0..255, with the default interpolation."""
    times = [frame_time_us(number, fps) for number in range(len(frames))]
    return _simulate(frames, times)


def decode(autoencoder: Autoencoder, inputs: NDArray[np.float32]) -> Frames:
    """Frames [n, H, W, 3], 0..255, of what a decoder takes."""
    with torch.inference_mode():
        decoded = autoencoder.module.decode(torch.from_numpy(inputs)[None]).sample[0]
    frames: Frames = ((decoded + 1) * 127.5).clamp(0, 255).permute(1, 2, 3, 0).numpy()
    return np.ascontiguousarray(frames)


def ideal_pixels(change: BrightnessChange) -> EventStream:
    """Events of pixels that see the changes and remember the brightness of their last event."""
    frames = list(change.frames())
    luma, times = np.stack([one.pixels for one in frames]), [one.t_us for one in frames]
    return _simulate(luma, times, interpolate="none")


def _simulate(frames: Frames, times: list[int], **options: Any) -> EventStream:
    events: EventStream = texvent.simulate(frames, t_us=times, **PIXELS, **options)
    return events


def ldati(change: BrightnessChange) -> EventStream:
    """Events as V2CE samples them."""
    return EventStream.concat(list(sample_packets(change, contrast_threshold=THRESHOLD)))


def summarise(rows: list[Row]) -> list[Row]:
    """Means over scenes with 95 % bootstrap intervals, a row per way; see `describe`."""
    ways = list(dict.fromkeys(row["way"] for row in rows))
    scenes = sorted({row["scene"] for row in rows})
    draws = np.random.default_rng(0).integers(len(scenes), size=(RESAMPLES, len(scenes)))
    by_way = {way: [row for row in rows if row["way"] == way] for way in ways}
    original = column(by_way[ORIGINAL], "1-stpp")
    return [{"way": way, **describe(by_way[way], original, draws)} for way in ways]


def describe(rows: list[Row], original: NDArray[Any], draws: NDArray[Any]) -> Row:
    """Of one way: values as [mean, low, high] of the interval.

    Returns:
        `1-stpp`; `minus original`: difference from original frames, scene by scene; `rate ratio`:
        events over true events, of all scenes; CPU ms per frame; PSNR where there are frames.
    """
    error, events, true = (column(rows, name) for name in ("1-stpp", "events", "true_events"))
    ratio = [events.sum() / true.sum(), *_interval(events[draws].sum(1) / true[draws].sum(1))]
    result: Row = {
        "1-stpp": _mean(error, draws),
        "minus original": _mean(error - original, draws),
        "rate ratio": [float(one) for one in ratio],
    }
    frames = column(rows, "frames").sum()
    result["cpu_ms_per_frame"] = float(1000 * column(rows, "cpu_s").sum() / frames)
    if "psnr" in rows[0]:
        result["psnr"] = _mean(column(rows, "psnr"), draws)
    return result


def column(rows: list[Row], name: str) -> NDArray[Any]:
    """Values of all rows."""
    return np.array([row[name] for row in rows])


def _mean(values: NDArray[Any], draws: NDArray[Any]) -> list[float]:
    return [float(values.mean()), *_interval(values[draws].mean(1))]


def _interval(values: NDArray[Any]) -> list[float]:
    outside = (100 - LEVEL) / 2
    return [float(one) for one in np.percentile(values, [outside, 100 - outside])]


def _timed(make: Callable[[], Any]) -> tuple[Row, Any]:
    started = time.process_time()
    made = make()
    return {"cpu_s": time.process_time() - started}, made


def table(summary: list[Row]) -> str:
    """Markdown; intervals in brackets."""
    names = ("1-stpp", "minus original", "rate ratio", "psnr")
    lines = [
        "| events from | 1 − STPP | minus original | rate ratio | PSNR, dB | CPU ms, frame |",
        "|---|---|---|---|---|---|",
    ]
    for row in summary:
        cells = [_cell(row.get(name), digits=1 if name == "psnr" else 3) for name in names]
        lines.append(f"| {row['way']} | {' | '.join(cells)} | {row['cpu_ms_per_frame']:.1f} |")
    return "\n".join(lines)


def _cell(value: list[float] | None, *, digits: int) -> str:
    if value is None:
        return ""
    middle, low, high = (f"{one:.{digits}f}" for one in value)
    return f"{middle} [{low}, {high}]"
