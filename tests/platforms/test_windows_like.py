"""Without what Windows lacks texvent works, or refuses in one clear line. Not run on Windows."""

import errno
import os
import sys
from pathlib import Path

import pytest

from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import InputError, OutputError
from texvent.io.atomic import atomic_file, atomic_folder
from texvent.runtime import memory
from texvent.runtime.files import hidden_parts


@pytest.fixture
def no_posix(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(hidden_parts, "CAN_SWEEP", False)
    for name in ("O_DIRECTORY", "O_NOFOLLOW", "pread", "sysconf"):
        monkeypatch.delattr(os, name)
    for name in ("fcntl", "grp", "pwd", "resource", "termios", "tty", "pty"):
        monkeypatch.setitem(sys.modules, name, None)


@pytest.mark.usefixtures("no_posix")
def test_files_and_folders_appear_whole_without_locks(tmp_path):
    left = tmp_path / ".texvent-0.part.h5"
    left.write_bytes(b"of a killed process, or of one that lives")
    for content in (b"one", b"two"):
        with atomic_file(tmp_path / "a.bin", overwrite=True) as part:
            part.write_bytes(content)
        with atomic_folder(tmp_path / "set", overwrite=True, is_own=lambda path: True) as part:
            (part / "shard").write_bytes(content)
    with pytest.raises(ZeroDivisionError), atomic_file(tmp_path / "b.bin", overwrite=True):
        raise ZeroDivisionError
    assert (tmp_path / "a.bin").read_bytes() == (tmp_path / "set/shard").read_bytes() == b"two"
    assert {path.name for path in tmp_path.iterdir()} == {"a.bin", "set", left.name}


def test_a_file_that_another_program_has_open_is_refused_in_one_line(tmp_path, monkeypatch):
    target = tmp_path / "a.bin"
    target.write_bytes(b"old")

    def refuse(source: Path, target: Path) -> None:  # as Windows does
        raise PermissionError(errno.EACCES, "Access is denied", str(source), None, str(target))

    monkeypatch.setattr(os, "replace", refuse)
    with (
        pytest.raises(
            OutputError, match=r"a\.bin: Access is denied; end what has the old one open"
        ),
        atomic_file(target, overwrite=True) as part,
    ):
        part.write_bytes(b"new")
    assert target.read_bytes() == b"old"
    assert [path.name for path in tmp_path.iterdir()] == ["a.bin"]


@pytest.mark.usefixtures("no_posix")
def test_memory_that_the_system_does_not_tell_is_assumed(monkeypatch):
    monkeypatch.setattr(memory, "_CONTROL_GROUPS", ())
    assert memory.machine_bytes() is None
    assert memory.usable_bytes.__wrapped__() == int(memory.SHARE * memory.UNKNOWN_BYTES)


@pytest.mark.parametrize(("system", "words"), [("win32", "dshow"), ("darwin", "avfoundation")])
def test_a_camera_named_as_on_linux_is_refused_with_another_way(system, words, monkeypatch):
    monkeypatch.setattr(sys, "platform", system)
    with pytest.raises(InputError, match=rf"a camera's name on Linux.*ffmpeg -f {words} .* -o"):
        open_frames("/dev/video77", CaptureConfig())
