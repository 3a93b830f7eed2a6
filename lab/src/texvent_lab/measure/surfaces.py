"""How lively surfaces are, whether they alias, and what each costs.

    python -m texvent_lab.measure.surfaces                  # docs/results/surfaces.json
    python -m texvent_lab.measure.surfaces --frames real/*.png   # also the contrast of real frames
    python -m texvent_lab.measure.surfaces --only sand snow --out sand.json  # some

Contrast: median over 9 × 9 windows of the standard deviation of log luma (BT.601 of 0..255, plus
1). Activity: an ideal sensor (threshold 0.2, light in straight lines between 48 frames) while the
camera pans for 1 s. Aliasing: events of a sunlit plane that slides by 2 pixels in 1 s, at 24 and at
1,000 instants, for pixels of several sizes (`VIEWS`). Cost: processor time of a wall that fills the
image, one thread.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import statistics
import time
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from texvent.io.atomic import atomic_file
from texvent.runtime.jit import jit
from texvent.runtime.threads import THREADS_VARIABLE
from texvent.scenes.description import (
    CameraMove,
    ObjectMotion,
    SceneDescription,
    SceneObject,
    Shot,
    Surroundings,
)
from texvent.scenes.raycast.render import render
from texvent.scenes.raycast.shading.material import patch_axes, tile_average
from texvent.scenes.raycast.surfaces.catalogue import SURFACES, build_tile
from texvent.scenes.scene import Camera, Environment, Ground, Primitives, Scene, Shape, Texture
from texvent.scenes.staging.compose import compose_scene
from texvent.sensor import SensorSize
from texvent.transfer import encode_srgb

Floats = NDArray[np.float64]
SIZE = SensorSize(346, 260)
THRESHOLD = 0.2
SCENES = {
    "road": "car",
    "dirt road": "horse",
    "city": "car",
    "grass": "dog",
    "savanna": "ostrich",
    "forest": "fox",
    "desert": "dog",
    "snow": "horse",
    "river": "dog",
    "lake": "dog",
    "living room": "dog",
    "kitchen": "table",
    "office": "person",
    "warehouse": "person",
}
"""Place → what moves there."""
VIEWS = {"near": (0.01, 0.01), "middle": (0.06, 0.06), "far": (0.15, 0.15), "grazing": (0.03, 0.11)}
"""Metres of a plane that a pixel covers, across and away."""
POINTS = 1500
FEWEST_EVENTS = 50
"""Fewer events say nothing about aliasing."""


def main() -> None:
    """Measure and write the results."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--frames", nargs="*", default=[], help="real frames or films to compare")
    parser.add_argument("--only", nargs="*", default=[], help="places and materials; none: all")
    parser.add_argument("--out", default="docs/results/surfaces.json", help="where to write")
    options = parser.parse_args()
    os.environ[THREADS_VARIABLE] = "1"
    results: dict[str, Any] = {"scenes": {}, "materials": {}, "real": {}}
    for name in options.frames:
        results["real"][Path(name).name] = round(contrast_of_file(name), 3)
    for place, noun in SCENES.items():
        if options.only and place not in options.only:
            continue
        results["scenes"][place] = measure_scene(place, noun)
        print(place, results["scenes"][place], flush=True)
    for texture in (Texture.PLAIN, *SURFACES):
        if options.only and texture.name.lower() not in options.only:
            continue
        results["materials"][texture.name.lower()] = measure_material(texture)
        print(texture.name, results["materials"][texture.name.lower()], flush=True)
    with atomic_file(options.out, overwrite=True) as path:
        Path(path).write_text(json.dumps(results, indent=1) + "\n")


def log_luma(image: NDArray[Any]) -> Floats:
    """Log of BT.601 luma plus 1."""
    luma = np.asarray(image, dtype=np.float64) @ np.array([0.299, 0.587, 0.114])
    return np.asarray(np.log(luma + 1.0))


def local_contrast(log: Floats) -> float:
    """Median over 9 × 9 windows of the standard deviation."""
    windows = np.lib.stride_tricks.sliding_window_view(log, (9, 9))
    return float(np.median(windows.std(axis=(2, 3))))


def contrast_of_file(name: str) -> float:
    """Median contrast of an image, or of up to eight frames of a film, at 346 × 260."""
    film, found = cv2.VideoCapture(name), []
    count = max(int(film.get(cv2.CAP_PROP_FRAME_COUNT)), 1)
    for number in range(min(count, 320)):
        was_read, frame = film.read()
        if was_read and number % max(min(count, 320) // 8, 1) == 0:
            factor = max(SIZE.width / frame.shape[1], SIZE.height / frame.shape[0])
            shrunk = cv2.resize(frame, None, fx=factor, fy=factor, interpolation=cv2.INTER_AREA)
            found.append(local_contrast(log_luma(shrunk[: SIZE.height, : SIZE.width, ::-1])))
    return statistics.median(found)


def make_scene(place: str, noun: str, *, pans: bool) -> Scene:
    """An object that moves in a place, seen by a still camera or one that pans."""
    moves = (CameraMove("pan", "right", pace=1.0),) if pans else ()
    description = SceneDescription(
        place,
        objects=(SceneObject(noun, motion=ObjectMotion("stand")),),
        surroundings=Surroundings(place),
        shot=Shot(moves=moves),
    )
    return compose_scene(description, seed=1, size=SIZE, duration_s=1.0)


def measure_scene(place: str, noun: str) -> dict[str, float]:
    """Contrast, activity under a pan, and milliseconds per frame."""
    scene = make_scene(place, noun, pans=True)
    first = render(scene, 0.0, SIZE)
    spent = []
    for k in range(5):
        started = time.process_time()
        render(scene, 0.01 * k, SIZE)
        spent.append((time.process_time() - started) * 1e3)
    logs = [log_luma(render(scene, k / 48, SIZE)) for k in range(49)]
    counts, active = np.zeros(SIZE.shape), []
    level = logs[0].copy()
    in_window = np.zeros(SIZE.shape)
    for number, log in enumerate(logs[1:], 1):
        steps = np.trunc((log - level) / THRESHOLD)
        level += THRESHOLD * steps
        counts += np.abs(steps)
        in_window += np.abs(steps)
        if number % 2 == 0:
            active.append(float(np.mean(in_window > 0)))
            in_window[:] = 0
    return {
        "contrast": round(local_contrast(log_luma(first)), 3),
        "active_per_41.7_ms": round(float(np.mean(active)), 3),
        "two_or_more_events": round(float(np.mean(counts >= 2)), 3),
        "events_per_pixel": round(float(counts.mean()), 2),
        "ms": round(min(spent), 1),
    }


@dataclass(frozen=True)
class Wall:
    """A wall of a material that slides past a still camera."""

    texture: Texture
    environment_base: Environment
    camera_base: Camera
    speed: float

    def primitives(self, time_s: float) -> Primitives:
        """The wall."""
        to_world = np.zeros((1, 3, 4))
        to_world[0, :, :3] = np.diag([8.0, 0.1, 8.0])
        to_world[0, :, 3] = (self.speed * time_s, 3.1, 0.0)
        shade = np.array([[0.25, 0.22, 0.20]], dtype=np.float32)
        return Primitives(
            shape=np.array([Shape.BOX], dtype=np.int8),
            to_world=to_world,
            colour=shade,
            second_colour=1.4 * shade,
            texture=np.array([self.texture], dtype=np.int8),
            texture_scale=np.ones(1, dtype=np.float32),
            emission=np.zeros(1, dtype=np.float32),
            instance=np.ones(1, dtype=np.int32),
        )

    def camera(self, time_s: float) -> Camera:
        """Still."""
        return self.camera_base

    def environment(self, time_s: float) -> Environment:
        """Still."""
        return self.environment_base

    @property
    def class_names(self) -> dict[int, str]:
        """One wall."""
        return {1: "wall"}


def make_wall(texture: Texture, width: int) -> Wall:
    """A wall that moves by two pixels of an image of that width per second."""
    base = make_scene("plain", "cube", pans=False)
    surroundings = replace(base.environment(0.0), ground=Ground.NONE, shadows=False)
    looks_north = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
    return Wall(texture, surroundings, Camera(np.zeros(3), looks_north, 1.0), 2.0 * 3.0 / width)


def measure_material(texture: Texture) -> dict[str, Any]:
    """Milliseconds and contrast of an image, and aliasing in each of `VIEWS`."""
    wall = make_wall(texture, SIZE.width)
    render(wall, 0.0, SIZE)
    spent = []
    for k in range(7):
        started = time.process_time()
        render(wall, 0.01 * k, SIZE)
        spent.append((time.process_time() - started) * 1e3)
    return {
        "ms": round(min(spent), 1),
        "contrast": round(local_contrast(log_luma(render(wall, 0.0, SIZE))), 3),
        "events_24_over_1000": measure_aliasing(texture),
    }


def measure_aliasing(texture: Texture) -> dict[str, float | None]:
    """View → events at 24 instants over those at 1,000; None: too few events."""
    if texture == Texture.PLAIN:
        return dict.fromkeys(VIEWS)
    ratios: dict[str, float | None] = {}
    for view, patch in VIEWS.items():
        many = count_events(slide(texture, patch, 1001))
        few = count_events(slide(texture, patch, 25))
        ratios[view] = round(few / many, 3) if many >= FEWEST_EVENTS else None
    return ratios


def slide(texture: Texture, patch: tuple[float, float], count: int) -> list[Floats]:
    """Log luma of `POINTS` pixels at `count` instants, while a plane slides by two pixels."""
    places = np.random.default_rng(1).uniform(0.0, 50.0, (POINTS, 2))
    light = np.empty((count, POINTS))
    tile, scale = build_tile(texture).ctypes.data, 1.0 / SURFACES[texture].side_m
    sample_plane(tile, scale, patch, places, light)
    return [log_luma(frame) for frame in encode_srgb(np.repeat(light[:, :, None], 3, axis=2))]


@jit(error_model="numpy")
def sample_plane(
    tile: int, scale: float, patch: tuple[float, float], places: Floats, light: Floats
) -> None:
    """Write the light of pixels of a plane under a sun at 45 degrees, instant by instant."""
    axes = patch_axes((scale * patch[0], 0.0, 0.0, scale * patch[1]))
    last = len(light) - 1
    for k in range(last + 1):
        for i in range(len(places)):
            u = scale * (places[i, 0] + 2.0 * patch[0] * k / last)
            first, second, along, away = tile_average(tile, u, scale * places[i, 1], axes)
            length = math.sqrt(1.0 + along * along + away * away)
            facing = max(0.71 - 0.5 * (along + away), 0.0) / length
            light[k, i] = (0.3 + facing) * (0.24 * first + 0.32 * second)


def count_events(logs: list[Floats]) -> int:
    """Events of an ideal sensor, all pixels together."""
    level, count = logs[0].copy(), 0
    for log in logs[1:]:
        steps = np.trunc((log - level) / THRESHOLD)
        level += THRESHOLD * steps
        count += int(np.abs(steps).sum())
    return count


if __name__ == "__main__":
    main()
