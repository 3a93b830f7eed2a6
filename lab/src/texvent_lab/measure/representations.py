"""Events per CPU-second of every representation, and an image of them all.

    python -m texvent_lab.measure.representations [--device cpu] [--figure FILE.png]

The slice holds random events of 50 ms on a 640×480 sensor. With `--device`, tensors on that device
are measured instead, from events that are there already; on a GPU, time on the clock.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

import texvent
from texvent.events import EventStream
from texvent.extending import REPRESENTATIONS, require
from texvent.represent.array_ops import Events
from texvent.represent.named import represent
from texvent.represent.tensors import EventTensors
from texvent.sensor import SensorSize
from texvent.view.drawing.canvas import Image, blank, draw_text, enlarge, png_bytes
from texvent.view.drawing.palettes import get_palette

VGA = SensorSize(640, 480)
SLICE_US = 50_000
REPEATS = 5
SCENE = "a red car drives left past two trees, the camera follows it"
WINDOW_US = (200_000, 230_000)
SIZE = SensorSize(288, 216)
TEXT = 10
CAPTION = 28
GAP = 10
GREY = (190, 190, 190)
WHITE = (255, 255, 255)


class Tile(NamedTuple):
    """A representation to draw."""

    name: str
    options: dict[str, Any]
    caption: str
    on: Any = ...
    """Index of the ON values in the array."""
    off: Any = None
    """Index of the OFF values; None: the values at `on` are signed."""


TILES = (
    Tile("event-frame", {}, "event-frame (signed)"),
    Tile("histogram-2d", {"shape": (36, 48)}, "histogram-2d, 36 x 48 cells", 1, 0),
    Tile("binary-event-image", {"size": (96, 72)}, "binary-event-image, 96 x 72", 0, 1),
    Tile("time-surface", {"tau_us": 15_000}, "time-surface, tau 15 ms", 1, 0),
    Tile("voxel-e2vid", {"bins": 5}, "voxel-e2vid, bin 2 of 0..4", 2),
    Tile("voxel-tonic", {"bins": 5}, "voxel-tonic, bin 2 of 0..4", 2),
    Tile("voxel-dsec", {"bins": 5}, "voxel-dsec, bin 2 of 0..4", 2),
    Tile("stacked-histogram", {}, "stacked-histogram, bin 5 of 0..9", 15, 5),
    Tile("histogram-3d", {"bins": 10}, "histogram-3d, bin 5 of 0..9", (1, 5), (0, 5)),
)


def main() -> None:
    """Print the table, and draw the figure with its option."""
    parser = argparse.ArgumentParser(description="Measure and draw all representations.")
    parser.add_argument("--events", type=int, default=1_000_000)
    parser.add_argument("--device", help="measure torch on this device, such as cpu or cuda")
    parser.add_argument("--figure", type=Path, help="draw instead of measuring")
    arguments = parser.parse_args()
    if arguments.figure:
        arguments.figure.write_bytes(png_bytes(draw_figure()))
        return
    events: Events = random_events(arguments.events)
    if arguments.device:
        events = EventTensors.of(random_events(arguments.events), arguments.device)
    print(f"{arguments.events:,} events, {VGA}, {arguments.device or 'NumPy'}")
    for name in REPRESENTATIONS.names():
        seconds = measure(partial(represent, name, events), arguments.device)
        print(f"{name:20} {arguments.events / seconds / 1e6:7.1f} million events per second")


def random_events(count: int) -> EventStream:
    """Events at random places and times of one slice."""
    rng = np.random.default_rng(1)
    x, y, p = (rng.integers(0, side, count) for side in (*VGA, 2))
    t = np.sort(rng.integers(0, SLICE_US, count))
    return EventStream.from_columns(x, y, t, p, size=VGA)


def measure(call: Callable[[], Any], device: str | None) -> float:
    """Least seconds of CPU, or of the clock on a GPU, after one call that does not count."""
    is_gpu = device is not None and device != "cpu"
    clock = time.perf_counter if is_gpu else time.process_time
    wait = require("torch", extra="torch").cuda.synchronize if is_gpu else lambda: None
    call()
    taken = []
    for _ in range(REPEATS):
        wait()
        begin = clock()
        call()
        wait()
        taken.append(clock() - begin)
    return min(taken)


def draw_figure() -> Image:
    """One tile per representation, all of the same 30 ms."""
    events = texvent.generate(
        SCENE, seed=3, sensor=str(SIZE), duration=0.3, contrast_threshold=0.12, noise="none"
    ).between(*WINDOW_US)
    tiles = [draw_tile(events, tile) for tile in TILES]
    return np.vstack([np.hstack(tiles[first : first + 3]) for first in range(0, len(tiles), 3)])


def draw_tile(events: EventStream, tile: Tile) -> Image:
    """One array, ON and OFF in the palette's colours, the 90th percentile in full colour."""
    array = represent(tile.name, events, **tile.options).astype(np.float64)
    values = array[tile.on]
    if tile.off is not None:
        values = np.where(values >= array[tile.off], values, -array[tile.off])
    full = np.percentile(np.abs(values[values != 0]), 90)
    image = enlarge(paint(values / full), SIZE.width // values.shape[1], how="blocks")
    whole = blank(SIZE.width + GAP, SIZE.height + CAPTION + GAP, WHITE)
    draw_text(whole, tile.caption, 2, CAPTION - 8, height=TEXT, colour=get_palette("paper").ink)
    whole[CAPTION : CAPTION + SIZE.height, : SIZE.width] = GREY
    whole[CAPTION + 1 : CAPTION + SIZE.height - 1, 1 : SIZE.width - 1] = image[1:-1, 1:-1]
    return whole


def paint(values: NDArray[np.float64]) -> Image:
    """−1 .. 1 as OFF .. background .. ON."""
    palette = get_palette("paper")
    strength = np.clip(np.abs(values), 0, 1)[..., None]
    ink = np.where(values[..., None] > 0, palette.on, palette.off)
    colours = ink * strength + np.array(palette.background) * (1 - strength)
    return np.asarray(np.rint(colours), dtype=np.uint8)


if __name__ == "__main__":
    main()
