"""Damage one file of an input; which damage follows from the number alone."""

import gzip
import random
import zipfile
import zlib
from pathlib import Path

import h5py

from .array_damage import damage_archive, damage_npy, raw_pickle
from .byte_damage import BYTE_DAMAGE, nudge_byte
from .hdf5_damage import damage_hdf5
from .text_damage import TEXT_DAMAGE, nudge_number, yaml_bomb

TEXT = frozenset((".json", ".jsonl", ".toml", ".yaml", ".yml", ".csv", ".txt"))
ARCHIVES = frozenset((".npz", ".zip"))
HDF5 = frozenset((".h5", ".hdf5"))


def damage_input(rng: random.Random, folder: Path) -> str:
    """Damage one file below a folder; returns what was done, for the report."""
    path = rng.choice(sorted(one for one in folder.rglob("*") if one.is_file()))
    return f"{path.name}: {_damage_file(rng, path)}"


def nudge_input(rng: random.Random, folder: Path) -> str:
    """Change one number or byte of a file a little, as bounds are met; returns what was done."""
    path = rng.choice(sorted(one for one in folder.rglob("*") if one.is_file()))
    nudge = nudge_number if path.suffix.lower() in TEXT else nudge_byte
    path.write_bytes(nudge(rng, path.read_bytes()))
    return f"{path.name}: {nudge.__name__}"


def _damage_file(rng: random.Random, path: Path) -> str:
    suffix = path.suffix.lower()
    if rng.random() < 0.02:
        path.write_bytes(rng.choice((b"", b"\0", raw_pickle(), b"PK\x05\x06" + bytes(18))))
        return "replaced"
    # Text is damaged as text, containers from inside; a third of each as plain bytes.
    if rng.random() < 0.67:
        if suffix in (".yaml", ".yml") and rng.random() < 0.1:
            path.write_bytes(yaml_bomb(rng, b""))
            return "yaml_bomb"
        if suffix in TEXT:
            damage = rng.choice(TEXT_DAMAGE)
            path.write_bytes(damage(rng, path.read_bytes()))
            return damage.__name__
        if suffix in ARCHIVES and zipfile.is_zipfile(path):
            return damage_archive(rng, path)
        if suffix in HDF5 and h5py.is_hdf5(path):
            return damage_hdf5(rng, path)
        if suffix == ".npy":
            return damage_npy(rng, path)
        if suffix == ".gz":
            damage = rng.choice(TEXT_DAMAGE)
            path.write_bytes(gzip.compress(damage(rng, gzip.decompress(path.read_bytes()))))
            return f"inside_{damage.__name__}"
        if suffix == ".png" and rng.random() < 0.4:
            return _resize_png(rng, path)
    damage = rng.choice(BYTE_DAMAGE)
    path.write_bytes(damage(rng, path.read_bytes()))
    return damage.__name__


def _resize_png(rng: random.Random, path: Path) -> str:
    """State another size, type or depth in the header, with a sound checksum."""
    content = bytearray(path.read_bytes())
    sides = (0, 1, 60_000, 2**20, 2**31 - 1)
    content[16:24] = b"".join(rng.choice(sides).to_bytes(4, "big") for _ in range(2))
    if rng.random() < 0.3:
        content[24:26] = rng.randbytes(2)
    content[29:33] = zlib.crc32(content[12:29]).to_bytes(4, "big")
    path.write_bytes(content)
    return "resized_png"
