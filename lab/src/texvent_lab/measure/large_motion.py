"""Interpolators on motion that is large, turns, or is of small things: PSNR, and events.

    python -m texvent_lab.measure.large_motion
    python -m texvent_lab.measure.large_motion --rife rife.safetensors --rife rife-4.6.safetensors

*dB* is the PSNR of the frame in the middle of two that are given. *1 - STPP* compares the events of
ESIM (noise-free) from five frames with those it makes when it gets the scene itself at every
instant.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from texvent.events import EventStream
from texvent.interpolate.protocol import Interpolator
from texvent.metrics.compare import compare
from texvent.sensor import SensorSize
from texvent.settings.resolution import resolve
from texvent.video import Video
from texvent_lab.bench.fidelity.entries import simulate_video
from texvent_lab.bench.oracle.camera import radiance_of
from texvent_lab.bench.oracle.recording import FPS, TrueFrames
from texvent_lab.measure.interpolation import between, interpolators, psnr
from texvent_lab.measure.interpolation_scenes import FloatArray, value_noise

WIDTH, HEIGHT = 192, 144
SIZE = SensorSize(WIDTH, HEIGHT)
SAMPLES = 3
"""Samples per pixel along each side."""
FRAMES = 5
SEEDS = (1, 2)

Scene = Callable[[FloatArray, FloatArray, float, int], FloatArray]
"""Places x and y from the centre, px, time in frames, seed → levels 0..255."""


def pan(x: FloatArray, y: FloatArray, t: float, seed: int, share: float) -> FloatArray:
    """A texture that moves by a share of the width per frame."""
    return value_noise(x - share * WIDTH * t, y - 0.2 * share * WIDTH * t, seed, "sharp")


def pan_behind(x: FloatArray, y: FloatArray, t: float, seed: int, share: float) -> FloatArray:
    """The same behind a disc that rests."""
    disc = np.hypot(x, y) < HEIGHT / 5
    return np.where(disc, value_noise(x, y, seed + 20, "sharp"), pan(x, y, t, seed, share))


def turn(x: FloatArray, y: FloatArray, t: float, seed: int, degrees: float) -> FloatArray:
    """A texture that turns about the centre, degrees per frame."""
    cos, sin = math.cos(math.radians(degrees) * t), math.sin(math.radians(degrees) * t)
    return value_noise(cos * x + sin * y, cos * y - sin * x, seed, "sharp")


def zoom(x: FloatArray, y: FloatArray, t: float, seed: int, factor: float) -> FloatArray:
    """A texture that grows by a factor per frame."""
    return value_noise(x / factor**t, y / factor**t, seed, "sharp")


def ball(x: FloatArray, y: FloatArray, t: float, seed: int, size: float, step: float) -> FloatArray:
    """A bright ball before a texture at rest; size px wide, step px per frame."""
    there = np.hypot(x + 2 * step - step * t, y + 10 + 0.3 * step * t) < size / 2
    return np.where(there, 230.0, 0.6 * value_noise(x, y, seed, "sharp"))


def spokes(x: FloatArray, y: FloatArray, t: float, seed: int, degrees: float) -> FloatArray:
    """A wheel of six spokes, 3 px wide, before a texture at rest."""
    ground = 0.6 * value_noise(x, y, seed, "sharp")
    turned = np.arctan2(y, x) - math.radians(degrees) * t
    away = (turned + math.pi / 6) % (math.pi / 3) - math.pi / 6
    radius = np.hypot(x, y)
    spoke = (np.abs(np.sin(away)) * radius < 1.5) & (radius < 55)
    return np.where(spoke, 230.0, ground)


def stripes(
    x: FloatArray,
    y: FloatArray,
    t: float,
    seed: int,
    period: float,
    step: float,
    degrees: float = 0.0,
) -> FloatArray:
    """Stripes that repeat after `period` px and move across themselves by `step` px per frame."""
    del seed
    along = x * math.cos(math.radians(degrees)) + y * math.sin(math.radians(degrees))
    return 127.5 + 100.0 * np.sin(2 * np.pi * (along - step * t) / period)


def fence(
    x: FloatArray, y: FloatArray, t: float, seed: int, period: float, step: float
) -> FloatArray:
    """Bars that move before a texture at rest."""
    is_bar = ((x - step * t) / period) % 1 < 0.3
    return np.where(is_bar, 220.0, 0.6 * value_noise(x, y, seed, "sharp"))


def shirt(
    x: FloatArray, y: FloatArray, t: float, seed: int, period: float, step: float
) -> FloatArray:
    """A striped disc, whose outline tells how it moves, before a texture at rest."""
    along = x - step * (t - 1.5)
    disc = stripes(along, y, 0.0, seed, period, 0.0, 37.0)
    return np.where(np.hypot(along, y) < 45, disc, 0.6 * value_noise(x, y, seed, "sharp"))


SCENES: Mapping[str, Scene] = {
    **{
        f"pan, {share:.0%} of the width": partial(pan, share=share)
        for share in (0.02, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4)
    },
    **{
        f"pan, {share:.0%}, behind a disc": partial(pan_behind, share=share)
        for share in (0.05, 0.2)
    },
    **{f"turn, {angle}°": partial(turn, degrees=angle) for angle in (3, 6, 10, 15)},
    **{f"zoom, {factor}": partial(zoom, factor=factor) for factor in (1.05, 1.1, 1.2, 1.3)},
    "ball, 8 px, 12 px": partial(ball, size=8.0, step=12.0),
    "ball, 14 px, 25 px": partial(ball, size=14.0, step=25.0),
    "ball, 30 px, 20 px": partial(ball, size=30.0, step=20.0),
    "spokes, 6°": partial(spokes, degrees=6.0),
    "spokes, 12°": partial(spokes, degrees=12.0),
    "stripes of 10 px, 2 px": partial(stripes, period=10.0, step=2.0),
    "stripes of 10 px, 3 px": partial(stripes, period=10.0, step=3.0),
    "slanted stripes of 24 px, 2 px": partial(stripes, period=24.0, step=2.0, degrees=30.0),
    "slanted stripes of 12 px, 2 px": partial(stripes, period=12.0, step=2.0, degrees=30.0),
    "stripes of 16 px, 7 px": partial(stripes, period=16.0, step=7.0),
    "stripes of 16 px, 12 px": partial(stripes, period=16.0, step=12.0),
    "stripes of 16 px, 40 px": partial(stripes, period=16.0, step=40.0),
    "fence of 12 px, 2 px": partial(fence, period=12.0, step=2.0),
    "fence of 24 px, 9 px": partial(fence, period=24.0, step=9.0),
    "shirt of 8 px, 6 px": partial(shirt, period=8.0, step=6.0),
}


def render(scene: Scene, t: float, seed: int) -> FloatArray:
    """The scene at a time, in frames."""
    total = np.zeros((HEIGHT, WIDTH))
    rows, columns = np.mgrid[:HEIGHT, :WIDTH].astype(np.float64)
    for k in range(SAMPLES**2):
        x = columns - WIDTH / 2 + (k % SAMPLES + 0.5) / SAMPLES
        y = rows - HEIGHT / 2 + (k // SAMPLES + 0.5) / SAMPLES
        total += scene(x, y, t, seed)
    return total / SAMPLES**2


def scene_video(scene: Scene, seed: int) -> TrueFrames:
    """The scene at 24 frames per second, and at any instant."""

    def show(seconds: float) -> FloatArray:
        return radiance_of(render(scene, seconds * float(FPS), seed).astype(np.float32))

    return TrueFrames(show, SIZE, FPS, FRAMES)


def main() -> None:
    """Print one table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rife", type=Path, action="append", default=[], help="RIFE weights")
    parser.add_argument("--scenes", default="", help="only those whose name contains this")
    parser.add_argument("--no-events", action="store_true", help="PSNR alone")
    options = parser.parse_args()
    chosen = {
        name: one
        for name, one in interpolators(options.rife).items()
        if name in ("blend", "flow") or "shared" in name
    }
    names = [f"{name}, dB" for name in chosen]
    if not options.no_events:
        names += [f"{name}, 1 - STPP" for name in chosen]
    print("| scene | " + " | ".join(names) + " |\n|" + "---|" * (len(names) + 1))
    for name, scene in SCENES.items():
        if options.scenes not in name:
            continue
        row = [f"{measure(scene, one):.1f}" for one in chosen.values()]
        if not options.no_events:
            row += [f"{value:.3f}" for value in measure_events(scene, options.rife)]
        print(f"| {name} | " + " | ".join(row) + " |", flush=True)


def measure(scene: Scene, interpolator: Interpolator | None) -> float:
    """PSNR of the middle frame, mean over the textures, dB."""
    found = []
    for seed in SEEDS:
        first, truth, last = (render(scene, t, seed) for t in (1.0, 1.5, 2.0))
        found.append(psnr(between(interpolator, first, last, 1)[0], truth))
    return float(np.mean(found))


def measure_events(scene: Scene, rife: list[Path]) -> list[float]:
    """1 - STPP of each interpolator to the scene itself, mean over the textures."""
    kinds: list[dict[str, Any]] = [{"interpolate": "blend"}, {"interpolate": "flow"}]
    kinds += [{"interpolate": "rife", "interpolator_weights": path} for path in rife]
    totals = np.zeros(len(kinds))
    for seed in SEEDS:
        video = scene_video(scene, seed)
        truth = simulate(video, {"interpolate": "exact"})
        frames = list(video)
        recorded = Video(
            np.stack([np.rint(one.pixels).astype(np.uint8) for one in frames]),
            [one.t_us for one in frames],
            FPS,
        )
        for k, kind in enumerate(kinds):
            totals[k] += 1.0 - compare(simulate(recorded, kind), truth, ("stpp",))["stpp"]
    return list(totals / len(SEEDS))


def simulate(video: Any, interpolation: dict[str, Any]) -> EventStream:
    """Events of ESIM."""
    options = {"simulator": "esim", "frames_per_pixel": 1.0, **interpolation}
    return simulate_video(video, resolve("simulate", options), None)


if __name__ == "__main__":
    main()
