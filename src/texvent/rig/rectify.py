"""Stereo rectification: two virtual pinholes in which matching points lie in one row.

Source: Fusiello, Trucco and Verri, A compact algorithm for rectification of stereo pairs, 2000.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from texvent.errors import ConfigError
from texvent.rig.description import Float64Array, RigCamera
from texvent.scenes.lens import Lens, distort, normalised
from texvent.sensor import SensorSize


@dataclass(frozen=True, eq=False)
class Rectified:
    """The pair of pinholes; both have `lens` and the first's size."""

    lens: Lens
    size: SensorSize
    turns: tuple[Float64Array, Float64Array]
    """[3, 3] each: coordinates in a camera → in its rectified one."""
    baseline_m: float


def rectify(first: RigCamera, second: RigCamera) -> Rectified:
    """The rectified pair of two cameras, whose lenses are known.

    Raises:
        ConfigError: they stand at one place, or one before the other.
    """
    to_first = np.linalg.inv(second.from_first @ np.linalg.inv(first.from_first))
    baseline = to_first[:3, 3]
    length = float(np.linalg.norm(baseline))
    if length < 1e-6 or baseline[0] < 0.5 * length:
        raise ConfigError(
            f"{second.name} must stand to the right of {first.name}; it is at "
            f"({', '.join(f'{one:.3g}' for one in baseline)}) m"
        )
    across = baseline / length
    forward = np.array([0.0, 0.0, 1.0]) + to_first[:3, 2]
    down = np.cross(forward, across)
    down /= np.linalg.norm(down)
    turn = np.stack([across, down, np.cross(across, down)])
    turns = (turn, np.asarray(turn @ to_first[:3, :3]))
    middle = []
    for camera, own in zip((first, second), turns, strict=True):
        centre = np.array([0.5 * camera.size.width, 0.5 * camera.size.height])
        seen = own @ np.append(normalised(_lens(camera), centre), 1.0)
        middle.append(seen[:2] / seen[2])
    focal = 0.25 * sum(_lens(one).fx + _lens(one).fy for one in (first, second))
    x, y = (float(one) for one in np.mean(middle, axis=0))
    size = first.size
    lens = Lens(focal, focal, 0.5 * size.width - focal * x, 0.5 * size.height - focal * y)
    return Rectified(lens, size, turns, length)


def rectified_points(pair: Rectified, number: int, camera: RigCamera) -> Float64Array:
    """[H, W, 2] where each pixel's middle of a raw image lies in the rectified one, our pixels."""
    rows, columns = np.indices(camera.size.shape) + 0.5
    plane = normalised(_lens(camera), np.stack([columns, rows], axis=-1))
    seen = np.concatenate([plane, np.ones((*plane.shape[:2], 1))], axis=-1) @ pair.turns[number].T
    lens = pair.lens
    return np.asarray(seen[..., :2] / seen[..., 2:] * lens.fx + [lens.cx, lens.cy])


def raw_points(pair: Rectified, number: int, camera: RigCamera) -> Float64Array:
    """[H, W, 2] where each pixel's middle of a rectified image lies in the raw one; may be NaN."""
    rows, columns = np.indices(pair.size.shape) + 0.5
    plane = (np.stack([columns, rows], axis=-1) - [pair.lens.cx, pair.lens.cy]) / pair.lens.fx
    seen = np.concatenate([plane, np.ones((*plane.shape[:2], 1))], axis=-1) @ pair.turns[number]
    lens = _lens(camera)
    placed = distort(lens, seen[..., :2] / seen[..., 2:])
    return np.asarray(placed * [lens.fx, lens.fy] + [lens.cx, lens.cy])


def rectified_camera(pair: Rectified, number: int, camera: RigCamera) -> RigCamera:
    """The virtual pinhole, as a camera of the rig."""
    turn = np.eye(4)
    turn[:3, :3] = pair.turns[number]
    return RigCamera(f"{camera.name}_rect", pair.size, pair.lens, turn @ camera.from_first)


def _lens(camera: RigCamera) -> Lens:
    if camera.lens is None:
        raise ConfigError(f"{camera.name} has no lens; the rig is not resolved")
    return camera.lens
