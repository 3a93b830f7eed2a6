"""How long the embedded generator takes per frame, in milliseconds of processor time.

    python -m texvent_lab.measure.render
    python -m texvent_lab.measure.render --prompt "a red car drives left past two trees"
    python -m texvent_lab.measure.render --light
    python -m texvent_lab.measure.render --reuse

Prints the median over frames of a moving scene; compiling is done before and timed apart. `--reuse`
compares whole frames with those of which only tiles are drawn that can differ from the one before.
"""

from __future__ import annotations

import argparse
import os
import statistics
import time
from dataclasses import dataclass, replace
from typing import Literal

from texvent.generate.procedural import ProceduralConfig, ProceduralGenerator
from texvent.runtime.threads import THREADS_VARIABLE
from texvent.scenes.description import (
    Effect,
    Illumination,
    ObjectMotion,
    SceneDescription,
    SceneObject,
    Surroundings,
)
from texvent.scenes.raycast.render import render
from texvent.scenes.raycast.reuse.memory import FrameMemory
from texvent.scenes.scene import Camera, Environment, Primitives, Scene
from texvent.scenes.staging.compose import compose_scene
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
    parser.add_argument("--light", action="store_true", help="time lamps, smoke and fire")
    parser.add_argument("--reuse", action="store_true", help="time frames after one another")
    options = parser.parse_args()
    if options.reuse:
        time_reuse(options)
        return
    if options.light:
        time_light(options)
        return
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


def _described(
    noun: str,
    *effects: Effect,
    light: Literal["night", "day", "lamp"] = "night",
    place: str = "road",
    moves: bool = False,
) -> SceneDescription:
    motion = ObjectMotion("drive", "left") if moves else None
    return SceneDescription(
        "", objects=(SceneObject(noun, motion=motion),), effects=effects,
        light=Illumination(light), surroundings=Surroundings(place),
    )  # fmt: skip


LIGHT_SCENES = {
    "a car drives at night": _described("car", moves=True),
    "a city street at night": _described("person", place="city"),
    "a LED in a dark room": _described("led", light="lamp", place="indoor"),
    "smoke rises from a house": _described("house", Effect("smoke", 0), light="day"),
    "a campfire at night": _described("campfire", place="grass"),
    "mist on a meadow": _described("horse", Effect("mist"), light="day", place="grass"),
    "sparks fly from a box": _described("box", Effect("sparks", 0), light="lamp", place="indoor"),
}


@dataclass(frozen=True)
class _Partly:
    """A scene without puffs, and without lamps or their shadows."""

    scene: Scene
    has_lamps: bool

    def primitives(self, time_s: float) -> Primitives:
        return self.scene.primitives(time_s)

    def camera(self, time_s: float) -> Camera:
        return self.scene.camera(time_s)

    def environment(self, time_s: float) -> Environment:
        whole = self.scene.environment(time_s)
        lamps = whole.lamps.copy() if self.has_lamps else whole.lamps[:0]
        lamps[:, 13] = 0.0
        return replace(whole, lamps=lamps, puffs=whole.puffs[:0])

    @property
    def class_names(self) -> dict[int, str]:
        return self.scene.class_names


def time_light(options: argparse.Namespace) -> None:
    """Print what lamps, their shadows and puffs add to a frame."""
    size = SIZES[0]
    print(
        f"{'scene at 346x260':46s} {'lamps':>5s} {'puffs':>5s} {'dark':>7s} {'lit':>7s} {'all':>7s}"
    )
    for name, description in LIGHT_SCENES.items():
        scene = compose_scene(description, seed=0, size=size, duration_s=1.0)
        render(scene, 0.0, size)
        there = scene.environment(0.3)
        times = [
            time_frames(one, size, options)
            for one in (_Partly(scene, False), _Partly(scene, True), scene)
        ]
        print(
            f"{name:46s} {len(there.lamps):5d} {len(there.puffs):5d} "
            + " ".join(f"{one:7.1f}" for one in times)
        )


REUSE_PROMPTS = (
    "a red car drives left past two trees",
    "a red car drives left past two trees at night",
    "a person walks through a living room",
    "a crowd of people in a city street",
    "a dog walks through a city street at night",
    "smoke rises from a house",
    "the camera flies over a city",
)


def time_reuse(options: argparse.Namespace) -> None:
    """Print what a frame takes whole, and after one 1/96 s before it, timed in turns."""
    os.environ[THREADS_VARIABLE] = "1"
    size = SIZES[0]
    print(f"{'scene at 346x260':46s} {'whole':>7s} {'after':>7s}")
    for prompt in options.prompt or REUSE_PROMPTS:
        scene = make_scene(prompt, size)
        memory = FrameMemory(scene, size, samples=2, shadows=True)
        render(scene, 0.5, size)
        memory.render(0.5)
        whole, after = [], []
        for index in range(1, options.frames + 1):
            time_s = 0.5 + index / 96.0
            started = time.process_time()
            render(scene, time_s, size)
            between = time.process_time()
            memory.render(time_s)
            after.append((time.process_time() - between) * 1e3)
            whole.append((between - started) * 1e3)
        print(f"{prompt:46.46s} {min(whole):7.1f} {min(after):7.1f}", flush=True)


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
