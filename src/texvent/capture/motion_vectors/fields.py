"""Fields of motion, depth and ids: NumPy files, OpenEXR, images of depth and ids, arrays in memory.

One file per frame, or one file for all frames.
"""

from __future__ import annotations

import functools
import glob
import itertools
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.capture.motion_vectors.exr_image import EXR, read_exr
from texvent.errors import FileFormatError, InputError, few, shown
from texvent.io.arrays.npy_file import StoredArray
from texvent.io.arrays.npz import NPZ_DAMAGE
from texvent.io.input_checks import check_zip, reporting_damage
from texvent.runtime.file_names import natural_key, usable_path

Role: TypeAlias = str
"""Option that named the file (a key of `ROLE_KIND`): the meaning of an array without a name."""
Fields: TypeAlias = Mapping[str, NDArray[Any]]
"""Kind → array of one frame: "vectors" (their direction follows from the convention), "forward",
"backward" ([h, w, 2 or more]), "depth" and "instances" ([h, w])."""
ROLE_KIND: Mapping[str, str] = {
    "motion": "vectors",
    "motion_back": "backward",
    "depth": "depth",
    "instances": "instances",
}
NAMES: Mapping[str, tuple[str, ...]] = {
    "vectors": ("flow", "vectors", "motion_vectors", "optical_flow"),
    "forward": ("forward", "flow_forward", "forward_flow"),
    "backward": ("backward", "flow_back", "flow_backward", "backward_flow"),
    "depth": ("depth", "distance_to_image_plane"),
    "instances": ("instances", "instance", "ids", "instance_id"),
}
"""Kind → names of arrays in .npz files."""
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
"""Kind or renderer → its channels in an EXR file; the first that are there count."""
PNG = ".png"
FRAME_EXTENSIONS = (EXR, ".npz", ".npy", PNG)
CACHED_FRAMES = 3
"""Frames whose fields are kept: they are read once for vectors, depth and ids."""


@dataclass(frozen=True, eq=False)
class FieldStack:
    """The fields of all frames, read one by one."""

    name: str
    """Name in messages."""
    count: int
    """Number of frames, or of pairs of frames, with fields."""
    read: Callable[[int], Fields]
    found: frozenset[str]
    """Kinds of fields that it holds."""
    convention: str | None = None
    """The renderer that wrote it, where the file states it."""
    gap: str | None = None
    """The two files between which a number is missing, if one is."""

    def field(self, kind: str, index: int) -> NDArray[Any]:
        """One field of one frame.

        Raises:
            InputError: the file of this frame lacks a kind that the first one has.
            FileFormatError: it is damaged.
        """
        fields = self.read(index)
        if kind not in fields:
            raise InputError(
                f"{self.name}: the fields of frame {index} lack {kind}, which those of the first "
                "frame have; write all files alike"
            )
        return fields[kind]


def open_fields(given: Any, role: Role) -> FieldStack:
    """Fields of a folder, a file, a pattern such as `out/flow_*.npy`, or of arrays.

    Args:
        given: a path; or an array [N, h, w, ...] or a sequence of N arrays.
        role: the option that names it.

    Raises:
        InputError: nothing is found there, or nothing of this role in it.
        FileFormatError: a file is damaged.
    """
    if not isinstance(given, str | Path):
        return _stack_of_arrays(given, role)
    stack = _open_path(given, role)
    # One file may hold all kinds of fields of a frame, which are asked for one by one.
    return replace(stack, read=functools.lru_cache(maxsize=CACHED_FRAMES)(stack.read))


def _open_path(given: str | Path, role: Role) -> FieldStack:
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
        return _stack_of_file(files[0], role)
    first = read_file(files[0], role)
    return FieldStack(
        str(given),
        len(files),
        lambda index: read_file(files[index], role),
        frozenset(first),
        written_by(files[0]),
        _gap(files),
    )


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


def _gap(files: Sequence[Path]) -> str | None:
    """Two numbered files between which one is missing: all steps equal, but a few longer."""
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


def _stack_of_file(path: Path, role: Role) -> FieldStack:
    """All frames in one file."""
    extension = path.suffix.lower()
    if extension == ".npy":
        stored = StoredArray(path)
        count = _count({ROLE_KIND[role]: stored.shape}, str(path))
        return FieldStack(
            str(path),
            count,
            lambda index: {ROLE_KIND[role]: stored.rows(index, index + 1)[0]},
            frozenset([ROLE_KIND[role]]),
        )
    if extension == ".npz":
        whole = _of_role(_read_npz(path, role), role, path)
        count = _count({kind: one.shape for kind, one in whole.items()}, str(path))
        return FieldStack(
            str(path),
            count,
            lambda index: {kind: array[index] for kind, array in whole.items()},
            frozenset(whole),
        )
    _check_extension(path)
    raise InputError(f"{path} is the field of one frame; give a folder of them, or a pattern")


def _stack_of_arrays(given: Any, role: Role) -> FieldStack:
    """Fields in memory: an array [N, ...] or a sequence of N arrays."""
    if not hasattr(given, "__len__") or isinstance(given, Mapping):
        raise InputError(
            f"{role}: {shown(given)} is no field of motion; give a path, an array [N, H, W, 2] or "
            "a list of N arrays"
        )
    kind = ROLE_KIND[role]
    return FieldStack(
        role, len(given), lambda index: {kind: np.asarray(given[index])}, frozenset([kind])
    )


def _count(shapes: Mapping[str, tuple[int, ...]], name: str) -> int:
    """The number of frames that all arrays of a file have."""
    if not all(shapes.values()):
        raise InputError(f"{name} holds a single number; fields are arrays [N, H, W, ...]")
    if len({shape[0] for shape in shapes.values()}) > 1:
        counts = ", ".join(f"{kind} {shape[0]}" for kind, shape in shapes.items())
        raise InputError(f"{name} holds fields of different numbers of frames ({counts})")
    return next(iter(shapes.values()))[0]


def read_file(path: Path, role: Role) -> Fields:
    """The fields of one frame in a file of its own.

    Raises:
        InputError: it holds nothing of this role.
        FileFormatError: it is damaged.
    """
    extension = path.suffix.lower()
    fields: Fields
    if extension == EXR:
        fields = _read_exr(path)
    elif extension == PNG:
        fields = _read_png(path, role)
    elif extension == ".npy":
        stored = StoredArray(path)
        _count({role: stored.shape}, str(path))
        fields = {ROLE_KIND[role]: stored.rows(0, len(stored))}
    else:
        _check_extension(path)
        fields = _read_npz(path, role)
    return _of_role(fields, role, path)


def _check_extension(path: Path) -> None:
    if path.suffix.lower() not in FRAME_EXTENSIONS:
        raise InputError(
            f"{path} is no file of motion vectors, depth or ids; known: "
            f"{', '.join(FRAME_EXTENSIONS)}, or a folder of them"
        )


def _of_role(fields: Fields, role: Role, path: Path) -> Fields:
    """All fields for motion, one kind for the other options."""
    if role == "motion":
        found = dict(fields)
        has_motion = {"vectors", "forward", "backward"} & found.keys()
    elif role == "motion_back":
        has_motion = {"vectors", "backward"} & fields.keys()
        found = {"backward": fields[next(iter(has_motion))]} if has_motion else {}
    else:
        found = {role: fields[role]} if role in fields else {}
        has_motion = set(found)
    if not has_motion:
        others = ", ".join(fields) or "nothing else"
        raise InputError(f"{path} has no {role.replace('_', ' ')}; it holds {others}")
    return found


def _read_npz(path: Path, role: Role) -> dict[str, NDArray[Any]]:
    """The arrays of a NumPy archive by kind; a single array is of the role's kind."""
    with (
        reporting_damage(path, "a NumPy archive", NPZ_DAMAGE),
        np.load(path, allow_pickle=False) as archive,
    ):
        check_zip(path, archive.zip)
        kinds = {name: kind for kind, known in NAMES.items() for name in known}
        names = {kinds[name]: name for name in archive.files if name in kinds}
        if not names and len(archive.files) == 1:
            names = {ROLE_KIND[role]: archive.files[0]}
        if not names:
            known = ", ".join(known[0] for known in NAMES.values())
            raise InputError(f"{path} holds {few(archive.files)}; arrays must be called {known}")
        arrays = {kind: archive[name] for kind, name in names.items()}
    if not all(isinstance(one, np.ndarray) for one in arrays.values()):
        raise FileFormatError(f"{path} is damaged: it holds entries that are no arrays")
    return arrays


def _read_png(path: Path, role: Role) -> dict[str, NDArray[Any]]:
    """Depth or ids in an image of one channel of 8 or 16 bits."""
    from texvent.capture.image_folder import read_image

    if role not in ("depth", "instances"):
        raise InputError(f"{path} is an image; vectors are read from {EXR}, .npy and .npz")
    image = read_image(path)
    if image.ndim != 2:
        raise FileFormatError(
            f"{path} is a colour image; {role} is one channel of 8 or 16 bits, or an array"
        )
    return {role: image}


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
