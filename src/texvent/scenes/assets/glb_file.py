"""GLB files (glTF 2.0, binary; Khronos specification, section 3): arrays, images, animations.

Read here and not by a library: the well-kept ones leave out skins and animations (trimesh) or the
arrays themselves (pygltflib), and the format is short.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError
from texvent.scenes.mesh import SurfaceImage, decode_srgb, surface_image

_MAGIC = 0x46546C67
_JSON, _BINARY = 0x4E4F534A, 0x004E4942
_TYPES = {
    5120: np.dtype("<i1"), 5121: np.dtype("<u1"), 5122: np.dtype("<i2"), 5123: np.dtype("<u2"),
    5125: np.dtype("<u4"), 5126: np.dtype("<f4"),
}  # fmt: skip
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
_KNOWN_EXTENSIONS = frozenset(
    {"KHR_materials_unlit", "KHR_texture_transform", "KHR_mesh_quantization"}
)
"""Extensions that a file may require: without their effect it still looks right."""


class GlbFile:
    """The JSON of a GLB file with its arrays and images.

    Args:
        path: the file.

    Raises:
        FileFormatError: it is no GLB file, is damaged, or needs what is not read.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        try:
            data = path.read_bytes()
            magic, version, length = struct.unpack_from("<III", data)
        except (OSError, struct.error) as error:
            raise FileFormatError(f"{path} cannot be read: {error}") from error
        if magic != _MAGIC or version != 2 or length > len(data):
            raise FileFormatError(f"{path} is no whole GLB file of version 2")
        self._binary = b""
        place, document = 12, None
        while place + 8 <= length:
            size, kind = struct.unpack_from("<II", data, place)
            chunk = data[place + 8 : place + 8 + size]
            if kind == _JSON:
                document = chunk
            elif kind == _BINARY:
                self._binary = chunk
            place += 8 + size
        try:
            self.json: dict[str, Any] = json.loads(document or b"null") or {}
        except ValueError as error:
            raise FileFormatError(f"{path} has a damaged description: {error}") from error
        needed = set(self.json.get("extensionsRequired", ())) - _KNOWN_EXTENSIONS
        if needed:
            raise FileFormatError(
                f"{path} needs {', '.join(sorted(needed))}, which is not read; export it without"
            )

    def items(self, name: str) -> list[dict[str, Any]]:
        """A list of the file's description, such as "nodes"; empty if it has none."""
        found = self.json.get(name, [])
        return found if isinstance(found, list) else []

    def array(self, number: int) -> NDArray[Any]:
        """The numbers of an accessor, [n] or [n, width]; normalised integers become 0..1 or ±1."""
        accessor = self.items("accessors")[number]
        dtype: Any = _TYPES[accessor["componentType"]]
        width, count = _WIDTHS[accessor["type"]], int(accessor["count"])
        if "sparse" in accessor or "bufferView" not in accessor:
            raise FileFormatError(f"{self.path} has a sparse array, which is not read")
        view = self.items("bufferViews")[accessor["bufferView"]]
        if view.get("buffer", 0) != 0 or "uri" in self.items("buffers")[0]:
            raise FileFormatError(f"{self.path} keeps arrays in other files, which is not read")
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        stride = view.get("byteStride") or dtype.itemsize * width
        values = np.ndarray(
            (count, width), dtype, self._binary, start, (stride, dtype.itemsize)
        ).copy()
        if accessor.get("normalized"):
            values = np.maximum(values / np.iinfo(dtype).max, -1.0).astype(np.float32)
        return values[:, 0] if width == 1 else values

    @cached_property
    def images(self) -> list[SurfaceImage | None]:
        """All images in linear light; None where one lies in another file."""
        return [self._image(image) for image in self.items("images")]

    def _image(self, image: dict[str, Any]) -> SurfaceImage | None:
        if "bufferView" not in image:
            return None
        view = self.items("bufferViews")[image["bufferView"]]
        start = view.get("byteOffset", 0)
        coded = np.frombuffer(self._binary, np.uint8, view["byteLength"], start)
        pixels = cv2.imdecode(coded, cv2.IMREAD_COLOR)
        if pixels is None:
            raise FileFormatError(f"{self.path} has an image that cannot be decoded")
        rgb = np.asarray(pixels[..., ::-1], dtype=np.uint8)
        return surface_image(decode_srgb(rgb), repeats=True)


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
