"""A GLB file as a tool of its own writes it."""

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
import trimesh


def write_bar(path: Path, height: float = 2.0) -> Path:
    """A red bar, 0.2 wide, on a node 3 aside."""
    bar = trimesh.creation.box((0.2, height, 0.2))
    paint = trimesh.visual.material.PBRMaterial(baseColorFactor=[0.8, 0.2, 0.0, 1.0])
    bar.visual = trimesh.visual.TextureVisuals(material=paint)
    scene = trimesh.Scene()
    scene.add_geometry(bar, transform=trimesh.transformations.translation_matrix((3.0, 0.0, 0.0)))
    scene.export(path)
    return path


def write_triangle(
    path: Path,
    *,
    corners: Any = ((0, 0, 0), (1, 0, 0), (0, 1, 0)),
    numbers: Any = (0, 1, 2),
    image: bytes | None = None,
    **changes: Any,
) -> Path:
    """A triangle with an image; `changes` replace parts of the file's JSON."""
    places = np.array(corners, "<f4")
    parts = [places.tobytes(), np.array(numbers, "<u4").tobytes(), bytes(8 * len(places)), image]
    starts = np.cumsum([0, *(len(one or b"") for one in parts)]).tolist()
    types = [
        (5126, len(places), "VEC3"),
        (5125, len(numbers), "SCALAR"),
        (5126, len(places), "VEC2"),
    ]
    primitive = {"attributes": {"POSITION": 0, "TEXCOORD_0": 2}, "indices": 1, "material": 0}
    head = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [primitive]}],
        "accessors": [
            {"bufferView": view, "componentType": kind, "count": count, "type": form}
            for view, (kind, count, form) in enumerate(types)
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": start, "byteLength": len(one)}
            for start, one in zip(starts, parts, strict=False)
            if one is not None
        ],
        "buffers": [{"byteLength": starts[-1]}],
        "images": [{"bufferView": 3, "mimeType": "image/png"}] if image else [],
        "textures": [{"source": 0}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        **changes,
    }
    head["scenes"] = [{"nodes": list(range(len(head["nodes"])))}]
    text, data = json.dumps(head).encode(), b"".join(one or b"" for one in parts)
    text, data = text + b" " * (-len(text) % 4), data + bytes(-len(data) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text
    chunks += struct.pack("<II", len(data), 0x004E4942) + data
    path.write_bytes(b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks)
    return path
