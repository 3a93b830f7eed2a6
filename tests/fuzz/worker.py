"""A process that reads damaged inputs one after another, and its parent, which ends it in time.

Whatever libraries print goes nowhere. The parent ends the process when a reader hangs or fills the
memory, and begins another one.
"""

import functools
import multiprocessing
import os
import random
import resource
import shutil
import signal
import tempfile
import time
import traceback
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

from texvent.errors import MissingDependencyError, TexventError, TexventWarning

from .array_damage import CODE_RAN
from .damage import damage_input, nudge_input
from .event_readers import event_readers
from .frame_readers import frame_readers
from .lab_readers import lab_readers
from .motion_readers import motion_readers
from .reader import Reader, digest
from .text_readers import text_readers

PREPARE_SECONDS = 120.0
"""Loading libraries and compiling kernels for a reader's sound input."""
MAX_SECONDS, KILL_SECONDS = 10.0, 120.0
MAX_GROWTH_BYTES = 10**9
ADDRESS_SPACE_MARGIN = 3 * 2**30
"""What a reader may reserve beyond what the process holds; more is MemoryError."""
LONGEST_ERROR = 300
"""Characters of an error, its path left out."""
BAD = ("several lines", "too long", "traceback", "hang", "blow-up", "signal", "code ran")
"""Outcomes that must never be. Others: "same" and "changed" (read, with which content), "refused"
(one line of error), "warned", "not run" (a package is missing)."""


@functools.cache
def readers() -> dict[str, Reader]:
    """Name → reader."""
    pictures = [*frame_readers(), *motion_readers()]
    found = [*event_readers(), *pictures, *text_readers(), *lab_readers()]
    return {reader.name: reader for reader in found}


@dataclass(frozen=True)
class Outcome:
    """What became of one input."""

    kind: str
    detail: str = ""
    damage: str = ""


class Worker:
    """One process at a time; a new one after one that had to be ended."""

    def __init__(self) -> None:
        self._process: Any = None
        self._pipe: Any = None

    def one(self, name: str, number: int, finding: Path | None = None) -> Outcome:
        """Outcome of one damaged input, or of a kept finding."""
        if self._process is None:
            context = multiprocessing.get_context("spawn")
            self._pipe, theirs = context.Pipe()
            self._process = context.Process(target=_serve, args=(theirs,), daemon=True)
            self._process.start()
            theirs.close()
        self._pipe.send((name, number, finding))
        damage = self._receive(PREPARE_SECONDS)
        if isinstance(damage, Outcome):
            assert damage.kind == "not run", f"{name} cannot be fuzzed: {damage.detail}"
            return damage
        found = self._receive(KILL_SECONDS)
        if found.kind in ("hang", "blow-up"):
            self.end()
        return Outcome(found.kind, found.detail, damage)

    def _receive(self, seconds: float) -> Any:
        """The next answer, or what became of a process that gives none."""
        try:
            if self._pipe.poll(seconds):
                return self._pipe.recv()
            self.end()
            return Outcome("hang", f"no end after {seconds:g} s")
        except EOFError:
            self._process.join()
            code, self._process = self._process.exitcode, None
            return Outcome("signal", signal.Signals(-code).name if code < 0 else f"exit {code}")

    def end(self) -> None:
        """End the process, if there is one."""
        if self._process is not None:
            self._process.kill()
            self._process.join()
            self._process = None


def _serve(pipe: Connection) -> None:
    """Answer until the parent closes the pipe: first the kind of damage, then the outcome."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    for stream in (1, 2):
        os.dup2(nowhere, stream)
    warnings.simplefilter("error")
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        sound: dict[str, tuple[Path, Path, Any]] = {}
        while True:
            try:
                name, number, finding = pipe.recv()
            except EOFError:
                break
            try:
                _answer(pipe, Path(folder), sound, (readers()[name], number, finding))
            except MissingDependencyError as error:
                pipe.send(Outcome("not run", str(error).split(";")[0]))
            except Exception:  # noqa: BLE001  # the fuzzer itself is wrong
                pipe.send(Outcome("broken", traceback.format_exc(limit=-6)))
        os.chdir("/")


def _answer(
    pipe: Connection,
    folder: Path,
    sound: dict[str, tuple[Path, Path, Any]],
    task: tuple[Reader, int, Path | None],
) -> None:
    reader, number, finding = task
    if reader.name not in sound:
        # Read once, so that what loads and compiles does so untimed.
        place = Path(tempfile.mkdtemp(dir=folder))
        path = reader.make(place)
        sound[reader.name] = place, path.relative_to(place), reader.read(path)
    place, relative, wanted = sound[reader.name]
    copy = folder / "damaged"
    shutil.rmtree(copy, ignore_errors=True)
    shutil.copytree(place, copy)
    if finding is None:
        change = nudge_input if number % 2 else damage_input
        damage = change(random.Random(f"{reader.name} {number}"), copy)
    else:
        shutil.copy(finding, copy / relative)
        damage = f"finding {finding.name}"
    pipe.send(damage)
    before = _memory("VmRSS")
    Path("/proc/self/clear_refs").write_text("5")
    start = time.process_time()  # which other programs do not lengthen
    with _bounded_memory():
        result = outcome_of(reader, copy / relative, wanted)
    seconds, growth = time.process_time() - start, _memory("VmHWM") - before
    if seconds > MAX_SECONDS:
        result = Outcome("hang", f"{seconds:.1f} s, then {result}")
    if growth > MAX_GROWTH_BYTES:
        result = Outcome("blow-up", f"{growth >> 20} MiB, then {result}")
    if (folder / CODE_RAN).exists():
        result = Outcome("code ran")
        (folder / CODE_RAN).rmdir()
    pipe.send(result)


def outcome_of(reader: Reader, path: Path, sound: Any) -> Outcome:
    """What became of an input, and the error in words."""
    try:
        found = reader.read(path)
    except TexventError as error:
        message = str(error)
        bare = message.replace(f"{path}", "").replace(f"{path.parent}", "")
        kind = "refused" if len(bare) < LONGEST_ERROR else "too long"
        return Outcome("several lines" if "\n" in message else kind, bare[:700])
    except TexventWarning:
        return Outcome("warned")
    except MemoryError:
        return Outcome("blow-up", traceback.format_exc(limit=-4))
    except Exception:  # noqa: BLE001  # any other error is what is looked for
        return Outcome("traceback", traceback.format_exc(limit=-4))
    return Outcome("same") if found == sound else Outcome("changed", digest([found])[:8])


def _memory(field: str) -> int:
    """A field of the process's status, bytes."""
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith(field):
            return int(line.split()[1]) * 1024
    raise AssertionError(field)


@contextmanager
def _bounded_memory() -> Iterator[None]:
    hard = resource.getrlimit(resource.RLIMIT_AS)[1]
    resource.setrlimit(resource.RLIMIT_AS, (_memory("VmSize") + ADDRESS_SPACE_MARGIN, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (hard, hard))
