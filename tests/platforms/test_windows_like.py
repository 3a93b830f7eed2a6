"""Without what Windows lacks texvent works, or refuses in one clear line. Not run on Windows."""

from __future__ import annotations

import errno
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from tests.platforms import windows_like

from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import InputError, OutputError
from texvent.generate.opensora.external_program import run_program
from texvent.io import atomic
from texvent.io.atomic import atomic_file, atomic_folder
from texvent.runtime import memory


@pytest.fixture
def no_posix(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(atomic, "CAN_SWEEP", False)
    for name in ("O_DIRECTORY", "O_NOFOLLOW", "pread", "sysconf"):
        monkeypatch.delattr(os, name)
    for name in windows_like.MODULES:
        monkeypatch.setitem(sys.modules, name, None)


@pytest.mark.nightly
def test_every_module_is_imported_and_the_main_commands_run(tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, windows_like.__file__],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    count = re.search(r"^events +([\d,]+)$", done.stdout, re.MULTILINE)
    assert count is not None
    assert f"ramp.aedat4: {count[1]} events" in done.stdout
    assert "memory not told by this system" in done.stdout
    assert "memory unknown" in done.stdout
    assert {path.name for path in tmp_path.iterdir()} == {"ramp.npy", "ramp.h5", "ramp.aedat4"}


@pytest.mark.usefixtures("no_posix")
def test_files_and_folders_appear_whole_without_locks(tmp_path: Path) -> None:
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


def test_parts_without_locks_are_not_held_open_while_they_are_renamed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Windows would refuse the rename.
    monkeypatch.setattr(atomic, "CAN_SWEEP", False)
    with atomic.hidden_file(tmp_path, ".h5") as part:
        held = {os.readlink(f"/proc/self/fd/{number}") for number in open_descriptors()}
        assert str(part) not in held


def open_descriptors() -> list[str]:
    return [name for name in os.listdir("/proc/self/fd") if os.path.exists(f"/proc/self/fd/{name}")]


def test_a_file_that_another_program_has_open_is_refused_in_one_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
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
def test_memory_that_the_system_does_not_tell_is_assumed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(memory, "_CONTROL_GROUPS", ())
    assert memory.machine_bytes() is None
    assert memory.peak_bytes() is None
    assert memory.usable_bytes.__wrapped__() == int(memory.SHARE * memory.UNKNOWN_BYTES)


@pytest.mark.parametrize(("system", "words"), [("win32", "dshow"), ("darwin", "avfoundation")])
def test_a_camera_named_as_on_linux_is_refused_with_another_way(
    system: str, words: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "platform", system)
    with pytest.raises(InputError, match=rf"a camera's name on Linux.*ffmpeg -f {words} .* -o"):
        open_frames("/dev/video77", CaptureConfig())


def test_a_program_and_its_log_end_without_process_groups(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    wait = subprocess.Popen.wait
    waited: list[subprocess.Popen[bytes]] = []

    def interrupted_once(self: subprocess.Popen[bytes], timeout: float | None = None) -> int:
        waited.append(self)
        if len(waited) == 1:
            raise KeyboardInterrupt
        return wait(self, timeout)

    monkeypatch.delattr(os, "killpg")
    monkeypatch.setattr(subprocess.Popen, "wait", interrupted_once)
    with pytest.raises(KeyboardInterrupt):
        run_program(["sleep", "60"], cwd=tmp_path, log=tmp_path / "log")
    assert waited[0].returncode is not None
