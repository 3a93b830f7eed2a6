"""How long the embedded generator takes per frame, in milliseconds of processor time.

    python -m benchmarks.render
    python -m benchmarks.render --prompt "a red car drives left past two trees"

Prints the median over frames of a moving scene; compiling is done before and timed apart.
"""

from __future__ import annotations

import argparse
import os
import statistics
import time

from texvent.generate.procedural import ProceduralConfig, ProceduralGenerator
from texvent.runtime.threads import THREADS_VARIABLE
from texvent.scenes.raycast.render import render
from texvent.scenes.scene import Scene
from texvent.sensor import SensorSize

PROMPTS = (
    "a red car drives left past two trees",
    "ostriches crossing a grassland",
    "a white SUV drives along a dirt road surrounded by pine trees",
    "a busy city street with cars and people",
)
SIZES = (SensorSize(346, 260), SensorSize(640, 480), SensorSize(1280, 720))


def main() -> None:
    """Print one line per prompt and size."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--prompt", action="append", help="scene to time (may be repeated)")
    parser.add_argument("--frames", type=int, default=7, help="frames per scene and size")
    options = parser.parse_args()
    prompts = options.prompt or PROMPTS
    started = time.perf_counter()
    render(make_scene(prompts[0], SIZES[0]), 0.0, SIZES[0])
    print(f"first image, with loading or compiling: {time.perf_counter() - started:.1f} s")
    print(f"{'scene':62s} {'size':>9s} {'shapes':>6s} {'ms':>7s}")
    for prompt in prompts:
        for size in SIZES:
            scene = make_scene(prompt, size)
            count = len(scene.primitives(0.0).shape)
            print(
                f"{prompt:62.62s} {size!s:>9s} {count:6d} {time_frames(scene, size, options):7.1f}"
            )


def make_scene(prompt: str, size: SensorSize) -> Scene:
    """The scene of a prompt."""
    generator = ProceduralGenerator(ProceduralConfig(), seed=0, size=size)
    return generator.generate(prompt).scene


def time_frames(scene: Scene, size: SensorSize, options: argparse.Namespace) -> float:
    """Median processor time of a frame on one thread, ms."""
    os.environ[THREADS_VARIABLE] = "1"
    spent = []
    for index in range(options.frames):
        started = time.process_time()
        render(scene, index / 24.0, size)
        spent.append((time.process_time() - started) * 1e3)
    return statistics.median(spent)


if __name__ == "__main__":
    main()
