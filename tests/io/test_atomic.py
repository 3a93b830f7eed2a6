import errno
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from texvent.errors import OutputError
from texvent.io.atomic import atomic_file, check_output, check_output_folder, is_disk_full


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
