"""What a killed process leaves behind is removed by the next one, and nothing else is."""

import os
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from subprocess import PIPE, Popen

import pytest

from texvent.io.atomic import atomic_file
from texvent.runtime.files import hidden_parts
from texvent.runtime.files.hidden_parts import hidden_file, hidden_folder, remove_own_parts

HOLD = """
import sys
from pathlib import Path
from texvent.io.atomic import atomic_file, atomic_folder
from texvent.runtime.files.hidden_parts import hidden_file, hidden_folder, remove_own_parts

target = Path(sys.argv[1])
if target.suffix:
    context = atomic_file(target, overwrite=True)
else:
    context = atomic_folder(target, overwrite=True, is_own=lambda path: True)
with context as part:
    if part.is_dir():
        (part / "half").write_text("half")
    sys.stdout.write("writing\\n")
    sys.stdout.flush()
    sys.stdin.read()
"""
DIE_BETWEEN_RENAMES = """
import os, sys
from pathlib import Path
from texvent.io.atomic import atomic_folder

rename = os.replace

def die(source, target):
    if str(target) == sys.argv[1]:
        os._exit(9)
    rename(source, target)

os.replace = die
with atomic_folder(Path(sys.argv[1]), overwrite=True, is_own=lambda path: True) as part:
    (part / "events").write_text("new")
"""


@pytest.fixture(autouse=True)
def _forget_swept_folders(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(hidden_parts, "_swept", set())


@pytest.fixture(params=["out.h5", "folder"])
def holder(
    request: pytest.FixtureRequest, tmp_path: Path, spawn: Callable[..., Popen[str]]
) -> Popen[str]:
    """A process that writes a file or a folder until it is told to go on."""
    words = [sys.executable, "-c", HOLD, str(tmp_path / request.param)]
    process = spawn(words, stdin=PIPE, stdout=PIPE, text=True)
    assert process.stdout is not None
    assert process.stdout.readline() == "writing\n"
    return process


def test_parts_of_a_killed_process_go_at_the_next_run(tmp_path: Path, holder: Popen[str]) -> None:
    holder.send_signal(signal.SIGKILL)
    holder.communicate()
    assert len(list(tmp_path.glob(".texvent-*"))) == 1
    with atomic_file(tmp_path / "next.bin", overwrite=False) as part:
        part.write_bytes(b"next")
    assert [path.name for path in tmp_path.iterdir()] == ["next.bin"]


def test_parts_of_a_living_process_stay(tmp_path: Path, holder: Popen[str]) -> None:
    (living,) = tmp_path.glob(".texvent-*")
    with atomic_file(tmp_path / "next.bin", overwrite=False) as part:
        part.write_bytes(b"next")
    assert living.exists()
    holder.communicate("")
    assert {path.name for path in tmp_path.iterdir()} == {"next.bin", Path(holder.args[-1]).name}


def test_the_own_open_parts_and_files_of_others_stay(tmp_path: Path) -> None:
    others = [tmp_path / name for name in (".texvent-notes", "texvent-1.part.h5", ".hidden.part")]
    for other in others:
        other.write_text("mine")
    with atomic_file(tmp_path / "a.bin", overwrite=False) as part:
        hidden_parts._swept.clear()
        hidden_parts.sweep(tmp_path)
        assert part.exists()
        part.write_bytes(b"a")
    assert all(other.read_text() == "mine" for other in others)


def test_a_signal_between_the_making_and_the_block_leaves_nothing(tmp_path: Path) -> None:
    # A signal may end a context manager after it was entered and before its block begins.
    (tmp_path / "kept").mkdir()
    file, folder = hidden_file(tmp_path, ".h5"), hidden_folder(tmp_path)
    old = hidden_folder(tmp_path, ".old")
    file.__enter__(), folder.__enter__()
    (tmp_path / "kept").rename(old.__enter__() / "kept")
    remove_own_parts()
    assert [path.name for path in tmp_path.iterdir()] == ["kept"]


def test_a_link_with_the_name_of_a_part_is_not_followed(tmp_path: Path) -> None:
    precious = tmp_path / "precious"
    precious.mkdir()
    (precious / "file").write_text("kept")
    (tmp_path / ".texvent-0.part").symlink_to(precious)
    hidden_parts.sweep(tmp_path)
    assert (precious / "file").read_text() == "kept"


def test_a_folder_caught_between_two_renames_gets_its_name_back(tmp_path: Path) -> None:
    target = tmp_path / "recording"
    target.mkdir()
    (target / "events").write_text("old")
    command = [sys.executable, "-c", DIE_BETWEEN_RENAMES, str(target)]
    assert subprocess.run(command, check=False).returncode == 9
    assert not target.exists()
    hidden_parts.sweep(tmp_path)
    assert (target / "events").read_text() == "old"
    assert [path.name for path in tmp_path.iterdir()] == ["recording"]


SWEEP_ALL = """
import sys
from pathlib import Path
from texvent.runtime.files import hidden_parts
hidden_parts._is_dead = lambda part: True  # as in another PID namespace
hidden_parts.sweep(Path(sys.argv[1]))
"""


def test_another_pid_namespace_removes_no_part_that_is_written(tmp_path: Path) -> None:
    import h5py

    def sweep() -> None:
        subprocess.run([sys.executable, "-c", SWEEP_ALL, str(tmp_path)], check=True)

    with hidden_file(tmp_path, ".h5") as file, hidden_folder(tmp_path) as folder:
        with h5py.File(file, "w"):  # HDF5 locks its files, too
            sweep()
        sweep()
        assert file.is_file()
        assert folder.is_dir()
    (tmp_path / ".texvent-x-1-x.part.h5").touch()
    sweep()
    assert list(tmp_path.iterdir()) == []


def test_parts_of_other_users_stay(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    part = tmp_path / ".texvent-x-1-x.old"
    (part / "mine").mkdir(parents=True)
    os.utime(part, (1, 1))
    user = os.geteuid()
    monkeypatch.setattr(os, "geteuid", lambda: user + 1)
    hidden_parts.sweep(tmp_path)
    assert list(tmp_path.iterdir()) == [part]
