"""Fields of motion, depth and ids from files: one file per frame, or one file for all frames."""

from __future__ import annotations

import functools
import glob
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.capture.motion_vectors.exr_image import EXR, read_exr
from texvent.capture.motion_vectors.flow_files import (
    read_depth_png,
    read_flo,
    read_flow_png,
    read_png,
)
from texvent.errors import FileFormatError, InputError, few, shown
from texvent.io.arrays.npy_file import StoredArray
from texvent.io.arrays.npz import NPZ_DAMAGE
from texvent.io.input_checks import begins_with, check_zip, reporting_damage
from texvent.runtime.file_names import natural_key, usable_path

Role: TypeAlias = str
"""Which option named the file (a key of `ROLE_KIND`): what an array without a name holds."""
Fields: TypeAlias = Mapping[str, NDArray[Any]]
"""Kind → array of one frame: "vectors" (the convention says in which direction), "forward",
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
"""Kind → names of arrays in .npz files and of datasets in HDF5 files."""
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
HDF5_EXTENSIONS = (".h5", ".hdf5")
CACHED_FRAMES = 3
"""Frames whose fields are kept: they are read once for vectors, depth and ids."""
FRAME_EXTENSIONS = (EXR, ".flo", ".png", ".npz", ".npy", *HDF5_EXTENSIONS)


@dataclass(frozen=True, eq=False)
class FieldStack:
    """The fields of all frames, read one by one."""

    name: str
    """What to call it in messages."""
    count: int
    """Frames, or pairs of frames, that it has fields of."""
    read: Callable[[int], Fields]
    found: frozenset[str]
    """Kinds of fields that it holds."""
    convention: str | None = None
    """The renderer that wrote it, where the file says so."""
    marks_unknown: bool = False
    """Whether the format has a way to say that a vector is not known."""

    def field(self, kind: str, index: int) -> NDArray[Any]:
        """One field of one frame.

        Raises:
            InputError: the file of this frame lacks what the first one has.
            FileFormatError: it is damaged.
        """
        fields = self.read(index)
        if kind not in fields:
            raise InputError(
                f"{self.name}: the fields of frame {index} lack {kind}, which those of the first "
                "frame have; write all files alike"
            )
        return fields[kind]


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
        return _stack_of_arrays(given, role)
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
    )


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
        fields = {ROLE_KIND[role]: stored.rows(0, _count(stored.shape, str(path)))}
    elif extension == ".npz":
        fields = _read_npz(path, role)
    else:
        stack = _stack_of_hdf5(path, role)
        fields = stack.read(0)
    return _of_role(fields, role, path)


def _of_role(fields: Fields, role: Role, path: Path) -> Fields:
    """What the option asks for: everything for motion, one kind for the others."""
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


def _read_npz(path: Path, role: Role) -> dict[str, NDArray[Any]]:
    with (
        reporting_damage(path, "a NumPy archive", NPZ_DAMAGE),
        np.load(path, allow_pickle=False) as archive,
    ):
        check_zip(path, archive.zip)
        names = _named(list(archive.files), role, path)
        arrays = {kind: archive[name] for kind, name in names.items()}
    if not all(isinstance(one, np.ndarray) for one in arrays.values()):
        raise FileFormatError(f"{path} is damaged: it holds entries that are no arrays")
    return arrays


def _named(names: Sequence[str], role: Role, path: Path) -> dict[str, str]:
    """Kind → name of the array that holds it; a single array holds what the option says."""
    found = {
        kind: name
        for kind, known in NAMES.items()
        for name in names
        if name.rsplit("/")[-1] in known
    }
    if not found and len(names) == 1:
        return {ROLE_KIND[role]: names[0]}
    if not found:
        known = ", ".join(known[0] for known in NAMES.values())
        raise InputError(f"{path} holds {few(names)}; arrays must be called {known}")
    return found


def _stack_of_file(path: Path, role: Role, convention: str | None) -> FieldStack:
    """All frames in one file."""
    extension = path.suffix.lower()
    if extension in HDF5_EXTENSIONS:
        return _stack_of_hdf5(path, role)
    if extension == ".npy":
        stored = StoredArray(path)
        kind = ROLE_KIND[role]
        return FieldStack(
            str(path),
            _count(stored.shape, str(path)),
            lambda index: {kind: stored.rows(index, index + 1)[0]},
            frozenset([kind]),
        )
    if extension == ".npz":
        whole = _of_role(_read_npz(path, role), role, path)
        return _stack_of_mapping(whole, str(path))
    if extension not in FRAME_EXTENSIONS:
        raise InputError(
            f"{path} is no file of motion vectors; known: {', '.join(FRAME_EXTENSIONS)}, or a "
            "folder of them"
        )
    raise InputError(f"{path} is the field of one frame; give a folder of them, or a pattern")


@contextmanager
def _hdf5(path: Path) -> Iterator[Any]:
    from texvent.io.hdf5.damage import open_hdf5  # brings h5py

    if not begins_with(path, b"\x89HDF"):
        raise FileFormatError(f"{path} is no HDF5 file")
    with open_hdf5(path) as file:
        yield file


def _stack_of_hdf5(path: Path, role: Role) -> FieldStack:
    from texvent.io.hdf5.damage import check_claims, check_filters

    names: list[str] = []
    with _hdf5(path) as file:
        file.visititems(
            lambda name, item: names.append(name) if getattr(item, "ndim", 0) >= 2 else None
        )
        found = _named(names, role, path)
        for name in found.values():
            check_claims(file[name], path)
            check_filters(file[name], path)
        counts = {name: len(file[name]) for name in found.values()}
    wanted = _of_role(dict.fromkeys(found, np.empty(0)), role, path)
    sources = {kind: found.get(kind, found.get("vectors", "")) for kind in wanted}

    def read(index: int) -> Fields:
        with _hdf5(path) as file:
            return {kind: np.asarray(file[name][index]) for kind, name in sources.items()}

    count = _one_count({name: counts[name] for name in sources.values()}, str(path))
    return FieldStack(str(path), count, read, frozenset(sources))


def _stack_of_arrays(given: Any, role: Role) -> FieldStack:
    if not hasattr(given, "__len__") or isinstance(given, Mapping):
        raise InputError(
            f"{role}: {shown(given)} is no field of motion; give a path, an array [N, H, W, 2] or "
            "a list of N arrays"
        )
    kind = ROLE_KIND[role]
    return FieldStack(
        role, len(given), lambda index: {kind: np.asarray(given[index])}, frozenset([kind])
    )


def _stack_of_mapping(arrays: Fields, name: str) -> FieldStack:
    count = _one_count({kind: _count(one.shape, name) for kind, one in arrays.items()}, name)
    return FieldStack(
        name,
        count,
        lambda index: {kind: array[index] for kind, array in arrays.items()},
        frozenset(arrays),
    )


def _count(shape: tuple[int, ...], name: str) -> int:
    """The length of the first axis."""
    if not shape:
        raise InputError(f"{name} holds a single number; fields are arrays [N, H, W, ...]")
    return shape[0]


def _one_count(counts: Mapping[str, int], name: str) -> int:
    if len(set(counts.values())) > 1:
        said = ", ".join(f"{kind} {count}" for kind, count in counts.items())
        raise InputError(f"{name} holds fields of different numbers of frames ({said})")
    return next(iter(counts.values()))


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
