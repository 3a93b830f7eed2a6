"""The container and arrays of a GLB file (glTF 2.0, binary; Khronos specification, section 3).

Read here and not by a library: the well-kept ones leave out skins and animations (trimesh) or the
arrays themselves (pygltflib), and the format is short.
"""

from __future__ import annotations

import json
import struct
from functools import cached_property
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError
from texvent.scenes.image import SurfaceImage, decode_srgb, surface_image

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
