"""Frames with exact motion against every instant rendered: events, and processor time.

    python -m texvent_lab.measure.motion --json docs/results/motion.json     # all of it
    python -m texvent_lab.measure.motion --scenes fast mixed --prompts ""    # no prompts

Scenes of the oracle: 24 frames per second, not rounded, with the scene's own vectors and depth,
against the events of ideal pixels that see 4,800 instants per second. Thresholds are fitted so that
counts match. A lamp that beats at 37 Hz cannot be known from 24 frames per second: `mixed` is
scored with and without it.

Embedded scenes: `--interpolate motion` and `exact`, the same simulator and threshold, against ideal
pixels that see 1,200 instants per second. Time is processor time, the least of three runs in turn.
"""

from __future__ import annotations

import argparse
import json
import math
import platform
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent import __version__
from texvent.events import EventStream
from texvent.generate.procedural import ProceduralConfig, ProceduralGenerator
from texvent.metrics.compare import compare
from texvent.pipeline import Simulation
from texvent.sensor import SensorSize
from texvent.settings.resolution import resolve
from texvent.video import MICROSECONDS, Frame, Motion, frame_time_us
from texvent_lab.bench.oracle import scenes as oracle
from texvent_lab.bench.oracle.camera import radiance_of
from texvent_lab.bench.oracle.pixel import IDEAL, PixelArray
from texvent_lab.bench.oracle.recording import FPS, FRAMES, SIZE, TrueFrames, oracle_scene, record

SCENES = ("fast", "mixed", "translate", "slow")
PROMPTS = (
    "a red car drives left past two trees at dusk",
    "a dog runs across a meadow",
    "a bird flies over the sea at night",
    "the camera flies forward over a city",
    "a ball bounces on a table",
    "a man walks past a house",
)
STEPS = 40
"""Intermediate frames per pair on scenes of the oracle, for all ways of making them."""
EMBEDDED_SIZE = SensorSize(346, 260)
SECONDS, INSTANTS_PER_SECOND, REPEATS = 0.5, 1200, 3
TIMES_US = [frame_time_us(index, FPS) for index in range(FRAMES)]
LAMP = slice(SIZE.height // 2, SIZE.height // 2 + 8), slice(4, 12)
"""Rows and columns of the beating lamp of `mixed`."""


@dataclass(frozen=True, eq=False)
class KnownFrames(TrueFrames):
    """True frames that carry the scene's motion."""

    motions: list[Motion] = field(default_factory=list)

    def __iter__(self) -> Iterator[Frame]:
        for t_us, motion in zip(TIMES_US, self.motions, strict=True):
            yield Frame(self._level(t_us), t_us, motion=motion)


def main() -> None:
    """Measure, print a line per result, and write all of it."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scenes", nargs="*", default=SCENES)
    parser.add_argument("--prompts", nargs="*", default=PROMPTS)
    parser.add_argument("--size", default=str(EMBEDDED_SIZE))
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    width, height = map(int, options.size.split("x"))
    result: dict[str, Any] = {
        "version": __version__,
        "machine": f"{platform.machine()}, Python {platform.python_version()}",
        "scenes": {name: score_scene(name) for name in options.scenes},
        "embedded": {
            prompt: score_prompt(prompt, SensorSize(width, height))
            for prompt in options.prompts
            if prompt
        },
        "size": options.size,
    }
    if options.json:
        options.json.write_text(json.dumps(result, indent=1) + "\n")


def score_scene(name: str) -> dict[str, Any]:
    """1 − STPP of optical flow, known motion and true frames on a scene of the oracle."""
    scene = oracle_scene(name, 1)
    truth = record(scene, {"truth": (IDEAL, 1)})["truth"]
    known = KnownFrames(scene, motions=known_motion(name))
    keeps: dict[str, Callable[[EventStream], EventStream]] = {"all": everything}
    if name == "mixed":
        keeps["without the lamp"] = without_lamp
    result: dict[str, Any] = {}
    for label, keep in keeps.items():
        reference = keep(truth)
        row = {}
        for interpolate in ("flow", "motion", "exact"):
            video = known if interpolate == "motion" else TrueFrames(scene)
            events = fitted(video, interpolate, len(reference), keep)
            row[interpolate] = round(1 - compare(events, reference, ["stpp"])["stpp"], 4)
        row["gap closed"] = round(
            (row["flow"] - row["motion"]) / max(row["flow"] - row["exact"], 1e-9), 3
        )
        print(name, label, row, flush=True)
        result[label] = row
    return result


def fitted(
    video: Any, interpolate: str, count: int, keep: Callable[[EventStream], EventStream]
) -> EventStream:
    """Events whose number is `count` within a hundredth, by the threshold."""
    threshold = 0.09
    for _ in range(8):
        events = keep(simulate(video, interpolate, contrast_threshold=threshold, **FIXED))
        ratio = len(events) / count
        if abs(ratio - 1) < 0.01:
            break
        threshold *= ratio**0.9
    return events


SAME: Mapping[str, Any] = {"contrast_threshold": 0.0909, "count": "fixed", "fixed_count": 16}
"""Of embedded scenes: so both ways draw as many intermediate frames."""
FIXED: Mapping[str, Any] = {"count": "fixed", "fixed_count": STEPS, "detect_cuts": False}


def simulate(video: Any, interpolate: str, **options: Any) -> EventStream:
    """Events of simulator esim, without noise."""
    settings = resolve("simulate", {"simulator": "esim", "interpolate": interpolate, **options})
    return EventStream.concat(list(Simulation(video=video, settings=settings)))


def everything(events: EventStream) -> EventStream:
    """All events."""
    return events


def without_lamp(events: EventStream) -> EventStream:
    """The events outside the beating lamp."""
    rows, columns = LAMP
    inside = (events.y >= rows.start) & (events.y < rows.stop)
    inside &= (events.x >= columns.start) & (events.x < columns.stop)
    return events[~inside]


def known_motion(name: str) -> list[Motion]:
    """Vectors and depth of a scene of the oracle at its frames, from its definition."""
    seconds = [t_us / MICROSECONDS for t_us in TIMES_US]
    result = []
    for index, now in enumerate(seconds):
        shown = which_surface(name, now)
        forward, backward = (
            displacement(name, shown, now, seconds[other]) if 0 <= other < FRAMES else None
            for other in (index + 1, index - 1)
        )
        depth = np.array([10.0, 5.0, 3.0, 1.0], np.float32)[shown]
        result.append(Motion(forward, backward, depth))
    return result


def which_surface(name: str, seconds: float) -> NDArray[np.int64]:
    """[H, W] 0 for the texture; in `mixed`, 1 for the fast disc, 2 for the bar, 3 for the lamp."""
    width, height = SIZE
    shown = np.zeros(SIZE.shape, np.int64)
    if name != "mixed":
        return shown
    y, x = np.mgrid[:height, :width]
    shown[np.hypot(x - disc_x(seconds), y - 0.25 * height) < 0.08 * height] = 1
    angle, along, across = 4 * math.pi * seconds, x - 0.68 * width, y - 0.6 * height
    length = np.abs(along * math.cos(angle) + across * math.sin(angle))
    breadth = np.abs(across * math.cos(angle) - along * math.sin(angle))
    shown[(length < 0.18 * height) & (breadth < 2.5)] = 2
    shown[LAMP] = 3
    return shown


def disc_x(seconds: float) -> float:
    """Where the fast disc of `mixed` is."""
    return oracle._bounce(400 * seconds, 0.1 * SIZE.width, 0.9 * SIZE.width)


def displacement(
    name: str, shown: NDArray[np.int64], now: float, then: float
) -> NDArray[np.float32]:
    """[H, W, 2] how far what is shown moves, px."""
    width, height = SIZE
    velocity = {"mixed": (60.0, 10.0), **oracle.FLOWS}[name]
    vectors = np.empty((*SIZE.shape, 2), np.float32)
    vectors[:] = np.array(velocity) * (then - now)
    vectors[shown == 1] = (disc_x(then) - disc_x(now), 0.0)
    y, x = np.mgrid[:height, :width]
    along, across, angle = x - 0.68 * width, y - 0.6 * height, 4 * math.pi * (then - now)
    turned = np.stack(
        [
            along * math.cos(angle) - across * math.sin(angle) - along,
            along * math.sin(angle) + across * math.cos(angle) - across,
        ],
        axis=2,
    )
    vectors[shown == 2] = turned[shown == 2]
    vectors[shown == 3] = 0.0
    return vectors


def score_prompt(prompt: str, size: SensorSize) -> dict[str, Any]:
    """1 − STPP and processor time of following and of rendering every instant."""
    generator = ProceduralGenerator(ProceduralConfig(duration=SECONDS), seed=1, size=size)
    video = generator.generate(prompt)
    pixels = PixelArray(IDEAL, size, 1)
    for step in range(round(SECONDS * INSTANTS_PER_SECOND) + 1):
        t_us = round(step * MICROSECONDS / INSTANTS_PER_SECOND)
        pixels.expose(radiance_of(video.at(t_us).luma), t_us)
    truth = pixels.events()
    row: dict[str, Any] = {"true events": len(truth)}
    streams, best = {}, {"exact": math.inf, "motion": math.inf}
    for _ in range(REPEATS):
        for way in best:
            start = time.process_time()
            streams[way] = simulate(video, way, **SAME)
            best[way] = min(best[way], time.process_time() - start)
    for way, events in streams.items():
        row[f"{way}: 1 - STPP"] = round(1 - compare(events, truth, ["stpp"])["stpp"], 4)
        row[f"{way}: events"] = len(events)
        row[f"{way}: CPU s"] = round(best[way], 2)
    row["times faster"] = round(best["exact"] / best["motion"], 2)
    print(prompt, row, flush=True)
    return row


if __name__ == "__main__":
    main()
