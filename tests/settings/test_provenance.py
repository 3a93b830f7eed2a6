"""A source that was changed is told from one that was only touched."""

import itertools
import os
from collections.abc import Callable
from pathlib import Path

import pytest

from texvent.settings import provenance
from texvent.settings.provenance import describe_state, fingerprint, is_replaced

NAMES = ("0.png", "1.png", "2.png")


def grow(path: Path) -> None:
    path.write_bytes(path.read_bytes() + b"more")


def alter(path: Path, place: int) -> None:
    content = bytearray(path.read_bytes())
    content[place] ^= 1
    path.write_bytes(content)
    os.utime(path, ns=(1, path.stat().st_mtime_ns + 1))


def begin_otherwise(path: Path) -> None:
    alter(path, 0)


def end_otherwise(path: Path) -> None:
    alter(path, -1)


def rename(path: Path) -> None:
    path.rename(path.with_name("other.png"))


def touch(path: Path) -> None:
    os.utime(path, (1, 1))


def read(path: Path) -> None:
    path.read_bytes()


INSIDE = {begin_otherwise: True, end_otherwise: True}
OUTSIDE = {grow: True, rename: True, Path.unlink: True, touch: False, read: False}
CHANGES = {**INSIDE, **OUTSIDE}
"""Change of one file → whether the source holds something else afterwards."""
UNSEEN = {"folder": {*INSIDE}, "pattern": {*INSIDE}, "file": {rename, Path.unlink}}
"""Changes that a fingerprint does not show: of several files, names and sizes count."""


@pytest.mark.parametrize("change", CHANGES)
def test_what_counts_as_a_change_does(tmp_path, monkeypatch, change: Callable):
    for kind, end_bytes in itertools.product(UNSEEN, (16, 40, 64)):
        monkeypatch.setattr(provenance, "END_BYTES", end_bytes)
        check_change(tmp_path / f"{kind}-{end_bytes}", kind, change)


@pytest.mark.parametrize("change", CHANGES)
def test_below_a_folder_that_holds_no_images_every_file_counts(tmp_path, change: Callable):
    for number, place in enumerate(("left/images", "right/images")):
        (tmp_path / place).mkdir(parents=True)
        (tmp_path / place / "0.png").write_bytes(bytes(range(number, number + 64)))
    state = describe_state(tmp_path)
    change(tmp_path / "right/images/0.png")
    assert is_replaced(tmp_path, state) is CHANGES[change]


def check_change(folder: Path, kind: str, change: Callable) -> None:
    folder.mkdir()
    for number, name in reversed([*enumerate(NAMES)]):
        (folder / name).write_bytes(bytes(range(number, number + 64)))
    changed = folder / NAMES[1]
    source = {"folder": folder, "pattern": folder / "*.png", "file": changed}[kind]
    before, state = fingerprint(str(source)), describe_state(source)
    assert before is not None
    assert fingerprint(str(folder)) == fingerprint(f"{folder}/*")
    change(changed)
    is_gone = kind == "file" and not changed.exists()
    assert is_gone or (fingerprint(str(source)) != before) is (
        CHANGES[change] and change not in UNSEEN[kind]
    )
    if kind != "pattern":
        assert is_replaced(source, state) is (CHANGES[change] and not is_gone)
