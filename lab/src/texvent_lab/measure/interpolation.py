"""How well interpolators guess frames that are known: PSNR, SSIM, brightness travelled, time.

    python -m texvent_lab.measure.interpolation  # textures, exact truth
    python -m texvent_lab.measure.interpolation --embedded  # embedded scenes, exact truth
    python -m texvent_lab.measure.interpolation --clip bikes.mp4  # frames i, i+2 → i+1
    python -m texvent_lab.measure.interpolation --clip mouse.mp4 --gap 4  # frames i, i+4 → i+1..i+3
    python -m texvent_lab.measure.interpolation --time  # ms per pair and per frame
    python -m texvent_lab.measure.interpolation --rife rife.safetensors  # with RIFE; --rife repeats

A clip is a video file or a folder of images. Pairs with a cut between them are left out, and
every change found between neighbouring frames is listed.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import av
import cv2
import numpy as np
from numpy.typing import NDArray

from texvent.config import InterpolateConfig
from texvent.generate.procedural import ProceduralConfig, ProceduralGenerator
from texvent.interpolate.blend import BlendInterpolator
from texvent.interpolate.flow import FlowInterpolator
from texvent.interpolate.protocol import Interpolator
from texvent.interpolate.rife.interpolator import RifeInterpolator
from texvent.interpolate.rife.weights import read_rife_weights
from texvent.metrics.image_measures import structural_similarity
from texvent.pairs.scene_change import SceneChange, detect_scene_change
from texvent.video import Frame, Video

FloatArray = NDArray[np.float64]
TEXTURES = {
    "sharp": ((16.0, 0.55), (5.0, 0.3), (2.3, 0.15)),
    "smooth": ((32.0, 0.6), (16.0, 0.4)),
}
"""Octaves of value noise: (cell size, px; weight)."""
SPEEDS = {"slow": 14_000, "medium": 42_000, "fast": 126_000}
"""Name → interval between the two given frames, µs: one drive, three times as slow and as fast."""
PROMPT = "a red car drives left past two trees"
START_US = 1_000_000
"""Time of the first of them; the car is in the image."""


def embedded_scene(speed: str) -> Callable[[float], NDArray[Any]]:
    """The luma of an embedded scene at every position between two frames, 0..1.

    Args:
        speed: a name in `SPEEDS`.
    """
    stream = ProceduralGenerator(ProceduralConfig()).generate(PROMPT)

    def render(position: float) -> NDArray[Any]:
        return stream.at(START_US + round(position * SPEEDS[speed])).luma

    return render


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


INTERVAL_US = 40_000
STEPS = 11
"""Intermediate frames per pair where the truth is known at every instant: odd, for a middle."""
PIXELS = (3, 10, 24)
"""Motion between the two given frames of a texture, px."""

SIZES = ((346, 260), (1280, 720))
REPEATS, FURTHER = 3, 6
"""Runs that the least time is taken of; intermediate frames after the first."""


@dataclass(frozen=True)
class Case:
    """Frames of which the first and the last are given."""

    frames: list[NDArray[Any]]
    is_exact: bool
    """True if they hold no sensor noise, so that the brightness travelled can be compared."""

    @property
    def inner(self) -> list[NDArray[Any]]:
        """The frames to be guessed."""
        return self.frames[1:-1]


def main() -> None:
    """Print one table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--clip", type=Path, help="video file or folder of images")
    parser.add_argument("--embedded", action="store_true", help="scenes of the embedded generator")
    parser.add_argument("--time", action="store_true", help="time alone, at three sizes")
    parser.add_argument("--gap", type=int, default=2, help="frames between the two given ones")
    parser.add_argument("--pairs", type=int, default=12, help="pairs per clip")
    parser.add_argument("--first", type=int, default=0, help="where the first pair starts")
    parser.add_argument("--step", type=int, help="frames from pair to pair; default: even spread")
    parser.add_argument("--rife", type=Path, action="append", default=[], help="RIFE weights")
    options = parser.parse_args()
    if options.gap < 2 or options.gap % 2:
        parser.error(f"--gap is {options.gap}; it must be even and at least 2")
    chosen = interpolators(options.rife)
    if options.time:
        print_times(chosen)
        return
    print("| scene | frames from | middle, dB | SSIM | all, dB | travel |")
    print("|---|---|---|---|---|---|")
    if options.clip is not None:
        frames = list(read_grey(options.clip))
        cases = clip_cases(frames, options)
        print_rows(f"{options.clip.stem}, gap {options.gap}", cases, chosen)
        print("changes: " + (", ".join(list_scene_changes(frames)) or "none"))
        return
    positions = np.linspace(0, 1, STEPS + 2)
    if options.embedded:
        for speed in SPEEDS:
            render = embedded_scene(speed)
            print_rows(speed, [Case([render(at) for at in positions], True)], chosen)
        return
    for texture in TEXTURES:
        for pixels in PIXELS:
            truth = [moving_scene(pixels * at, texture) for at in positions]
            print_rows(f"{texture} {pixels} px", [Case(list(truth), True)], chosen)


def clip_cases(frames: Sequence[NDArray[Any]], options: argparse.Namespace) -> list[Case]:
    """Runs of gap + 1 frames without a cut, spread evenly or by a fixed step."""
    last = len(frames) - 1 - options.gap
    if options.step is None:
        starts = np.unique(np.linspace(options.first, last, options.pairs).astype(int))
    else:
        starts = options.first + options.step * np.arange(options.pairs)
    runs = [list(frames[start : start + options.gap + 1]) for start in starts if start <= last]
    return [
        Case(run, False)
        for run in runs
        if detect_scene_change(Frame(run[0], 0), Frame(run[-1], 1)) is SceneChange.NONE
    ]


def print_rows(name: str, cases: list[Case], chosen: dict[str, Interpolator | None]) -> None:
    """One row per interpolator, averaged over the cases."""
    for kind, interpolator in chosen.items():
        found = [measure(case, interpolator) for case in cases]
        means = [float(np.mean(column)) for column in zip(*found, strict=True)]
        middle, ssim, inner, travelled = means
        share = "" if np.isnan(travelled) else f"{travelled:.0%}"
        print(
            f"| {name} | {kind} | {middle:.2f} | {ssim:.3f} | {inner:.2f} | {share} |", flush=True
        )


def measure(case: Case, interpolator: Interpolator | None) -> tuple[float, ...]:
    """PSNR and SSIM of the middle frame, mean PSNR of all, brightness travelled."""
    first, last, count = case.frames[0], case.frames[-1], len(case.inner)
    middle = case.inner[count // 2].astype(np.float64)
    guesses = between(interpolator, first, last, count)
    guess = guesses[count // 2].astype(np.float64)
    travelled = travel([first, *guesses, last]) / travel(case.frames) if case.is_exact else np.nan
    return (
        psnr(guess, middle),
        structural_similarity(guess, middle, data_range=255.0),
        float(np.mean([psnr(a, b) for a, b in zip(guesses, case.inner, strict=True)])),
        travelled,
    )


def print_times(chosen: dict[str, Interpolator | None]) -> None:
    """The least of some runs: one pair with one frame, and each frame more.

    Processor time of all threads, which other programs hardly change; with a GPU, wall-clock time.
    """
    print("| size | frames from | ms, first frame | ms, each further |")
    print("|---|---|---|---|")
    for width, height in SIZES:
        first, last = (moving_scene(shift, "smooth", width, height) for shift in (0.0, 5.0))
        for kind, interpolator in chosen.items():
            one = min(seconds(interpolator, first, last, 1) for _ in range(REPEATS))
            more = min(seconds(interpolator, first, last, 1 + FURTHER) for _ in range(REPEATS))
            each = max(0.0, more - one) / FURTHER
            print(f"| {width}×{height} | {kind} | {1e3 * one:.1f} | {1e3 * each:.1f} |", flush=True)


def seconds(
    interpolator: Interpolator | None, first: NDArray[Any], last: NDArray[Any], count: int
) -> float:
    """How long a pair takes, s."""
    torch = sys.modules.get("torch")
    clock = time.perf_counter if torch and torch.cuda.is_available() else time.process_time
    start = clock()
    between(interpolator, first, last, count)
    return clock() - start


def interpolators(rife: Sequence[Path]) -> dict[str, Interpolator | None]:
    """Name → what guesses; None repeats the first frame. Each has run once, so it is compiled."""
    config = InterpolateConfig()
    stream = Video(np.zeros((1, 4, 4), np.uint8), [0])
    found: dict[str, Interpolator | None] = {
        "none": None,
        "blend": BlendInterpolator(config, stream),
        "flow": FlowInterpolator(config, stream),
    }
    for path in rife:
        name = read_rife_weights(path).layout.name
        found[f"RIFE {name}"] = RifeInterpolator(
            InterpolateConfig(interpolator_weights=path), stream
        )
    for interpolator in found.values():
        flat = np.zeros((64, 64), np.uint8)
        between(interpolator, flat, flat, 2)
    return found


def between(
    interpolator: Interpolator | None, first: NDArray[Any], second: NDArray[Any], count: int
) -> list[NDArray[Any]]:
    """`count` equally spaced intermediate images."""
    if interpolator is None:
        return [first] * count
    times_us = [INTERVAL_US * k // (count + 1) for k in range(1, count + 1)]
    pair = Frame(first, 0), Frame(second, INTERVAL_US)
    return [frame.pixels for frame in interpolator.between(*pair, times_us)]


def psnr(guess: NDArray[Any], truth: NDArray[Any]) -> float:
    """Peak signal-to-noise ratio, dB, peak 255."""
    error = np.mean((guess.astype(np.float64) - truth) ** 2)
    return float(10 * np.log10(255**2 / error)) if error else float("inf")


def travel(images: list[NDArray[Any]]) -> float:
    """Mean path length of a pixel's brightness ln(30 + I): what makes events, in units of δ."""
    levels = [np.log(30.0 + image) for image in images]
    return float(sum(np.abs(later - earlier).mean() for earlier, later in pairwise(levels)))


def list_scene_changes(frames: list[NDArray[Any]]) -> list[str]:
    """Cuts and flashes between neighbouring frames: `cut at 30`."""
    changes = [
        detect_scene_change(Frame(first, 0), Frame(second, 1)) for first, second in pairwise(frames)
    ]
    return [
        f"{change.value} at {i}"
        for i, change in enumerate(changes, 1)
        if change is not SceneChange.NONE
    ]


def read_grey(path: Path) -> Iterator[NDArray[np.uint8]]:
    """Grey frames of a video, or of the images in a folder in name order."""
    if path.is_dir():
        for name in sorted(path.glob("*.png")):
            image = cv2.imread(str(name), cv2.IMREAD_GRAYSCALE)
            if image is None:
                raise SystemExit(f"cannot read {name}")
            yield np.asarray(image, dtype=np.uint8)
        return
    with av.open(str(path)) as container:
        for frame in container.decode(video=0):
            yield np.asarray(frame.to_ndarray(format="gray"), dtype=np.uint8)


if __name__ == "__main__":
    main()
