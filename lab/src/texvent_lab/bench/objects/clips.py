"""Clips of scene files, rendered once, and the windows that each arm makes of the same frames."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.dataset.specification.items import Item
from texvent.errors import ConfigError
from texvent.events import EventStream
from texvent.frames import Frame, Video
from texvent.io.atomic import atomic_file
from texvent.run.prepare import make_video
from texvent.run.rate_search import find_threshold
from texvent.runtime.identity import derived_seed
from texvent.settings.resolution import Settings, resolve
from texvent.simulation.model_options import contrast_threshold_of
from texvent_lab.bench.fidelity.entries import simulate_video
from texvent_lab.bench.objects.recorded import SIDE, WINDOW_US, Frames, last_polarity

MARGIN = 5.0
"""Pixels by which boxes are larger than what is visible, on each side, as the recorded ones are."""
LEAST_SIDE = 24.0
"""Least side of a box, px: that of the recorded ones is 20 to 27, of a fork as of a mug."""
PILOT = 14
"""Clips on which thresholds are matched."""
Simulate: TypeAlias = Callable[[Path, float | None], EventStream]
"""Frames of a clip and contrast threshold → events."""


def render_clip(item: Item, options: Mapping[str, Any], path: Path) -> str:
    """Render a clip into a file: `luma` [n, 128, 128], `t_us` [n], `boxes` [windows, 4].

    Boxes are those of the first object in the middle of each window, NaN out of view.
    """
    seed = derived_seed(0, item.key)
    chosen = {name: value for name, value in options.items() if value != ""}
    settings = resolve("generate", {**chosen, "seed": seed})
    video: Any = make_video(item.subject, settings)
    frames = [(one.luma.astype(np.float16), one.t_us) for one in video]
    luma, t_us = (np.array(one) for one in zip(*frames, strict=True))
    if luma.shape[1:] != (SIDE, SIDE):
        raise ConfigError(f"sensor is {luma.shape[2]}x{luma.shape[1]}; a DVS128 has {SIDE}x{SIDE}")
    if not _starts(t_us):
        raise ConfigError(f"clips of {t_us[-1] / 1e6:g} s hold no window; make duration .4 or more")
    boxes = [_box(video, start + WINDOW_US // 2) for start in _starts(t_us)]
    with atomic_file(path, overwrite=True) as part, part.open("wb") as file:
        np.savez(file, luma=luma, t_us=t_us, boxes=np.array(boxes, np.float32))
    return f"{item.label}, {len(luma)} frames"


def _starts(t_us: NDArray[np.int64]) -> range:
    """Windows but for the first, in which models settle."""
    return range(WINDOW_US, int(t_us[-1]) + 1 - WINDOW_US, WINDOW_US)


def _box(video: Any, t_us: int) -> list[float]:
    """Box of the first object, with the margin of the recorded ones."""
    y, x = np.mgrid[:SIDE, :SIDE]
    points = np.stack([x.ravel(), y.ravel()], axis=1) + 0.5
    is_object = video.instances_at(t_us, points)[1].reshape(SIDE, SIDE) == 1
    if not is_object.any():
        return [np.nan] * 4
    sides = []
    for axis in (0, 1):
        places = np.flatnonzero(is_object.any(axis=axis))
        middle = (places[0] + places[-1] + 1) / 2
        sides.append((middle, max(places[-1] + 1 - places[0] + 2 * MARGIN, LEAST_SIDE)))
    (x_px, width), (y_px, height) = sides
    return [x_px - width / 2, y_px - height / 2, width, height]


@cache
def _video(path: Path) -> Video:
    with np.load(path) as file:
        times = [int(one) for one in file["t_us"]]
        return Video(file["luma"].astype(np.float32), times, None)


def frames_of(path: Path) -> Iterator[Frame]:
    """The frames of a clip in 8-bit grey, for other programs."""
    for one in _video(path):
        yield replace(one, pixels=np.rint(one.pixels).astype(np.uint8))


def simulate_clip(path: Path, options: Mapping[str, Any], threshold: float | None) -> EventStream:
    """Events of an arm from the frames of a clip."""
    return simulate_video(_video(path), _settings(path, options), threshold)


def stream_clip(path: Path, randomize: str) -> EventStream:
    """Events of an arm whose pixels are drawn as a training stream draws them."""
    from texvent_lab.train.one_clip import streamed_events  # imports torch

    luma = np.stack([one.pixels for one in frames_of(path)])
    times_us = np.array(_video(path).times_us)
    return streamed_events(luma, times_us, randomize, derived_seed(1, path.stem))


def at_frames(path: Path, events: EventStream) -> EventStream:
    """Events of a clip, each at the time of the first frame that is not before it."""
    times_us = np.array(_video(path).times_us)
    after = np.searchsorted(times_us, events.t).clip(max=len(times_us) - 1)
    return EventStream(events.x, events.y, times_us[after], events.p, events.size)


def _settings(path: Path, options: Mapping[str, Any]) -> Settings:
    chosen = {"interpolate": "none", **options, "seed": derived_seed(1, path.stem)}
    return resolve("simulate", chosen)


def match_threshold(
    paths: Sequence[Path], options: Mapping[str, Any], simulate: Simulate, target: float
) -> float | None:
    """The threshold with which the share of pixels with an event is that of the recorded frames.

    Args:
        paths: frames of some clips.
        options: of the arm.
        simulate: makes its events.
        target: share of pixels in a window of 100 ms.

    Returns:
        The threshold, log units, None for a model without one.
    """
    try:
        start = contrast_threshold_of(_settings(paths[0], options).simulate)
    except ConfigError:
        return None
    count, pixels = count_pixels(paths, simulate)
    return find_threshold(count, round(target * pixels), start=start).threshold


def count_pixels(
    paths: Sequence[Path], simulate: Simulate
) -> tuple[Callable[[float | None], int], int]:
    """Threshold → pixels with an event in all windows of some clips; pixels there are in all."""

    @cache
    def count(threshold: float | None) -> int:
        images = [_images(one, simulate(one, threshold)) for one in paths]
        return int(np.count_nonzero(np.concatenate(images)))

    windows = sum(len(_starts(np.array(_video(one).times_us))) for one in paths)
    return count, windows * SIDE * SIDE


def _images(path: Path, events: EventStream) -> NDArray[np.int8]:
    starts = _starts(np.array(_video(path).times_us))
    return np.stack([last_polarity(events, start_us) for start_us in starts])


def make_windows(
    paths: Sequence[Path],
    classes: Sequence[int],
    simulate: Simulate,
    thresholds: Sequence[float | None],
) -> tuple[Frames, int]:
    """Windows of all clips in an arm, but for those whose object is out of view.

    Args:
        paths: frames of the clips.
        classes: number of the class of each.
        simulate: makes the events.
        thresholds: contrast threshold of each clip, log units; None leaves the model's.

    Returns:
        The windows; their events in all.
    """
    images, labels, boxes, groups, count = [], [], [], [], 0
    clips = zip(paths, classes, thresholds, strict=True)
    for number, (path, kind, threshold) in enumerate(clips):
        events = simulate(path, threshold)
        count += len(events)
        images.append(_images(path, events))
        with np.load(path) as file:
            boxes.append(file["boxes"])
        labels += [kind] * len(boxes[-1])
        groups += [number] * len(boxes[-1])
    found = Frames(
        np.concatenate(images), np.array(labels), np.concatenate(boxes), np.array(groups)
    )
    return found, count
