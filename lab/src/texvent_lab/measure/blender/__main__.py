"""Compare events of few frames with motion vectors with events of many frames.

    python lab/src/texvent_lab/measure/blender/scene.py scene.blend   with Blender's Python
    python "$(texvent blender)" scene.blend film24                          the same
    python "$(texvent blender)" scene.blend film480 --fps 480 --colour-only
    python -m texvent_lab.measure.blender film24 film480 --json OUT.json --picture OUT.png

The reference are events of the dense film, whose frames are mixed: between two of 480 per second
hardly anything moves by more than a pixel. How sure it is show the rows of the same frames followed
by optical flow, and of every second one.
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

import texvent
from texvent.capture.image_folder import find_images_folder, list_images
from texvent.capture.motion_vectors.attach import find_motion_sidecar
from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.events import EventStream
from texvent.extending import full_version, require
from texvent.io.atomic import atomic_file
from texvent.represent.event_frame import count_events
from texvent.video import Frame
from texvent.view.drawing.canvas import Image, blank, draw_text, enlarge, png_bytes, tile
from texvent.view.drawing.event_image import count_ceiling, draw_events
from texvent.view.drawing.palettes import get_palette
from texvent_lab.measure.blender.fast_object import is_passed, passed_pixels

RUN: Mapping[str, Any] = {"simulator": "esim"}
"""A pixel that forgets nothing at source frames, whose number differs here."""
METRICS = ("stpp", "nearest", "van_rossum", "count_ratio")
COMPARED_BY_PLACE = ("dense", "dense, halved", "flow", "motion")
"""Rows that are also given for the fastest object and the rest; the first is the reference."""
ENLARGED, TEXT_PX, WINDOW_US = 2, 9, 20_000


def main() -> None:
    """Run the comparison, print its rows, store them and the picture."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("film", type=Path, help="folder of the script for Blender, with passes")
    parser.add_argument("dense", type=Path, help="folder of the same scene with many frames")
    parser.add_argument("--json", type=Path)
    parser.add_argument("--picture", type=Path)
    options = parser.parse_args()
    results, streams = compare(options.film, options.dense)
    for name, row in results["rows"].items():
        print(name.ljust(24), "  ".join(f"{metric} {value:.4g}" for metric, value in row.items()))
    if options.json:
        text = json.dumps(results, indent=1) + "\n"
        with atomic_file(options.json, overwrite=True) as part:
            part.write_text(text, encoding="utf-8")
    if options.picture:
        with atomic_file(options.picture, overwrite=True) as part:
            part.write_bytes(png_bytes(draw(options.film, streams)))


def compare(film: Path, dense: Path) -> tuple[dict[str, Any], dict[str, EventStream]]:
    """Every way of simulating the sparse film against the dense one.

    Args:
        film: frames at the low rate with passes.
        dense: frames of the same times at the high rate.

    Returns:
        Results, ready for JSON, and the events by the name of their row.
    """
    frames = list(open_frames(dense, CaptureConfig()))
    span_us = (frames[0].t_us, frames[-1].t_us)
    streams = {
        "dense": simulate(frames, "blend"),
        "dense, followed": simulate(frames, "flow"),
        "dense, halved": simulate(frames[::2], "blend"),
    }
    rows: dict[str, dict[str, float]] = {}
    reference = streams["dense"]
    rows["dense"] = {"events": len(reference), "frames": len(frames)}
    for name in ("dense, followed", "dense, halved"):
        rows[name] = score(streams[name], reference, span_us)
    for name, given in variants(film).items():
        begin = time.perf_counter()
        streams[name] = texvent.simulate(film, **given, **RUN)
        seconds = time.perf_counter() - begin
        rows[name] = {**score(streams[name], reference, span_us), "seconds": round(seconds, 2)}
    rows |= by_place(film, streams, span_us)
    results = {
        "texvent_version": full_version(),
        "options": dict(RUN),
        "film": describe(film),
        "dense": describe(dense),
        "rows": rows,
    }
    return results, streams


def by_place(
    film: Path, streams: Mapping[str, EventStream], span_us: tuple[int, int]
) -> dict[str, dict[str, float]]:
    """Rows of the events where the fastest object passes, and of all others."""
    frames = list(open_frames(film, CaptureConfig(motion=find_motion_sidecar(film))))
    passed = passed_pixels(frames)
    rows = {}
    at_object = {name: is_passed(streams[name], frames, passed) for name in COMPARED_BY_PLACE}
    for name in COMPARED_BY_PLACE[1:]:
        for place, is_wanted in (("at the fast object", True), ("elsewhere", False)):
            kept, reference = (
                streams[one][at_object[one] == is_wanted] for one in (name, COMPARED_BY_PLACE[0])
            )
            rows[f"{name}, {place}"] = score(kept, reference, span_us)
    return rows


def variants(film: Path) -> dict[str, dict[str, Any]]:
    """Name of a row → what is given with the sparse film."""
    passes = find_motion_sidecar(film)
    frames = list(open_frames(film, CaptureConfig(motion=passes)))
    motions = [frame.motion for frame in frames if frame.motion is not None]
    backward = [one.backward for one in motions if one.backward is not None]
    depth = [one.depth for one in motions]
    return {
        "none": {"interpolate": "none"},
        "blend": {"interpolate": "blend"},
        "flow": {"interpolate": "flow", "frames_per_pixel": 0.0},
        "flow, a frame per px": {"interpolate": "flow", "frames_per_pixel": 1.0},
        "motion": {"motion": passes},
        "motion, backward only": {"motion_back": backward, "depth": depth},
        "motion, backward, no depth": {"motion_back": backward},
    }


def simulate(frames: list[Frame], interpolate: str) -> EventStream:
    """Events of frames in memory."""
    times = [frame.t_us for frame in frames]
    pixels = [frame.luma for frame in frames]
    events: EventStream = texvent.simulate(pixels, t_us=times, interpolate=interpolate, **RUN)
    return events


def score(
    events: EventStream, reference: EventStream, span_us: tuple[int, int]
) -> dict[str, float]:
    """Metrics of one row, within the times that both films cover."""
    found = texvent.compare(events, reference, METRICS, span_us=span_us)
    return {"events": len(events), **{name: round(value, 5) for name, value in found.items()}}


def describe(folder: Path) -> dict[str, Any]:
    """Frames of a film, their size, and how long Blender rendered them, s."""
    images = list_images(find_images_folder(folder))
    library = require("OpenEXR", extra="exr")
    seconds, size = 0.0, [0, 0]
    for path in images:
        with library.File(str(path), header_only=True) as file:
            header = dict(file.header())
        minutes, rest = str(header.get("RenderTime", "0:0")).split(":")[-2:]
        seconds += 60.0 * float(minutes) + float(rest)
        size = (np.asarray(header["dataWindow"][1]) + 1).tolist()
    return {"frames": len(images), "size": size, "render_seconds": round(seconds, 1)}


def draw(film: Path, streams: Mapping[str, EventStream]) -> Image:
    """The frame in which most happens, and the events after it, by every row."""
    reference = streams["dense"]
    frames = list(open_frames(film, CaptureConfig()))
    counts = [
        np.count_nonzero((reference.t >= one.t_us) & (reference.t < one.t_us + WINDOW_US))
        for one in frames
    ]
    frame = frames[int(np.argmax(counts))]
    pixels = np.clip(frame.pixels, 0, 255).astype(np.uint8)
    panels = [_titled("Blender", enlarge(pixels, ENLARGED, how="smooth"))]
    palette, ceiling = get_palette("paper"), None
    titles = {"dense": "480 fps", "motion": "24 fps + vectors", "flow": "24 fps, optical flow"}
    for name, title in titles.items():
        shown = count_events(streams[name].between(frame.t_us, frame.t_us + WINDOW_US))
        ceiling = ceiling or count_ceiling(shown)
        image = enlarge(draw_events(shown, palette, ceiling=ceiling), ENLARGED, how="blocks")
        panels.append(_titled(title, image))
    return tile(panels, 2, (255, 255, 255), gap=4)


def _titled(title: str, image: Image) -> Image:
    head = blank(image.shape[1], 2 * TEXT_PX, (255, 255, 255))
    draw_text(head, title, 2, TEXT_PX + 5, height=TEXT_PX, colour=(20, 22, 26))
    return np.concatenate([head, image])


if __name__ == "__main__":
    main()
