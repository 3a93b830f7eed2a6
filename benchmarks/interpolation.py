"""How well none, blend and flow guess held-out middle frames: PSNR, and the brightness travelled.

    python -m benchmarks.interpolation                            # synthetic scenes, exact truth
    python -m benchmarks.interpolation --clip bikes.mp4           # frames i, i+2 → i+1
    python -m benchmarks.interpolation --clip mouse.mp4 --gap 4   # frames i, i+4 → i+2

A clip is a video file or a folder of pictures. Pairs with a cut between them are left out, and
every jump found between neighbouring frames is listed.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

import av
import cv2
import numpy as np
from numpy.typing import NDArray

from texvent.config import InterpolateConfig
from texvent.interpolate.blend import BlendInterpolator
from texvent.interpolate.cuts import Jump, detect_jump
from texvent.interpolate.flow import FlowInterpolator
from texvent.interpolate.protocol import Interpolator
from texvent.video import Frame, Video

FloatArray = NDArray[np.float64]
INTERVAL_US = 40_000
STEPS = 12
"""Intermediate frames per pair when the brightness travel is measured."""
TEXTURES = {
    "sharp": ((16.0, 0.55), (5.0, 0.3), (2.3, 0.15)),
    "smooth": ((32.0, 0.6), (16.0, 0.4)),
}
"""Octaves of value noise: (cell size, px; weight)."""


def main() -> None:
    """Print one table: synthetic scenes, or a clip."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--clip", type=Path, help="video file or folder of pictures")
    parser.add_argument("--gap", type=int, default=2, help="frames between the two given ones")
    parser.add_argument("--pairs", type=int, default=12, help="pairs per clip, spread evenly")
    options = parser.parse_args()
    if options.gap < 2 or options.gap % 2:
        parser.error(f"--gap is {options.gap}; it must be even and at least 2")
    if options.clip is None:
        print_synthetic()
    else:
        print_clip(options.clip, options.gap, options.pairs)


def print_synthetic() -> None:
    """PSNR and brightness travel on scenes that can be rendered at any instant."""
    print("| scene | px/frame | hold | blend | flow | blend travel | flow travel |")
    print("|---|---|---|---|---|---|---|")
    for name in TEXTURES:
        for pixels in (3, 10, 24):
            truth = [moving_scene(pixels * k / (STEPS + 1), name) for k in range(STEPS + 2)]
            middle = moving_scene(pixels / 2, name)
            first, second = truth[0], truth[-1]
            cells = [f"{psnr(first, middle):.1f}"]
            travels = []
            for interpolator in interpolators().values():
                cells.append(f"{psnr(between(interpolator, first, second, 1)[0], middle):.1f}")
                inner = between(interpolator, first, second, STEPS)
                travels.append(f"{travel([first, *inner, second]) / travel(truth):.0%}")
            print(f"| {name} | {pixels} | {' | '.join([*cells, *travels])} |")


def print_clip(path: Path, gap: int, pairs: int) -> None:
    """PSNR on held-out frames of a real clip, time per frame, and the jumps in it."""
    frames = list(read_grey(path))
    spread = np.unique(np.linspace(0, len(frames) - 1 - gap, pairs).astype(int))
    triplets = [
        (frames[i], frames[i + gap // 2], frames[i + gap])
        for i in spread
        if detect_jump(Frame(frames[i], 0), Frame(frames[i + gap], 1)) is Jump.NONE
    ]
    print(f"{path.name}: {len(frames)} frames, gap {gap}, {len(triplets)} pairs")
    print(f"  hold  {np.mean([psnr(first, middle) for first, middle, _ in triplets]):.2f} dB")
    for name, interpolator in interpolators().items():
        between(interpolator, triplets[0][0], triplets[0][2], 1)
        start = time.perf_counter()
        guesses = [between(interpolator, first, last, 1)[0] for first, _, last in triplets]
        spent_ms = (time.perf_counter() - start) / len(triplets) * 1e3
        scores = [
            psnr(guess, middle) for guess, (_, middle, _) in zip(guesses, triplets, strict=True)
        ]
        print(f"  {name:5} {np.mean(scores):.2f} dB, {spent_ms:.1f} ms per pair")
    print("  jumps " + (", ".join(list_jumps(frames)) or "none"))


def interpolators() -> dict[str, Interpolator]:
    """The interpolators that guess."""
    config = InterpolateConfig()
    stream = Video(np.zeros((1, 4, 4), np.uint8), [0])
    return {"blend": BlendInterpolator(config, stream), "flow": FlowInterpolator(config, stream)}


def between(
    interpolator: Interpolator, first: NDArray[Any], second: NDArray[Any], count: int
) -> list[NDArray[Any]]:
    """`count` equally spaced intermediate pictures."""
    times_us = [INTERVAL_US * k // (count + 1) for k in range(1, count + 1)]
    pair = Frame(first, 0), Frame(second, INTERVAL_US)
    return [frame.pixels for frame in interpolator.between(*pair, times_us)]


def psnr(guess: NDArray[Any], truth: NDArray[Any]) -> float:
    """Peak signal-to-noise ratio, dB, peak 255."""
    error = np.mean((guess.astype(np.float64) - truth) ** 2)
    return float(10 * np.log10(255**2 / error)) if error else float("inf")


def travel(pictures: list[NDArray[Any]]) -> float:
    """Mean path length of a pixel's brightness ln(30 + I): what makes events, in units of δ."""
    levels = [np.log(30.0 + picture) for picture in pictures]
    return float(sum(np.abs(later - earlier).mean() for earlier, later in pairwise(levels)))


def list_jumps(frames: list[NDArray[Any]]) -> list[str]:
    """Cuts and flashes between neighbouring frames: `cut at 30`."""
    jumps = [detect_jump(Frame(first, 0), Frame(second, 1)) for first, second in pairwise(frames)]
    return [f"{jump.value} at {i}" for i, jump in enumerate(jumps, 1) if jump is not Jump.NONE]


def read_grey(path: Path) -> Iterator[NDArray[np.uint8]]:
    """Grey frames of a video, or of the pictures in a folder in name order."""
    if path.is_dir():
        for name in sorted(path.glob("*.png")):
            picture = cv2.imread(str(name), cv2.IMREAD_GRAYSCALE)
            if picture is None:
                raise SystemExit(f"cannot read {name}")
            yield np.asarray(picture, dtype=np.uint8)
        return
    with av.open(str(path)) as container:
        for frame in container.decode(video=0):
            yield np.asarray(frame.to_ndarray(format="gray"), dtype=np.uint8)


def moving_scene(position: float, texture: str, width: int = 346, height: int = 260) -> FloatArray:
    """A panning texture with a counter-moving disc, 3×3 samples per pixel, float levels.

    Args:
        position: how far both have moved, px.
        texture: a name in `TEXTURES`.
        width: px.
        height: px.
    """
    samples = 3
    total = np.zeros((height, width))
    rows, columns = np.mgrid[:height, :width].astype(np.float64)
    for k in range(samples * samples):
        x = columns + (k % samples + 0.5) / samples - 0.5
        y = rows + (k // samples + 0.5) / samples - 0.5
        ground = value_noise(x + position, y + 0.3 * position, 1, texture)
        disc = value_noise(x - position, y - 0.2 * position, 20, texture)
        from_centre = np.hypot(x - width / 2 - position, y - height / 2 - 0.2 * position)
        total += np.where(from_centre < height / 4, disc, ground)
    return total / samples**2


def value_noise(x: FloatArray, y: FloatArray, seed: int, texture: str) -> FloatArray:
    """Random levels on a lattice, joined smoothly; 0..255."""
    total = np.zeros_like(x)
    for octave, (cell, weight) in enumerate(TEXTURES[texture]):
        lattice = np.random.default_rng(seed + octave).random((64, 64))
        u, v = x / cell, y / cell
        column, row = np.floor(u).astype(int), np.floor(v).astype(int)
        fx, fy = (f * f * (3 - 2 * f) for f in (u - column, v - row))
        left, right, top, bottom = column % 64, (column + 1) % 64, row % 64, (row + 1) % 64
        upper = lattice[top, left] * (1 - fx) + lattice[top, right] * fx
        lower = lattice[bottom, left] * (1 - fx) + lattice[bottom, right] * fx
        total += weight * (upper * (1 - fy) + lower * fy)
    return np.asarray(255 * np.clip((total - 0.5) * 1.6 + 0.5, 0, 1))


if __name__ == "__main__":
    main()
