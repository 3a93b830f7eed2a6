"""Compare events of few frames with motion vectors with events of many frames.

    python lab/src/texvent_lab/measure/blender_scene.py scene.blend    with Blender's Python
    python "$(texvent blender)" scene.blend film24                          the same
    python "$(texvent blender)" scene.blend film480 --fps 480 --colour-only
    python -m texvent_lab.measure.blender film24 film480 --json OUT.json

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
from texvent.capture.motion_vectors.frames import find_motion_sidecar
from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.events import EventStream
from texvent.extending import full_version, require
from texvent.io.atomic import atomic_file
from texvent.video import Frame

RUN: Mapping[str, Any] = {"simulator": "esim"}
"""A pixel that forgets nothing at source frames, whose number differs here."""
METRICS = ("stpp", "nearest", "count_ratio")


def main() -> None:
    """Run the comparison, print its rows, store them."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("film", type=Path, help="folder of the script for Blender, with passes")
    parser.add_argument("dense", type=Path, help="folder of the same scene with many frames")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    results = compare(options.film, options.dense)
    for name, row in results["rows"].items():
        print(name.ljust(24), "  ".join(f"{metric} {value:.4g}" for metric, value in row.items()))
    if options.json:
        text = json.dumps(results, indent=1) + "\n"
        with atomic_file(options.json, overwrite=True) as part:
            part.write_text(text, encoding="utf-8")


def compare(film: Path, dense: Path) -> dict[str, Any]:
    """Every way of simulating the sparse film against the dense one.

    Args:
        film: frames at the low rate with passes.
        dense: frames of the same times at the high rate.

    Returns:
        Results, ready for JSON.
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
    return {
        "texvent_version": full_version(),
        "options": dict(RUN),
        "film": describe(film),
        "dense": describe(dense),
        "rows": rows,
    }


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


if __name__ == "__main__":
    main()
