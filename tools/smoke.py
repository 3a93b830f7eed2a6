"""The main commands and every small extra of an installed texvent, on inputs made here.

Run by `tools.check_wheel` with the interpreter of an environment, in an empty folder. Nothing of
the repository is imported, and every command runs in this process, so that kernels compile once.
"""

from __future__ import annotations

import contextlib
import importlib
import sys
import time
from collections.abc import Iterator
from importlib import metadata
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

SIZE = (48, 64)
SPECIFICATION = """
name = "balls"
license = "cc0-1.0"
samples_per_shard = 2
options = { sensor = "64x48", duration = 0.1 }
variants.esim = { simulator = "esim" }

[[sources]]
prompts = ["a red ball bounces", "a blue ball rolls"]
"""
MODEL = """
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
f 1 3 2
f 1 2 4
f 2 3 4
f 1 4 3
"""
FORMATS = ("npz", "txt", "raw", "dat", "aedat4", "bin", "zip", "csv", "bag", "mcap")
"""Endings of all formats that are written; the last two need the extra bags."""
COMMANDS = (
    "generate 'a red ball bounces' --sensor 64x48 --duration 0.1 -o ball.h5",
    "simulate clip.mp4 -o clip.h5",
    "simulate pictures --fps 50 --simulator esim -o pictures.h5",
    "simulate exr --fps 50 --interpolate flow -o exr.h5",
    "check clip.mp4",
    "info clip.h5",
    "validate clip.h5",
    "compare clip.h5 ball.h5 --metrics count_ratio",
    "render clip.h5 -o drawn.mp4",
    "render clip.h5 -o drawn.html",
    "generate 'a wedge spins' --assets models --sensor 64x48 --duration 0.05 -o wedge.h5",
    "dataset make balls.toml -o balls --workers 1",
    "dataset verify balls",
    *(f"convert clip.h5 clip.{ending}" for ending in FORMATS),
    *(f"validate clip.{ending} --sensor 64x48" for ending in FORMATS),
    "convert events.parquet parquet.h5 --sensor 64x48",
    "convert blosc.h5 plain.h5 --sensor 64x48",
)


def frames() -> list[NDArray[np.uint8]]:
    """A bright square that moves a pixel per frame."""
    images = np.full((10, *SIZE, 3), 60, np.uint8)
    for index, image in enumerate(images):
        image[16:32, 10 + index : 26 + index] = 200
    return list(images)


def write_inputs() -> None:
    """A video whose title is not UTF-8, folders of pictures, a model and a specification."""
    import av
    import cv2

    with av.open("clip.mp4", "w") as container:
        container.metadata["title"] = "Stra-e"
        stream = container.add_stream("libx264", rate=50)
        stream.height, stream.width, stream.pix_fmt = *SIZE, "yuv420p"
        for image in frames():
            container.mux(stream.encode(av.VideoFrame.from_ndarray(image, format="rgb24")))
        container.mux(stream.encode())
    clip = Path("clip.mp4")
    clip.write_bytes(clip.read_bytes().replace(b"Stra-e", b"Stra\xdfe"))
    for folder in ("pictures", "exr", "models"):
        Path(folder).mkdir()
    open_exr: Any = importlib.import_module("OpenEXR")
    for index, image in enumerate(frames()):
        cv2.imwrite(f"pictures/{index:03d}.png", image)
        light = {"RGB": (image / np.float32(255)).astype(np.float32)}
        header = {"compression": open_exr.ZIP_COMPRESSION, "type": open_exr.scanlineimage}
        open_exr.File(header, light).write(f"exr/{index:03d}.exr")
    Path("models/wedge.obj").write_text(MODEL)
    Path("balls.toml").write_text(SPECIFICATION)


def write_others() -> None:
    """Events in files of other programs, by the extras that read them."""
    import h5py

    import texvent

    events = texvent.load("clip.h5")
    importlib.import_module("pyarrow.parquet")
    events.to_dataframe().to_parquet("events.parquet")
    zstd: Any = importlib.import_module(
        "compression.zstd" if sys.version_info >= (3, 14) else "backports.zstd"
    )
    zstd.decompress(zstd.compress(Path("clip.txt").read_bytes()))
    blosc: Any = importlib.import_module("hdf5plugin").Blosc()
    with h5py.File("blosc.h5", "w") as file:
        for name in "xytp":
            file.create_dataset(f"events/{name}", data=getattr(events, name), **blosc)


def use_python() -> None:
    """The camera of a program, and what a notebook shows."""
    import texvent

    with texvent.EventCamera(SIZE[::-1]) as camera:
        for index, image in enumerate(frames()):
            camera.step(image, index * 20_000)
    events = texvent.load("clip.h5")
    matplotlib: Any = importlib.import_module("matplotlib")
    matplotlib.use("agg")
    for kind in ("frame", "cloud", "rate"):
        events.plot(kind)


@contextlib.contextmanager
def timed(what: str) -> Iterator[None]:
    """Print how long a step took, s, before what it was."""
    started = time.monotonic()
    yield
    sys.stdout.write(f"{time.monotonic() - started:7.1f} s  {what}\n")
    sys.stdout.flush()


def main() -> int:
    """Exit code 1, with the command, at the first that fails."""
    sys.stdout.write(f"Python {sys.version.split()[0]}: ")
    found = sorted(f"{one.name} {one.version}" for one in metadata.distributions())
    sys.stdout.write(", ".join(found) + "\n")
    import shlex

    from texvent.cli.app import main as texvent

    write_inputs()
    for command in COMMANDS:
        if command.startswith("convert events.parquet"):
            write_others()
        with timed(command):
            code = texvent(shlex.split(command))
        if code:
            sys.stderr.write(f"error: texvent {command} ended with {code}\n")
            return 1
    with timed("EventCamera, plots"):
        use_python()
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
