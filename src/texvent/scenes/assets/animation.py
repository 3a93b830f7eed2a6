"""Animations of glTF: places of all nodes at any time (specification, sections 3.5 and 3.11)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.scenes.assets.glb_file import GlbFile

Matrix = NDArray[np.float64]
_USUAL = {"translation": (0.0, 0.0, 0.0), "rotation": (0.0, 0.0, 0.0, 1.0), "scale": (1.0,) * 3}
_ACTIVITIES = {
    "move": ("walk", "drive", "fly", "swim", "move", "trot"),
    "run": ("run", "gallop"),
    "stand": ("idle", "stand"),
}
"""Activity of a pose → words in names of animations that show it."""


@dataclass(frozen=True, eq=False)
class Channel:
    """One moving property of one node."""

    node: int
    path: str
    """"translation", "rotation" or "scale"."""
    times_s: NDArray[np.float64]
    """[k] ascending."""
    values: NDArray[np.float64]
    """[k, 3 or 4]; of a spline [k, 3, 3 or 4]: tangent in, value, tangent out."""
    rule: str
    """"LINEAR", "STEP" or "CUBICSPLINE"."""

    def at(self, time_s: float) -> NDArray[np.float64]:
        """The value at a time; before the first and after the last key it rests."""
        times = self.times_s
        last = int(np.clip(np.searchsorted(times, time_s, side="right"), 1, max(len(times) - 1, 1)))
        first = last - 1
        if len(times) == 1:
            first = last = 0
        gap = times[last] - times[first]
        share = float(np.clip((time_s - times[first]) / gap, 0.0, 1.0)) if gap > 0.0 else 0.0
        if self.rule == "CUBICSPLINE":
            value = self._spline(first, last, share, gap)
        elif self.rule == "STEP":
            value = self.values[last if share >= 1.0 else first]
        elif self.path == "rotation":
            value = _slerp(self.values[first], self.values[last], share)
        else:
            value = (1.0 - share) * self.values[first] + share * self.values[last]
        return value / np.linalg.norm(value) if self.path == "rotation" else value

    def _spline(self, first: int, last: int, s: float, gap: float) -> NDArray[np.float64]:
        start, stop = self.values[first], self.values[last]
        return np.asarray(
            (2.0 * s**3 - 3.0 * s**2 + 1.0) * start[1]
            + gap * (s**3 - 2.0 * s**2 + s) * start[2]
            + (3.0 * s**2 - 2.0 * s**3) * stop[1]
            + gap * (s**3 - s**2) * stop[0]
        )


def _slerp(
    start: NDArray[np.float64], stop: NDArray[np.float64], share: float
) -> NDArray[np.float64]:
    cosine = float(np.dot(start, stop))
    other, cosine = (stop, cosine) if cosine >= 0.0 else (-stop, -cosine)
    if cosine > 0.9995:
        return (1.0 - share) * start + share * other
    angle = np.arccos(cosine)
    first, second = np.sin((1.0 - share) * angle), np.sin(share * angle)
    return np.asarray((first * start + second * other) / np.sin(angle))


@dataclass(frozen=True, eq=False)
class Animation:
    """Channels that play together, again and again."""

    name: str
    channels: tuple[Channel, ...]
    duration_s: float


def read_animations(file: GlbFile) -> tuple[Animation, ...]:
    """All animations that move nodes; moving weights of morph targets are left out."""
    found = []
    for animation in file.items("animations"):
        channels = []
        for channel in animation["channels"]:
            target, sampler = channel["target"], animation["samplers"][channel["sampler"]]
            if target.get("path") not in _USUAL or "node" not in target:
                continue
            rule = sampler.get("interpolation", "LINEAR")
            times = np.asarray(file.array(sampler["input"]), dtype=np.float64)
            values = np.asarray(file.array(sampler["output"]), dtype=np.float64)
            if rule == "CUBICSPLINE":
                values = values.reshape(len(times), 3, -1)
            channels.append(Channel(target["node"], target["path"], times, values, rule))
        if channels:
            end = max(float(channel.times_s[-1]) for channel in channels)
            found.append(Animation(animation.get("name", ""), tuple(channels), max(end, 1e-6)))
    return tuple(found)


def choose_animation(animations: Sequence[Animation], activity: str) -> Animation | None:
    """The animation whose name says the activity; otherwise the first one."""
    for word in (activity, *_ACTIVITIES.get(activity, ())):
        for animation in animations:
            if word in animation.name.lower():
                return animation
    return animations[0] if animations else None


def place_nodes(
    nodes: Sequence[Mapping[str, Any]],
    roots: Sequence[int],
    animation: Animation | None,
    time_s: float,
) -> dict[int, Matrix]:
    """[4, 4] map of each node below the roots to the scene's coordinates."""
    moved: dict[int, dict[str, NDArray[np.float64]]] = {}
    if animation is not None:
        for channel in animation.channels:
            value = channel.at(time_s % animation.duration_s)
            moved.setdefault(channel.node, {})[channel.path] = value
    found: dict[int, Matrix] = {}
    pending = [(root, np.eye(4)) for root in roots]
    while pending:
        number, above = pending.pop()
        if number in found:
            continue
        found[number] = above @ _own_map(nodes[number], moved.get(number))
        pending += [(child, found[number]) for child in nodes[number].get("children", ())]
    return found


def _own_map(node: Mapping[str, Any], moved: Mapping[str, NDArray[np.float64]] | None) -> Matrix:
    """A node's map to its parent."""
    if moved is None and "matrix" in node:
        return np.array(node["matrix"], dtype=np.float64).reshape(4, 4).T
    values = {
        name: np.array(node.get(name, usual), dtype=np.float64) for name, usual in _USUAL.items()
    }
    values.update(moved or {})
    x, y, z, w = values["rotation"]
    turn = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
    own = np.eye(4)
    own[:3, :3] = turn * values["scale"]
    own[:3, 3] = values["translation"]
    return own
