"""Fields of motion, depth and ids: NumPy files, OpenEXR, images of depth and ids, arrays in memory.

One file per frame, or one file for all frames.
"""

from __future__ import annotations

import functools
import glob
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.capture.exr_image import EXR, read_exr
from texvent.errors import FileFormatError, InputError, few, shown
from texvent.io.arrays.npy_file import StoredArray
from texvent.io.arrays.npz import NPZ_DAMAGE
from texvent.io.input_checks import check_zip, reporting_damage
from texvent.options.arrays import as_array
from texvent.runtime.files.file_names import in_natural_order, numbering_gap, usable_path

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
        """One field of one frame; half floats, whose products overflow, as float32.

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
        field = fields[kind]
        return field.astype(np.float32) if field.dtype == np.float16 else field


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
    files = _find_files(given, role)
    if len(files) == 1:
        return _stack_of_file(files[0], role)
    # One file may hold all kinds of fields of a frame, which are asked for one by one.
    read = functools.lru_cache(CACHED_FRAMES)(lambda index: read_file(files[index], role))
    found = frozenset(read_file(files[0], role))
    gap = numbering_gap(files)
    return FieldStack(str(given), len(files), read, found, written_by(files[0]), gap)


def _find_files(given: str | Path, role: Role) -> list[Path]:
    """The file itself, those that a pattern matches, or those of a folder; in natural order."""
    path = usable_path(usable_path(given).expanduser())
    if path.is_dir():
        files = [
            one
            for one in path.iterdir()
            if one.suffix.lower() in FRAME_EXTENSIONS and one.name[0] != "." and one.is_file()
        ]
        if not files:
            raise InputError(
                f"{path} holds no file of motion vectors, depth or ids; looked for "
                f"{', '.join(FRAME_EXTENSIONS)}"
            )
    else:
        files = [path] if path.is_file() else [*map(Path, glob.glob(str(path)))]
    if not files:
        raise InputError(f"--{role.replace('_', '-')}: no file or folder {path}; check its name")
    extensions = sorted({one.suffix.lower() for one in files})
    if len(extensions) > 1:
        raise InputError(
            f"{path} holds {' and '.join(extensions)} files; name those that are meant, such as "
            f"'{path}/*{extensions[0]}'"
        )
    if extensions[0] not in FRAME_EXTENSIONS:
        raise InputError(
            f"{files[0]} is no file of motion vectors, depth or ids; known: "
            f"{', '.join(FRAME_EXTENSIONS)}, or a folder of them"
        )
    return in_natural_order(files)


def _stack_of_file(path: Path, role: Role) -> FieldStack:
    """All frames in one file."""
    if path.suffix.lower() not in (".npy", ".npz"):
        raise InputError(f"{path} is the field of one frame; give a folder of them, or a pattern")
    whole = _of_role(_read_arrays(path, role), role, path)
    counts = {kind: len(array) for kind, array in whole.items()}
    if len(set(counts.values())) > 1:
        words = ", ".join(f"{kind} {count}" for kind, count in counts.items())
        raise InputError(f"{path} holds fields of different numbers of frames ({words})")
    return FieldStack(
        str(path),
        next(iter(counts.values())),
        lambda index: {kind: array[index : index + 1][0] for kind, array in whole.items()},
        frozenset(whole),
    )


def _stack_of_arrays(given: Any, role: Role) -> FieldStack:
    """Fields in memory: an array [N, ...] or a sequence of N arrays."""
    if not hasattr(given, "__len__") or isinstance(given, Mapping):
        raise InputError(
            f"{role}: {shown(given)} is no field of motion; give a path, an array [N, H, W, 2] or "
            "a list of N arrays"
        )
    kind = ROLE_KIND[role]
    return FieldStack(
        role, len(given), lambda index: {kind: as_array(given[index], role)}, frozenset([kind])
    )


def read_file(path: Path, role: Role) -> Fields:
    """The fields of one frame in a file of its own.

    Raises:
        InputError: it holds nothing of this role.
        FileFormatError: it is damaged.
    """
    extension = path.suffix.lower()
    if extension == EXR:
        return _of_role(_read_exr(path), role, path)
    if extension == PNG:
        return _of_role(_read_png(path, role), role, path)
    arrays = _of_role(_read_arrays(path, role), role, path)
    return {kind: array[: len(array)] for kind, array in arrays.items()}


def _of_role(fields: Mapping[str, Any], role: Role, path: Path) -> dict[str, Any]:
    """All fields for motion, one kind for the other options."""
    vectors = {"vectors", "forward", "backward"} & fields.keys()
    if role == "motion" and vectors:
        return dict(fields)
    back = [name for name in ("backward", "vectors") if name in vectors]
    if role == "motion_back" and back:
        return {"backward": fields[back[0]]}
    if role in fields:
        return {role: fields[role]}
    others = ", ".join(fields) or "nothing else"
    raise InputError(f"{path} has no {role.replace('_', ' ')}; it holds {others}")


def _read_arrays(path: Path, role: Role) -> dict[str, StoredArray | NDArray[Any]]:
    """The arrays of a .npy file or a NumPy archive by kind; a single one is of the role's kind."""
    arrays: dict[str, StoredArray | NDArray[Any]]
    arrays = (
        {ROLE_KIND[role]: StoredArray(path)}
        if path.suffix.lower() == ".npy"
        else dict(_read_npz(path, role))
    )
    if not all(array.ndim for array in arrays.values()):
        raise InputError(f"{path} holds a single number; fields are arrays [N, H, W, ...]")
    return arrays


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
