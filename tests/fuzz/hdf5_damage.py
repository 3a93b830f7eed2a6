"""What happens to HDF5: sound files whose objects are of another kind, type, shape or length."""

from __future__ import annotations

import random
from pathlib import Path
from typing import Any

import h5py
import numpy as np


def damage_hdf5(rng: random.Random, path: Path) -> str:
    """Replace one object or attribute."""
    with h5py.File(path, "r+") as file:
        names: list[str] = []
        file.visit(names.append)
        attributes = [(one, key) for one in ["/", *names] for key in file[one].attrs]
        if attributes and rng.random() < 0.35:
            node, key = rng.choice(attributes)
            file[node].attrs[key] = _hostile_value(rng)
            return "hdf5_attribute"
        name = rng.choice(names)
        old = file[name]
        shape = old.shape if isinstance(old, h5py.Dataset) else (3,)
        del old
        del file[name]
        kind, make = rng.choice(_REPLACEMENTS)
        make(rng, file, name, shape)
    return f"hdf5_{kind}"


def _hostile_value(rng: random.Random) -> Any:
    return rng.choice(
        (
            "text",
            "x" * 5000,
            b"\xff\xfe",
            -1,
            0,
            2**63 - 1,
            np.uint64(2**64 - 1),
            1.5,
            float("nan"),
            float("inf"),
            [1, 2, 3],
            np.zeros((2, 2)),
            np.zeros(3, [("a", "<i4"), ("b", "<f8")]),
            1j,
            h5py.Empty("f8"),
            h5py.Empty("S10"),
            '{"a": ' * 3000,
            "[1, 2]",
            True,
        )
    )


def _gone(rng: random.Random, file: Any, name: str, shape: Any) -> None:
    del rng, file, name, shape


def _group(rng: random.Random, file: Any, name: str, shape: Any) -> None:
    del rng, shape
    file.create_group(name)


def _scalar(rng: random.Random, file: Any, name: str, shape: Any) -> None:
    del shape
    file[name] = _hostile_value(rng)


def _other_type(rng: random.Random, file: Any, name: str, shape: Any) -> None:
    kind = rng.choice(("f8", "f2", "S4", "c16", "?", "u8", "i1", h5py.ref_dtype, "S1"))
    file.create_dataset(name, shape, dtype=kind)


def _text(rng: random.Random, file: Any, name: str, shape: Any) -> None:
    del rng
    file.create_dataset(name, shape, dtype=h5py.string_dtype())


def _ragged(rng: random.Random, file: Any, name: str, shape: Any) -> None:
    del rng
    file.create_dataset(name, shape, dtype=h5py.vlen_dtype(np.int32))


def _other_shape(rng: random.Random, file: Any, name: str, shape: Any) -> None:
    del shape
    other = rng.choice(((), (0,), (0, 4), (7,), (5, 4), (2, 3, 4), (1,)))
    file.create_dataset(name, other, dtype=rng.choice(("u2", "i8", "u4")))


def _huge(rng: random.Random, file: Any, name: str, shape: Any) -> None:
    wide = len(shape) > 1
    count = rng.choice((10**9, 10**12, 2**60))
    big = (count, *shape[1:]) if wide else (count,)
    chunks = tuple(min(one, 4096) for one in big)
    file.create_dataset(name, big, dtype="u4", chunks=chunks, compression="gzip")


def _huge_plain(rng: random.Random, file: Any, name: str, shape: Any) -> None:
    del rng, shape
    file.create_dataset(name, (10**9,), dtype="u2", chunks=(10**6,))


def _dangling(rng: random.Random, file: Any, name: str, shape: Any) -> None:
    del rng, shape
    file[name] = h5py.SoftLink("/nowhere")


def _cycle(rng: random.Random, file: Any, name: str, shape: Any) -> None:
    del rng, shape
    file[name] = h5py.SoftLink(f"/{name}")


def _elsewhere(rng: random.Random, file: Any, name: str, shape: Any) -> None:
    del shape
    other = rng.choice(("/dev/zero", "nowhere.h5", "/etc/passwd"))
    file[name] = h5py.ExternalLink(other, "/x")


def _values(rng: random.Random, file: Any, name: str, shape: Any) -> None:
    values = np.full(shape, rng.choice((0, 1, 2**16 - 1, 2**31, 2**62)), np.uint64)
    file[name] = values


_REPLACEMENTS = (
    ("gone", _gone),
    ("group", _group),
    ("scalar", _scalar),
    ("type", _other_type),
    ("type", _other_type),
    ("text", _text),
    ("ragged", _ragged),
    ("shape", _other_shape),
    ("shape", _other_shape),
    ("huge", _huge),
    ("huge", _huge_plain),
    ("dangling", _dangling),
    ("cycle", _cycle),
    ("elsewhere", _elsewhere),
    ("values", _values),
)
