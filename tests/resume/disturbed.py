"""Commands that resume, and what may happen between two of their runs.

A kill is the folder as it is before a step that changes it: such copies are taken of a whole run,
and each is what the next process would find.
"""

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
from tests.examples import one_of

from texvent.dataset.generation.recipe import _recipe_in
from texvent.runtime.files import hidden_parts

STEPS = ("replace", "rename", "unlink", "remove", "rmdir", "mkdir", "fsync")
"""Functions of `os` that change a folder, or make a change durable."""
NOBODY = 2**22 + 1
"""A number that no process has."""
OF_THE_CLOCK = ("seconds", "training_seconds", "seen", "commit")
"""Times of work, states that hold times of change, and the tree, which may be edited meanwhile: no
two runs share them."""


@dataclass(frozen=True, kw_only=True)
class Resumable:
    """A command that resumes, at a small work; it is run in a folder of its own."""

    prepare: Callable[[], None]
    """Writes its inputs."""
    words: tuple[object, ...]
    """The command; its outputs are in the folder `out`."""
    index: tuple[str, ...]
    """Patterns of files there that say what is done."""
    rewritten: tuple[str, ...] = ()
    """Patterns of those that every run writes."""
    named: tuple[str, ...] = ()
    """Patterns of those that are named after all that they depend on, so old ones may stay."""
    changes: Mapping[str, Callable[[], tuple[object, ...] | None]] = field(default_factory=dict)
    """Changes of inputs; each gives the words of the run that follows, if they are others."""
    checks: tuple[object, ...] = ()
    """A command that sees damage that leaves the size of an output as it was, where a second run
    does not look."""
    readers: Mapping[str, Callable[[Path], Any]] = field(default_factory=dict)
    """Extension → what is compared of a file; else its bytes, or values without the clock's."""

    def outputs(self) -> dict[str, Any]:
        """Place of every output, also of hidden ones → what is compared of it."""
        readers = {".json": _as_json, ".jsonl": _as_rows, **self.readers}
        files = sorted(one for one in Path("out").rglob("*") if one.is_file())
        return {str(one): readers.get(one.suffix, Path.read_bytes)(one) for one in files}

    def states(self) -> dict[str, tuple[int, int]]:
        """Place of every output that one run writes → its number on the disk, time of change."""
        again = (*self.index, *self.rewritten)
        found = {name: Path(name).stat() for name in self.outputs()}
        return {
            name: (one.st_ino, one.st_mtime_ns)
            for name, one in found.items()
            if not any(map(Path(name).match, again))
        }


def _as_json(path: Path) -> Any:
    return _timeless(json.loads(path.read_text(), parse_constant=str))  # NaN is NaN


def _as_rows(path: Path) -> Any:
    """The last line of every key: others say that it was begun."""
    rows = [_timeless(json.loads(line)) for line in path.read_text().splitlines()]
    return {row.get("key", number): row for number, row in enumerate(rows)}


def _timeless(value: Any) -> Any:
    if isinstance(value, dict):
        return {name: _timeless(one) for name, one in value.items() if name not in OF_THE_CLOCK}
    return [*map(_timeless, value)] if isinstance(value, list) else value


@dataclass(frozen=True)
class Runs:
    """A command that nothing disturbed: the folder before, after and when it was killed."""

    command: Resumable
    begun: Path
    done: Path
    killed: list[Path]
    whole: dict[str, Any]

    def run_again(self, state: Path, words: tuple[object, ...] = ()) -> int:
        """The exit code of a run in a folder as it was, by what could be a new process."""
        restore(state)
        return run(*(words or self.command.words))


@contextmanager
def undisturbed(command: Resumable, places: Path) -> Iterator[Runs]:
    """A command run in a folder of `places`, which is the working directory inside the block."""
    here, begun, done, killed = (places / name for name in ("here", "begun", "done", "killed"))
    here.mkdir()
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(here)
        command.prepare()
        shutil.copytree(here, begun)
        with kills(killed):
            assert run(*command.words) == 0
        shutil.copytree(here, done)
        yield Runs(command, begun, done, sorted(killed.iterdir()), command.outputs())


def restore(state: Path) -> None:
    """Make the working directory what it was, as a new process finds it."""
    for one in Path().iterdir():
        shutil.rmtree(one) if one.is_dir() else one.unlink()
    shutil.copytree(state, Path(), dirs_exist_ok=True)
    hidden_parts._swept.clear()
    _recipe_in.cache_clear()


@contextmanager
def kills(kept: Path) -> Iterator[None]:
    """Keep the working directory before every step inside the block, as a kill leaves it.

    Of those in which the same is visible, the one with most hidden parts; parts have the name of a
    process that is dead.
    """
    found: dict[str, tuple[int, Path]] = {}
    lock, here, is_copying = threading.RLock(), Path.cwd(), False

    def keep() -> None:
        paths = sorted(one for one in here.rglob("*") if one.is_file())
        shown = {str(one): one.read_bytes() for one in paths if hidden_parts.PREFIX not in str(one)}
        parts = len(paths) - len(shown)
        before, place = found.get(repr(shown), (-1, kept / f"{len(found):03d}"))
        if parts <= before:
            return
        shutil.rmtree(place, ignore_errors=True)
        shutil.copytree(here, place)
        for one in sorted(place.rglob(f"{hidden_parts.PREFIX}*"), reverse=True):
            one.rename(one.with_name(one.name.replace(f"-{os.getpid()}-", f"-{NOBODY}-")))
        found[repr(shown)] = parts, place

    def watched(step: Callable[..., Any]) -> Callable[..., Any]:
        def call(*words: Any, **named: Any) -> Any:
            nonlocal is_copying
            with lock:
                if not is_copying:
                    is_copying = True
                    keep()
                    is_copying = False
                return step(*words, **named)

        return call

    with pytest.MonkeyPatch.context() as patch:
        for name in STEPS:
            patch.setattr(os, name, watched(getattr(os, name)))
        yield


def kill_it(runs: Runs, capsys: pytest.CaptureFixture[str]) -> None:
    """Killed at any instant it goes on, and nothing is left of the process that died."""
    assert len(runs.killed) > 3
    for killed in runs.killed[:: one_of()]:
        assert runs.run_again(killed) == 0, killed.name
        assert runs.command.outputs() == runs.whole, killed.name


def run_it_twice(runs: Runs, capsys: pytest.CaptureFixture[str]) -> None:
    """Outputs that are all there are not made again, though inputs were touched."""
    restore(runs.done)
    before = runs.command.states()
    for one in Path().rglob("*"):
        if one.is_file() and "out" not in one.parts:
            os.utime(one, (1, 1))
    assert run(*runs.command.words) == 0
    assert runs.command.states() == before
    assert runs.command.outputs() == runs.whole


def change_its_inputs(runs: Runs, capsys: pytest.CaptureFixture[str]) -> None:
    """Every change ends as a run of the changed inputs in a new folder, or is refused."""
    for name, change in runs.command.changes.items():
        restore(runs.begun)
        words = change() or runs.command.words
        assert run(*words) == 0, name
        expected = runs.command.outputs()
        restore(runs.done)
        change()
        if not _is_refused(words, capsys):
            found = runs.command.outputs()
            for old in found.keys() - expected.keys():
                if any(map(Path(old).match, runs.command.named)):
                    del found[old]
            assert found == expected, name


def damage_its_outputs(
    runs: Runs, capsys: pytest.CaptureFixture[str], *, how_often: int = 1
) -> None:
    """What is damaged is made again or refused, or a command that checks outputs says it."""
    command, kinds = runs.command, dict[str, str]()
    for name in runs.whole:
        path = Path(name)
        is_state = len(path.parts) == 2 and any(map(path.match, command.index))
        is_state |= path.name in command.index
        kinds.setdefault(name if is_state else f"{len(path.parts)} {path.suffixes[-2:]}", name)
    for number, name in enumerate(kinds.values()):
        some = [OF_OUTPUTS[(number + n) % len(OF_OUTPUTS)] for n in range(how_often)]
        is_index = any(map(Path(name).match, command.index))
        for how in OF_INDICES if is_index else ("deleted", *some):
            restore(runs.done)
            content = DAMAGE[how](Path(name).read_bytes())
            Path(name).unlink() if content is None else Path(name).write_bytes(content)
            if _is_refused(command.words, capsys) or command.outputs() == runs.whole:
                continue
            assert (how, command.checks != ()) == ("flipped", True), (name, how)
            assert run(*command.checks) != 0, (name, how)


def damage_its_outputs_in_every_way(runs: Runs, capsys: pytest.CaptureFixture[str]) -> None:
    """As `damage_its_outputs`."""
    damage_its_outputs(runs, capsys, how_often=len(OF_OUTPUTS))


def _is_refused(words: tuple[object, ...], capsys: pytest.CaptureFixture[str]) -> bool:
    """Whether a run ends with one line that says why."""
    capsys.readouterr()
    code = run(*words)
    errors = [line for line in capsys.readouterr().err.splitlines() if line.startswith("error: ")]
    assert len(errors) == (code != 0), (code, errors)
    return code != 0


def _flipped(content: bytes) -> bytes:
    middle = len(content) // 2
    return bytes(one ^ 16 if place == middle else one for place, one in enumerate(content))


DAMAGE: Mapping[str, Callable[[bytes], bytes | None]] = {
    "deleted": lambda content: None,
    "truncated": lambda content: content[: len(content) // 2],
    "flipped": _flipped,
    "cut": lambda content: content[:-9],
    "emptied": lambda content: b"",
    "begun otherwise": lambda content: b"x" + content[1:],
}
"""Name → content of a damaged file, from that before; None: no file."""
OF_OUTPUTS, OF_INDICES = ("truncated", "flipped"), ("deleted", "cut", "emptied", "begun otherwise")
DISTURBANCES = [
    *(kill_it, run_it_twice, change_its_inputs, damage_its_outputs),
    pytest.param(damage_its_outputs_in_every_way, marks=pytest.mark.nightly),
]
