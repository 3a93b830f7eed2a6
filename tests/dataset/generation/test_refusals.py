"""A disk that is full, a folder that is read-only, another specification or version: one line each.

What was made before stays, and the same command goes on when the cause is gone.
"""

import contextlib
import io
import json
import os
import resource
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from tests.dataset.generation.small_sets import clips_recipe, digests

from texvent.cli.app import main

SPECIFICATION = """
name = "tiny"
seed = 1
samples_per_shard = 1
filters = { min_events = 1 }
[options]
fps = 120
interpolate = "none"
[[sources]]
videos = ["clips/*.npy"]
[variants.paper]
seeds = 2
"""


@pytest.fixture(scope="module")
def inputs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A specification of six shards, and the data set as one process makes it."""
    folder = tmp_path_factory.mktemp("inputs")
    clips_recipe(folder)
    (folder / "tiny.toml").write_text(SPECIFICATION)
    done = make(folder, folder / "wanted")
    assert done.returncode == 0, done.stderr
    return folder


@pytest.mark.parametrize("device", ["gpu", "cuda:99"])
def test_a_device_that_is_not_there_is_one_line_and_no_folder(device, inputs, tmp_path):
    done = make(inputs, tmp_path / "set", "--device", device)
    assert done.returncode != 0
    assert len(done.stderr.splitlines()) == 1
    assert not (tmp_path / "set").exists()


def make(
    inputs: Path, out: Path, *words: str, before: Callable[[], None] | None = None
) -> subprocess.CompletedProcess[str]:
    """The command in this process, or in one of its own that begins with `before`."""
    words = ("dataset", "make", "--quiet", str(inputs / "tiny.toml"), "-o", str(out), *words)
    if before:
        command = [sys.executable, "-m", "texvent.cli.app", *words]
        return subprocess.run(command, capture_output=True, text=True, preexec_fn=before)
    with contextlib.redirect_stderr(io.StringIO()) as said:
        code = main([*words, "--workers", "1"])
    return subprocess.CompletedProcess(words, code, "", said.getvalue())


def check_one_line(done: subprocess.CompletedProcess[str]) -> str:
    assert done.returncode in (1, 2, 3)
    lines = done.stderr.strip().splitlines()
    assert len(lines) == 1, done.stderr
    assert lines[0].startswith("error: ")
    return lines[0]


@contextlib.contextmanager
def disk(folder: Path, kilobytes: int) -> Iterator[None]:
    """A disk of its own under a folder; skips where this user may not mount one."""
    folder.mkdir()
    options = ["mount", "-t", "tmpfs", "-o", f"size={kilobytes}k", "tmpfs", str(folder)]
    if os.geteuid() or subprocess.run(options, capture_output=True).returncode:
        pytest.skip("only root may mount a small disk, and not in every container")
    try:
        yield
    finally:
        subprocess.run(["umount", str(folder)], check=True)


def test_a_full_disk(inputs, tmp_path):
    with disk(tmp_path / "disk", 150):
        out = tmp_path / "disk" / "out"
        line = check_one_line(make(inputs, out))
        assert "full" in line or "No space left" in line
        before = digests(out) if out.exists() else {}
        assert len(before) < 6
        assert before.items() <= digests(inputs / "wanted").items()
        subprocess.run(["mount", "-o", "remount,size=8m", str(out.parent)], check=True)
        assert make(inputs, out).returncode == 0
        assert digests(out) == digests(inputs / "wanted")
        assert not list(out.rglob(".texvent-*"))


@pytest.mark.long
def test_files_that_may_not_grow(inputs, tmp_path):
    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (16_000, 16_000))

    out = tmp_path / "out"
    line = check_one_line(make(inputs, out, "--workers", "2", before=limit))
    assert "it grew over the largest file allowed here" in line
    assert not list(out.rglob("*.tar"))
    assert make(inputs, out).returncode == 0
    assert digests(out) == digests(inputs / "wanted")


def test_a_read_only_folder(inputs, tmp_path):
    with disk(tmp_path / "disk", 8000):
        out = tmp_path / "disk" / "out"
        assert make(inputs, out, "--shards", "1/2").returncode == 0
        before = digests(out)
        subprocess.run(["mount", "-o", "remount,ro", str(out.parent)], check=True)
        assert "is not writable" in check_one_line(make(inputs, out))
        subprocess.run(["mount", "-o", "remount,rw", str(out.parent)], check=True)
        assert digests(out) == before
        assert make(inputs, out).returncode == 0
        assert digests(out) == digests(inputs / "wanted")


def test_another_version_of_texvent(inputs, tmp_path):
    out = tmp_path / "out"
    assert make(inputs, out, "--shards", "1/2").returncode == 0
    before, note = digests(out), out / "specification.json"
    text = note.read_text()
    note.write_text(json.dumps({**json.loads(text), "texvent_version": "9.9"}))
    line = check_one_line(make(inputs, out))
    assert "was begun by texvent 9.9" in line
    assert "install that version, or name another folder" in line
    assert main(["dataset", "stats", str(out)]) == 0  # to look at it needs no version
    note.write_text(text)
    assert digests(out) == before
    assert make(inputs, out).returncode == 0


def test_a_kill_while_a_folder_is_begun(inputs, tmp_path):
    out = tmp_path / "out"
    out.mkdir()
    (out / "items.jsonl").write_text((inputs / "wanted" / "items.jsonl").read_text()[:40])
    part = out / ".texvent-0123456789ab.part.json"
    part.touch()
    os.utime(part, (0, 0))  # of another machine, and long dead
    assert make(inputs, out).returncode == 0
    assert digests(out) == digests(inputs / "wanted")
    assert not list(out.rglob(".texvent-*"))
