"""Fields of motion in .npz and HDF5 files, whose arrays have names."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.capture.motion_vectors.stack import (
    NAMES,
    ROLE_KIND,
    Fields,
    FieldStack,
    Role,
    one_count,
)
from texvent.errors import FileFormatError, InputError, few
from texvent.io.arrays.npz import NPZ_DAMAGE
from texvent.io.input_checks import begins_with, check_zip, reporting_damage

HDF5_EXTENSIONS = (".h5", ".hdf5")


def of_role(fields: Fields, role: Role, path: Path) -> Fields:
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


def read_npz(path: Path, role: Role) -> dict[str, NDArray[Any]]:
    """The arrays of a NumPy archive, by what they hold.

    Raises:
        FileFormatError: it is damaged.
        InputError: no array has a name that is known.
    """
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


@contextmanager
def _hdf5(path: Path) -> Iterator[Any]:
    from texvent.io.hdf5.storage import open_hdf5  # brings h5py

    if not begins_with(path, b"\x89HDF"):
        raise FileFormatError(f"{path} is no HDF5 file")
    with open_hdf5(path) as file:
        yield file


def stack_of_hdf5(path: Path, role: Role) -> FieldStack:
    """The fields of all frames in an HDF5 file, read one by one; errors as `read_npz`."""
    from texvent.io.hdf5.storage import check_claims, check_filters

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
    wanted = of_role(dict.fromkeys(found, np.empty(0)), role, path)
    sources = {kind: found.get(kind, found.get("vectors", "")) for kind in wanted}

    def read(index: int) -> Fields:
        with _hdf5(path) as file:
            return {kind: np.asarray(file[name][index]) for kind, name in sources.items()}

    count = one_count({name: counts[name] for name in sources.values()}, str(path))
    return FieldStack(str(path), count, read, frozenset(sources))
