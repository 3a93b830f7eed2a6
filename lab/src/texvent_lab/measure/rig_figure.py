"""The picture of docs/rigs.md: what a rig of a stereo pair and a fisheye camera records.

    python -m texvent_lab.measure.rig_figure -o docs/images/rig.png

Above: a frame of each camera (rolling shutter, 8 ms of exposure), with the events of 10 ms around
it; the third lens is equidistant, 120° across. Below: a second of the IMU beside its truth.
"""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path

import cv2
import numpy as np

import texvent
from texvent import rig
from texvent.generate.scene_input import list_nouns, understand
from texvent.io.atomic import atomic_file
from texvent.rig.imu import true_samples
from texvent.scenes.staging.compose import compose_scene
from texvent.sensor import SensorSize
from texvent.view.drawing.canvas import Image, blank, draw_text, png_bytes, tile

PROMPT = "a red car drives left past two trees, handheld camera"
RIG = """
cam0: {}
cam1: {baseline: 0.3}
cam2: {baseline: -0.15, field_of_view: 120, distortion_model: equidistant}
"""
SIZE, DURATION, SEED = SensorSize(346, 260), 1.0, 3
HALF_WINDOW_US = 5_000
FRAME = 15
WHITE, INK, ON, OFF = (255, 255, 255), (30, 30, 30), (40, 200, 90), (235, 60, 60)
COLOURS = ((214, 90, 60), (60, 150, 80), (60, 90, 200))


def camera_panel(folder: Path, title: str) -> Image:
    """A frame darkened, the events around it on top."""
    rows = (folder / "frames.csv").read_text().splitlines()[1:]
    name, t_us = rows[FRAME].split(",")[:2]
    pixels = cv2.cvtColor(np.asarray(cv2.imread(str(folder / name))), cv2.COLOR_BGR2RGB)
    image = np.asarray(0.75 * pixels, dtype=np.uint8)
    events = texvent.load(folder / "events.h5")
    near = np.abs(events.t - int(t_us)) < HALF_WINDOW_US
    for polarity, colour in ((1, ON), (0, OFF)):
        chosen = near & (events.p == polarity)
        image[events.y[chosen], events.x[chosen]] = colour
    panel = blank(SIZE.width, SIZE.height + 20, WHITE)
    panel[20:] = image
    draw_text(panel, title, 4, 14, height=9, colour=INK)
    return panel


def plot(measured: np.ndarray, true: np.ndarray, title: str, width: int) -> Image:
    """Three axes over time: measured dim, true bold; each about its own mean."""
    height = 150
    panel = blank(width, height, WHITE)
    shown = measured - true.mean(axis=0)
    scale = 0.42 * (height - 20) / np.abs(shown).max()
    across = np.linspace(4, width - 4, len(true))
    for axis, colour in enumerate(COLOURS):
        dim = tuple(int(0.45 * one + 0.55 * 255) for one in colour)
        for values, ink, thickness in (
            (shown[:, axis], dim, 1),
            (true[:, axis] - true[:, axis].mean(), colour, 2),
        ):
            places = np.stack([across, 20 + 0.5 * (height - 20) - scale * values], axis=1)
            points = np.round(places).astype(np.int32).reshape(-1, 1, 2)
            cv2.polylines(panel, [points], False, ink, thickness, cv2.LINE_AA)
    draw_text(panel, title, 4, 14, height=9, colour=INK)
    for axis, (name, colour) in enumerate(zip("xyz", COLOURS, strict=True)):
        draw_text(panel, name, width - 60 + 18 * axis, 14, height=9, colour=colour)
    return panel


def main() -> None:
    """Record, draw, write."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--out", type=Path, required=True)
    out = parser.parse_args().out
    with tempfile.TemporaryDirectory() as scratch:
        path = Path(scratch) / "rig.yaml"
        path.write_text(RIG)
        made = rig.record(
            PROMPT, Path(scratch) / "made", rig=path, frames=30, exposure=0.008,
            shutter="rolling", readout=0.02, imu=500.0, duration=DURATION, seed=SEED,
        )  # fmt: skip
        titles = ("cam0", "cam1, 0.3 m to the right", "cam2: equidistant lens, 120 degrees")
        above = tile(
            [camera_panel(made / f"cam{number}", title) for number, title in enumerate(titles)],
            3, WHITE, gap=8,
        )  # fmt: skip
        imu = np.loadtxt(made / "imu.csv", delimiter=",")
    described = understand(PROMPT, list_nouns())
    scene = compose_scene(described, seed=SEED, size=SIZE, duration_s=DURATION)
    true = true_samples(scene, np.eye(4), (imu[:, 0] // 1000).astype(np.int64))
    width = (above.shape[1] - 8) // 2
    below = tile(
        [
            plot(imu[:, 4:], true.acceleration, "specific force, about its mean", width),
            plot(imu[:, 1:4], true.rate, "angular velocity, about its mean", width),
        ],
        2, WHITE, gap=8,
    )  # fmt: skip
    page = blank(above.shape[1], above.shape[0] + 8 + below.shape[0], WHITE)
    page[: above.shape[0]] = above
    page[above.shape[0] + 8 :, : below.shape[1]] = below
    with atomic_file(out, overwrite=True) as part:
        part.write_bytes(png_bytes(page, level=9))


if __name__ == "__main__":
    main()
