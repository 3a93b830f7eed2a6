"""Pictures of the examples of the web page: events of each, on a clear ground, 2 bits a pixel.

Example:
    .venv/bin/python -m tools.example_pictures
"""

from __future__ import annotations

import struct
import tempfile
import tomllib
import zlib
from pathlib import Path

import numpy as np

import texvent
from texvent.view.stills import find_busiest
from texvent_scenes import load_scene

FOLDER = Path(__file__).parent.parent / "src" / "texvent" / "web" / "examples"
SENSOR, DURATION_S, WINDOW_US = "160x120", 0.6, 40_000
COLOURS = [(255, 255, 255), (84, 104, 255), (240, 72, 72), (162, 88, 163)]
"""Clear ground, ON, OFF, both: seen on white and on nearly black."""


def main() -> None:
    """Write a picture for each example, in their order."""
    examples = tomllib.loads((FOLDER / "examples.toml").read_text("utf-8"))["examples"]
    with tempfile.TemporaryDirectory() as folder:
        for number, subject in enumerate(one["text"] for one in examples):
            path = Path(folder) / "scene.toml"
            path.write_text(subject, encoding="utf-8")
            scene = load_scene(path) if "[[objects]]" in subject else subject
            events = texvent.generate(scene, duration=DURATION_S, sensor=SENSOR)
            window = find_busiest([events], WINDOW_US)
            if window is None:
                raise ValueError(f"no events of: {subject}")
            off, on = window.counts > 0
            (FOLDER / f"{number}.png").write_bytes(_png(on + 2 * off))


def _png(indices: np.ndarray) -> bytes:
    """An indexed image of four colours, the first clear."""
    four = indices.astype(np.uint8).reshape(len(indices), -1, 4)
    rows = (four @ np.array([64, 16, 4, 1], np.uint8)).astype(np.uint8)
    lines = np.pad(rows, ((0, 0), (1, 0))).tobytes()  # each without a filter
    size = struct.pack(">II5B", indices.shape[1], indices.shape[0], 2, 3, 0, 0, 0)
    parts = {b"IHDR": size, b"PLTE": bytes(sum(COLOURS, ())), b"tRNS": b"\0"}
    chunks = {**parts, b"IDAT": zlib.compress(lines, 9), b"IEND": b""}
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
        for name, data in chunks.items()
    )


if __name__ == "__main__":
    main()
