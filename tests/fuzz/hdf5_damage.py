"""What happens to HDF5: sound files whose objects are of another kind, type, shape or length."""

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


def _dataset(*kinds: Any) -> Any:
    """A dataset of the old shape, of one of several types."""
    return lambda rng, file, name, shape: file.create_dataset(name, shape, dtype=rng.choice(kinds))


def _other_shape(rng: random.Random, file: Any, name: str, shape: Any) -> None:
    del shape
    other = rng.choice(((), (0,), (0, 4), (7,), (5, 4), (2, 3, 4), (1,)))
    file.create_dataset(name, other, dtype=rng.choice(("u2", "i8", "u4")))


def _huge(rng: random.Random, file: Any, name: str, shape: Any) -> None:
    """More rows than there is memory, stored in no bytes."""
    big = (rng.choice((10**9, 10**12, 2**60)), *shape[1:])
    chunks = tuple(min(one, 4096) for one in big)
    file.create_dataset(name, big, dtype=rng.choice(("u2", "u4")), chunks=chunks)


def _link(*links: Any) -> Any:
    def put(rng: random.Random, file: Any, name: str, shape: Any) -> None:
        del shape
        file[name] = rng.choice(links or (h5py.SoftLink(f"/{name}"),))

    return put


def _values(rng: random.Random, file: Any, name: str, shape: Any) -> None:
    file[name] = np.full(shape, rng.choice((0, 1, 2**16 - 1, 2**31, 2**62)), np.uint64)


_TYPES = ("f8", "f2", "S4", "c16", "?", "u8", "i1", h5py.ref_dtype, "S1")
_ELSEWHERE = [h5py.ExternalLink(one, "/x") for one in ("/dev/zero", "nowhere.h5", "/etc/passwd")]
_REPLACEMENTS = (
    ("gone", lambda rng, file, name, shape: None),
    ("group", lambda rng, file, name, shape: file.create_group(name)),
    ("scalar", lambda rng, file, name, shape: file.create_dataset(name, data=_hostile_value(rng))),
    ("type", _dataset(*_TYPES)),
    ("type", _dataset(*_TYPES)),
    ("text", _dataset(h5py.string_dtype())),
    ("ragged", _dataset(h5py.vlen_dtype(np.int32))),
    ("shape", _other_shape),
    ("shape", _other_shape),
    ("huge", _huge),
    ("huge", _huge),
    ("dangling", _link(h5py.SoftLink("/nowhere"))),
    ("cycle", _link()),
    ("elsewhere", _link(*_ELSEWHERE)),
    ("values", _values),
)
