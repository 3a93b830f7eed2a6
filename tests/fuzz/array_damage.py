"""What happens to NumPy's files and to zip archives: wrong types, lengths and members."""

import io
import os
import pickle
import random
import zipfile
from collections.abc import Callable
from pathlib import Path

import numpy as np

from .byte_damage import BYTE_DAMAGE

CODE_RAN = "code-ran"
"""A pickle of ours makes a folder of this name, if a reader runs it."""
_SHAPES = ("(10,)", "()", "(0,)", "(1000000000000,)", "(-1,)", "(4, 4)", "(2, 0, 3)")
_DTYPES = (
    "'|S0'",
    "'|V0'",
    "'<U0'",
    "'|O'",
    "'<f8'",
    "'|u1'",
    "'<i8'",
    "'?'",
    "'<c16'",
    "'<M8[us]'",
    "'<U4'",
    "[('x', '<u2'), ('y', '<u2'), ('t', '<i8'), ('p', '?')]",
    "[('x', '|S0'), ('y', '|V0'), ('t', '|S0'), ('p', '|V0')]",
    "'nonsense'",
    "[[[[",
)


class _Code:
    def __reduce__(self) -> tuple[Callable[..., object], tuple[str]]:
        return os.mkdir, (CODE_RAN,)


def raw_pickle() -> bytes:
    """A pickle that makes a folder when it is loaded."""
    return pickle.dumps([_Code(), "x" * 50])


def npy_header(descr: str, shape: str, *, extra: str = "") -> bytes:
    """The beginning of a .npy file that claims a type and a shape."""
    text = f"{{'descr': {descr}, 'fortran_order': False, 'shape': {shape}, {extra}}}\n".encode()
    return b"\x93NUMPY\x01\x00" + len(text).to_bytes(2, "little") + text


def hostile_npy(rng: random.Random) -> bytes:
    """A .npy file whose header claims what is not there, or whose header is no header."""
    kind = rng.randrange(4)
    if kind == 0:
        header = npy_header(rng.choice(_DTYPES), rng.choice(_SHAPES))
        return header + bytes(rng.choice((0, 16, 160, 4096)))
    if kind == 1:
        text = rng.choice((b"{'descr': [[[[(((", b"[" * 5000, b"{" * 60_000, b"lambda: 0", b"\0"))
        length = len(text).to_bytes(2, "little")
        return b"\x93NUMPY\x01\x00" + length + text
    if kind == 2:
        return npy_header("'|O'", "(1,)") + raw_pickle()
    return _saved(_wrong_array(rng))


def _wrong_array(rng: random.Random) -> np.ndarray:
    count = rng.choice((0, 1, 12, 40))
    values = np.arange(count)
    return rng.choice(
        (
            values.astype(np.float64) + 0.5,
            np.full(count, np.nan),
            np.full(count, np.inf, np.float32),
            np.full(count, 1e300),
            values - 2**62,
            np.full(count, 2**64 - 1, np.uint64),
            values.astype(np.complex128),
            values.astype("<M8[us]"),
            values.astype("<U3"),
            values.astype("|S3"),
            values.astype(bool),
            np.zeros((count, 2), np.int64),
            np.zeros((count, 0), np.uint8),
            np.float16(3.0) + np.zeros(()),
            np.array("x" * 5000),
            np.zeros(count, [("x", "<u2"), ("t", "<f4")]),
            np.zeros((3, 0, 4), np.uint8),
        )
    )


def _saved(array: np.ndarray) -> bytes:
    buffer = io.BytesIO()
    np.save(buffer, array, allow_pickle=False)
    return buffer.getvalue()


def damage_npy(rng: random.Random, path: Path) -> str:
    """Replace a .npy file."""
    path.write_bytes(hostile_npy(rng))
    return "hostile_npy"


def damage_archive(rng: random.Random, path: Path) -> str:
    """Write the archive anew, with sound checksums, and one member changed."""
    with zipfile.ZipFile(path) as archive:
        members = [(name, archive.read(name)) for name in archive.namelist()]
    index = rng.randrange(len(members))
    name, content = members[index]
    kind = rng.choice(
        ("hostile_npy", "hostile_npy", "text", "empty", "pickle", "damaged", "gone", "more")
    )
    replacement = {
        "hostile_npy": hostile_npy(rng),
        "text": rng.choice((b"hello\n", b"64 48\n", b"x" * 400_000, b"1 2 3 4\n" * 3)),
        "empty": b"",
        "pickle": raw_pickle(),
        "damaged": rng.choice(BYTE_DAMAGE)(rng, content),
        "more": content,
    }
    if kind == "gone":
        del members[index]
    else:
        members[index] = (name, replacement[kind])
    if kind == "more":
        members.append((rng.choice(("../up", "/abs", "a\nb", "x" * 400, "é")), b"x"))
    compression = rng.choice((zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED, zipfile.ZIP_LZMA))
    with zipfile.ZipFile(path, "w", compression) as archive:
        for one, data in members:
            archive.writestr(one, data)
    return f"archive_{kind}"
