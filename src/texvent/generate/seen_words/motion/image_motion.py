"""How far things move and change in the picture while they do one thing."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from texvent.generate.seen_words.picture import Picture, uneven_times
from texvent.scenes.projection import project
from texvent.scenes.scene import Camera, Float64Array, Primitives
from texvent.sensor import SensorSize

SAMPLES = 9
"""Instants of a phase."""
_REACH = np.concatenate([np.zeros((3, 1)), np.eye(3), -np.eye(3)], axis=1)
"""Middle of a unit shape, and the ends of its axes."""


class ImageMotion(NamedTuple):
    """What a thing does in the picture, for a camera that stays where it was at the start.

    All are shares of the thing's size: the greater side of its box in the picture at the start, at
    most that of the picture.
    """

    shift: float
    """Greatest way of its middle from where it was."""
    growth: float
    """By how much its size changes."""
    change: float
    """Greatest way of one of its parts from where it was; inf: it deforms or changes its colour."""
    speed: float
    """Length of its middle's way per second, 1/s."""
    lift: float
    """Change of height of its topmost part, upwards; the greatest in magnitude."""
    size: float
    """Its size, as a share of the picture's width."""


def measure_motion(
    picture: Picture, instances: Sequence[int], start_s: float, end_s: float
) -> dict[int, ImageMotion]:
    """What things do in the picture.

    Args:
        picture: of the staged scene.
        instances: ids of the things.
        start_s: first instant, s.
        end_s: last instant, s.

    Returns:
        Id → what it does; those of which no view shows a part are left out.
    """
    times = uneven_times(start_s, end_s, SAMPLES)
    camera = picture.scene.camera(start_s)
    frames = [picture.scene.primitives(float(t)) for t in times]
    seen = _list_seen(picture)
    found = {}
    for one in instances:
        parts = [n for n in seen if n < len(frames[0].instance) and frames[0].instance[n] == one]
        if parts and all(len(frame.instance) > max(parts) for frame in frames):
            found[one] = _measure(frames, np.array(parts), camera, picture.size, end_s - start_s)
    return found


def _list_seen(picture: Picture) -> list[int]:
    """Shapes of which any view shows something."""
    numbers = np.unique(np.concatenate([view.number for view in picture.views]))
    return [int(n) for n in numbers[numbers >= 0]]


def _measure(
    frames: Sequence[Primitives],
    parts: np.ndarray,
    camera: Camera,
    size: SensorSize,
    length_s: float,
) -> ImageMotion:
    spots = np.array([_project(frame, parts, camera, size) for frame in frames])
    low, high = np.nanmin(spots, axis=(1, 2)), np.nanmax(spots, axis=(1, 2))
    sides = np.clip(np.nanmax(high - low, axis=1), 1e-6, None)
    own = float(min(sides[0], max(size.width, size.height)))
    middles = 0.5 * (low + high)
    steps = np.linalg.norm(np.diff(middles, axis=0), axis=1)
    ways = np.linalg.norm(spots - spots[:1], axis=3)
    rises = low[0, 1] - low[:, 1]
    change = float(np.nanmax(ways)) / own
    return ImageMotion(
        float(np.linalg.norm(middles - middles[0], axis=1).max()) / own,
        float(sides.max() / sides.min()) - 1.0,
        np.inf if _is_changing(frames, parts) else change,
        float(steps.sum()) / own / max(length_s, 1e-6),
        float(rises[np.argmax(np.abs(rises))]) / own,
        own / size.width,
    )


def _project(
    frame: Primitives, parts: np.ndarray, camera: Camera, size: SensorSize
) -> Float64Array:
    """[k, 7, 2] pixels of the parts' middles and ends; NaN behind the camera."""
    to_world = frame.to_world[parts]
    spots = (to_world[:, :, :3] @ _REACH + to_world[:, :, 3:]).transpose(0, 2, 1)
    image = project(camera, size, spots)
    is_ahead = image[..., 2:] > 1e-3
    found = np.where(is_ahead, image[..., :2], np.nan)
    # A thing that passes beside the camera has left the picture: far outside is outside.
    edge = 2.0 * np.array([size.width, size.height], dtype=np.float64)
    clipped = np.clip(found, -edge, edge)
    return np.nan_to_num(clipped, nan=0.0) if np.isnan(clipped).all() else clipped


def _is_changing(frames: Sequence[Primitives], parts: np.ndarray) -> bool:
    """Whether a part lights up, changes its colour or deforms."""
    first = frames[0]
    return any(
        bool(np.any(one.emission[parts] != first.emission[parts]))
        or bool(np.any(one.colour[parts] != first.colour[parts]))
        or (
            one.mesh is not None
            and first.mesh is not None
            and bool(np.any(one.mesh[parts] != first.mesh[parts]))
        )
        for one in frames[1:]
    )
