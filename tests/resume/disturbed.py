"""Commands that resume, and everything that may happen between two of their runs.

`Resumable` is a row of a table of commands. A kill is the folder as it is before a step that
changes it: such copies are taken of a whole run, and each is what the next process would find.
"""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest
from tests.cli.running import run

from texvent.dataset.generation.recipe import load_recipe_once
from texvent.io import atomic

STEPS = ("replace", "rename", "unlink", "remove", "rmdir", "mkdir", "fsync")
"""Functions of `os` that change a folder, or make a change durable."""
NOBODY = 2**22 + 1
"""A number that no process has."""
OF_THE_CLOCK = ("seconds", "seen", "train_seconds")
"""Values that no two runs share: times of work, and states that hold times of change."""


@dataclass(frozen=True, kw_only=True)
class Resumable:
    """A command that resumes, at a small work; it is run in a folder of its own."""

    prepare: Callable[[], None]
    """Writes its inputs."""
    words: tuple[object, ...] = ()
    """The command."""
    run: Callable[..., int] = run
    """Runs the words; returns an exit code."""
    out: str = "out"
    """Folder of its outputs."""
    index: tuple[str, ...] = ()
    """Files in it that say what is done."""
    changes: Mapping[str, Callable[[], tuple[object, ...] | None]] = field(default_factory=dict)
    """Changes of inputs; each gives the words of the run that follows, if they are others."""
    checks: tuple[object, ...] = ()
    """A command that sees damage of outputs at which a second run does not look: those of
    `STATED_ELSEWHERE`."""
    readers: Mapping[str, Callable[[Path], Any]] = field(default_factory=dict)
    """Extension → what is compared of a file; without one, all its bytes."""

    def contents(self) -> dict[str, Any]:
        """Place of every output, hidden ones too → what is compared of it."""
        folder = Path(self.out)
        files = sorted(one for one in folder.rglob("*") if one.is_file())
        return {str(one.relative_to(folder)): self._read(one) for one in files}

    def _read(self, path: Path) -> Any:
        reader = {".json": as_json, ".jsonl": as_rows, **self.readers}.get(path.suffix)
        return path.read_bytes() if reader is None else reader(path)


def as_json(path: Path) -> Any:
    """Values of a JSON file without those of the clock."""
    return _timeless(json.loads(path.read_text()))


def as_rows(path: Path) -> Any:
    """The last line of every key, without values of the clock."""
    rows = [_timeless(json.loads(line)) for line in path.read_text().splitlines()]
    return {row.get("key", number): row for number, row in enumerate(rows)}


def _timeless(value: Any) -> Any:
    if isinstance(value, dict):
        return {n: _timeless(one) for n, one in value.items() if n not in OF_THE_CLOCK}
    return [_timeless(one) for one in value] if isinstance(value, list) else value


def restore(state: Path) -> None:
    """Make the working directory what it was, as a new process finds it."""
    for one in Path().iterdir():
        shutil.rmtree(one) if one.is_dir() else one.unlink()
    shutil.copytree(state, Path(), dirs_exist_ok=True)
    atomic._swept.clear()
    load_recipe_once.cache_clear()


@contextmanager
def kills(kept: Path) -> Iterator[list[Path]]:
    """Copies of the working directory before every step inside the block.

    Of those in which the same is visible, the one with most hidden parts; parts have the name of a
    process that is dead.
    """
    found: dict[str, tuple[int, Path]] = {}
    copies: list[Path] = []
    lock, here = threading.RLock(), Path.cwd()
    is_copying = False

    def take() -> None:
        paths = sorted(here.rglob("*"))
        hidden = [one for one in paths if atomic.PREFIX in str(one)]
        shown = [one for one in paths if one.is_file() and one not in hidden]
        seen = repr([(str(one), one.read_bytes()) for one in shown]).encode()
        key = hashlib.sha256(seen).hexdigest()
        if key in found and found[key][0] >= len(hidden):
            return
        place = kept / f"{len(list(kept.iterdir())):03d}"
        shutil.copytree(here, place)
        for one in sorted(place.rglob(f"{atomic.PREFIX}*"), reverse=True):
            one.rename(one.with_name(one.name.replace(f"-{os.getpid()}-", f"-{NOBODY}-")))
        found[key] = len(hidden), place

    def watched(function: Callable[..., Any]) -> Callable[..., Any]:
        def call(*words: Any, **named: Any) -> Any:
            nonlocal is_copying
            with lock:
                if not is_copying:
                    is_copying = True
                    try:
                        take()
                    finally:
                        is_copying = False
                return function(*words, **named)

        return call

    with pytest.MonkeyPatch.context() as patch:
        for name in STEPS:
            patch.setattr(os, name, watched(getattr(os, name)))
        yield copies
    copies += [place for _, place in found.values()]


@dataclass(frozen=True)
class Runs:
    """A command run without disturbance, and the folders that kills of it leave."""

    command: Resumable
    begun: Path
    """The folder before."""
    done: Path
    """The folder after."""
    killed: list[Path]
    whole: dict[str, Any]
    """Contents of the outputs."""


@contextmanager
def undisturbed(command: Resumable, places: Path) -> Iterator[Runs]:
    """A command run in a folder inside `places`, which is the working directory in the block."""
    here, kept = places / "here", places / "kept"
    for one in (here, kept):
        one.mkdir()
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(here)
        command.prepare()
        shutil.copytree(here, places / "begun")
        with kills(kept) as killed:
            assert command.run(*command.words) == 0
        shutil.copytree(here, places / "done")
        yield Runs(command, places / "begun", places / "done", killed, command.contents())


def goes_on_after_every_kill(runs: Runs) -> None:
    assert len(runs.killed) > 3
    for killed in runs.killed:
        restore(killed)
        assert runs.command.run(*runs.command.words) == 0, killed.name
        assert runs.command.contents() == runs.whole, killed.name


def notices_every_change(runs: Runs, capsys: pytest.CaptureFixture[str]) -> None:
    """Every change ends as a run of the changed inputs in a new folder, or is refused."""
    command = runs.command
    for name, change in command.changes.items():
        restore(runs.begun)
        words = change() or command.words
        assert command.run(*words) == 0, name
        expected = command.contents()
        restore(runs.done)
        change()
        if not is_refused(command.run, words, capsys):
            assert command.contents() == expected, name


def is_refused(
    run: Callable[..., int], words: tuple[object, ...], capsys: pytest.CaptureFixture[str]
) -> bool:
    """Whether a run ends with one line that says why."""
    capsys.readouterr()
    code = run(*words)
    errors = [line for line in capsys.readouterr().err.splitlines() if line.startswith("error: ")]
    assert (code != 0) == (len(errors) == 1)
    return code != 0


HARMS: Mapping[str, Callable[[bytes, bytes], bytes | None]] = {
    "deleted": lambda content, older: None,
    "truncated": lambda content, older: content[: len(content) // 2],
    "flipped": lambda content, older: _flipped(content),
    "older": lambda content, older: older,
    "cut": lambda content, older: content[:-9],
    "emptied": lambda content, older: b"",
}
"""Name → content of a damaged file, from that before and that of another run; None: no file."""
OF_OUTPUTS = ("truncated", "flipped", "older")
OF_INDICES = ("deleted", "cut", "emptied")
STATED_ELSEWHERE = ("flipped", "older")
"""Damage that leaves the size of a file as it was, or may leave it."""
Harms = Callable[[int], tuple[str, ...]]
"""Number of an output → what is done to it."""


def FEW(number: int) -> tuple[str, ...]:
    """It is deleted, and damaged in one way."""
    return ("deleted", OF_OUTPUTS[number % len(OF_OUTPUTS)])


def ALL(number: int) -> tuple[str, ...]:
    """Everything."""
    return ("deleted", *OF_OUTPUTS)


def _flipped(content: bytes) -> bytes:
    middle = len(content) // 2
    return (
        content[:middle]
        + bytes(one ^ 0x10 for one in content[middle : middle + 1])
        + (content[middle + 1 :])
    )


def makes_damaged_outputs_again(
    runs: Runs, harms: Harms, capsys: pytest.CaptureFixture[str]
) -> None:
    """Damaged outputs are made again or named, by the command or by the one that checks them."""
    command, older = runs.command, _older(runs)
    for place, how in _damage(command, runs.whole, harms):
        restore(runs.done)
        path, other = Path(command.out, place), older / place
        before = path.read_bytes()
        content = HARMS[how](before, other.read_bytes() if other.exists() else before)
        if content == before:
            continue
        path.unlink() if content is None else path.write_bytes(content)
        if is_refused(command.run, command.words, capsys) or command.contents() == runs.whole:
            continue
        assert how in STATED_ELSEWHERE, (place, how)
        assert command.checks, (place, how)
        assert command.run(*command.checks) != 0, (place, how)


def _older(runs: Runs) -> Path:
    """Outputs of a run on another content, under the same names where those do not tell."""
    older = runs.done.with_name("older")
    if "content" in runs.command.changes and not older.exists():
        restore(runs.begun)
        runs.command.changes["content"]()
        runs.command.run(*runs.command.words)
        shutil.copytree(runs.command.out, older)
    return older


def _damage(
    command: Resumable, whole: Mapping[str, Any], harms: Harms
) -> Iterator[tuple[str, str]]:
    """Place of one file of every kind, and what is done to it."""
    kinds: dict[object, str] = {}
    for place in whole:
        path = Path(place)
        is_index = any(map(path.match, command.index))
        kind = place if is_index and len(path.parts) == 1 else (len(path.parts), path.suffixes[-2:])
        kinds.setdefault(repr((is_index, kind)), place)
    for number, place in enumerate(kinds.values()):
        is_index = any(map(Path(place).match, command.index))
        for how in OF_INDICES if is_index else harms(number):
            yield place, how
