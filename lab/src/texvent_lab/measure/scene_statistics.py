"""Statistics of 25 drawn scenes beside recordings: events, contrast of pictures, cost.

    texvent data pull davis346    # and slider_depth, dvxplorer
    python -m texvent_lab.measure.scene_statistics scenes.json

Scenes are sentences at the defaults, of one second. Recordings that are not pulled are left out.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

import texvent
from texvent import EventStream
from texvent.data.pull import find_pulled
from texvent.transfer import decode_srgb
from texvent_lab.bench.document import markdown_table, write_document
from texvent_lab.measure.street import soon_share
from texvent_scenes.procedural import ProceduralConfig, ProceduralGenerator

SIZE = texvent.SensorSize(346, 260)
WINDOWS_US = (10_000, 33_000)
OFTEN_HZ = 5.0
"""Rate from which on a pixel is busy."""
FLOOR, SMOOTH_PX = 0.01, 3
"""Least intensity, of 1; side of the squares over which pictures are smoothed."""
MIDDLE_US, RIM, LEAST_PX = 500_000, np.ones((5, 5), np.uint8), 200
"""Instant of the pictures; squares that must lie in a part; least size of a part, pixels."""
VEHICLES = ("car", "bus", "truck", "van", "taxi", "ambulance", "tram", "train")
SCENES = {
    "street, camera stands": (
        "two cars pass each other on a road",
        "three cars drive left and a bus drives right on a city street",
        "cars and a truck on a motorway",
        "a pedestrian crosses the street in front of cars",
        "a tram and two taxis in a city",
    ),
    "camera stands": (
        "a red ball bounces on a wooden floor",
        "a dog runs across a meadow",
        "a man juggles three balls in a gym",
        "a drone hovers above a field",
        "a fan spins on a table in an office",
        "a bird flies over a lake",
        "rain on a road at night with cars",
        "a woman waves in a living room",
    ),
    "rooms, camera moves": (
        "the camera pans through a kitchen",
        "handheld shot of an office",
        "the camera moves forward along a corridor",
        "the camera orbits a laptop on a desk in a laboratory",
        "walking through a library",
    ),
    "outdoors, camera moves": (
        "driving along a road at 50 km/h",
        "driving through a city at night",
        "a drone flies over a village, aerial view",
        "a horse gallops along a beach",
        "a cyclist rides through a forest, the camera follows",
        "a handheld shot of trees in a park",
        "a train leaves a station",
    ),
}  # fmt: skip
"""Group → sentences."""
SHARES = ("ever", "often", "positive", "soon")
RECORDINGS = ("davis346", "slider_depth", "dvxplorer")


@dataclass(frozen=True)
class Row:
    """Statistics of one stream of events, and of the pictures that it was made of."""

    group: str
    name: str
    rate_hz: float
    """Events per pixel and second."""
    active: tuple[float, float]
    """Share of pixels with an event in a window of `WINDOWS_US`, mean over windows."""
    ever: float
    """Share of pixels that have an event at all."""
    often: float
    """Share of pixels that have more than `OFTEN_HZ`."""
    positive: float
    soon: float
    contrast: dict[str, float]
    """Mean gradient of log intensity per pixel: all, of vehicles and of the sky where there are."""
    cpu_s: float | None


def active_share(events: EventStream, window_us: int) -> float:
    """Mean share of the pixels that have an event in a window; whole windows count."""
    size = events.size
    pixel = events.y.astype(np.int64) * size.width + events.x
    window = (events.t - events.t[0]) // window_us
    count = int((events.t[-1] - events.t[0]) // window_us)
    if not count:
        return float("nan")
    inside = window < count
    seen = np.unique(window[inside] * (size.width * size.height) + pixel[inside])
    return len(seen) / (count * size.width * size.height)


def log_gradient(light: NDArray[Any]) -> NDArray[np.float64]:
    """[H, W] |∂x ln I| of a picture [H, W, 3] of linear light, smoothed over `SMOOTH_PX`."""
    grey = np.asarray(light, np.float64).mean(axis=-1)
    smooth = np.asarray(cv2.blur(grey, (SMOOTH_PX, SMOOTH_PX)), np.float64)
    gradient: NDArray[np.float64] = np.gradient(np.log(np.maximum(smooth, FLOOR)), axis=1)
    return np.abs(gradient)


def measure(
    group: str, name: str, events: EventStream, contrast: dict[str, float], cpu_s: float | None
) -> Row:
    """The statistics of a stream."""
    size, seconds = events.size, (events.t[-1] - events.t[0]) / 1e6
    pixel = events.y.astype(np.int64) * size.width + events.x
    counts = np.bincount(pixel, minlength=size.width * size.height)
    first, second = (active_share(events, one) for one in WINDOWS_US)
    return Row(
        group, name, float(len(events.t) / seconds / counts.size), (first, second),
        float(np.mean(counts > 0)), float(np.mean(counts / seconds >= OFTEN_HZ)),
        float(np.mean(events.p > 0)), soon_share(events), contrast, cpu_s,
    )  # fmt: skip


def picture_contrast(sentence: str) -> dict[str, float]:
    """Mean log gradients in the middle of a clip, of vehicles and of the sky without their rims."""
    generator = ProceduralGenerator(ProceduralConfig(duration=1.0), size=SIZE)
    video = generator.generate(sentence)
    light = decode_srgb(np.asarray(video.at(MIDDLE_US).pixels, np.float64) / 255.0)
    gradient, truth = log_gradient(light), video.ground_truth(MIDDLE_US, MIDDLE_US + 10_000)
    own = [number for number, name in video.class_names.items() if name in VEHICLES]
    masks = {"vehicles": np.isin(truth.instance, own), "sky": np.isinf(truth.depth)}
    inner = {part: cv2.erode(mask.astype(np.uint8), RIM) > 0 for part, mask in masks.items()}
    found = {part: float(gradient[mask].mean()) for part, mask in inner.items()
             if mask.sum() >= LEAST_PX}  # fmt: skip
    return {"all": float(gradient.mean()), **found}


def drawn_rows() -> Iterator[Row]:
    """The drawn scenes; a first clip that is not measured compiles the kernels."""
    texvent.generate("a ball rolls", sensor=str(SIZE), duration=0.1)
    for group, sentences in SCENES.items():
        for one in sentences:
            begun = time.process_time()
            events = texvent.generate(one, sensor=str(SIZE), duration=1.0)
            spent = time.process_time() - begun
            yield measure(group, one, events, picture_contrast(one), spent)


def recorded_rows() -> Iterator[Row]:
    """The recordings that are pulled."""
    for name in RECORDINGS:
        path = find_pulled(name)
        files = [] if path is None else [path]
        if path is not None and path.is_dir():
            files = [*sorted(path.rglob("*.aedat4")), *path.glob("events.txt")]
        for number, file in enumerate(files, 1):
            label = name if len(files) == 1 else f"{name} {number}"
            size = "davis240c" if file.suffix == ".txt" else None
            yield measure("recorded", label, texvent.load(file, size=size), {}, None)


def as_markdown(rows: Sequence[dict[str, Any]]) -> str:
    """Medians of each group, and each recording."""
    heads = ["", "events per px and s", "active in 10 / 33 ms, %", "ever, %", "≥ 5/s, %", "ON, %",
             "within 5 ms, %", "log gradient", "CPU-s"]  # fmt: skip
    groups = {row["group"]: [one for one in rows if one["group"] == row["group"]] for row in rows}
    named = {name: [one] for one in groups.pop("recorded", []) for name in [one["name"]]}
    cells = []
    for name, own in {**named, **groups}.items():

        def middle(values: list[float | None], scale: float, digits: int) -> str:
            known = [one for one in values if one is not None]
            return f"{scale * float(np.median(known)):.{digits}f}" if known else ""

        active = [middle([one["active"][k] for one in own], 100, 1) for k in (0, 1)]
        cells.append([
            f"recorded {name}" if name in named else f"{name} ({len(own)})",
            middle([one["rate_hz"] for one in own], 1, 1), " / ".join(active),
            *(middle([one[key] for one in own], 100, 0) for key in SHARES),
            middle([one["contrast"].get("all") for one in own], 1, 3),
            middle([one["cpu_s"] for one in own], 1, 0),
        ])  # fmt: skip
    return markdown_table(heads, cells)


def main(arguments: list[str]) -> None:
    """Measure all rows, write them and print the table."""
    if len(arguments) != 1:
        sys.exit("error: name the file to write, such as scene_statistics.json.gz")
    rows = [asdict(one) for one in (*recorded_rows(), *drawn_rows())]
    write_document(Path(arguments[0]), {"kind": "scenes", "rows": rows}, overwrite=True)
    print(as_markdown(rows))


if __name__ == "__main__":
    main(sys.argv[1:])
