"""Writes small GLB files: a bar that two joints bend, and a box on a node that moves and turns."""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np


class GlbWriter:
    def __init__(self) -> None:
        self.document: dict[str, Any] = {
            "asset": {"version": "2.0"}, "scene": 0, "accessors": [], "bufferViews": [],
        }  # fmt: skip
        self._binary = b""

    def array(self, values: Any, dtype: str, kind: str) -> int:
        """Add an accessor; its number."""
        data = np.ascontiguousarray(values, dtype=dtype)
        component = {"<f4": 5126, "<u2": 5123, "<u1": 5121}[dtype]
        self.document["bufferViews"].append(self.blob(data.tobytes()))
        self.document["accessors"].append(
            {
                "bufferView": len(self.document["bufferViews"]) - 1,
                "componentType": component,
                "count": len(data),
                "type": kind,
            }
        )
        return len(self.document["accessors"]) - 1

    def blob(self, data: bytes) -> dict[str, int]:
        view = {"buffer": 0, "byteOffset": len(self._binary), "byteLength": len(data)}
        self._binary += data + b"\0" * (-len(data) % 4)
        return view

    def write(self, path: Path) -> Path:
        self.document["buffers"] = [{"byteLength": len(self._binary)}]
        text = json.dumps(self.document).encode()
        text += b" " * (-len(text) % 4)
        chunks = struct.pack("<II", len(text), 0x4E4F534A) + text
        chunks += struct.pack("<II", len(self._binary), 0x004E4942) + self._binary
        path.write_bytes(struct.pack("<III", 0x46546C67, 2, 12 + len(chunks)) + chunks)
        return path


def write_bar(path: Path) -> Path:
    """A square bar along y, 0 to 2 m; its upper joint, at 1 m, turns by 90° about z in 1 s."""
    writer = GlbWriter()
    heights = np.repeat(np.linspace(0.0, 2.0, 5), 4)
    ring = np.tile([[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1], [-0.1, 0.1]], (5, 1))
    places = np.stack([ring[:, 0], heights, ring[:, 1]], axis=1)
    sides = []
    for level in range(4):
        for side in range(4):
            a, b = 4 * level + side, 4 * level + (side + 1) % 4
            sides += [a, a + 4, b + 4, a, b + 4, b]
    joints = np.zeros((20, 4))
    joints[:, 0] = heights > 0.9
    weights = np.tile([1.0, 0.0, 0.0, 0.0], (20, 1))
    binds = np.stack([np.eye(4), np.eye(4)])
    binds[1, 1, 3] = -1.0
    half = np.sqrt(0.5)
    document = writer.document
    document["meshes"] = [
        {
            "primitives": [
                {
                    "attributes": {
                        "POSITION": writer.array(places, "<f4", "VEC3"),
                        "JOINTS_0": writer.array(joints, "<u1", "VEC4"),
                        "WEIGHTS_0": writer.array(weights, "<f4", "VEC4"),
                    },
                    "indices": writer.array(sides, "<u2", "SCALAR"),
                    "material": 0,
                }
            ]
        }
    ]
    document["materials"] = [{"pbrMetallicRoughness": {"baseColorFactor": [0.2, 0.4, 0.1, 1.0]}}]
    document["nodes"] = [
        {"mesh": 0, "skin": 0},
        {"children": [2]},
        {"translation": [0.0, 1.0, 0.0]},
    ]
    document["scenes"] = [{"nodes": [0, 1]}]
    flat = binds.transpose(0, 2, 1).reshape(2, 16)
    document["skins"] = [
        {"joints": [1, 2], "inverseBindMatrices": writer.array(flat, "<f4", "MAT4")}
    ]
    times = writer.array([0.0, 1.0], "<f4", "SCALAR")
    turns = writer.array([[0.0, 0.0, 0.0, 1.0], [0.0, 0.0, half, half]], "<f4", "VEC4")
    document["animations"] = [
        {
            "name": "Bend",
            "samplers": [{"input": times, "output": turns}],
            "channels": [{"sampler": 0, "target": {"node": 2, "path": "rotation"}}],
        }
    ]
    return writer.write(path)


def write_slider(path: Path, **extra: Any) -> Path:
    """A triangle on a node that moves 2 m along x in 1 s, in steps of its own rule."""
    writer = GlbWriter()
    corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
    document = writer.document
    document["meshes"] = [
        {"primitives": [{"attributes": {"POSITION": writer.array(corners, "<f4", "VEC3")}}]}
    ]
    document["nodes"] = [{"mesh": 0}]
    document["scenes"] = [{"nodes": [0]}]
    times = writer.array([0.0, 0.5, 1.0], "<f4", "SCALAR")
    places = writer.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]], "<f4", "VEC3")
    document["animations"] = [
        {
            "name": name,
            "samplers": [{"input": times, "output": places, "interpolation": rule}],
            "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
        }
        for name, rule in (("Slide", "LINEAR"), ("Run fast", "STEP"))
    ]
    document.update(extra)
    return writer.write(path)
