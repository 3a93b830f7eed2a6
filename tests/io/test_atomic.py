"""Outputs appear whole, replace nothing unasked, and never an input.

`tests/cli/test_nothing_lost.py` spells inputs in other ways.
"""

import errno
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from texvent.errors import OutputError
from texvent.io.atomic import (
    atomic_file,
    check_output,
    check_output_folder,
    is_disk_full,
    protect_inputs,
    protected_inputs,
)


def test_the_file_appears_only_when_the_block_ends(tmp_path):
    target = tmp_path / "out.bin"
    with atomic_file(target, overwrite=False) as part:
        part.write_bytes(b"new")
        assert not target.exists()
        assert (part.parent, part.suffix) == (tmp_path, ".bin")
    assert target.read_bytes() == b"new"
    assert list(tmp_path.iterdir()) == [target]


@pytest.mark.parametrize("error", [ValueError, KeyboardInterrupt, SystemExit, GeneratorExit])
def test_any_exception_leaves_the_old_file_and_nothing_else(tmp_path, error):
    target = tmp_path / "out.bin"
    target.write_bytes(b"old")
    with pytest.raises(error):
        _write_and_raise(target, error)
    assert target.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [target]


def _write_and_raise(target: Path, error: type[BaseException]) -> None:
    with atomic_file(target, overwrite=True) as part:
        part.write_bytes(b"half")
        raise error


def _write_while_another_does(target: Path) -> None:
    with atomic_file(target, overwrite=False) as part:
        part.write_bytes(b"mine")
        target.write_bytes(b"theirs")


def test_a_file_made_by_somebody_else_meanwhile_is_not_replaced(tmp_path):
    target = tmp_path / "out.bin"
    with pytest.raises(OutputError, match="exists already"):
        _write_while_another_does(target)
    assert target.read_bytes() == b"theirs"
    assert list(tmp_path.iterdir()) == [target]


def test_a_missing_folder_is_named_with_the_command_that_makes_it(tmp_path):
    with pytest.raises(OutputError, match="does not exist; create it with: mkdir -p"):
        check_output(tmp_path / "no" / "out.bin", overwrite=False)


def test_folders_and_devices_are_never_replaced(tmp_path):
    with pytest.raises(OutputError, match="it is a folder"):
        check_output(tmp_path, overwrite=True)
    with pytest.raises(OutputError, match="not a regular file"):
        check_output("/dev/null", overwrite=True)


ENTRIES: dict[str, Callable[[Path], object]] = {
    "own": Path.touch,
    "foreign": Path.touch,
    "folder": Path.mkdir,
    "link to a folder": lambda place: place.symlink_to(place.parent, target_is_directory=True),
    "link to nothing": lambda place: place.symlink_to("nothing"),
}


@pytest.mark.parametrize("is_nested", [False, True])
@pytest.mark.parametrize("entry", ENTRIES)
def test_a_folder_is_replaced_if_all_that_it_holds_is_of_its_kind(tmp_path, entry, is_nested):
    (tmp_path / "out").mkdir()
    ENTRIES[entry](tmp_path / "out" / entry)
    options: dict[str, Any] = {"is_own": lambda path: path.name == "own", "is_nested": is_nested}
    is_replaced = entry == "own" or (entry == "folder" and is_nested)
    said = "exists already" if is_replaced else "holds other files"
    with pytest.raises(OutputError, match=said):
        check_output_folder(tmp_path / "out", overwrite=False, **options)
    if is_replaced:
        assert check_output_folder(tmp_path / "out", overwrite=True, **options).is_dir()
        return
    with pytest.raises(OutputError, match=said):
        check_output_folder(tmp_path / "out", overwrite=True, **options)


def test_a_symbolic_link_keeps_pointing_at_the_replaced_file(tmp_path):
    real, link = tmp_path / "real.bin", tmp_path / "link.bin"
    real.write_bytes(b"old")
    link.symlink_to(real)
    with atomic_file(link, overwrite=True) as part:
        part.write_bytes(b"new")
    assert link.is_symlink()
    assert real.read_bytes() == b"new"


def test_other_system_errors_are_not_called_a_full_disk():
    assert not is_disk_full(OSError(errno.EACCES, "Permission denied"))
    assert not is_disk_full(ValueError("No space left on device"))
    assert is_disk_full(OSError(errno.EDQUOT, "Disk quota exceeded"))


@pytest.fixture
def clip(tmp_path: Path) -> Iterator[Path]:
    clip = tmp_path / "clip.mp4"
    clip.write_bytes(b"video")
    with protected_inputs():
        protect_inputs([clip, tmp_path / "missing", "not a file\0"])
        yield clip


def test_nothing_is_put_among_the_files_of_an_input_folder(tmp_path: Path) -> None:
    frames = tmp_path / "frames"
    (frames / "events").mkdir(parents=True)
    with protected_inputs():
        protect_inputs([frames])
        with pytest.raises(OutputError, match="would lie among the files of the input"):
            check_output(frames / "out.png", overwrite=False)
        check_output(frames / "events" / "out.png", overwrite=False)
        check_output(frames / "out.h5", overwrite=False)


def test_a_folder_that_holds_an_input_is_not_replaced(tmp_path: Path) -> None:
    folder = tmp_path / "recording"
    folder.mkdir()
    (folder / "events.txt").write_text("0 1 1 1\n")
    with protected_inputs():
        protect_inputs([folder / "events.txt"])
        with pytest.raises(OutputError, match="it holds the input"):
            check_output_folder(folder, overwrite=True, is_own=lambda path: True)


def test_inputs_are_forgotten_with_their_command(clip: Path) -> None:
    with protected_inputs():
        check_output(clip, overwrite=True)


@pytest.mark.parametrize("name", ["a\0b.h5", "a" * 300 + ".h5"])
def test_a_name_that_no_file_can_have_is_refused_in_one_line(tmp_path: Path, name: str) -> None:
    with pytest.raises(OutputError, match=r"cannot write .* choose another name") as caught:
        check_output(tmp_path / name, overwrite=False)
    assert len(str(caught.value)) < 300
