"""Fields of motion, depth and ids from files: one file per frame, or one file for all frames."""

from __future__ import annotations

import functools
import glob
import itertools
import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.capture.motion_vectors.array_files import (
    HDF5_EXTENSIONS,
    of_role,
    read_npz,
    stack_of_hdf5,
)
from texvent.capture.motion_vectors.exr_image import EXR, read_exr
from texvent.capture.motion_vectors.flow_files import (
    read_depth_png,
    read_flo,
    read_flow_png,
    read_png,
)
from texvent.capture.motion_vectors.stack import (
    ROLE_KIND,
    Fields,
    FieldStack,
    Role,
    count_of,
    stack_of_arrays,
    stack_of_mapping,
)
from texvent.errors import FileFormatError, InputError, few
from texvent.io.arrays.npy_file import StoredArray
from texvent.runtime.file_names import natural_key, usable_path

EXR_CHANNELS: Mapping[str, tuple[tuple[str, ...], ...]] = {
    "blender": (("Vector.X", "Vector.Y", "Vector.Z", "Vector.W"),),
    "unreal": (
        (
            "FinalImageMovieRenderQueue_MotionVectors.R",
            "FinalImageMovieRenderQueue_MotionVectors.G",
        ),
    ),
    "depth": (
        ("Depth.Z",),
        ("Depth.V",),
        ("depth.Z",),
        ("Z",),
        ("FinalImageMovieRenderQueue_WorldDepth.R",),
    ),
    "instances": (("Object Index.X",), ("IndexOB.X",)),
}
"""What is in an EXR file → the channels that hold it, the first that are there."""
CACHED_FRAMES = 3
"""Frames whose fields are kept: they are read once for vectors, depth and ids."""
FRAME_EXTENSIONS = (EXR, ".flo", ".png", ".npz", ".npy", *HDF5_EXTENSIONS)


def open_fields(given: Any, role: Role, convention: str | None) -> FieldStack:
    """Fields of a folder, a file, a pattern such as `out/flow_*.npy`, or of arrays.

    Args:
        given: a path; or an array [N, h, w, ...] or a sequence of N arrays.
        role: what it is given as.
        convention: name of the renderer or data set that was given, or None.

    Raises:
        InputError: there is nothing there, or nothing of this role in it.
        FileFormatError: a file is damaged.
    """
    if not isinstance(given, str | Path):
        return stack_of_arrays(given, role)
    stack = _open_path(given, role, convention)
    # One file may hold all kinds of fields of a frame, which are asked for one by one.
    return replace(stack, read=functools.lru_cache(maxsize=CACHED_FRAMES)(stack.read))


def _open_path(given: str | Path, role: Role, convention: str | None) -> FieldStack:
    path = usable_path(usable_path(given).expanduser())
    if path.is_dir():
        files = _files_of_folder(path)
    elif path.is_file():
        files = [path]
    else:
        files = sorted(map(Path, glob.glob(str(path))), key=natural_key)
        if not files:
            raise InputError(
                f"--{role.replace('_', '-')}: no file or folder {path}; check its name"
            )
    if len(files) == 1:
        return _stack_of_file(files[0], role, convention)
    first = read_file(files[0], role, convention)
    return FieldStack(
        str(given),
        len(files),
        lambda index: read_file(files[index], role, convention),
        frozenset(first),
        written_by(files[0]),
        files[0].suffix.lower() in (".flo", ".png"),
        _gap(files),
    )


def _gap(files: Sequence[Path]) -> str | None:
    """Between which numbered files one is missing: all steps are equal, but a few are longer."""
    numbers = [int(found[-1]) for one in files if (found := re.findall(r"\d+", one.stem))]
    if len(numbers) != len(files):
        return None
    steps = [second - first for first, second in itertools.pairwise(numbers)]
    usual = min(steps)
    longer = [index for index, step in enumerate(steps) if step != usual]
    is_gap = usual > 0 and all(steps[index] % usual == 0 for index in longer)
    if not longer or not is_gap or len(longer) > len(steps) // 4 + 1:
        return None
    return f"{files[longer[0]].name} and {files[longer[0] + 1].name}"


def read_file(path: Path, role: Role, convention: str | None) -> Fields:
    """The fields of one frame in a file of its own.

    Raises:
        InputError: there is nothing of this role in it, or what it means is not said.
        FileFormatError: it is damaged.
    """
    extension = path.suffix.lower()
    fields: Fields
    if extension == EXR:
        fields = _read_exr(path)
    elif extension == ".flo":
        fields = {"vectors": read_flo(path)}
    elif extension == ".png":
        fields = _read_png(path, role, convention)
    elif extension == ".npy":
        stored = StoredArray(path)
        fields = {ROLE_KIND[role]: stored.rows(0, count_of(stored.shape, str(path)))}
    elif extension == ".npz":
        fields = read_npz(path, role)
    else:
        stack = stack_of_hdf5(path, role)
        fields = stack.read(0)
    return of_role(fields, role, path)


def _read_exr(path: Path) -> dict[str, NDArray[Any]]:
    image = read_exr(path)
    found: dict[str, NDArray[Any]] = {}
    for kind, choices in EXR_CHANNELS.items():
        for names in choices:
            channels = image.find(*names)
            if channels:
                found[kind] = np.stack([channels[name] for name in names], axis=-1)
                break
    blender, unreal = found.pop("blender", None), found.pop("unreal", None)
    if blender is not None:
        found["backward"], found["forward"] = blender[..., :2], blender[..., 2:]
    if unreal is not None:
        found["vectors"] = unreal
    if not found:
        raise InputError(
            f"{path} has no pass that is known (Vector, Depth, Object Index; Movie Render Queue's "
            f"MotionVectors); its channels: {few(sorted(image.channels))}"
        )
    return {
        kind: field[..., 0] if kind in ("depth", "instances") else field
        for kind, field in found.items()
    }


def written_by(path: Path) -> str | None:
    """The renderer whose channels an EXR file has."""
    if path.suffix.lower() != EXR:
        return None
    image = read_exr(path)
    return next(
        (name for name in ("blender", "unreal") if image.find(*EXR_CHANNELS[name][0])), None
    )


def _read_png(path: Path, role: Role, convention: str | None) -> dict[str, NDArray[Any]]:
    if role == "depth":
        return {"depth": read_depth_png(path, convention)}
    if role == "instances":
        ids = read_png(path)
        if ids.ndim != 2:
            raise FileFormatError(f"{path} is a colour image; ids are one channel of 8 or 16 bits")
        return {"instances": ids}
    return {ROLE_KIND[role]: read_flow_png(path, convention)}


def _stack_of_file(path: Path, role: Role, convention: str | None) -> FieldStack:
    """All frames in one file."""
    extension = path.suffix.lower()
    if extension in HDF5_EXTENSIONS:
        return stack_of_hdf5(path, role)
    if extension == ".npy":
        stored = StoredArray(path)
        kind = ROLE_KIND[role]
        return FieldStack(
            str(path),
            count_of(stored.shape, str(path)),
            lambda index: {kind: stored.rows(index, index + 1)[0]},
            frozenset([kind]),
        )
    if extension == ".npz":
        whole = of_role(read_npz(path, role), role, path)
        return stack_of_mapping(whole, str(path))
    if extension not in FRAME_EXTENSIONS:
        raise InputError(
            f"{path} is no file of motion vectors; known: {', '.join(FRAME_EXTENSIONS)}, or a "
            "folder of them"
        )
    raise InputError(f"{path} is the field of one frame; give a folder of them, or a pattern")


def _files_of_folder(folder: Path) -> list[Path]:
    """The files of one format in a folder, in natural order."""
    files = [
        one
        for one in folder.iterdir()
        if one.suffix.lower() in FRAME_EXTENSIONS and not one.name.startswith(".") and one.is_file()
    ]
    extensions = sorted({one.suffix.lower() for one in files})
    if not files:
        raise InputError(
            f"{folder} holds no file of motion vectors, depth or ids; looked for "
            f"{', '.join(FRAME_EXTENSIONS)}"
        )
    if len(extensions) > 1:
        raise InputError(
            f"{folder} holds {' and '.join(extensions)} files; name those that are meant, such as "
            f"'{folder}/*{extensions[0]}'"
        )
    return sorted(files, key=natural_key)
